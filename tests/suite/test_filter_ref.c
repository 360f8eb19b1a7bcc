/* SPDX-License-Identifier: MIT */
/* test_filter_ref.c - the reference filter on pictures whose answer is known without it. */
#include "tests/host.h"
#include "tests/ref/filter_ref.h"
#include "tools/ref/ref.h"
#include "smear.h"

enum { WIDTH = 60, HEIGHT = 44, PIXELS = WIDTH * HEIGHT, TILE = 16 };

/* A picture to be filtered, and the answer. */
struct sheet {
    uint8_t rgb[3 * PIXELS];
    uint16_t depth[PIXELS];
    int16_t velocity[2 * PIXELS];
    double code[3 * PIXELS];
    struct filter_ref_input in;
};

static size_t at(int x, int y)
{
    return (size_t)y * WIDTH + (size_t)x;
}

static uint32_t random_bits(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

/* Random colours, one depth, no motion. */
static void sheet_set(struct sheet *s)
{
    uint32_t seed = 7;
    memset(s, 0, sizeof *s);
    for (size_t i = 0; i < 3 * PIXELS; i++)
        s->rgb[i] = (uint8_t)random_bits(&seed);
    for (size_t i = 0; i < PIXELS; i++)
        s->depth[i] = 20000;
    s->in = (struct filter_ref_input){ .width = WIDTH, .height = HEIGHT, .rgb = s->rgb,
                                       .depth = s->depth, .velocity = s->velocity, .tile = TILE,
                                       .samples = 8 };
}

static void move_all(struct sheet *s, int vx, int vy)
{
    for (size_t i = 0; i < PIXELS; i++) {
        s->velocity[2 * i] = (int16_t)vx;
        s->velocity[2 * i + 1] = (int16_t)vy;
    }
}

static void run(struct sheet *s)
{
    struct failure f = {{0}};
    CHECK(filter_ref(&s->in, s->code, &f));
}

static double change(const struct sheet *s, size_t pixel)
{
    double most = 0.0;
    for (size_t c = 0; c < 3; c++)
        most = fmax(most, fabs(s->code[3 * pixel + c] - s->rgb[3 * pixel + c]));
    return most;
}

static void test_a_still_picture_stays_as_it_is(void)
{
    static struct sheet s;
    double most = 0.0;
    sheet_set(&s);
    run(&s);
    for (size_t i = 0; i < PIXELS; i++)
        most = fmax(most, change(&s, i));
    CHECK(most == 0.0);
    move_all(&s, 11, 11);                   /* 1.94 px: below the threshold of 2 */
    run(&s);
    for (size_t i = 0; i < PIXELS; i++)
        most = fmax(most, change(&s, i));
    CHECK(most == 0.0);
}

/* Whatever moves wherever, a mean of equal colours is that colour: no weight is negative or
 * undefined. */
static void test_one_colour_stays_that_colour_whatever_moves(void)
{
    static struct sheet s;
    static const unsigned flags[6] = { 0, SMEAR_FENCE, SMEAR_CORNER, SMEAR_BOX, SMEAR_DIRECTION,
                                       15 };
    uint32_t seed = 99;
    sheet_set(&s);
    memset(s.rgb, 123, sizeof s.rgb);
    for (size_t i = 0; i < PIXELS; i++) {
        s.depth[i] = random_bits(&seed) % 5 == 0 ? 0 : (uint16_t)random_bits(&seed);
        for (size_t c = 0; c < 2 && random_bits(&seed) % 2 == 0; c++)
            s.velocity[2 * i + c] = (int16_t)(random_bits(&seed) % 193 - 96);
    }
    for (int k = 0; k < 12; k++) {
        s.in.flags = flags[k % 6];
        s.in.encoded = k >= 6;
        run(&s);
        double most = 0.0;
        for (size_t i = 0; i < PIXELS; i++)
            most = fmax(most, change(&s, i));
        CHECK(most < 1e-9);
    }
}

/* All at (-10, 0) or (0, 10) px, one depth: every speed is 10, so the pixel at l along the velocity
 * has weight clamp(10 - l, 0, 1)/10 x (1.2 - t) and the centre 1.2/(20 n). */
static void test_a_pan_is_the_sum_of_its_taps(void)
{
    static struct sheet s;
    for (int way = 0; way < 8; way++) {
        bool box = (way & 1) != 0, along_y = (way & 2) != 0, encoded = (way & 4) != 0;
        sheet_set(&s);
        move_all(&s, along_y ? 0 : -80, along_y ? 80 : 0);
        s.in.flags = box ? SMEAR_BOX : 0;
        s.in.encoded = encoded;
        run(&s);
        for (int y = 15; y < 30; y++)
            for (int x = 15; x < 40; x++) {
                double noise = filter_ref_noise(x, y), peak = box ? 1.0 : 1.2;
                double sum = 0.0, weights = 0.0;
                for (int i = -4; i <= 4; i++) {     /* 0 is the centre */
                    double t = 1.0 - (abs(i) - 0.5) / 4.0, s_tap = 0.0, w = peak / 80.0;
                    if (i != 0) {
                        s_tap = (i < 0 ? -t : t) + (noise - 0.5) / 4.0;
                        w = fmin(fmax(10.0 - 10.0 * fabs(s_tap), 0.0), 1.0) / 10.0;
                        w *= box ? 1.0 : 1.2 - t;
                    }
                    int u = along_y ? x : (int)floor(x + 0.5 - 10.0 * s_tap);
                    int v = along_y ? (int)floor(y + 0.5 + 10.0 * s_tap) : y;
                    double code = s.rgb[3 * at(u, v) + 1] / 255.0;
                    sum += w * (encoded ? code : ref_srgb_decode(code));
                    weights += w;
                }
                double mean = encoded ? sum / weights : ref_srgb_encode(sum / weights);
                CHECK_CLOSE(s.code[3 * at(x, y) + 1], 255.0 * mean, 1e-6);
            }
    }
}

static double unit(double value)
{
    return fmin(fmax(value, 0.0), 1.0);
}

static double distance(const struct filter_ref_input *in, uint16_t code)
{
    double share = (double)smear_depth_units(code) / SMEAR_DEPTH_NEAR;
    double range = in->far_plane - in->near_plane;
    return in->orthographic ? in->far_plane - range * share : 1.0 / share;
}

/* Two taps around p, nothing else: p of speed `own` at one depth, the first tap at another, all
 * else still and as deep as p. A fast pixel elsewhere in the tile makes the filter look 10 px to
 * either side. */
static void check_pair(int x, int y, int own, uint16_t first_depth, int first_speed,
                       bool orthographic)
{
    static struct sheet s;
    double noise = filter_ref_noise(x, y);
    int first = (int)floor(x + 0.5 + 10.0 * noise);
    int second = (int)floor(x + 0.5 + 10.0 * (noise - 1.0));
    sheet_set(&s);
    s.in.samples = 2;
    s.in.encoded = true;
    s.in.orthographic = orthographic;
    s.in.near_plane = 2.0;
    s.in.far_plane = 3.0;
    s.velocity[2 * at(17, 17)] = 80;
    s.velocity[2 * at(first, y)] = (int16_t)first_speed;
    s.velocity[2 * at(x, y) + 1] = (int16_t)own;
    s.depth[at(first, y)] = first_depth;
    if (first == x || second == x)          /* p would be its own neighbour */
        return;
    run(&s);

    double background = fmax(own / 8.0, 1.0), deep = distance(&s.in, s.depth[at(x, y)]);
    double front = unit(20.0 * (deep - distance(&s.in, first_depth)) / deep);
    double u = fmax(background + (first_speed / 8.0 - background) * front, 1.0 / 16.0);
    double w1 = 0.7 * unit(u - 10.0 * noise) / u;
    background = fmax(background, u);
    double w2 = 0.7 * unit(background - 10.0 * (1.0 - noise)) / background;
    double w0 = 1.2 / (2.0 * background);
    for (size_t c = 0; c < 3; c++) {
        double sum = w0 * s.rgb[3 * at(x, y) + c] + w1 * s.rgb[3 * at(first, y) + c]
                   + w2 * s.rgb[3 * at(second, y) + c];
        CHECK_CLOSE(s.code[3 * at(x, y) + c], sum / (w0 + w1 + w2), 1e-9);
    }
}

static void test_a_pair_of_taps_is_weighed_by_depth_speed_and_order(void)
{
    for (int y = 20; y < 28; y++)
        for (int x = 20; x < 28; x++) {
            check_pair(x, y, 0, 20500, 80, false);      /* a little nearer: partly in front */
            check_pair(x, y, 0, 60000, 80, false);
            check_pair(x, y, 48, 60000, 0, false);      /* still, before what moves: nothing, */
            check_pair(x, y, 48, 60000, 24, false);     /* but B keeps its speed */
            check_pair(x, y, 48, 0, 80, false);
            check_pair(x, y, 0, 33000, 80, true);
            check_pair(x, y, 24, 32768, 72, true);
        }
}

/* Own motion 6 px down, the tile's 10 px to the right: of two pairs the outer looks along the
 * tile's and is too far away, the inner looks along the own. Only p's column is white. */
static void test_the_outer_pair_takes_the_tile_s_direction_the_inner_its_own(void)
{
    static struct sheet s;
    sheet_set(&s);
    memset(s.rgb, 0, sizeof s.rgb);
    s.in.samples = 4;
    s.in.encoded = true;
    s.velocity[2 * at(17, 17)] = 80;
    s.velocity[2 * at(24, 24) + 1] = 48;
    for (int y = 0; y < HEIGHT; y++)
        if (y != 24)
            memset(s.rgb + 3 * at(24, y), 255, 3);
    run(&s);
    double inner = 2.0 * 0.95 / 6.0, center = 1.2 / (2.0 * 6.0 * 2.0);
    CHECK_CLOSE(s.code[3 * at(24, 24)], 255.0 * inner / (inner + center), 1e-9);
    s.velocity[2 * at(24, 24) + 1] = 40;    /* half as fast: both pairs look along the tile's */
    run(&s);
    CHECK(s.code[3 * at(24, 24)] == 0.0);
}

/* All tiles but the last two columns move by 1.9 px, which is still; those have 2.5 px in reach. A
 * pixel beside the border is blurred exactly when its jittered look-up lands beyond it. */
static void test_the_tile_is_looked_up_a_quarter_tile_away(void)
{
    static struct sheet s;
    int here = 0, there = 0;
    sheet_set(&s);
    move_all(&s, 15, 0);
    s.velocity[2 * at(50, 20)] = 20;
    run(&s);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 20; x < 40; x++) {
            double noise = filter_ref_noise(x, y);
            double angle = 6.28318530717958647693 * filter_ref_noise(x + 2 * WIDTH, y);
            bool beyond = x + 0.5 + 4.0 * cos(angle) >= 32.0;
            if (fabs(noise - 0.5) > 0.2)    /* a tap might be the pixel itself */
                continue;
            CHECK_EQ(change(&s, at(x, y)) > 0.0, beyond);
            here += !beyond && x >= 32;
            there += beyond && x < 32;
        }
    CHECK(here > 0 && there > 0);
}

static void test_samples_beyond_half_the_length_change_nothing(void)
{
    static struct sheet s, more;
    sheet_set(&s);
    move_all(&s, 80, 0);                    /* L = 10: five pairs at most */
    s.in.samples = 10;
    run(&s);
    more = s;
    more.in.rgb = more.rgb, more.in.depth = more.depth, more.in.velocity = more.velocity;
    more.in.samples = 100;
    run(&more);
    CHECK(memcmp(s.code, more.code, sizeof s.code) == 0);
    more.in.samples = 9;
    run(&more);
    CHECK(memcmp(s.code, more.code, sizeof s.code) != 0);
}

/* A still bar in front of a moving wall. */
static void fence_set(struct sheet *s)
{
    sheet_set(s);
    move_all(s, 80, 0);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 26; x < 34; x++) {
            s->depth[at(x, y)] = 40000;
            s->velocity[2 * at(x, y)] = 0;
            memset(s->rgb + 3 * at(x, y), 255, 3);
        }
}

static void test_a_fence_keeps_a_still_bar_and_blurs_what_moves_behind(void)
{
    static struct sheet s;
    for (int fence = 0; fence < 2; fence++) {
        double bar = 0.0, wall = 0.0;
        fence_set(&s);
        s.in.flags = fence ? SMEAR_FENCE : 0;
        run(&s);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                bool on_bar = x >= 26 && x < 34;
                if (on_bar)
                    bar = fmax(bar, change(&s, at(x, y)));
                else
                    wall = fmax(wall, change(&s, at(x, y)));
            }
        CHECK(fence ? bar < 1e-9 : bar > 1.0);
        CHECK(wall > 20.0);
    }
    for (int steps = 4; steps <= 5; steps++) {          /* up to half a pixel is still */
        double bar = 0.0;
        fence_set(&s);
        s.in.flags = SMEAR_FENCE;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 26; x < 34; x++)
                s.velocity[2 * at(x, y) + 1] = (int16_t)steps;
        run(&s);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 26; x < 34; x++)
                bar = fmax(bar, change(&s, at(x, y)));
        CHECK(steps == 4 ? bar < 1e-9 : bar > 1.0);
    }
}

/* A bar in front that moves spreads over the still wall, up to its own half length and no farther.
 * */
static void test_a_moving_bar_spreads_by_its_own_length(void)
{
    static struct sheet s;
    double least = 255.0, beyond = 0.0;
    sheet_set(&s);
    memset(s.rgb, 0, sizeof s.rgb);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 24; x < 34; x++) {
            s.depth[at(x, y)] = 40000;
            s.velocity[2 * at(x, y)] = 64;
            memset(s.rgb + 3 * at(x, y), 255, 3);
        }
    s.in.samples = 16;
    run(&s);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++)
            if (x < 24 - 9 || x > 33 + 9)
                beyond = fmax(beyond, s.code[3 * at(x, y)]);
        least = fmin(least, fmax(s.code[3 * at(20, y)], s.code[3 * at(37, y)]));
    }
    CHECK(beyond == 0.0);
    CHECK(least > 20.0);
}

static void test_tile_maximum_is_exact_and_keeps_the_first_of_equals(void)
{
    static struct sheet s;
    int16_t tile_max[2 * 4 * 3];
    sheet_set(&s);
    s.velocity[2 * at(20, 5)] = 30;         /* tile 1, 0 */
    s.velocity[2 * at(17, 6) + 1] = -30;
    s.velocity[2 * at(59, 43)] = -9;        /* the last pixel of the last, narrow tile */
    s.velocity[2 * at(16, 16)] = 3;         /* tile 1, 1 */
    s.velocity[2 * at(16, 16) + 1] = 4;
    s.velocity[2 * at(31, 31)] = -5;        /* as long, later */
    filter_ref_tile_max(&s.in, tile_max);
    for (int i = 0; i < 12; i++) {
        static const int16_t want[12][2] = { [1] = { 30, 0 }, [5] = { 3, 4 }, [11] = { -9, 0 } };
        CHECK_EQ(tile_max[2 * i], want[i][0]);
        CHECK_EQ(tile_max[2 * i + 1], want[i][1]);
    }
}

static void test_neighbour_maximum_prefers_the_centre_and_skips_turned_away_corners(void)
{
    static struct sheet s;
    int16_t tile_max[2 * 4 * 3];
    double neighbor[2 * 4 * 3];
    sheet_set(&s);
    s.in.velocity_step = 0.5;
    memset(tile_max, 0, sizeof tile_max);
    tile_max[2 * 5] = 100;                  /* the tile (1, 1): 50 px to the right */
    tile_max[2 * 6 + 1] = -101;             /* (2, 1): longer, by 1.01 and no more */
    filter_ref_neighbor_max(&s.in, tile_max, neighbor);
    CHECK_CLOSE(neighbor[2 * 5], 50.0, 1e-12);              /* the first of equals */
    CHECK_CLOSE(neighbor[2 * 6 + 1], -50.5, 1e-12);
    tile_max[2 * 6 + 1] = -102;
    filter_ref_neighbor_max(&s.in, tile_max, neighbor);
    CHECK_CLOSE(neighbor[2 * 5 + 1], -51.0 / 1.01, 1e-12);
    tile_max[2 * 6 + 1] = -100;
    filter_ref_neighbor_max(&s.in, tile_max, neighbor);
    CHECK_CLOSE(neighbor[2 * 5], 50.0, 1e-12);
    CHECK_CLOSE(neighbor[2 * 6 + 1], -50.0, 1e-12);
    CHECK_CLOSE(neighbor[2 * 4], 50.0 / 1.01, 1e-12);       /* a neighbour wins, shortened */
    CHECK_CLOSE(neighbor[2 * 0], 50.0 / 1.01, 1e-12);       /* also over a corner */
    s.in.whole_neighbor = true;
    s.in.flags = SMEAR_CORNER;
    filter_ref_neighbor_max(&s.in, tile_max, neighbor);
    CHECK_CLOSE(neighbor[2 * 4], 50.0, 1e-12);
    CHECK(neighbor[2 * 0] == 0.0);          /* level motion points at no corner */
    tile_max[2 * 5 + 1] = 1;
    filter_ref_neighbor_max(&s.in, tile_max, neighbor);
    CHECK_CLOSE(neighbor[2 * 0], 50.0, 1e-12);              /* down right: from upper left */
    CHECK_CLOSE(neighbor[2 * 10], 50.0, 1e-12);             /* to lower right */
    CHECK(neighbor[2 * 8] == 0.0 && neighbor[2 * 8 + 1] == 0.0);
}

/* Where everything moves alike the second direction is the first, whichever rule makes it. */
static void test_direction_rules_agree_on_a_pan(void)
{
    static struct sheet s, other;
    double most = 0.0;
    sheet_set(&s);
    move_all(&s, 56, -72);
    other = s;
    other.in.rgb = other.rgb, other.in.depth = other.depth, other.in.velocity = other.velocity;
    other.in.flags = SMEAR_DIRECTION;
    run(&s);
    run(&other);
    for (size_t i = 0; i < 3 * PIXELS; i++)
        most = fmax(most, fabs(s.code[i] - other.code[i]));
    CHECK(most < 1e-6);
    CHECK(change(&s, at(30, 20)) > 1.0);
}

/* A still pixel beside motion looks across it under SMEAR_DIRECTION: rows of one colour show that.
 * */
static void test_direction_of_a_still_pixel_is_across_the_motion(void)
{
    static struct sheet s;
    sheet_set(&s);
    for (size_t i = 0; i < PIXELS; i++)
        memset(s.rgb + 3 * i, i / WIDTH % 2 == 0 ? 255 : 0, 3);     /* alike along x, not along y */
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 28; x < 32; x++)
            s.velocity[2 * at(x, y)] = 80;
    run(&s);
    CHECK(change(&s, at(20, 20)) < 1e-9);
    for (int y = 0; y < HEIGHT; y++)        /* near things that rush by the still ones */
        for (int x = 20; x < 28; x++) {
            s.velocity[2 * at(x, y)] = 80;
            s.depth[at(x, y)] = 40000;
        }
    for (int y = 0; y < HEIGHT; y++)
        s.velocity[2 * at(22, y)] = 0, s.depth[at(22, y)] = 20000;
    s.in.samples = 32;
    run(&s);
    CHECK(change(&s, at(22, 20)) < 1e-9);
    for (int y = 17; y < 23; y++)           /* and above and below it */
        if (y != 20)
            s.velocity[2 * at(22, y)] = 80, s.depth[at(22, y)] = 40000;
    s.in.flags = SMEAR_DIRECTION;
    run(&s);
    CHECK(change(&s, at(22, 20)) > 1.0);
}

static void test_velocity_is_packed_as_half_the_exposure_within_reach(void)
{
    static const struct { double v[2], degrees; int16_t want[2]; } cases[6] = {
        { { 40.0, 0.0 }, 180.0, { 80, 0 } },        /* 10 px in steps of 1/8 */
        { { 0.0, -40.0 }, 360.0, { 0, -96 } },      /* 20 px, reach 12 */
        { { 60.0, 80.0 }, 180.0, { 58, 77 } },      /* 25 px at 3:4 to 12: 57.6, 76.8 */
        { { 0.25, -0.25 }, 180.0, { 1, 0 } },       /* half a step: up */
        { { 0.24, -0.24 }, 180.0, { 0, 0 } },
        { { 0.0, 0.0 }, 180.0, { 0, 0 } },
    };
    for (int i = 0; i < 6; i++) {
        int16_t got[2];
        filter_ref_pack(cases[i].v, cases[i].degrees, 12.0, 0.125, got);
        CHECK_EQ(got[0], cases[i].want[0]);
        CHECK_EQ(got[1], cases[i].want[1]);
    }
}

static void test_noise_is_spread_evenly(void)
{
    int slots[8] = { 0 };
    for (int y = 0; y < 64; y++)
        for (int x = 0; x < 64; x++) {
            double noise = filter_ref_noise(x, y);
            REQUIRE(noise >= 0.0 && noise < 1.0);
            slots[(int)(noise * 8.0)]++;
        }
    for (int i = 0; i < 8; i++)
        CHECK_NEAR(slots[i], 512, 32);
    CHECK_CLOSE(filter_ref_noise(0, 0), 0.0, 1e-12);
    CHECK_CLOSE(filter_ref_noise(3, 5), 0.21349, 1e-5);     /* frac(52.9829189 x 0.23051743) */
}

static void test_impossible_filters_fail(void)
{
    static struct sheet s;
    struct failure f = {{0}};
    sheet_set(&s);
    s.in.tile = 0;
    CHECK(!filter_ref(&s.in, s.code, &f) && f.text[0] != '\0');
    s.in.tile = TILE;
    s.in.orthographic = true;
    f.text[0] = '\0';
    CHECK(!filter_ref(&s.in, s.code, &f) && f.text[0] != '\0');
    s.in.near_plane = 1.0;
    s.in.far_plane = 10.0;
    CHECK(filter_ref(&s.in, s.code, &f));
}

#include "build/suites/filter_ref.h"

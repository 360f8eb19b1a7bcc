/* SPDX-License-Identifier: MIT */
/* test_filters.c - filters beside the reconstruction: camera velocity from depth against that of vertices, passes against
 * direct taps, half size; on scenes of the suite. */
#include "tests/ref/accuracy.h"

#include "filter/filter.h"
#include "tests/context_rig.h"

/* ------------------------------------------------------------------ taps of passes */

/* In 2^-20 of the reach. */
static void test_no_tap_of_a_pass_lies_beyond_the_reach(void)
{
    for (int passes = 1; passes <= 3; passes++)
        for (int taps = 2; taps <= 64; taps++)
            for (int base = 2; base <= 64; base++)
                for (int jitter = 0; jitter <= 128; jitter += jitter == 0 ? 1 : 127) {
                    const smear_pingpong options = { .passes = (uint8_t)passes, .taps = (uint8_t)taps, .base = (uint8_t)base,
                                                     .jitter = (uint8_t)jitter };
                    struct smear_pass pass[PINGPONG_PASSES_MAX];
                    smear_pingpong_plan(pass, &options, 64);
                    for (int i = 0; i < passes; i++) {
                        const int64_t farthest = (taps - 1) * (int64_t)pass[i].spacing
                                               + ((int64_t)pass[i].spacing * pass[i].jitter >> 8);
                        if (!CHECK(farthest <= 1 << 20) || !CHECK(pass[i].reach <= 64))
                            return;
                        CHECK(base > taps || jitter == 128 || pass[i].jitter == 2 * jitter);
                    }
                }
}

/* ------------------------------------------------------------------ velocity from depth */

/* RMS and largest distance of two pictures' velocities where both see a surface, px in the exposure. */
static bool compare_velocities(struct subject *s, const struct present_options *vertices, int step, double *rms,
                               double *largest)
{
    struct shot_options options = { .look = true, .reach = 60, .tile = 64 };
    struct present_options depth = *vertices;
    struct shot a OWNED(shot_free) = { 0 }, b;
    double sum = 0.0;
    int count = 0;
    depth.camera_step = step;
    *rms = *largest = INFINITY;
    if (!shot_take(s, vertices, &options, &a))
        return false;
    if (!shot_take(s, &depth, &options, &b))
        return false;
    double open = vertices->shutter_degrees / 360.0;
    *largest = 0.0;
    for (int i = 0; i < a.width * a.height; i++) {
        if (a.depth[i] == 0)
            continue;
        double x = (double)(a.velocity[2 * i] - b.velocity[2 * i]) * open;
        double y = (double)(a.velocity[2 * i + 1] - b.velocity[2 * i + 1]) * open;
        sum += x * x + y * y;
        *largest = fmax(*largest, hypot(x, y));
        count++;
    }
    CHECK(count > a.width * a.height / 4);
    CHECK(a.stats.draws_moved > b.stats.draws_moved);
    *rms = sqrt(sum / count);
    shot_free(&b);
    return true;
}

static void test_camera_velocity_from_depth_is_that_of_vertices(void)
{
    static const char *const scene[] = { "suite/pan", "suite/dolly", "suite/roll", "test/terrain", "test/ortho" };
    for (int k = 0; k < 5; k++) {
        struct subject s OWNED(subject_close) = { 0 };
        if (!subject_open(&s, scene[k]))
            continue;
        if (k >= 3 && !subject_circle(&s, 1.0))
            continue;
        /* Hills seen at a glance: depths too steep for blocks; and much of what is carried on to the future of a frame
         * has left the eye. */
        for (int poses = 0; poses < 4; poses++)
            for (int step = 1; step <= 4; step *= 2) {      /* a tenth, a half and all of a quarter pixel */
                if (k == 3 && (step > 1 || poses == 1 || poses == 2))
                    continue;
                struct present_options p = subject_options(&s);
                double rms, largest;
                char name[80];
                p.method = SMEAR_RECONSTRUCT;
                p.reconstruct = SMEAR_PUBLISHED;
                p.shutter_poses = poses == 3;
                p.exposure = poses == 1 ? SMEAR_TRAILING : poses == 2 ? SMEAR_LEADING : SMEAR_CENTRED;
                snprintf(name, sizeof name, "%s, poses %d, step %d", scene[k], poses, step);
                if (!compare_velocities(&s, &p, step, &rms, &largest))
                    continue;
                say("      %-34s %.3f px RMS, at most %.2f\n", name, rms, largest);
                CHECK_BAR(rms, step == 1 ? 0.03 : step == 2 ? 0.125 : 0.26, name);
            }
    }
}

/* ------------------------------------------------------------------ memory */

static int take_nothing(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    return 0;
}

static void test_room_for_filters_goes_with_the_methods_that_need_it(void)
{
    smear_desc desc = { .width = 64, .height = 64, .flush = take_nothing, .methods = SMEAR_SET(SMEAR_PINGPONG) };
    const size_t two = smear_memory_size(&desc);
    desc.filter.passes = 2;
    CHECK(two > 0 && smear_memory_size(&desc) == two);
    desc.filter.passes = 4;
    CHECK_EQ((int64_t)smear_memory_size(&desc), 0);
    desc.filter.passes = 2;
    desc.methods = SMEAR_SET(SMEAR_NONE);
    CHECK_EQ((int64_t)smear_memory_size(&desc), 0);
    desc = (smear_desc){ .width = 64, .height = 64, .flush = take_nothing, .methods = SMEAR_SET(SMEAR_RECONSTRUCT) };
    const size_t window = smear_memory_size(&desc);
    desc.methods |= SMEAR_SET(SMEAR_CAMERA);
    CHECK(window > 0 && smear_memory_size(&desc) == window);
    desc.methods |= SMEAR_SET(SMEAR_HALF);
    CHECK(smear_memory_size(&desc) > window);
    desc.methods = (uint16_t)SMEAR_SET(SMEAR_METHOD_COUNT);
    CHECK_EQ((int64_t)smear_memory_size(&desc), 0);
}

/* ------------------------------------------------------------------ passes, on the suite */

static double rmse_of(const uint8_t *a, const uint8_t *b, int values)
{
    double sum = 0.0;
    for (int i = 0; i < values; i++)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum / values);
}

static void test_8_and_8_taps_on_a_pan_are_within_1_5_codes_of_64(void)
{
    struct subject s OWNED(subject_close) = { 0 };
    END_UNLESS(subject_open(&s, "suite/pan"));
    for (int degrees = 90; degrees <= 360; degrees += 90) {
        struct shot_options options = { .reach = 48, .tile = 64 };
        struct present_options p = subject_options(&s);
        struct shot passes OWNED(shot_free) = { 0 }, direct;
        char name[60];
        p.method = SMEAR_CAMERA;
        p.filter = SMEAR_FILTER_PINGPONG;
        p.shutter_degrees = degrees;
        p.shutter_poses = true;
        p.pingpong = (smear_pingpong){ .bias = 255 };
        if (!shot_take(&s, &p, &options, &passes))
            continue;
        p.pingpong = (smear_pingpong){ .bias = 255, .passes = 1, .taps = 64 };
        if (shot_take(&s, &p, &options, &direct)) {
            double rmse = rmse_of(passes.rgb, direct.rgb, 3 * s.width * s.height);
            snprintf(name, sizeof name, "%d degrees", degrees);
            say("      %-12s %.2f codes, %u taps for %u\n", name, rmse, (unsigned)passes.stats.samples,
                (unsigned)direct.stats.samples);
            CHECK_BAR(rmse, 1.5, name);
            CHECK(rmse > 0.1);
            CHECK(passes.stats.samples <= direct.stats.samples / 4);
            CHECK(direct.stats.samples > 64u * 10000u);
            shot_free(&direct);
        }
    }
}

/* What each method and option draws, whatever cores, parts and tiles there are. */
static const struct drawn {
    const char *scene;
    struct present_options p;
    double rmse;                /* at most, against the truth */
} drawn[] = {
    { "suite/pan", { .method = SMEAR_CAMERA }, 6.5 },
    { "suite/dolly", { .method = SMEAR_CAMERA, .camera_step = 2 }, 9 },
    { "suite/roll", { .method = SMEAR_CAMERA, .filter = SMEAR_FILTER_RECONSTRUCT, .camera_step = 4 }, 12 },
    { "suite/pan", { .method = SMEAR_CAMERA, .filter = SMEAR_FILTER_PINGPONG, .pingpong = { .jitter = 90 } }, 10.5 },
    { "suite/translate", { .method = SMEAR_PINGPONG }, 8 },
    { "suite/translate", { .method = SMEAR_PINGPONG, .pingpong = { .passes = 3, .taps = 4, .spread = 1 } }, 5.5 },
    { "suite/cross", { .method = SMEAR_PINGPONG, .light = SMEAR_LIGHT_ENCODED, .camera_step = 1 }, 9 },
    { "suite/translate", { .method = SMEAR_HALF }, 6.5 },
    { "suite/fence_obj", { .method = SMEAR_HALF, .reconstruct = SMEAR_FENCE }, 8 },
    { "suite/cross", { .method = SMEAR_HALF, .filter = SMEAR_FILTER_PINGPONG, .light = SMEAR_LIGHT_ENCODED }, 10 },
    { "suite/arena", { .method = SMEAR_HALF, .filter = SMEAR_FILTER_MEAN, .camera_step = 2 }, 9 },
    { "suite/translate", { .method = SMEAR_RECONSTRUCT, .weights = SMEAR_WEIGHTS_MCGUIRE }, 5.5 },
    { "suite/translate", { .method = SMEAR_RECONSTRUCT, .weights = SMEAR_WEIGHTS_GUERTIN, .samples = 32 }, 5.5 },
    { "suite/translate", { .method = SMEAR_RECONSTRUCT, .weights = SMEAR_WEIGHTS_JIMENEZ }, 3.5 },
    { "suite/arena", { .method = SMEAR_RECONSTRUCT, .camera_step = 1 }, 9 },
};

static void test_filters_are_near_the_truth_and_do_not_depend_on_cores_and_parts(void)
{
    for (size_t i = 0; i < sizeof drawn / sizeof *drawn; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        struct shot one, other;
        char name[100];
        if (!subject_open(&s, drawn[i].scene))
            continue;
        struct present_options p = drawn[i].p, from = subject_options(&s);
        p.fps = from.fps;
        p.clear = from.clear;
        p.shutter_degrees = from.shutter_degrees;
        snprintf(name, sizeof name, "%d %s, method %d", (int)i, drawn[i].scene, (int)p.method);
        const struct ref_truth *truth = truth_of(&s, &p, 64);
        if (truth != NULL && shot_take(&s, &p, &(struct shot_options){ .reach = 24, .tile = 32 }, &one)) {
            double rmse = rmse_to_truth(one.rgb, truth);
            say("      %-40s %.2f codes\n", name, rmse);
            CHECK_BAR(rmse, drawn[i].rmse, name);
            shot_free(&one);
        }
        struct shot_options plain = { .reach = 13, .tile = 16, .width = 117, .height = 91 };
        static const struct { int workers, triangles; } how[] = { { 3, 0 }, { 8, 0 }, { 1, 300 }, { 2, 150 } };
        if (shot_take(&s, &p, &plain, &one)) {
            for (int k = 0; k < 4; k++) {
                struct shot_options o = plain;
                o.workers = how[k].workers;
                o.triangles = how[k].triangles;
                if (!shot_take(&s, &p, &o, &other))
                    continue;
                if (other.stats.triangles_dropped == 0 && !CHECK_EQ((int64_t)one.stats.crc32, (int64_t)other.stats.crc32))
                    say("      %s: workers %d, triangles %d\n", name, o.workers, o.triangles);
                CHECK(o.triangles != 0 || other.stats.parts_added == 0);
                shot_free(&other);
            }
            shot_free(&one);
        }
    }
    truth_forget();
}

/* ------------------------------------------------------------------ filters alone, on made pictures */

/* What comes out of the filter for a picture of rows that are all alike. */
struct strip {
    int width;
    uint32_t color[128], depth[128];
    int16_t velocity[256];      /* 1/16 px */
    uint32_t out[128];          /* the middle row */
};

enum { STRIP_HEIGHT = 80 };

static bool strip_filter(struct strip *strip, const smear_frame *frame)
{
    smear_camera camera = { .pose = SMEAR_IDENTITY, .focal = 65536, .near_plane = 65536 };
    smear_frame f = *frame;
    smear_desc desc = { .width = (int16_t)strip->width, .height = STRIP_HEIGHT, .reach = 32, .tile = 32, .filter.passes = 3,
                        .methods = SMEAR_SET_FILTERS, .max_triangles = 1, .max_draws = 1 };
    RIG(r, &desc, false);
    f.camera = &camera;
    f.shutter.degrees = 360;
    f.light_space = SMEAR_LIGHT_ENCODED;
    bool ok = CHECK_EQ(smear_filter_begin(r.ctx, &f), SMEAR_OK);
    for (int y = 0; y < STRIP_HEIGHT && ok; y++)
        ok = CHECK_EQ(smear_filter_row(r.ctx, strip->color, strip->depth, strip->velocity), SMEAR_OK);
    memcpy(strip->out, r.picture + (size_t)(STRIP_HEIGHT / 2 * strip->width) * 4, (size_t)strip->width * 4);
    return ok;
}

static void strip_fill(struct strip *strip, int x0, int x1, uint32_t color, double distance, double velocity)
{
    for (int x = x0; x < x1; x++) {
        strip->color[x] = color;
        strip->depth[x] = (uint32_t)(distance * 65536);
        strip->velocity[2 * x] = (int16_t)lround(velocity * 16);
        strip->velocity[2 * x + 1] = 0;
    }
}

/* A bright line of a pixel under a pan: what each column gets of it is the kernel. */
static void kernel_of(const smear_pingpong *passes, double pan, int kernel[128])
{
    struct strip strip = { .width = 128 };
    strip_fill(&strip, 0, 128, 0x000000, 10, pan);
    strip_fill(&strip, 64, 65, 0xffffff, 10, pan);
    memset(kernel, 0, 128 * sizeof *kernel);
    if (strip_filter(&strip, &(smear_frame){ .method = SMEAR_PINGPONG, .filter.pingpong = *passes }))
        for (int x = 0; x < 128; x++)
            kernel[x] = (int)(strip.out[x] & 255);
}

static void test_even_passes_are_a_box_and_the_original_is_a_comb(void)
{
    static const smear_pingpong even[] = { { .passes = 1, .taps = 64 }, { .passes = 2 }, { .passes = 3, .taps = 4 } };
    int kernel[128];
    for (int i = 0; i < 3; i++) {
        kernel_of(&even[i], 64, kernel);
        for (int x = 0; x < 128; x++)
            CHECK_EQ(kernel[x], x >= 32 && x <= 95 ? 4 : 0);        /* 255 / 64 */
    }
    /* 31 places with weights 1 1 1 1 2 2 2 1 2 2 2 1 2 2 2 1 ... of 49. */
    static const int tooth[31] = { 1, 1, 1, 1, 2, 2, 2, 1, 2, 2, 2, 1, 2, 2, 2, 1,
                                   2, 2, 2, 1, 2, 2, 2, 1, 2, 2, 2, 1, 1, 1, 1 };
    kernel_of(&(smear_pingpong){ .taps = 7, .base = 4 }, 31, kernel);
    for (int x = 0; x < 128; x++)
        CHECK_NEAR(kernel[x], x >= 49 && x <= 79 ? tooth[x - 49] * 255 / 49 : 0, 1);
}

static void test_the_depth_mask_keeps_what_is_in_front_from_bleeding(void)
{
    for (int bias = 4; bias <= 255; bias += 251) {
        struct strip strip = { .width = 128 };
        int bled = 0;
        strip_fill(&strip, 0, 128, 0x0000ff, 100, 24);
        strip_fill(&strip, 48, 80, 0xff0000, 5, 0);
        if (!strip_filter(&strip, &(smear_frame){ .method = SMEAR_PINGPONG, .filter.pingpong.bias = (uint8_t)bias }))
            continue;
        for (int x = 0; x < 128; x++) {
            if (x >= 48 && x < 80)
                CHECK_EQ((int64_t)strip.out[x], 0xff0000);      /* still: as it was */
            else
                bled += strip.out[x] != 0x0000ff;
        }
        CHECK_EQ(bled > 0, bias == 255);
    }
}

/* Short streaks are taken whole by the last pass, whose own taps reach less far. Where a tile lies that close to the right
 * side, columns beyond it stand for the last one, not for the next row's first. */
static void test_short_streaks_end_at_the_frames_side(void)
{
    for (int width = 97; width <= 127; width += 6)
        for (int velocity = -32; velocity <= 32; velocity += 64) {
            struct strip strip = { .width = width };
            strip_fill(&strip, 0, 48, 0xffffff, 10, velocity);
            strip_fill(&strip, 48, width, 0x000000, 10, velocity);
            if (!strip_filter(&strip, &(smear_frame){ .method = SMEAR_PINGPONG,
                                                      .filter.pingpong = { .passes = 2, .taps = 32, .base = 64 } }))
                continue;
            for (int x = 65; x < width; x++)
                REQUIRE_EQ((int64_t)strip.out[x] & 0xffffff, 0);
        }
}

static void test_silhouettes_spread_where_that_is_asked_for(void)
{
    for (int spread = 0; spread < 2; spread++) {
        struct strip strip = { .width = 128 };
        int outside = 0, behind = 0;
        double sum = 0;
        strip_fill(&strip, 0, 128, 0x0000ff, 100, 0);
        strip_fill(&strip, 48, 80, 0xff0000, 5, 24);
        strip_fill(&strip, 84, 128, 0x00ff00, 1, 0);        /* still, and in front of it */
        if (!strip_filter(&strip, &(smear_frame){ .method = SMEAR_PINGPONG, .filter.pingpong.spread = (uint8_t)spread }))
            continue;
        for (int x = 0; x < 48; x++)
            outside += strip.out[x] >> 16 != 0;
        for (int x = 0; x < 84; x++)
            sum += strip.out[x] >> 16;
        for (int x = 84; x < 128; x++)
            behind += strip.out[x] != 0x00ff00;
        CHECK(spread ? outside >= 9 && outside <= 13 : outside == 0);
        CHECK_EQ(behind, 0);
        /* What spreads is about what it was; without, the inside only gets thinner. */
        CHECK(spread ? fabs(sum - 32 * 255) < 0.08 * 32 * 255 : sum < 0.9 * 32 * 255);
    }
}

static void test_still_pictures_pass_every_filter_unchanged(void)
{
    static const smear_frame frames[] = {
        { .method = SMEAR_PINGPONG, .filter.pingpong.spread = 1 }, { .method = SMEAR_HALF },
        { .method = SMEAR_HALF, .filter.kind = SMEAR_FILTER_PINGPONG },
        { .method = SMEAR_RECONSTRUCT, .filter.weights = SMEAR_WEIGHTS_MCGUIRE },
        { .method = SMEAR_RECONSTRUCT, .filter.weights = SMEAR_WEIGHTS_GUERTIN },
        { .method = SMEAR_RECONSTRUCT, .filter.weights = SMEAR_WEIGHTS_JIMENEZ }
    };
    for (size_t i = 0; i < sizeof frames / sizeof *frames; i++)
        for (int moving = 0; moving < 2; moving++) {
            struct strip strip = { .width = 128 };
            for (int x = 0; x < 128; x++) {
                uint32_t color = ((uint32_t)x * 2654435761u >> 8) & 0xffffffu;
                strip_fill(&strip, x, x + 1, moving ? 0x804020 : color, x % 7 + 2, moving ? x / 3 : 0);
            }
            if (!strip_filter(&strip, &frames[i]))
                continue;
            /* Nothing moves; or all is one colour. */
            for (int x = 0; x < 128; x++)
                if (!CHECK_EQ((int64_t)strip.out[x], (int64_t)strip.color[x])) {
                    say("      filter %d, moving %d, column %d\n", (int)i, moving, x);
                    break;
                }
        }
}

/* Half size: what moves gets the blur; what it does not touch is as it was, detail and all. */
static void test_half_size_keeps_the_detail_of_what_it_does_not_touch(void)
{
    struct strip strip = { .width = 128 };
    for (int x = 0; x < 128; x++)
        strip_fill(&strip, x, x + 1, x & 1 ? 0xffffff : 0x000000, 50, x < 32 ? 24 : 0);
    END_UNLESS(strip_filter(&strip, &(smear_frame){ .method = SMEAR_HALF, .filter.flags = SMEAR_FENCE }));
    for (int x = 0; x < 128; x++) {
        if (x < 24)
            CHECK_NEAR(strip.out[x] & 255, 128, 3);
        if (x >= 64)
            CHECK_EQ((int64_t)strip.out[x], x & 1 ? 0xffffff : 0x000000);
    }
}

/* ------------------------------------------------------------------ streaks longer than a tile */

static void test_scattered_maxima_carry_streaks_over_several_tiles(void)
{
    static const uint8_t weights[] = { SMEAR_WEIGHTS_STACK, SMEAR_WEIGHTS_JIMENEZ };
    struct subject s OWNED(subject_close) = { 0 };
    END_UNLESS(subject_open(&s, "suite/long"));
    for (int w = 0; w < 2; w++) {
        struct present_options p = subject_options(&s);
        p.method = SMEAR_RECONSTRUCT;
        p.weights = weights[w];
        p.samples = 32;
        const struct ref_truth *truth = truth_of(&s, &p, 128);
        double rmse[4];
        static const struct shot_options how[4] = { { .reach = 16, .tile = 16 }, { .reach = 48, .tile = 64 },
                                                    { .reach = 48, .tile = 16, .scatter = true },
                                                    { .reach = 48, .tile = 8, .scatter = true } };
        uint32_t bytes[4], crc = 0;
        for (int i = 0; i < 4; i++) {
            struct shot shot;
            rmse[i] = INFINITY;
            bytes[i] = 0;
            for (int workers = 1; workers <= 4; workers += 3) {
                struct shot_options o = how[i];
                o.workers = workers;
                if (truth == NULL || !shot_take(&s, &p, &o, &shot))
                    continue;
                rmse[i] = rmse_to_truth(shot.rgb, truth);
                if (workers == 1)
                    bytes[i] = shot.stats.arena_bytes;
                else
                    CHECK_EQ((int64_t)shot.stats.crc32, (int64_t)crc);
                crc = shot.stats.crc32;
                shot_free(&shot);
            }
        }
        say("      weights %d: %.2f codes with a reach of a tile, %.2f in tiles of 64, scattered %.2f in 16, %.2f in 8;"
            " %u, %u, %u kB\n", weights[w], rmse[0], rmse[1], rmse[2], rmse[3], (unsigned)bytes[1] / 1024,
            (unsigned)bytes[2] / 1024, (unsigned)bytes[3] / 1024);
        CHECK(rmse[2] < 0.7 * rmse[0] && rmse[2] < 1.05 * rmse[1] && rmse[3] < 1.05 * rmse[1]);
        CHECK(bytes[3] < bytes[2] && bytes[2] < bytes[1] * 3 / 4);
    }
    truth_forget();
}

static void test_scatter_goes_with_filters_alone(void)
{
    smear_desc desc = { .width = 64, .height = 64, .flush = take_nothing, .methods = SMEAR_SET(SMEAR_RECONSTRUCT), .tile = 8,
                        .reach = 64, .filter.scatter = 1 };
    CHECK(smear_memory_size(&desc) > 0);
    desc.reach = 65;
    CHECK_EQ((int64_t)smear_memory_size(&desc), 0);
    desc.reach = 64;
    static const uint16_t others[] = { SMEAR_SET(SMEAR_PINGPONG), SMEAR_SET(SMEAR_HALF), SMEAR_SET(SMEAR_AUTO) };
    for (int i = 0; i < 3; i++) {
        desc.methods = (uint16_t)(SMEAR_SET(SMEAR_RECONSTRUCT) | others[i]);
        CHECK_EQ((int64_t)smear_memory_size(&desc), 0);
    }
    desc.methods = SMEAR_SET(SMEAR_NONE);
    CHECK_EQ((int64_t)smear_memory_size(&desc), 0);
}

#include "build/suites/filters.h"

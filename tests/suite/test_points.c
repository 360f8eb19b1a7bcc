/* SPDX-License-Identifier: MIT */
/* test_points.c - points of smear_overlay.h: streaks as long and as bright as those of a dot drawn at ever so many instants,
 * the same whatever draws them, hidden by what is nearer. Host only. */
#include "smear_math.h"
#include "smear_overlay.h"

#include "tests/rig.h"

enum { WIDTH = 104, HEIGHT = 72, PIXELS = WIDTH * HEIGHT, POINTS = 24 };

static const uint16_t all_methods = SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET_FILTERS | SMEAR_SET(SMEAR_NONE)
                                  | SMEAR_SET(SMEAR_ACCUMULATE);

static smear_desc desc_of(void)
{
    return (smear_desc){ .width = WIDTH, .height = HEIGHT, .tile = 8, .reach = 6, .methods = all_methods };
}

/* A camera at the origin: what is 10 away and 1 to the right is 18 pixels right of the middle; half the height is 36. */
static smear_camera camera(void)
{
    return (smear_camera){ .pose = SMEAR_IDENTITY, .focal = 5 << 16, .near_plane = SMEAR_Q16(0.5), .far_plane = 100 << 16 };
}

/* At (x, y) pixels right of and above the middle, 10 away. */
static void put(int32_t at[3], double x, double y)
{
    at[0] = q16(x / 18);
    at[1] = q16(y / 18);
    at[2] = -(10 << 16);
}

/* ------------------------------------------------------------------ truth */

/* The light of a dot in a pixel, in the mean over many instants. */
static double light_at(double px, double py, const double a[2], const double b[2], double radius)
{
    enum { INSTANTS = 1024 };
    const double r = radius < 0.5 ? 0.5 : radius, a2 = 3 * r * r + 1.25;
    const double peak = 3 * r * r / a2 * (radius < 0.5 ? radius * radius * 4 : 1);
    double sum = 0;
    if (px < fmin(a[0], b[0]) - sqrt(a2) || px > fmax(a[0], b[0]) + sqrt(a2) || py < fmin(a[1], b[1]) - sqrt(a2)
        || py > fmax(a[1], b[1]) + sqrt(a2))
        return 0;
    for (int k = 0; k < INSTANTS; k++) {
        const double t = (k + 0.5) / INSTANTS, x = a[0] + (b[0] - a[0]) * t - px, y = a[1] + (b[1] - a[1]) * t - py;
        const double q = (x * x + y * y) / a2;
        sum += q < 1 ? (1 - q) * (1 - q) : 0;
    }
    return peak * sum / INSTANTS;
}

/* What is drawn of one point over a plain background, and how far it is off: the RMSE over the pixels' box. */
static double error_of(const smear_point *point, const double a[2], const double b[2], double radius, uint32_t clear, int method,
                       bool linear)
{
    smear_point copy = *point;
    const smear_points points = { &copy, 1 };
    const smear_overlay overlay = { NULL, 0, &points };
    const smear_camera eye = camera();
    const smear_frame frame = { .camera = &eye, .method = (uint8_t)method, .clear = clear, .overlay = &overlay,
                                .shutter = { .degrees = 360 }, .samples = 8,
                                .light_space = linear ? SMEAR_LIGHT_LINEAR : SMEAR_LIGHT_ENCODED };
    const smear_desc desc = desc_of();
    double sum = 0;
    int count = 0;
    RIG(r, &desc, false);
    CHECK_EQ(rig_frame(&r, &frame, NULL, 0), SMEAR_OK);
    const uint32_t *picture = (const uint32_t *)(void *)r.picture;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const double light = light_at(x + 0.5, y + 0.5, a, b, radius) * (255 - point->fade) / 255;
            for (int k = 0; k < 3; k++) {
                const double under = clear >> (16 - 8 * k) & 255u, own = point->color[k];
                const double keep = point->mode == SMEAR_POINT_BLEND ? 1 - light : 1;
                double want = linear ? code_of(fmin(light_of(under) * keep + light_of(own) * light, 1)) : under * keep + own * light;
                want = want > 255 ? 255 : want;
                const double off = (picture[y * WIDTH + x] >> (16 - 8 * k) & 255u) - want;
                if (light == 0)
                    CHECK(fabs(off) < 2);
                sum += light != 0 ? off * off : 0;
                count += light != 0;
            }
        }
    return count != 0 ? sqrt(sum / count) : 0;
}

/* Streaks of no, some and 40 pixels, in all directions, of every size, in both kinds of light. */
static void test_streaks_are_those_of_many_instants(void)
{
    static const uint32_t clear[3] = { 0, 0x304060, 0xc0c0c0 };
    static const double sizes[4] = { 0.6, 1, 2, 7 };
    double worst = 0;
    for (int i = 0; i < 192; i++) {
        const double turn = i * 0.37, length = i % 4 == 0 ? 40 : i % 4 == 1 ? 10 : i % 4 == 2 ? 1.3 : 0;
        const double size = sizes[i / 4 % 4];
        const double from[2] = { -2.3 - length / 2 * cos(turn), 1.7 - length / 2 * sin(turn) };
        const double to[2] = { from[0] + length * cos(turn), from[1] + length * sin(turn) };
        smear_point point = { .size = q16(size / 18), .color = { 255, 200, 90 }, .fade = (uint8_t)(i % 3 == 0 ? 100 : 0),
                              .mode = i % 5 == 0 ? SMEAR_POINT_BLEND : SMEAR_POINT_ADD };
        put(point.before, from[0], from[1]);
        put(point.now, to[0], to[1]);
        /* Centred: half a frame before now to half a frame after it. */
        double a[2], b[2];
        for (int k = 0; k < 2; k++) {
            const double middle = k == 0 ? WIDTH / 2 : HEIGHT / 2, sign = k == 0 ? 1 : -1;
            a[k] = middle + sign * (from[k] + to[k]) / 2;
            b[k] = middle + sign * (to[k] + (to[k] - from[k]) / 2);
        }
        const double off = error_of(&point, a, b, size / 2, clear[i % 3], SMEAR_AUTO, i / 3 % 2 == 0);
        worst = off > worst ? off : worst;
        CHECK(off <= 1);
    }
    printf("    largest RMSE of a streak: %.2f codes\n", worst);
}

/* ------------------------------------------------------------------ whole frames */

/* Sparks before, within and behind the busy scene, and beyond the frame. */
static void make_points(smear_point point[POINTS], double t)
{
    random_state = 7;
    for (int i = 0; i < POINTS; i++) {
        const double x = uniform(-3, 3), y = uniform(-1, 2);
        const double z = uniform(-7, -1), dx = uniform(-4, 4);
        const double dy = uniform(-4, 4);
        point[i] = (smear_point){ .now = { q16(x + dx * t), q16(y + dy * t), q16(z) },
                                  .before = { q16(x + dx * (t - 0.1)), q16(y + dy * (t - 0.1)), q16(z) },
                                  .size = q16(0.04 + 0.03 * (i % 5)), .color = { 255, (uint8_t)(90 + i), 40 },
                                  .fade = (uint8_t)(i * 5), .mode = (uint8_t)(i % 3 == 0) };
    }
}

static int differing(const uint8_t *a, const uint8_t *b)
{
    int n = 0;
    for (int i = 0; i < PIXELS; i++)
        n += memcmp(a + 4 * i, b + 4 * i, 4) != 0;
    return n;
}

/* Where nothing else moves, all methods draw the same streaks over the same picture: with a blended draw or without,
 * from one fill of the store or several. */
static void test_all_methods_draw_the_same_streaks(void)
{
    static uint32_t first[2][PIXELS];
    for (int i = 4 * SMEAR_RECONSTRUCT; i < 4 * SMEAR_METHOD_COUNT; i++) {
        const int method = i / 4, blends = i & 1, fills = i & 2;
        smear_point point[POINTS];
        const smear_points points = { point, POINTS };
        const smear_overlay overlay = { NULL, 0, &points };
        smear_desc desc = desc_of();
        desc.max_triangles = fills ? 4 : 0;
        struct scene s;
        make_scene(&s, 0.1, method);
        make_points(point, 0.1);
        s.frame.overlay = &overlay;
        s.frame.cut = 0;
        for (int k = 0; k < SCENE_DRAWS; k++) {
            s.draw[k].id = 0;
            if (!blends)
                s.material[k].alpha = SMEAR_OPAQUE;
        }
        RIG(r, &desc, false);
        CHECK_EQ(rig_frame(&r, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        if (method == SMEAR_RECONSTRUCT && !fills)
            memcpy(first[blends], r.picture, sizeof first[blends]);
        CHECK_EQ(differing((const uint8_t *)first[blends], r.picture), 0);
    }
}

/* ------------------------------------------------------------------ depth */

/* A wall that covers the right half of the frame in the middle of the exposure, at a distance; it moves, or stands. */
static void wall(struct scene *s, double distance, bool moves, int method)
{
    make_scene(s, 0, method);
    static smear_camera eye;
    eye = camera();
    s->frame.camera = &eye;
    s->frame.open = s->frame.close = NULL;
    s->frame.clear = 0;
    s->frame.shutter = (smear_shutter){ .degrees = 360, .poses = 1 };
    s->pose[0] = pose_at(3, 0, -distance, 0, 0);
    s->pose[1] = pose_at(moves ? 2.8 : 3, 0, -distance, 0, 0);
    s->pose[2] = pose_at(moves ? 3.2 : 3, 0, -distance, 0, 0);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 9; k++)
            s->pose[i].basis[k] *= 3;
    s->material[0] = (smear_material){ .color = { 1, 1, 1, 255 }, .unlit = 1 };
    s->draw[0] = (smear_draw){ .id = 1, .mesh = &square, .material = &s->material[0], .now = &s->pose[0], .open = &s->pose[1],
                               .close = &s->pose[2] };
}

static void test_points_are_hidden_by_what_is_nearer_in_the_middle_of_the_exposure(void)
{
    for (int method = SMEAR_NONE; method < SMEAR_METHOD_COUNT; method++)
        for (int moves = 0; moves < 2; moves++)
            for (int near = 0; near < 2; near++) {
                struct scene s;
                smear_point point = { .size = q16(2.0 / 18), .color = { 255, 255, 255 } };
                const smear_points points = { &point, 1 };
                const smear_overlay overlay = { NULL, 0, &points };
                const smear_desc desc = desc_of();
                put(point.now, 0, 0);
                put(point.before, -30, 0);      /* 15 pixels to either side in a frame's time, half open */
                wall(&s, near ? 9 : 11, moves != 0, method);
                s.frame.overlay = &overlay;
                RIG(r, &desc, false);
                CHECK_EQ(rig_frame(&r, &s.frame, s.draw, 1), SMEAR_OK);
                const uint32_t *row = (const uint32_t *)(void *)r.picture + HEIGHT / 2 * WIDTH;
                if (method == SMEAR_NONE)
                    CHECK(near ? (row[WIDTH / 2 + 1] & 255u) < 20 : (row[WIDTH / 2] & 255u) > 100);
                else
                    for (int x = 8; x < 24; x++) {
                        CHECK((row[WIDTH / 2 - x] & 255u) > 30);
                        CHECK(near ? (row[WIDTH / 2 + x] & 255u) < 20 : (row[WIDTH / 2 + x] & 255u) > 30);
                    }
            }
}

/* ------------------------------------------------------------------ a display that keeps what it is sent */

static void test_a_panel_is_sent_the_tiles_over_which_points_pass(void)
{
    smear_point point[2] = { { .size = 9000, .color = { 255, 90, 20 } }, { .size = 9000, .color = { 20, 90, 255 } } };
    smear_points points = { point, 2 };
    const smear_overlay overlay = { NULL, 0, &points };
    smear_desc desc = { .width = WIDTH, .height = HEIGHT, .tile = 8, .flush = place_band };
    RIG(whole, &desc, false);
    desc.reuse.buffer_age = 1;
    desc.reuse.cache_static = 1;
    RIG(kept, &desc, false);
    for (int i = 0; i < 12; i++) {
        struct scene s;
        make_scene(&s, 0, SMEAR_AUTO);
        for (int k = 0; k < 3; k++)
            point[0].now[k] = point[0].before[k] = s.camera.pose.origin[k] - (k == 2 ? 4 << 16 : 0);
        for (int k = 0; k < 3; k++)
            point[1].now[k] = point[1].before[k] = point[0].now[k] + (k == 0 ? 1 << 15 : 0);
        point[0].before[0] -= i >= 3 && i < 6 ? 9000 * i : 0;
        point[1].fade = i >= 8 ? 60 : 0;
        points.count = i >= 10 ? 1 : 2;
        s.frame.overlay = &overlay;
        kept.sent = 0;
        CHECK_EQ(rig_frame(&whole, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        CHECK_EQ(rig_frame(&kept, &s.frame, s.draw, SCENE_DRAWS), SMEAR_OK);
        CHECK(memcmp(kept.picture, whole.picture, PIXELS * 4) == 0);
        const bool changed = (i >= 3 && i < 7) || i == 8 || i == 10;
        CHECK(i < 2 || (kept.sent != 0) == changed);
        CHECK(i < 2 || kept.sent < PIXELS / 2);
    }
}

#include "build/suites/points.h"

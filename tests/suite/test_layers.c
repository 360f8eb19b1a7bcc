/* SPDX-License-Identifier: MIT */
/* test_layers.c - SMEAR_OBJECT and SMEAR_LAYERED: how far they are from the truth on the scenes of the quality suite, what
 * must stay as it is bit for bit, layers with settings of their own, memory. */
#include "layers/layer.h"
#include "tests/context_rig.h"
#include "tests/ref/accuracy.h"

/* ------------------------------------------------------------------ scenes of the suite */

/* Error of a method on a scene, exact poses, encoded light; NAN after a failed check. */
static double error_of(struct subject *s, smear_method method, int samples)
{
    enum { INSTANTS = 96 };         /* enough: on these scenes it is 0.2 codes from 1024 */
    struct shot shot OWNED(shot_free) = { 0 };
    struct present_options p = subject_options(s);
    p.shutter_poses = true;
    p.light = SMEAR_LIGHT_ENCODED;
    p.method = method;
    p.samples = samples;
    const struct ref_truth *truth = truth_of(s, &p, INSTANTS);
    return truth != NULL && shot_take(s, &p, &(struct shot_options){ 0 }, &shot) ? rmse_to_truth(shot.rgb, truth) : NAN;
}

/* The bar is 1.8 codes at 1.6 times the sharp frame (make chart counts the cost). */
static void test_object_is_within_1_8_codes_of_the_truth(void)
{
    static const char *const scene[] = { "suite/translate", "suite/cross", "suite/fence_obj", "suite/enter", "suite/long" };
    double sum = 0.0;
    for (int i = 0; i < 5; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        END_UNLESS(subject_open(&s, scene[i]));
        sum += log(error_of(&s, SMEAR_OBJECT, 0));
    }
    CHECK_BAR(exp(sum / 5), 1.8, "object");
}

static void test_layered_errs_two_thirds_of_reconstruct(void)
{
    double sum = 0.0;
    for (int i = 0; i < OBJECT_KINDS; i++) {
        struct subject s OWNED(subject_close) = { 0 };
        END_UNLESS(subject_open(&s, suite_kind[i]));
        sum += log(error_of(&s, SMEAR_LAYERED, 8) / error_of(&s, SMEAR_RECONSTRUCT, 8));
    }
    CHECK_BAR(exp(sum / OBJECT_KINDS), 2.0 / 3.0, "layered");
    truth_forget();
}

/* ------------------------------------------------------------------ a scene of plates */

enum { W = 96, H = 64, REACH = 10, TILE = 16 };

static const int16_t corners[] = { -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0 };
static const uint16_t sides[] = { 0, 1, 2, 0, 2, 3 };
static const smear_mesh square = { .position = corners, .vertex_count = 4, .index = sides, .triangle_count = 2 };
static const smear_material red = { .color = { 255, 0, 0, 255 }, .unlit = 1 };
static const smear_material green = { .color = { 0, 255, 0, 255 }, .unlit = 1 };
static const smear_material blue = { .color = { 0, 0, 255, 255 }, .unlit = 1 };
static const smear_material white = { .color = { 255, 255, 255, 255 }, .unlit = 1 };

/* A pixel is a unit of the world: the camera is orthographic, y up, its middle the frame's. */
static const smear_camera camera = { .pose = SMEAR_IDENTITY, .half_height = H / 2 << 16, .near_plane = 1 << 16,
                                     .far_plane = 101 << 16 };

/* A plate of the given half size around (x, y), `depth` units away. */
static smear_transform plate(double x, double y, double depth, double half_x, double half_y)
{
    smear_transform t = SMEAR_IDENTITY;
    t.basis[0] = (int32_t)(half_x * SMEAR_BASIS_ONE);
    t.basis[4] = (int32_t)(half_y * SMEAR_BASIS_ONE);
    t.origin[0] = (int32_t)(x * 65536);
    t.origin[1] = (int32_t)(y * 65536);
    t.origin[2] = (int32_t)(-depth * 65536);
    return t;
}

/* The plate moves so many pixels during the exposure, poses at shutter open and close. */
struct mover {
    smear_transform now, open, close;
};

static void mover_make(struct mover *m, double x, double y, double depth, double half_x, double half_y, double dx, double dy)
{
    m->now = plate(x, y, depth, half_x, half_y);
    m->open = plate(x - dx / 2, y - dy / 2, depth, half_x, half_y);
    m->close = plate(x + dx / 2, y + dy / 2, depth, half_x, half_y);
}

static smear_draw draw_of(const struct mover *m, const smear_material *material)
{
    return (smear_draw){ .mesh = &square, .material = material, .now = &m->now, .open = &m->open, .close = &m->close };
}

static uint32_t picture[W * H];

static smear_desc desc_of(void)
{
    return (smear_desc){ .width = W, .height = H, .reach = REACH, .tile = TILE, .format = SMEAR_XRGB8888,
                         .methods = SMEAR_SET_LAYERS };
}

static smear_stats stats;

static smear_frame frame_of(smear_method method)
{
    return (smear_frame){ .camera = &camera, .method = (uint8_t)method, .shutter.poses = 1, .light_space = SMEAR_LIGHT_ENCODED,
                          .clear = 0x102030 };
}

/* False after a failed check. */
static bool render(uint32_t *out, const smear_frame *frame, const smear_draw *draw, int count)
{
    const smear_desc desc = desc_of();
    RIG(r, &desc, false);
    const bool ok = CHECK_EQ(rig_frame(&r, frame, draw, count), SMEAR_OK);
    smear_get_stats(r.ctx, &stats);
    memcpy(out, r.picture, W * H * sizeof *out);
    return ok;
}

static int channel(uint32_t p, int shift)
{
    return (int)(p >> shift & 255u);
}

/* Largest difference within [x0, x1) x [y0, y1). */
static int difference(const uint32_t *a, const uint32_t *b, int x0, int y0, int x1, int y1)
{
    int most = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            for (int shift = 0; shift < 24; shift += 8) {
                int d = abs(channel(a[y * W + x], shift) - channel(b[y * W + x], shift));
                most = d > most ? d : most;
            }
    return most;
}

static const smear_method both[] = { SMEAR_OBJECT, SMEAR_LAYERED };

/* ------------------------------------------------------------------ what stays */

/* A still plate, a mover, one that opts out, one that is attached to nothing. */
static void test_pixels_that_no_streak_passes_are_those_of_none(void)
{
    static uint32_t sharp[W * H], scene[W * H];
    struct mover still, mover, calm;
    mover_make(&still, -30, 10, 20, 12, 15, 0, 0);
    mover_make(&mover, 20, 0, 10, 8, 8, 14, 4);
    mover_make(&calm, -20, -20, 15, 9, 7, 12, 0);
    smear_draw draw[3] = { draw_of(&still, &green), draw_of(&calm, &white), draw_of(&mover, &red) };
    draw[1].motion = SMEAR_MOTION_NONE;
    smear_frame none = frame_of(SMEAR_NONE);
    if (!render(sharp, &none, draw, 3) || !render(scene, &none, draw, 2))
        return;
    for (int k = 0; k < 2; k++) {
        smear_frame frame = frame_of(both[k]);
        END_UNLESS(render(picture, &frame, draw, 3));
        /* Its way and its size, and a pixel. */
        int x0 = W / 2 + 20 - 8 - 7 - 1, x1 = W / 2 + 20 + 8 + 7 + 1, y0 = H / 2 - 8 - 2 - 2, y1 = H / 2 + 8 + 2 + 2;
        CHECK_EQ(difference(picture, scene, 0, 0, x0, H), 0);
        CHECK_EQ(difference(picture, scene, x1, 0, W, H), 0);
        CHECK_EQ(difference(picture, scene, 0, 0, W, y0), 0);
        CHECK_EQ(difference(picture, scene, 0, y1, W, H), 0);
        CHECK(difference(picture, sharp, x0, y0, x1, y1) > 100);
        /* Tiles without the layer are told. */
        CHECK_EQ(stats.tiles_static + stats.tiles[SMEAR_OBJECT] + stats.tiles[SMEAR_LAYERED], W / TILE * (H / TILE));
        CHECK(stats.tiles_static >= 8);
        CHECK((k == 0 ? stats.tiles[SMEAR_OBJECT] : stats.tiles[SMEAR_LAYERED]) > 0);
        CHECK_EQ(k == 0 ? stats.tiles[SMEAR_LAYERED] : stats.tiles[SMEAR_OBJECT], 0);
    }
}

static void test_a_frame_in_which_nothing_moves_is_that_of_none(void)
{
    static uint32_t sharp[W * H];
    struct mover a, b;
    mover_make(&a, -10, 3, 20, 20, 11, 0, 0);
    mover_make(&b, 12, -5, 10, 9, 17, 0, 0);
    smear_draw draw[2] = { draw_of(&a, &green), draw_of(&b, &red) };
    smear_frame none = frame_of(SMEAR_NONE);
    END_UNLESS(render(sharp, &none, draw, 2));
    for (int k = 0; k < 2; k++) {
        smear_frame frame = frame_of(both[k]);
        if (render(picture, &frame, draw, 2))
            CHECK_EQ(difference(picture, sharp, 0, 0, W, H), 0);
        CHECK_EQ(stats.tiles_static, W / TILE * (H / TILE));
        CHECK_EQ(stats.samples, 0);
    }
}

/* A still fence before a mover: its pixels stay, the mover is seen between them. */
static void test_a_fence_before_a_mover_keeps_its_pixels(void)
{
    static uint32_t sharp[W * H];
    struct mover bar[12], ball;
    smear_draw draw[13];
    mover_make(&ball, 3, 0, 20, 14, 14, 18, 3);
    draw[0] = draw_of(&ball, &red);
    for (int i = 0; i < 12; i++) {
        mover_make(&bar[i], -44 + 8 * i, 0, 10, 1.5, 28, 0, 0);
        draw[1 + i] = draw_of(&bar[i], &green);
    }
    smear_frame none = frame_of(SMEAR_NONE);
    END_UNLESS(render(sharp, &none, draw, 13));
    for (int k = 0; k < 2; k++) {
        smear_frame frame = frame_of(both[k]);
        int fence = 0, between = 0;
        END_UNLESS(render(picture, &frame, draw, 13));
        for (int i = 0; i < W * H; i++) {
            if (sharp[i] == 0x00ff00) {
                fence++;
                CHECK_EQ(picture[i], sharp[i]);
            } else {
                between += channel(picture[i], 16) > 60;
            }
        }
        CHECK(fence > 12 * 3 * 50);
        CHECK(between > 300);
    }
}

/* Blended draws come after the blur, before and behind what moves. */
static void test_blended_draws_are_over_the_blur_and_behind_movers(void)
{
    static const smear_material pane = { .color = { 255, 255, 255, 128 }, .unlit = 1, .alpha = SMEAR_BLEND };
    struct mover ball, before, behind;
    mover_make(&ball, 0, 0, 20, 12, 12, 8, 0);
    mover_make(&before, -20, 0, 10, 20, 5, 0, 0);
    mover_make(&behind, 20, 0, 30, 20, 5, 0, 0);
    smear_draw draw[3] = { draw_of(&ball, &red), draw_of(&before, &pane), draw_of(&behind, &pane) };
    for (int k = 0; k < 2; k++) {
        smear_frame frame = frame_of(both[k]);
        END_UNLESS(render(picture, &frame, draw, 3));
        CHECK_NEAR(channel(picture[H / 2 * W + W / 2 - 3], 8), 128, 2);
        CHECK_EQ(picture[H / 2 * W + W / 2 + 3], 0xff0000);
        CHECK(channel(picture[H / 2 * W + W / 2 + 30], 8) > 128);
    }
}

/* ------------------------------------------------------------------ layers */

static void test_only_masked_draws_are_blurred(void)
{
    static uint32_t sharp[W * H];
    struct mover a, b;
    mover_make(&a, -24, 0, 10, 8, 8, 12, 0);
    mover_make(&b, 24, 0, 10, 8, 8, 12, 0);
    smear_draw draw[2] = { draw_of(&a, &green), draw_of(&b, &red) };
    draw[1].layers = 4;
    const smear_layer masked = { .mask = 4 };
    smear_frame none = frame_of(SMEAR_NONE);
    END_UNLESS(render(sharp, &none, draw, 2));
    for (int k = 0; k < 2; k++) {
        smear_frame frame = frame_of(both[k]);
        frame.layer = &masked;
        frame.layer_count = 1;
        END_UNLESS(render(picture, &frame, draw, 2));
        CHECK_EQ(difference(picture, sharp, 0, 0, W / 2, H), 0);
        CHECK(difference(picture, sharp, W / 2, 0, W, H) > 100);
    }
}

/* Columns of red over black, in pixels of full red. */
static double red_width(void)
{
    double sum = 0.0;
    int first = W, last = 0;
    for (int x = 0; x < W; x++) {
        int r = channel(picture[H / 2 * W + x], 16);
        sum += r / 255.0;
        if (r > 4) {
            first = x < first ? x : first;
            last = x;
        }
    }
    CHECK_CLOSE(sum, 16.0, 0.5);
    return last - first + 1;
}

static void test_a_layer_has_its_own_shutter(void)
{
    struct mover m;
    mover_make(&m, 0, 0, 10, 8, 8, 8, 0);
    smear_draw draw = draw_of(&m, &red);
    const smear_layer longer = { .mask = 255, .shutter_degrees = 360 };
    for (int k = 0; k < 2; k++) {
        smear_frame frame = frame_of(both[k]);
        frame.clear = 0;
        frame.samples = 32;
        END_UNLESS(render(picture, &frame, &draw, 1));
        double once = red_width();
        frame.layer = &longer;
        frame.layer_count = 1;
        END_UNLESS(render(picture, &frame, &draw, 1));
        CHECK_CLOSE(once, 16 + 8, 1.5);
        double twice = red_width();
        CHECK_CLOSE(twice, 16 + 16, 3.5);      /* nodes of long streaks lie 4 px apart */
    }
}

static void test_a_layer_has_its_own_method(void)
{
    static uint32_t object[W * H], layered[W * H], sharp[W * H];
    struct mover a, b, c;
    mover_make(&a, -30, 0, 10, 6, 6, 10, 0);
    mover_make(&b, 0, 0, 10, 6, 6, 10, 0);
    mover_make(&c, 30, 0, 10, 6, 6, 10, 0);
    smear_draw draw[3] = { draw_of(&a, &red), draw_of(&b, &green), draw_of(&c, &white) };
    for (int i = 0; i < 3; i++)
        draw[i].layers = (uint8_t)(1 << i);
    const smear_layer layer[3] = { { .mask = 1, .method = SMEAR_OBJECT }, { .mask = 2, .method = SMEAR_LAYERED },
                                   { .mask = 4, .method = SMEAR_NONE } };
    smear_frame frame = frame_of(SMEAR_OBJECT), other = frame_of(SMEAR_LAYERED), none = frame_of(SMEAR_NONE);
    if (!render(object, &frame, draw, 3) || !render(layered, &other, draw, 3) || !render(sharp, &none, draw, 3))
        return;
    frame.layer = layer;
    frame.layer_count = 3;
    END_UNLESS(render(picture, &frame, draw, 3));
    CHECK(difference(picture, object, 0, 0, W / 2 - 15, H) <= 8);        /* there it was one group with others */
    CHECK_EQ(difference(picture, layered, W / 2 - 15, 0, W / 2 + 15, H), 0);
    CHECK_EQ(difference(picture, sharp, W / 2 + 15, 0, W, H), 0);
    CHECK(difference(object, layered, 0, 0, W, H) > 0);
}

/* A cockpit: over a moving view, sharp, whatever the depths are; and as none draws it alone. */
static void test_a_layer_with_its_own_camera_stays_sharp_over_the_view(void)
{
    static uint32_t alone[W * H];
    smear_camera view = camera, before = camera, after = camera;
    before.pose.origin[0] = -6 * 65536;
    after.pose.origin[0] = 6 * 65536;
    struct mover wall, dial;
    mover_make(&wall, 5, 0, 5, 30, 30, 0, 0);
    mover_make(&dial, -20, -18, 60, 25, 12, 0, 0);      /* farther than the wall, by depth */
    smear_draw draw[2] = { draw_of(&dial, &blue), draw_of(&wall, &green) };
    draw[0].layers = 2;
    const smear_layer layer[2] = { { .mask = 1 }, { .mask = 2, .camera = &camera } };
    smear_frame none = frame_of(SMEAR_NONE);
    END_UNLESS(render(alone, &none, draw, 1));
    for (int k = 0; k < 2; k++) {
        smear_frame frame = frame_of(both[k]);
        frame.camera = &view;
        frame.open = &before;
        frame.close = &after;
        frame.layer = layer;
        frame.layer_count = 2;
        END_UNLESS(render(picture, &frame, draw, 2));
        int cockpit = 0, streak = 0;
        for (int i = 0; i < W * H; i++) {
            if (alone[i] == 0x0000ff) {
                cockpit++;
                CHECK_EQ(picture[i], alone[i]);
            } else {
                int g = channel(picture[i], 8);
                streak += g > 60 && g < 220;
            }
        }
        CHECK_EQ(cockpit, 50 * 24);
        CHECK(streak > 300);            /* the wall, as the view moves */
    }
}

/* A layer whose camera moves is blurred as the frame is where its camera moves so: by either method, and where what it
 * sees stands still. */
static void test_a_layers_camera_blurs_what_stands_still(void)
{
    static uint32_t view[W * H];
    smear_camera before = camera;
    before.pose.origin[0] = -8 * 65536;
    struct mover m;
    mover_make(&m, 4, 4, 20, 12, 8, 0, 0);
    const smear_draw draw = draw_of(&m, &green);
    for (int k = 0; k < 2; k++) {
        const smear_layer layer = { .mask = 255, .camera = &camera, .open = &before };
        smear_frame frame = frame_of(both[k]);
        frame.open = &before;
        END_UNLESS(render(view, &frame, &draw, 1));
        frame.open = NULL;
        frame.layer = &layer;
        frame.layer_count = 1;
        END_UNLESS(render(picture, &frame, &draw, 1));
        CHECK_EQ(stats.draws_moved, 1);
        CHECK_EQ(difference(picture, view, 0, 0, W, H), 0);
        CHECK(channel(view[(H / 2 - 4) * W + W / 2 - 9], 8) > 60 && channel(view[(H / 2 - 4) * W + W / 2 - 9], 8) < 220);
    }
}

/* Between a perspective and an orthographic view there is no path: neither in a layer nor in the frame. */
static void test_cameras_of_two_kinds_are_as_a_camera_that_stands(void)
{
    static uint32_t still[W * H];
    const smear_camera lens = { .pose = SMEAR_IDENTITY, .focal = 1 << 16, .near_plane = 1 << 16, .far_plane = 101 << 16 };
    smear_camera beside = lens, above = camera;
    beside.pose.origin[0] = above.pose.origin[1] = 3 << 16;
    struct mover behind, front;
    mover_make(&behind, 0, 0, -20, 12, 8, 0, 0);
    mover_make(&front, 4, 4, 20, 12, 8, 0, 0);
    const smear_draw draw[2] = { draw_of(&behind, &red), draw_of(&front, &green) };
    for (int i = 0; i < 8; i++) {
        const smear_camera *const now = i & 1 ? &lens : &camera, *const other = i & 1 ? &above : &beside;
        smear_frame frame = frame_of(both[i >> 1 & 1]);
        smear_layer layer = { .mask = 255, .camera = now };
        if (i < 4) {
            frame.layer = &layer;
            frame.layer_count = 1;
        } else {
            frame.camera = now;
        }
        END_UNLESS(render(still, &frame, draw, 2));
        layer.open = other;
        if (i >= 4)
            frame.open = other;
        if (!render(picture, &frame, draw, 2) || !CHECK_EQ(difference(picture, still, 0, 0, W, H), 0))
            CHECK_EQ(i, -1);
    }
}

static void test_a_layer_may_lie_over_all(void)
{
    struct mover bar, ball;
    mover_make(&bar, 0, 0, 10, 3, 28, 0, 0);
    mover_make(&ball, 0, 0, 20, 14, 14, 12, 0);
    smear_draw draw[2] = { draw_of(&bar, &green), draw_of(&ball, &red) };
    draw[1].layers = 2;
    smear_layer layer = { .mask = 2, .over = 1 };
    for (int k = 0; k < 3; k++) {
        smear_frame frame = frame_of(both[k % 2]);
        if (k == 2)
            layer = (smear_layer){ .mask = 2, .two_camera = 1 };
        frame.layer = &layer;
        frame.layer_count = 1;
        END_UNLESS(render(picture, &frame, draw, 2));
        CHECK_EQ(picture[H / 2 * W + W / 2], 0xff0000);
        CHECK_EQ(picture[4 * W + W / 2], 0x00ff00);
    }
}

/* As two cameras do it, without their faults: no dark fringe, and half of the way covers half. */
static void test_a_plain_layer_has_no_dark_fringe(void)
{
    struct mover m;
    mover_make(&m, 0, 0, 10, 10, 10, 16, 0);
    smear_draw draw = draw_of(&m, &white);
    const smear_layer plain = { .mask = 255, .two_camera = 1 };
    smear_frame frame = frame_of(SMEAR_OBJECT);
    frame.clear = 0xffffff;
    frame.samples = 5;
    frame.layer = &plain;
    frame.layer_count = 1;
    END_UNLESS(render(picture, &frame, &draw, 1));
    for (int i = 0; i < W * H; i++)
        CHECK_EQ(picture[i], 0xffffff);
    frame.clear = 0;
    frame.samples = 16;
    if (render(picture, &frame, &draw, 1))
        CHECK_NEAR(channel(picture[H / 2 * W + W / 2 + 10], 16), 128, 24);
}

/* ------------------------------------------------------------------ limits */

static void test_bad_layers_are_refused(void)
{
    smear_desc desc = desc_of();
    RIG(r, &desc, false);
    smear_camera bad_camera = { .pose = SMEAR_IDENTITY };
    const smear_layer good = { .mask = 1 };
    const smear_layer bad[] = {
        { .mask = 0 }, { .mask = 1, .method = SMEAR_RECONSTRUCT }, { .mask = 1, .method = 200 },
        { .mask = 1, .shutter_degrees = 3601 }, { .mask = 1, .camera = &bad_camera }, { .mask = 1, .open = &camera },
        { .mask = 1, .camera = &camera, .close = &bad_camera }
    };
    smear_layer many[SMEAR_LAYERS_MAX + 1];
    for (int i = 0; i <= SMEAR_LAYERS_MAX; i++)
        many[i] = good;
    smear_frame frame = frame_of(SMEAR_OBJECT);
    frame.layer_count = 1;
    CHECK_EQ(smear_error_kind(smear_begin(r.ctx, &frame)), SMEAR_ERR_ARG);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        frame.layer = &bad[i];
        CHECK_EQ(smear_error_kind(smear_begin(r.ctx, &frame)), SMEAR_ERR_ARG);
    }
    frame.layer = many;
    frame.layer_count = SMEAR_LAYERS_MAX + 1;
    CHECK_EQ(smear_error_kind(smear_begin(r.ctx, &frame)), SMEAR_ERR_ARG);
    frame.layer_count = SMEAR_LAYERS_MAX;
    CHECK_EQ(smear_begin(r.ctx, &frame), SMEAR_OK);
    frame.layer_count = 0;
    CHECK_EQ(smear_error_kind(smear_begin(r.ctx, &frame)), SMEAR_ERR_ARG);
    /* No room for layers. */
    desc.methods = SMEAR_SET(SMEAR_NONE);
    RIG(small, &desc, false);
    frame = frame_of(SMEAR_OBJECT);
    CHECK_EQ(smear_error_kind(smear_begin(small.ctx, &frame)), SMEAR_ERR_ARG);
    frame = frame_of(SMEAR_LAYERED);
    CHECK_EQ(smear_error_kind(smear_begin(small.ctx, &frame)), SMEAR_ERR_ARG);
}

static void test_memory_of_layers_is_small(void)
{
    const smear_desc desc = { .width = 240, .height = 240, .tile = 16, .reach = 12, .max_triangles = 600, .max_draws = 8,
                              .format = SMEAR_RGB565, .methods = SMEAR_SET_LAYERS, .flush = take_band };
    const size_t need = smear_memory_size(&desc);
    CHECK(need > 0 && need <= 209u * 1024u);
}

#include "build/suites/layers.h"

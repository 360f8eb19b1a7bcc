/* SPDX-License-Identifier: MIT */
/* test_ref.c - the reference renderer against closed forms, where the library, which is drawn beside it in the suites accuracy and
 * scenes, does not show what is wrong: velocities, texels, exposures, comparison. */
#include "tests/host.h"

#include "tools/ref/ref.h"

enum { SIZE = 64 };

static const double pi = 3.14159265358979323846;

/* ------------------------------------------------------------------ small scenes */

static void matrix_identity(double m[16])
{
    memset(m, 0, 16 * sizeof *m);
    m[0] = m[5] = m[10] = m[15] = 1.0;
}

static struct scene_camera orthographic(void)
{
    struct scene_camera camera = { .orthographic = true, .half_height = SIZE / 2, .znear = 1.0,
                                   .zfar = 1000.0 };
    matrix_identity(camera.pose);
    return camera;
}

static struct scene_camera perspective(void)
{
    struct scene_camera camera = { .yfov = pi / 2.0, .znear = 0.5 };
    matrix_identity(camera.pose);
    return camera;
}

/* World coordinates that the camera shows at (x, y) of the screen at distance d. */
static void place(float *out, const struct scene_camera *camera, double x, double y, double d)
{
    double unit = camera->orthographic ? 1.0 : d / (SIZE / 2);
    out[0] = (float)((x - SIZE / 2) * unit);
    out[1] = (float)((SIZE / 2 - y) * unit);
    out[2] = (float)-d;
}

static const uint32_t quad_index[6] = { 0, 1, 2, 0, 2, 3 };

static struct scene_surface surface_of(const float *position, int vertices, const uint32_t *index,
                                       int triangles)
{
    return (struct scene_surface){
        .vertex_count = vertices, .triangle_count = triangles, .position = position, .index = index,
        .material = { .base = { 1.0f, 1.0f, 1.0f, 1.0f }, .unlit = true, .alpha_cutoff = 0.5f },
    };
}

static struct scene_draw draw_of(const struct scene_surface *surface)
{
    struct scene_draw draw = { .surface = surface, .position = surface->position,
                               .normal = surface->normal, .node = -1 };
    matrix_identity(draw.world);
    return draw;
}

static struct scene_instant instant_of(struct scene_draw *draw, int count,
                                       struct scene_camera camera)
{
    return (struct scene_instant){ .camera = camera, .draw_count = count, .draw = draw };
}

/* A rectangle that faces the camera. */
static void place_quad(float position[12], const struct scene_camera *camera, double left,
                       double top, double right, double bottom, double d)
{
    place(position, camera, left, top, d);
    place(position + 3, camera, left, bottom, d);
    place(position + 6, camera, right, bottom, d);
    place(position + 9, camera, right, top, d);
}

static bool draw_now(const struct scene_instant *now, bool encoded, struct ref_frame *frame)
{
    struct failure f = {{0}};
    struct ref_options options = { .width = SIZE, .height = SIZE, .encoded = encoded };
    return CHECK(ref_draw(now, NULL, NULL, &options, frame, &f));
}

static size_t at(int x, int y)
{
    return (size_t)y * SIZE + (size_t)x;
}

/* ------------------------------------------------------------------ depth and velocity */

static void test_velocity_is_the_screen_path_of_the_surface_point(void)
{
    float position[12];
    struct scene_camera camera = perspective();
    struct ref_options options = { .width = SIZE, .height = SIZE };
    struct ref_frame frame;
    struct failure f = {{0}};
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    struct scene_draw draw = draw_of(&surface), before = draw;
    struct scene_instant now = instant_of(&draw, 1, camera), then = instant_of(&before, 1, camera);

    before.world[12] = -3.0;                /* came 3 to the right and 1 up: 32/16 px per unit */
    before.world[13] = -1.0;
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
    for (int y = 8; y < 56; y += 5)
        for (int x = 8; x < 56; x += 5) {
            CHECK_CLOSE(frame.velocity[2 * at(x, y)], 6.0, 1e-9);
            CHECK_CLOSE(frame.velocity[2 * at(x, y) + 1], -2.0, 1e-9);
        }
    CHECK(frame.velocity[0] == 0.0 && frame.velocity[1] == 0.0);
    ref_frame_free(&frame);

    matrix_identity(before.world);          /* came from d = 20 to d = 16: away from the middle */
    before.world[14] = -4.0;
    options.velocity_scale = 2.0;
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
    for (int x = 8; x < 56; x += 5)
        CHECK_CLOSE(frame.velocity[2 * at(x, 20)], 2.0 * (x - 31.5) * (1.0 - 16.0 / 20.0), 1e-9);
    ref_frame_free(&frame);

    matrix_identity(before.world);          /* the camera went 2 to the left instead */
    then.camera.pose[12] = 2.0;
    options.velocity_scale = 0.0;
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
    CHECK_CLOSE(frame.velocity[2 * at(20, 20)], 4.0, 1e-9);
    CHECK_CLOSE(frame.velocity[2 * at(20, 20) + 1], 0.0, 1e-9);
    ref_frame_free(&frame);

    before.world[14] = 20.0;                /* came from behind the eye: no path */
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
    CHECK(isnan(frame.velocity[2 * at(20, 20)]));
    ref_frame_free(&frame);
}

static void test_cut_and_masked_draws_move_with_the_camera_only(void)
{
    float position[12];
    struct scene_camera camera = orthographic();
    struct ref_frame frame;
    struct failure f = {{0}};
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    struct scene_draw draw = draw_of(&surface), before = draw;
    struct scene_instant now = instant_of(&draw, 1, camera), then = instant_of(&before, 1, camera);
    before.world[12] = -5.0;
    then.camera.pose[12] = -2.0;            /* the camera goes right: everything goes left by 2 */
    for (int way = 0; way < 7; way++) {
        static const double want[7] = { 3.0, -2.0, -2.0, -2.0, -2.0, 0.0, 0.0 };
        uint8_t motion = way == 4 ? SCENE_MOTION_CAMERA : way == 5 ? SCENE_MOTION_NONE
                                                                   : SCENE_MOTION_FULL;
        struct ref_options options = { .width = SIZE, .height = SIZE, .motion = &motion,
                                       .motion_count = 1 };
        before.epoch = way == 1;
        before.hidden = way == 2;
        then.draw_count = way != 3;
        then.camera.epoch = way == 6;
        REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));
        CHECK_CLOSE(frame.velocity[2 * at(30, 30)], want[way], 1e-9);
        ref_frame_free(&frame);
    }
}

/* ------------------------------------------------------------------ textures */

static uint8_t texel_value(long x, long y)
{
    return (uint8_t)(10 + 40 * x + 100 * y);
}

/* A 4 x 2 picture: red is distinct everywhere, alpha is 0 in one texel. */
static struct image small_image(void)
{
    static uint8_t rgba[4 * 8];
    for (int i = 0; i < 8; i++) {
        rgba[4 * i] = rgba[4 * i + 1] = rgba[4 * i + 2] = texel_value(i % 4, i / 4);
        rgba[4 * i + 3] = i == 1 ? 0 : 255;
    }
    return (struct image){ .width = 4, .height = 2, .rgba = rgba };
}

static long wrapped(long i, long n, enum model_wrap wrap)
{
    if (wrap == MODEL_WRAP_CLAMP)
        return i < 0 ? 0 : i >= n ? n - 1 : i;
    long period = wrap == MODEL_WRAP_MIRROR ? 2 * n : n, k = (i % period + period) % period;
    return k < n ? k : 2 * n - 1 - k;
}

/* 64 px across 16 texels (-6 .. 10 of a 4 wide picture): pixel x is inside texel x/4 - 6. */
static void test_texels_are_found_under_every_wrap_mode(void)
{
    static const float uv[8] = { -1.5f, -2.0f, -1.5f, 6.0f, 2.5f, 6.0f, 2.5f, -2.0f };
    static const enum model_wrap modes[3] = { MODEL_WRAP_REPEAT, MODEL_WRAP_CLAMP,
                                              MODEL_WRAP_MIRROR };
    float position[12];
    struct image image = small_image();
    struct scene_camera camera = orthographic();
    place_quad(position, &camera, 0, 0, 64, 64, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    surface.uv = uv;
    surface.material.image = &image;
    for (int mode = 0; mode < 9; mode++) {
        struct scene_draw draw = draw_of(&surface);
        struct scene_instant now = instant_of(&draw, 1, camera);
        struct ref_frame frame OWNED(ref_frame_free) = { 0 };
        surface.material.wrap_u = modes[mode % 3];
        surface.material.wrap_v = modes[mode / 3];
        END_UNLESS(draw_now(&now, true, &frame));
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++) {
                uint8_t want = texel_value(wrapped(x / 4 - 6, 4, surface.material.wrap_u),
                                           wrapped(y / 4 - 4, 2, surface.material.wrap_v));
                CHECK_EQ(lround(frame.color[3 * at(x, y)] * 255.0), want);
            }
    }
}

static void test_bilinear_texels_mix_in_the_working_light(void)
{
    static const float uv[8] = { 0, 0, 0, 2, 4, 2, 4, 0 };
    float position[12];
    struct image image = small_image();
    struct scene_camera camera = orthographic();
    place_quad(position, &camera, 0, 0, 64, 64, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    surface.uv = uv;
    surface.material.image = &image;
    surface.material.bilinear = true;
    for (int encoded = 0; encoded < 2; encoded++) {
        struct scene_draw draw = draw_of(&surface);
        struct scene_instant now = instant_of(&draw, 1, camera);
        struct ref_frame frame OWNED(ref_frame_free) = { 0 };
        END_UNLESS(draw_now(&now, encoded != 0, &frame));
        /* Pixel 5, 5 is at texel 1.375, 0.34: between columns 0 and 1, rows -1 and 0. */
        double value[4];
        for (int k = 0; k < 4; k++) {
            double code = texel_value(k & 1, k < 2 ? 1 : 0) / 255.0;
            value[k] = encoded ? code : ref_srgb_decode(code);
        }
        double v = 5.5 / 16.0 + 0.5, above = value[0] * 0.125 + value[1] * 0.875;
        double below = value[2] * 0.125 + value[3] * 0.875;
        CHECK_CLOSE(frame.color[3 * at(5, 5)], above * (1.0 - v) + below * v, 1e-9);
    }
}

/* ------------------------------------------------------------------ scenes of time */

struct slide {                      /* draws that move to the right at `speed` units per second */
    struct scene_draw draw[3];
    int draw_count;
    double speed;
    struct scene_camera camera;
};

static bool slide_pose(struct scene *scene, double time, struct scene_instant *out,
                       struct failure *f)
{
    const struct slide *slide = scene->data;
    if (out->store == NULL && (out->store = malloc(sizeof slide->draw)) == NULL)
        return fail(f, "no memory");
    memcpy(out->store, slide->draw, sizeof slide->draw);
    out->draw = out->store;
    out->draw_count = slide->draw_count;
    out->draw[0].world[12] = slide->speed * time;
    out->camera = slide->camera;
    return true;
}

static void slide_free(struct scene *scene, struct scene_instant *instant)
{
    (void)scene;
    free(instant->store);
}

static struct scene scene_of(struct slide *slide)
{
    return (struct scene){ .name = "slide", .width = SIZE, .height = SIZE, .fps = 10.0,
                           .pose = slide_pose, .instant_free = slide_free, .data = slide };
}

/* A white half plane whose right edge is at 20.5 px at t = 0 and moves 8 px per exposure. */
static struct slide edge_slide(float position[12], struct scene_surface *surface)
{
    struct slide slide = { .draw_count = 1, .speed = 160.0, .camera = orthographic() };
    place_quad(position, &slide.camera, -64, 0, 20.5, 64, 16.0);
    *surface = surface_of(position, 4, quad_index, 2);
    slide.draw[0] = draw_of(surface);
    return slide;
}

/* Two instants stand at a quarter and three quarters of the exposure. */
static void test_instants_stand_in_the_middle_of_their_share(void)
{
    float position[12];
    struct scene_surface surface;
    struct slide slide = edge_slide(position, &surface);
    struct scene scene = scene_of(&slide);
    struct ref_truth_options options = { .shutter_degrees = 180.0, .instants = 2, .encoded = true };
    struct ref_truth truth;
    struct failure f = {{0}};
    position[6] = position[9] += 0.25f;     /* at 20.75, so from 16.75 to 24.75 */
    REQUIRE(ref_truth(&scene, &options, &truth, &f));
    for (int x = 0; x < SIZE; x++) {
        int want = x + 0.5 < 18.75 ? 255 : x + 0.5 < 22.75 ? 128 : 0;
        CHECK_EQ(truth.image.rgba[4 * at(x, 9)], want);
    }
    ref_truth_free(&truth);
}

/* The first column that is not black and the first that is not white say where the edge went. */
static void test_the_exposure_lies_before_around_or_after_the_frame(void)
{
    static const double from[3] = { 16.5, 12.5, 20.5 };
    float position[12];
    struct scene_surface surface;
    struct slide slide = edge_slide(position, &surface);
    struct scene scene = scene_of(&slide);
    for (int way = 0; way < 3; way++) {
        struct ref_truth_options options = { .shutter_degrees = 180.0, .instants = 16,
                                             .exposure = (enum ref_exposure)way };
        struct ref_truth truth;
        struct failure f = {{0}};
        REQUIRE(ref_truth(&scene, &options, &truth, &f));
        for (int x = 0; x < SIZE; x++) {
            bool grey = x + 0.5 > from[way] && x + 0.5 < from[way] + 8.0;
            uint8_t code = truth.image.rgba[4 * at(x, 5)];
            CHECK_EQ(code != 255 && code != 0, grey);
        }
        ref_truth_free(&truth);
    }
    struct ref_truth_options still = { .instants = 16, .time = 0.05 };
    struct ref_truth truth;
    struct failure f = {{0}};
    if (CHECK(ref_truth(&scene, &still, &truth, &f))) {
        CHECK_EQ(truth.image.rgba[4 * at(27, 5)], 255);     /* sharp, at 28.5 */
        CHECK_EQ(truth.image.rgba[4 * at(28, 5)], 0);
        ref_truth_free(&truth);
    }
}

/* ------------------------------------------------------------------ ids and comparison */

struct copied {                     /* what a renderer that agrees would hand over */
    uint8_t rgb[3 * SIZE * SIZE], id[3 * SIZE * SIZE];
    float depth[SIZE * SIZE], velocity[2 * SIZE * SIZE];
};

static struct ref_planes planes_of(const struct ref_frame *frame, struct copied *copy)
{
    for (size_t i = 0; i < SIZE * SIZE; i++) {
        ref_id_to_rgb(frame->triangle[i], copy->id + 3 * i);
        copy->depth[i] = (float)frame->depth[i];
        for (size_t c = 0; c < 2; c++)
            copy->velocity[2 * i + c] = (float)frame->velocity[2 * i + c];
        for (size_t c = 0; c < 3; c++)
            copy->rgb[3 * i + c] =
                (uint8_t)lround(255.0 * ref_srgb_encode(frame->color[3 * i + c]));
    }
    return (struct ref_planes){ .width = SIZE, .height = SIZE, .rgb = copy->rgb,
                                .depth = copy->depth, .velocity = copy->velocity,
                                .id_rgb = copy->id };
}

static void test_comparison_finds_each_planted_difference(void)
{
    static struct copied copy;
    float position[12];
    struct scene_camera camera = orthographic();
    struct failure f = {{0}};
    struct ref_options options = { .width = SIZE, .height = SIZE };
    struct ref_frame frame OWNED(ref_frame_free) = { 0 };
    struct ref_difference d;
    place_quad(position, &camera, 8, 8, 56, 56, 16.0);
    struct scene_surface surface = surface_of(position, 4, quad_index, 2);
    struct scene_draw draw = draw_of(&surface), before = draw;
    struct scene_instant now = instant_of(&draw, 1, camera), then = instant_of(&before, 1, camera);
    before.world[12] = -4.0;
    surface.material.base[1] = 0.25f;
    REQUIRE(ref_draw(&now, &then, &now, &options, &frame, &f));

    struct ref_planes planes = planes_of(&frame, &copy);
    ref_compare(&frame, &planes, &d);
    CHECK_EQ(d.pixels, SIZE * SIZE);
    CHECK_EQ(d.same, 48 * 48);
    CHECK(d.triangle == 0 && d.coverage == 0 && d.off_edge == 0);
    CHECK(d.depth_max < 1e-7 && d.velocity_max < 1e-6 && d.color_max <= 0.5);
    CHECK_EQ(d.velocity_pixels, 46 * 46);

    ref_id_to_rgb(-1, copy.id + 3 * at(8, 20));         /* on the left edge */
    ref_id_to_rgb(0, copy.id + 3 * at(20, 20));         /* perhaps the diagonal's other side */
    ref_id_to_rgb(7, copy.id + 3 * at(3, 60));          /* far from everything */
    ref_id_to_rgb(7, copy.id + 3 * at(30, 50));
    ref_id_to_rgb(1 - frame.triangle[at(30, 30)], copy.id + 3 * at(30, 30));
    copy.depth[at(40, 12)] *= 1.25f;
    copy.velocity[2 * at(41, 12)] += 3.0f;
    copy.velocity[2 * at(41, 12) + 1] -= 4.0f;
    copy.velocity[2 * at(8, 50)] = 99.0f;               /* on the silhouette: not looked at */
    copy.rgb[3 * at(42, 12) + 2] = 205;
    ref_compare(&frame, &planes, &d);
    CHECK_EQ(d.coverage, 2);
    CHECK(d.triangle == 4 || d.triangle == 5);          /* 5 if (20, 20) is triangle 1 */
    CHECK_EQ(d.off_edge, 2);
    CHECK(d.off_edge_x == 30 && d.off_edge_y == 50);
    CHECK(d.depth_x == 40 && d.depth_y == 12);
    CHECK_CLOSE(d.depth_max, 0.25, 1e-6);
    CHECK(d.velocity_x == 41 && d.velocity_y == 12);
    CHECK_CLOSE(d.velocity_max, 5.0, 1e-6);
    CHECK_CLOSE(d.velocity_rms, 5.0 / sqrt(d.velocity_pixels), 1e-6);
    CHECK(d.color_x == 42 && d.color_y == 12);
    CHECK_CLOSE(d.color_max, 50.0, 1e-6);

    planes.width = SIZE - 1;
    ref_compare(&frame, &planes, &d);
    CHECK(d.off_edge == SIZE * SIZE && isinf(d.depth_max) && isinf(d.color_rms));
}

#include "build/suites/ref.h"

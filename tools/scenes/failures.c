/* SPDX-License-Identifier: MIT */
/* failures.c - scenes fail/... on a plane before an orthographic camera: one unit is one pixel, and
 * an exposure of 360 degrees lasts from -1/2 to 1/2 of what fail_shutters counts. */
#include "tools/scenes/failures.h"

#include "tools/scenes/suite.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Where things stand, seen from above. */
#define BACK (-50.0)
#define FRONT 40.0

/* ------------------------------------------------------------------ materials */

double fail_shutters(double time)
{
    return (time - FAIL_TIME) * FAIL_FPS;
}

struct scene_surface *fail_unlit(struct build *b)
{
    struct scene_surface *s = build_finish(b);
    if (s != NULL)
        s->material.unlit = true;
    return s;
}

static double smooth(double t)
{
    return t * t * (3 - 2 * t);
}

/* Random values at the corners of squares `period` texels wide, smooth between them; wraps. */
static double octave(const double *value, int period, int x, int y)
{
    int n = 256 / period, i = x / period, j = y / period;
    double u = smooth((x % period + 0.5) / period), v = smooth((y % period + 0.5) / period);
    double a = value[j * n + i], b = value[j * n + (i + 1) % n];
    double c = value[(j + 1) % n * n + i], d = value[(j + 1) % n * n + (i + 1) % n];
    return (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
}

static uint32_t mix(uint32_t dark, uint32_t light, double part)
{
    uint32_t rgb = 0;
    for (int shift = 0; shift <= 16; shift += 8) {
        double low = dark >> shift & 255, high = light >> shift & 255;
        rgb |= (uint32_t)(low + (high - low) * part + 0.5) << shift;
    }
    return rgb;
}

const struct image *fail_noise(struct stage *stage, uint32_t seed, uint32_t dark, uint32_t light)
{
    enum { EDGE = 256, COARSE = 32, FINE = 8 };
    double coarse[EDGE / COARSE * (EDGE / COARSE)], fine[EDGE / FINE * (EDGE / FINE)];
    struct image *image = stage_image(stage, EDGE, EDGE);
    for (size_t i = 0; i < sizeof coarse / sizeof *coarse; i++)
        coarse[i] = suite_random(&seed);
    for (size_t i = 0; i < sizeof fine / sizeof *fine; i++)
        fine[i] = suite_random(&seed);
    for (int y = 0; image != NULL && y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            double v = 0.6 * octave(coarse, COARSE, x, y) + 0.4 * octave(fine, FINE, x, y);
            stage_texel(image, x, y, mix(dark, light, v));
        }
    return image;
}

#define GREY 0x303848u
#define NOISE_DARK 0x182840u
#define NOISE_LIGHT 0xf4e6c0u

static const struct image *plain_noise(struct stage *stage, uint32_t seed)
{
    return fail_noise(stage, seed, NOISE_DARK, NOISE_LIGHT);
}

int fail_plane(struct stage *stage, const struct image *image, double half_width,
               double half_height, double scale)
{
    struct build b = build_begin(stage, BUILD_UV);
    double texels = image != NULL ? image->width * scale : 1, u = half_width / texels;
    double v = half_height / texels;
    uint32_t corner[4];
    for (int i = 0; i < 4; i++) {
        double x = i == 1 || i == 2 ? 1 : -1, y = i >= 2 ? 1 : -1;
        corner[i] = build_vertex(&b, vec3(x * half_width, y * half_height, 0), vec3(0, 0, 1),
                                 x * u, -y * v);
    }
    build_triangle(&b, corner[0], corner[1], corner[2]);
    build_triangle(&b, corner[0], corner[2], corner[3]);
    struct scene_surface *s = fail_unlit(&b);
    if (s != NULL)
        s->material.image = image;
    return stage_add(stage, s);
}

int fail_rectangle(struct stage *stage, double half_width, double half_height, uint32_t rgb)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, rgb);
    build_quad(&b, vec3(-half_width, -half_height, 0), vec3(half_width, -half_height, 0),
               vec3(half_width, half_height, 0), vec3(-half_width, half_height, 0));
    return stage_add(stage, fail_unlit(&b));
}

/* A polygon of so many sides that it is a disc. */
static void disc(struct build *b, double radius)
{
    enum { SIDES = 96 };
    struct vec3 out = vec3(0, 0, 1);
    uint32_t middle = build_vertex(b, vec3(0, 0, 0), out, 0, 0);
    for (int i = 0; i < SIDES; i++) {
        double a = 2 * PI * i / SIDES, x = radius * cos(a), y = radius * sin(a);
        build_vertex(b, vec3(x, y, 0), out, x / 256, -y / 256);
    }
    for (uint32_t i = 0; i < SIDES; i++)
        build_triangle(b, middle, middle + 1 + i, middle + 1 + (i + 1) % SIDES);
}

static int add_disc(struct stage *stage, double radius, uint32_t rgb)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, rgb);
    disc(&b, radius);
    return stage_add(stage, fail_unlit(&b));
}

static void ortho_camera(double x, double y, struct scene_instant *out)
{
    stage_camera(out, xform_move(x, y, 100), 60);
    out->camera.orthographic = true;
    out->camera.half_height = stage_of(out)->kind->height / 2.0;
    out->camera.znear = 1;
    out->camera.zfar = 200;
}

/* The camera stands still, draw 0 is the background. */
static double still_camera(double time, struct scene_instant *out)
{
    ortho_camera(0, 0, out);
    stage_place(out, 0, xform_move(0, 0, BACK));
    return fail_shutters(time);
}

/* Lines of letters of 5x7 texels at random. */
static const struct image *text_image(struct stage *stage)
{
    enum { EDGE = 256 };
    struct image *image = stage_image(stage, EDGE, EDGE);
    uint32_t seed = 5;
    for (int i = 0; image != NULL && i < EDGE * EDGE; i++)
        stage_texel(image, i % EDGE, i / EDGE, 0xf0ead8);
    for (int line = 0; line < EDGE / 12; line++)
        for (int letter = 0; letter < EDGE / 8; letter++)
            for (int i = 0; i < 35; i++)
                if (suite_random(&seed) < 0.5 && image != NULL)
                    stage_texel(image, letter * 8 + 1 + i % 5, line * 12 + 2 + i / 5, 0x101418);
    return image;
}

/* Checks of 3 texels with a grain: what no filter can guess. */
static const struct image *detail_image(struct stage *stage)
{
    enum { EDGE = 256 };
    struct image *image = stage_image(stage, EDGE, EDGE);
    uint32_t seed = 14;
    for (int y = 0; image != NULL && y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            double part = 0.25 + 0.5 * ((x / 3 + y / 3) & 1) + 0.25 * suite_random(&seed);
            stage_texel(image, x, y, mix(NOISE_DARK, NOISE_LIGHT, part));
        }
    return image;
}

/* ------------------------------------------------------------------ what goes straight */

#define CREAM 0xffe9b0u
#define RED 0xe0402au

static void noise_back(struct stage *stage, uint32_t seed)
{
    fail_plane(stage, plain_noise(stage, seed), 512, 384, 1);
}

static void flat_back(struct stage *stage, uint32_t rgb)
{
    fail_rectangle(stage, 512, 384, rgb);
}

static void text_back(struct stage *stage, uint32_t unused)
{
    (void)unused;
    fail_plane(stage, text_image(stage), 256, 192, 1);
}

static void detail_back(struct stage *stage, uint32_t unused)
{
    (void)unused;
    fail_plane(stage, detail_image(stage), 256, 192, 1);
}

/* Rectangles, and discs where there is no height, before a background: where each is at FAIL_TIME, and how far it goes in a frame. The
 * camera may stand aside, and go, too. Scenes whose things go otherwise, or not all the time, are built so and have a function of time. */
static const struct straight {
    const char *name;
    void (*back)(struct stage *stage, uint32_t of);
    uint32_t of;                    /* seed or colour */
    struct {
        double half_width, half_height;
        uint32_t rgb;
        double x, y, z, step_x, step_y;
    } thing[3];
    double camera_x, camera_step_x, camera_step_y;
} straight[] = {
    { "curve", flat_back, GREY, { { 12, 12, CREAM, 0, 0, 0, 0, 0 } }, 0, 0, 0 },
    { "long", flat_back, GREY, { { FAIL_LONG_RADIUS, 0, CREAM, 3.4, 1.3, 0, FAIL_LONG_STREAK, 0 } }, 0, 0, 0 },
    /* The upper one runs to the right, the lower one, in front, to the left; they share 12 rows. */
    { "opposite", flat_back, GREY, { { 14, 22, CREAM, 0, 16, 0, 20, 0 }, { 14, 22, RED, 0, -16, FRONT, -20, 0 } }, 0, 0, 0 },
    { "slow", text_back, 0, { { FAIL_SLOW_RADIUS, 0, RED, 0, 0, 0, FAIL_SLOW_STREAK, 0 } }, 0, 0, 0 },
    { "edge", flat_back, GREY, { { FAIL_EDGE_RADIUS, 0, CREAM, 0, 0, 0, 24, 0 } }, 0, 0, 0 },
    { "enter", noise_back, 10, { { 12, 36, RED, -92, 0, 0, FAIL_ENTER_STREAK, 0 } }, 0, 0, 0 },
    /* The same, seen from so far aside that no edge of the frame is near. */
    { "enter_inside", noise_back, 10, { { 12, 36, RED, -92, 0, 0, FAIL_ENTER_STREAK, 0 } }, -FAIL_ENTER_ASIDE, 0, 0 },
    { "spawn", noise_back, 13, { { 16, 16, RED, 0, 0, 0, 0, 0 }, { 16, 16, CREAM, 0, 0, 0, 0, 0 } }, 0, 0, 0 },
    { "hidden", detail_back, 0, { { FAIL_HIDDEN_HALF, FAIL_HIDDEN_HALF, RED, 0, 0, 0, FAIL_HIDDEN_STREAK, 0 } }, 0, 0, 0 },
    { "jitter", flat_back, GREY, { { 30, 0, CREAM, -48, 0, 0, 16, 0 } }, 0, 0, 0 },
    { "rate", flat_back, GREY, { { 4, 20, CREAM, 0, 0, 0, FAIL_RATE_SPEED / FAIL_FPS, 0 } }, 0, 0, 0 },
    { "strobe", flat_back, GREY, { { FAIL_STROBE_WIDTH / 2.0, 20, CREAM, 0, 0, 0, FAIL_STROBE_STEP, 0 } }, 0, 0, 0 },
    { "subpan", noise_back, 25, { { 0, 0, 0, 0, 0, 0, 0, 0 } }, 0, 4 * 0.92106099400288508, 4 * 0.38941834230865050 },  /* by 0.4 */
    { "sweep", noise_back, 26, { { 12, 12, RED, 0, 0, 0, 0, 0 } }, 0, 0, 0 },
    { "roll", noise_back, 28, { { 0, 0, 0, 0, 0, 0, 0, 0 } }, 0, 0, 0 },
    { "stop", noise_back, 31, { { 16, 16, RED, 0, 0, 0, 0, 0 } }, 0, 0, 0 },
    /* The square runs behind the left bar and in front of the right one. */
    { "layers", flat_back, GREY, { { 20, 20, RED, 0, 30, 0, FAIL_LAYER_STREAK, 0 },
                                   { FAIL_LAYER_BAR / 2.0, 70, 0xfff4d8, -FAIL_LAYER_BAR_X, 0, FRONT, 0, 0 },
                                   { FAIL_LAYER_BAR / 2.0, 70, 0x2f6fd0, FAIL_LAYER_BAR_X, 0, BACK / 2, 0, 0 } }, 0, 0, 0 },
    { "ghosts", flat_back, 0, { { 100, 60, 0xffffff, -100, 0, 0, FAIL_GHOST_STREAK, 0 } }, 0, 0, 0 },
};

static const struct straight *straight_of(const struct stage *stage)
{
    const struct straight *s = straight;
    while (strcmp(s->name, strchr(stage->kind->name, '/') + 1) != 0)
        s++;
    return s;
}

static void straight_build(struct stage *stage)
{
    const struct straight *s = straight_of(stage);
    s->back(stage, s->of);
    for (int i = 0; i < 3 && s->thing[i].half_width > 0; i++)
        if (s->thing[i].half_height > 0)
            fail_rectangle(stage, s->thing[i].half_width, s->thing[i].half_height, s->thing[i].rgb);
        else
            add_disc(stage, s->thing[i].half_width, s->thing[i].rgb);
}

static void straight_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct straight *s = straight_of(stage);
    double u = still_camera(time, out);
    ortho_camera(s->camera_x + s->camera_step_x * u, s->camera_step_y * u, out);
    for (int i = 0; i + 1 < stage->prop_count; i++)
        stage_place(out, i + 1, xform_move(s->thing[i].x + s->thing[i].step_x * u, s->thing[i].y + s->thing[i].step_y * u, s->thing[i].z));
}

/* ------------------------------------------------------------------ 1 rotation */

static void rotation_build(struct stage *stage)
{
    noise_back(stage, 1);
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < 6; i++) {
        b.at = xform_turn_z(PI * i / 3);
        build_color(&b, i == 0 ? 0xe0402a : i & 1 ? 0xfff4d8 : 0x101828);
        build_quad(&b, vec3(0, -4, 0), vec3(57, -4, 0), vec3(57, 4, 0), vec3(0, 4, 0));
    }
    /* The rim: squares all around. */
    enum { SIDES = 72 };
    b.at = xform_move(0, 0, 0.5);
    for (int i = 0; i < SIDES; i++) {
        double a = 2 * PI * i / SIDES, c = 2 * PI * (i + 1) / SIDES;
        double low = 56, high = FAIL_WHEEL_RADIUS;
        build_color(&b, i / 6 & 1 ? 0x2f6fd0 : 0xf3b52c);
        struct vec3 from = vec3(cos(a), sin(a), 0), to = vec3(cos(c), sin(c), 0);
        build_quad(&b, vec3_scale(from, low), vec3_scale(from, high), vec3_scale(to, high),
                   vec3_scale(to, low));
    }
    stage_add(stage, fail_unlit(&b));
}

/* 45 degrees per exposure. */
static void rotation_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_turn_z(0.2 + PI / 4 * u));
}

/* ------------------------------------------------------------------ 2 curve */

/* A parabola: 28 px along; across, the place is 26 times the square of time. */
static void curve_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_move(28 * u, 26 * u * u, 0));
}

/* ------------------------------------------------------------------ 6 thin */

static void thin_build(struct stage *stage)
{
    flat_back(stage, GREY);
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, 0xffffff);
    for (int i = -3; i <= 3; i++)
        build_quad(&b, vec3(37 * i - 0.75, -60, 0), vec3(37 * i + 0.75, -60, 0),
                   vec3(37 * i + 0.75, 60, 0), vec3(37 * i - 0.75, 60, 0));
    stage_add(stage, fail_unlit(&b));
}

static void thin_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_move(20 * u + 0.3, 0, 0));
}

/* ------------------------------------------------------------------ 7 fence */

/* Pickets begin at multiples of the pitch. */
static void fence_build(struct stage *stage)
{
    noise_back(stage, 7);
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = -7; i < 7; i++) {
        double x = i * FAIL_PICKET_PITCH;
        build_color(&b, i & 1 ? 0xb5583a : 0xfff4d8);
        build_quad(&b, vec3(x, -100, FRONT), vec3(x + FAIL_PICKET, -100, FRONT),
                   vec3(x + FAIL_PICKET, 100, FRONT), vec3(x, 100, FRONT));
    }
    stage_add(stage, fail_unlit(&b));
}

static void fence_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 0, xform_move(16 * u, 0, BACK));
}

/* ------------------------------------------------------------------ 9 sprites */

/* Both in the plane z = 0: the one submitted first is in front. */
static void sprites_build(struct stage *stage)
{
    fail_rectangle(stage, FAIL_SPRITE_HALF, FAIL_SPRITE_HALF, 0xffe9b0);
    fail_rectangle(stage, 70, 50, 0x28503c);
}

static void sprites_move(double time, struct scene_instant *out)
{
    ortho_camera(0, 0, out);
    stage_place(out, 0, xform_move(16 * fail_shutters(time), 0, 0));
}

/* ------------------------------------------------------------------ 12 teleport, jump, cut */

/* Greys, so that a colour is a trace of the square. */
static void jump_build(struct stage *stage)
{
    fail_plane(stage, fail_noise(stage, 12, 0x303030, 0xe0e0e0), 512, 384, 1);
    fail_rectangle(stage, FAIL_JUMP_HALF, FAIL_JUMP_HALF, 0xe0402a);
}

static bool has_jumped(double u)
{
    return u > FAIL_JUMP_FRAME - 0.75;
}

/* Half a screen at once, and nobody says so. */
static void jump_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_move(has_jumped(u) ? 64 : -64, 0, 0));
}

static void teleport_move(double time, struct scene_instant *out)
{
    jump_move(time, out);
    out->draw[1].epoch = has_jumped(fail_shutters(time));
}

static void cut_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    ortho_camera(has_jumped(u) ? 64 : -64, has_jumped(u) ? 24 : 0, out);
    out->camera.epoch = has_jumped(u);
}

/* ------------------------------------------------------------------ 13 spawn */

/* One moves all the time, below; one above is there from FAIL_SPAWN_FRAME on, goes and comes back.
 * It moves all the while. */
static void spawn_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_move(-80 + 12 * u, -50, 0));
    stage_place(out, 2, xform_move(-80 + 12 * u, 50, 0));
    out->draw[2].hidden = u < FAIL_SPAWN_FRAME - 0.01
                       || (u > FAIL_SPAWN_GONE - 0.01 && u < FAIL_SPAWN_AGAIN - 0.01);
}

/* ------------------------------------------------------------------ 15 pane */

static void pane_build(struct stage *stage)
{
    noise_back(stage, 15);
    struct build b = build_begin(stage, 0);
    build_quad(&b, vec3(-FAIL_PANE_HALF, -FAIL_PANE_HALF, 0),
               vec3(FAIL_PANE_HALF, -FAIL_PANE_HALF, 0), vec3(FAIL_PANE_HALF, FAIL_PANE_HALF, 0),
               vec3(-FAIL_PANE_HALF, FAIL_PANE_HALF, 0));
    struct scene_surface *s = fail_unlit(&b);
    if (s != NULL) {
        s->material.alpha = MODEL_ALPHA_BLEND;
        s->material.base[0] = 0.8f;
        s->material.base[1] = s->material.base[2] = 0.05f;
        s->material.base[3] = 0.5f;
    }
    stage_add(stage, s);
}

static void pane_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 0, xform_move(-8 * u, 0, BACK));
    stage_place(out, 1, xform_move(FAIL_PANE_STREAK * u, 0, 0));
}

/* ------------------------------------------------------------------ 16 leaf */

/* Half of it holes, 8 texels wide. */
static const struct image *leaf_image(struct stage *stage)
{
    enum { EDGE = 64 };
    struct image *image = stage_image(stage, EDGE, EDGE);
    for (int y = 0; image != NULL && y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            bool is_hole = (x / 8 + y / 8) & 1;
            stage_texel(image, x, y, y & 4 ? 0x3d8f3a : 0xcfe08a);
            image->rgba[4 * (y * EDGE + x) + 3] = is_hole ? 0 : 255;
        }
    return image;
}

static void leaf_build(struct stage *stage)
{
    noise_back(stage, 16);
    struct build b = build_begin(stage, BUILD_UV);
    build_quad(&b, vec3(-FAIL_LEAF_HALF, -FAIL_LEAF_HALF, 0),
               vec3(FAIL_LEAF_HALF, -FAIL_LEAF_HALF, 0), vec3(FAIL_LEAF_HALF, FAIL_LEAF_HALF, 0),
               vec3(-FAIL_LEAF_HALF, FAIL_LEAF_HALF, 0));
    struct scene_surface *s = fail_unlit(&b);
    if (s != NULL) {
        s->material.image = leaf_image(stage);
        s->material.alpha = MODEL_ALPHA_MASK;
        s->material.wrap_u = s->material.wrap_v = MODEL_WRAP_CLAMP;
    }
    stage_add(stage, s);
}

static void leaf_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_move(16 * u, 0, 0));
}

/* ------------------------------------------------------------------ 18 light */

enum { LIGHT_COLUMNS = 32, LIGHT_ROWS = 24 };

static void light_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR | BUILD_NORMAL);
    build_color(&b, 0xf0e4d0);
    b.at = xform_turn_x(PI / 2);
    build_field(&b, -128, -96, 128, 96, LIGHT_COLUMNS, LIGHT_ROWS, NULL);
    stage_add_soft(stage, build_finish(&b));
}

/* Nothing moves but the light: a spot 24 px wide, 32 px along. Light is part of smear, so the
 * floor's normals turn into it and away instead. */
static void light_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct scene_surface *floor = stage->prop[0].surface;
    double u = fail_shutters(time);
    float *position = stage_soft_position(out, 0), *normal = stage_soft_normal(out, 0);
    ortho_camera(0, 0, out);
    memcpy(position, floor->position, (size_t)floor->vertex_count * 3 * sizeof *position);
    for (int i = 0; i < floor->vertex_count; i++) {
        double x = (double)position[3 * i] - 32 * u, away = fmin(fabs(x) / 24, 1);
        normal[3 * i] = (float)(0.36 * (1 - 2 * away));
        normal[3 * i + 1] = (float)(0.80 * (1 - 2 * away));
        normal[3 * i + 2] = 0.48f;
    }
}

/* ------------------------------------------------------------------ 19 seams */

static void seams_build(struct stage *stage)
{
    fail_rectangle(stage, 128, 64, 0x303848);
    struct build b = build_begin(stage, BUILD_UV);
    disc(&b, 18);
    struct scene_surface *s = fail_unlit(&b);
    if (s != NULL)
        s->material.image = plain_noise(stage, 19);
    stage_add(stage, s);
}

/* Slowly over the borders of tiles, from frame 0 on. */
static void seams_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_move(-92 + 2.9 * u, -12 + 0.37 * u, 0));
}

/* ------------------------------------------------------------------ 23 subpixel, subpan */

static void subpixel_build(struct stage *stage)
{
    noise_back(stage, 23);
    fail_plane(stage, fail_noise(stage, 24, 0x601010, 0xffd0a0), 16, 12, 1);
}

/* 4 px in a whole frame, aslant. */
static void subpixel_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_move(0.37 + 4 * cos(0.4) * u, 0.21 + 4 * sin(0.4) * u, 0));
}

/* ------------------------------------------------------------------ 24 sweep */

/* Every other frame the camera pans another way: 15 degrees further, 8 to 18 px long. */
static void sweep_move(double time, struct scene_instant *out)
{
    int lap;
    still_camera(time, out);
    double u = suite_lap(fail_shutters(time), 2, &lap);
    double angle = 2 * PI * lap / FAIL_SWEEP_LAPS, length = 8 + 2 * (lap % 6);
    ortho_camera(length * cos(angle) * u, length * sin(angle) * u, out);
    out->camera.epoch = lap;
}

/* ------------------------------------------------------------------ 26 tiny */

static void tiny_build(struct stage *stage)
{
    fail_plane(stage, plain_noise(stage, 27), 64, 64, 0.25);
    add_disc(stage, 2.2, 0xe0402a);
}

static void tiny_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    out->camera.half_height = 3.5;
    stage_place(out, 1, xform_move(2.5 * u, 0.4 - u, 0));
}

/* ------------------------------------------------------------------ 27 roll */

/* 20 degrees per exposure. */
static void roll_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    struct xform pose = xform_mul(xform_move(0, 0, 100), xform_turn_z(PI / 9 * u));
    memcpy(out->camera.pose, pose.m, sizeof pose.m);
}

/* ------------------------------------------------------------------ 31 stop */

static void stop_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_move(-60 + 12 * fmin(u, FAIL_STOP_FRAME), 0, 0));
}

/* ------------------------------------------------------------------ 37 sign */

/* Letters of 15x21 px, aslant. */
static void sign_build(struct stage *stage)
{
    flat_back(stage, GREY);
    fail_plane(stage, text_image(stage), 72, 30, 3);
}

static void sign_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_mul(xform_move(28 * u, 6 * u, 0), xform_turn_z(0.15)));
}

/* ------------------------------------------------------------------ 38 fan, 39 rotor, 40 wheel */

/* Blades about the origin: narrow at the hub, with a tip of another colour. */
static void add_blades(struct stage *stage, int blades, double length, double width, uint32_t rgb, uint32_t tip)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < blades; i++) {
        b.at = xform_turn_z(2 * PI * i / blades);
        build_color(&b, rgb);
        build_quad(&b, vec3(0, -width / 4, 0), vec3(0.8 * length, -width / 2, 0), vec3(0.8 * length, width / 2, 0),
                   vec3(0, width / 4, 0));
        build_color(&b, tip);
        build_quad(&b, vec3(0.8 * length, -width / 2, 0), vec3(length, -width / 2, 0), vec3(length, width / 2, 0),
                   vec3(0.8 * length, width / 2, 0));
    }
    stage_add(stage, fail_unlit(&b));
}

static void fan_build(struct stage *stage)
{
    noise_back(stage, 38);
    add_blades(stage, 5, FAIL_FAN_RADIUS, 12, 0xfff4d8, 0xe0402a);
    add_blades(stage, 5, FAIL_FAN_RADIUS, 12, 0x2f6fd0, 0xf3b52c);
}

/* They turn against each other, by 40 degrees in half a frame, and overlap. */
static void fan_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out), turn = 4 * PI / 9 * u;
    stage_place(out, 1, xform_mul(xform_move(-FAIL_FAN_ASIDE, 0, 0), xform_turn_z(turn)));
    stage_place(out, 2, xform_mul(xform_move(FAIL_FAN_ASIDE, 0, FRONT), xform_turn_z(0.4 - turn)));
}

static void rotor_build(struct stage *stage)
{
    flat_back(stage, GREY);
    add_blades(stage, 2, FAIL_ROTOR_RADIUS, 6, 0xfff4d8, 0xe0402a);
}

static void rotor_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out);
    stage_place(out, 1, xform_mul(xform_move(6 * u, 2 * u, 0), xform_turn_z(0.3 + 4 * PI / 9 * u)));
}

static void wheel_build(struct stage *stage)
{
    noise_back(stage, 40);
    add_disc(stage, FAIL_ROLLING_RADIUS, 0x181c24);
    add_blades(stage, 6, FAIL_ROLLING_RADIUS - 4, 7, 0xc8ccd4, 0xf3b52c);
}

/* It rolls to the right, 30 px per frame. */
static void wheel_move(double time, struct scene_instant *out)
{
    double u = still_camera(time, out), way = 30 * u;
    struct xform turn = xform_turn_z(0.1 - way / FAIL_ROLLING_RADIUS);
    stage_place(out, 1, xform_mul(xform_move(way, 0, 0), turn));
    stage_place(out, 2, xform_mul(xform_move(way, 0, 1), turn));
}

/* ------------------------------------------------------------------ */

const struct stage_kind failure_flat_kinds[] = {
    {"fail/rotation", 192, 144, FAIL_TIME, 0, rotation_build, rotation_move},
    {"fail/curve", 192, 144, FAIL_TIME, 0, straight_build, curve_move},
    {"fail/long", 160, 64, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/opposite", 192, 144, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/slow", 192, 96, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/thin", 256, 128, FAIL_TIME, 0, thin_build, thin_move},
    {"fail/fence", 192, 96, FAIL_TIME, 0, fence_build, fence_move},
    {"fail/edge", 128, 96, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/sprites", 128, 96, FAIL_TIME, 0, sprites_build, sprites_move},
    {"fail/enter", 192, 96, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/enter_inside", 192, 96, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/jump", 192, 80, FAIL_TIME, 0, jump_build, jump_move},
    {"fail/teleport", 192, 80, FAIL_TIME, 0, jump_build, teleport_move},
    {"fail/cut", 192, 80, FAIL_TIME, 0, jump_build, cut_move},
    {"fail/spawn", 192, 160, FAIL_TIME, 0, straight_build, spawn_move},
    {"fail/hidden", 128, 96, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/pane", 192, 144, FAIL_TIME, 0, pane_build, pane_move},
    {"fail/leaf", 192, 144, FAIL_TIME, 0, leaf_build, leaf_move},
    {"fail/light", 192, 144, FAIL_TIME, 0, light_build, light_move},
    {"fail/seams", 192, 64, FAIL_TIME, 0, seams_build, seams_move},
    {"fail/jitter", 192, 96, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/rate", 128, 64, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/strobe", 192, 64, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/subpixel", 64, 48, FAIL_TIME, 0, subpixel_build, subpixel_move},
    {"fail/subpan", 64, 48, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/sweep", 96, 64, FAIL_TIME, 0, straight_build, sweep_move},
    {"fail/tiny", 28, 20, FAIL_TIME, 0, tiny_build, tiny_move},
    {"fail/roll", 192, 144, FAIL_TIME, 0, straight_build, roll_move},
    {"fail/stop", 192, 64, FAIL_TIME, 0, straight_build, stop_move},
    {"fail/layers", 192, 160, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/ghosts", 128, 64, FAIL_TIME, 0, straight_build, straight_move},
    {"fail/sign", 192, 96, FAIL_TIME, 0, sign_build, sign_move},
    {"fail/fan", 192, 112, FAIL_TIME, 0, fan_build, fan_move},
    {"fail/rotor", 160, 144, FAIL_TIME, 0, rotor_build, rotor_move},
    {"fail/wheel", 160, 112, FAIL_TIME, 0, wheel_build, wheel_move},
};

const int failure_flat_count = sizeof failure_flat_kinds / sizeof *failure_flat_kinds;

bool failure_make(const char *name, struct scene *out, struct failure *f)
{
    for (int i = 0; i < failure_flat_count; i++)
        if (strcmp(failure_flat_kinds[i].name, name) == 0)
            return stage_open(failure_flat_kinds, failure_flat_count, name, out, f);
    return stage_open(failure_space_kinds, failure_space_count, name, out, f);
}

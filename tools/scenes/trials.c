/* SPDX-License-Identifier: MIT */
/* trials.c - scenes test/..., on which the rasterizer is compared with a reference: each is hard
 * in one way, and all move by up to 64 px per frame at 320x240, so that velocities can be
 * compared as well. */
#include "tools/scenes/builtin.h"

#include "tools/scenes/build.h"
#include "tools/scenes/suite.h"

#include <math.h>

#define PI 3.14159265358979323846

static double within(uint32_t *state, double low, double high)
{
    return low + (high - low) * suite_random(state);
}

static void random_color(struct build *b, uint32_t *state)
{
    uint32_t rgb = 0;
    for (int shift = 0; shift <= 16; shift += 8)
        rgb |= (uint32_t)within(state, 30, 255) << shift;
    build_color(b, rgb);
}

static struct scene_surface *finish_unlit(struct build *b)
{
    struct scene_surface *s = build_finish(b);
    if (s != NULL)
        s->material.unlit = true;
    return s;
}

/* ------------------------------------------------------------------ floor256, floor1000: depth */

/* A floor of two triangles out to 64 m, and pairs of panels from 1 m to 56 m away, the front one
 * nearer by the part `gap` of its distance. */
static void floor_build(struct stage *stage, double gap)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, 0x6f7d5c);
    build_quad(&b, vec3(-90, -1, 20), vec3(90, -1, 20), vec3(90, -1, -75), vec3(-90, -1, -75));
    for (int i = 0; i < 14; i++) {
        double away = pow(56.0, i / 13.0), size = 0.16 * away;
        double x = away * 0.62 * sin(2.4 * i), y = -0.9 + 0.5 * size + 0.13 * (i % 3) * away;
        build_color(&b, i & 1 ? 0xd8362c : 0xf3b52c);
        b.at = xform_mul(xform_move(x, y, -away), xform_turn_y(0.2 * cos(3.0 * i)));
        build_quad(&b, vec3(-size, -size, 0), vec3(size, -size, 0), vec3(size * 0.8, size, 0),
                   vec3(-size * 0.9, size, 0));
        build_color(&b, i & 1 ? 0x2f6fd0 : 0x3fa796);
        b.at = xform_mul(b.at, xform_move(0, 0, away * gap));
        build_quad(&b, vec3(-size * 0.7, -size * 0.7, 0), vec3(size * 0.6, -size * 0.7, 0),
                   vec3(size * 0.7, size * 0.6, 0), vec3(-size * 0.6, size * 0.7, 0));
    }
    stage_add(stage, finish_unlit(&b));
}

static void floor256_build(struct stage *stage)
{
    floor_build(stage, 1.0 / 500);
}

static void floor1000_build(struct stage *stage)
{
    floor_build(stage, 1.0 / 140);
}

static void floor_camera(double time, double znear, struct scene_instant *out)
{
    struct xform pose = xform_mul(xform_move(0.9 * sin(7 * time), 0.4, 0.5 * cos(8 * time)),
                                  xform_turn_y(0.33 * sin(15 * time)));
    stage_camera(out, xform_mul(pose, xform_turn_x(-0.12)), 60);
    out->camera.znear = znear;
    out->camera.zfar = 64;
}

static void floor256_move(double time, struct scene_instant *out)
{
    floor_camera(time, 0.25, out);
}

static void floor1000_move(double time, struct scene_instant *out)
{
    floor_camera(time, 0.064, out);
}

/* ------------------------------------------------------------------ soup: triangles at random */

enum { SOUPS = 4 };

static void soup_build(struct stage *stage)
{
    uint32_t seed = 3;
    for (int i = 0; i < SOUPS; i++) {
        struct build b = build_begin(stage, BUILD_COLOR);
        for (int k = 0; k < 90; k++) {
            struct vec3 centre = vec3(within(&seed, -2, 2), within(&seed, -1.5, 1.5),
                                      within(&seed, -1.5, 1.5));
            double size = 0.05 + 1.1 * pow(suite_random(&seed), 3);
            uint32_t v[3];
            for (int j = 0; j < 3; j++) {
                struct vec3 off = vec3(within(&seed, -1, 1), within(&seed, -1, 1),
                                       within(&seed, -1, 1));
                random_color(&b, &seed);
                off = vec3_add(centre, vec3_scale(off, size));
                v[j] = build_vertex(&b, off, vec3(0, 0, 0), 0, 0);
            }
            build_triangle(&b, v[0], v[1], v[2]);
        }
        struct scene_surface *s = finish_unlit(&b);
        if (s != NULL)
            s->material.double_sided = i & 1;
        stage_add(stage, s);
    }
}

static void soup_move(double time, struct scene_instant *out)
{
    for (int i = 0; i < SOUPS; i++) {
        double turn = (i & 1 ? 5.3 : -4.4) * time + i;
        struct xform at = xform_move(0.7 * sin(9 * time + 2 * i), 0.4 * cos(11 * time + i), -4.6);
        stage_place(out, i, xform_mul(at, xform_mul(xform_turn_y(turn), xform_turn_x(0.7 * turn))));
    }
}

/* ------------------------------------------------------------------ room: perspective and
 * texels */

/* Squares of four texels, a gradient and a grain: no two places are alike. */
static const struct image *room_image(struct stage *stage, int width, int height)
{
    struct image *image = stage_image(stage, width, height);
    uint32_t seed = 77;
    for (int y = 0; image != NULL && y < height; y++)
        for (int x = 0; x < width; x++) {
            uint32_t r = (uint32_t)(40 + 200 * x / width), g = (uint32_t)(40 + 200 * y / height);
            uint32_t v = (x / 4 + y / 4) & 1 ? 70 : 170;
            v += (uint32_t)within(&seed, 0, 30);
            stage_texel(image, x, y, r << 16 | g << 8 | v);
        }
    return image;
}

static void add_wall(struct stage *stage, struct vec3 o, struct vec3 along, struct vec3 up,
                     double repeats, const struct image *image, enum model_wrap wrap)
{
    struct build b = build_begin(stage, BUILD_UV | BUILD_NORMAL);
    struct vec3 n = vec3_cross(along, up);
    double low = -0.3 * repeats, high = repeats;
    uint32_t v0 = build_vertex(&b, o, n, low, high);
    uint32_t v1 = build_vertex(&b, vec3_add(o, along), n, high, high);
    uint32_t v2 = build_vertex(&b, vec3_add(vec3_add(o, along), up), n, high, low);
    uint32_t v3 = build_vertex(&b, vec3_add(o, up), n, low, low);
    build_triangle(&b, v0, v1, v2);
    build_triangle(&b, v0, v2, v3);
    struct scene_surface *s = build_finish(&b);
    if (s != NULL) {
        s->material.image = image;
        s->material.wrap_u = s->material.wrap_v = wrap;
    }
    stage_add(stage, s);
}

static void room_build(struct stage *stage)
{
    const struct image *square = room_image(stage, 64, 64), *odd = room_image(stage, 48, 20);
    add_wall(stage, vec3(-3, -1.5, 2), vec3(6, 0, 0), vec3(0, 0, -14), 3, square,
             MODEL_WRAP_REPEAT);
    add_wall(stage, vec3(-3, 1.5, -12), vec3(6, 0, 0), vec3(0, 0, 14), 2, odd, MODEL_WRAP_MIRROR);
    add_wall(stage, vec3(-3, -1.5, 2), vec3(0, 0, -14), vec3(0, 3, 0), 2, square,
             MODEL_WRAP_MIRROR);
    add_wall(stage, vec3(3, -1.5, -12), vec3(0, 0, 14), vec3(0, 3, 0), 2, odd,
             MODEL_WRAP_REPEAT);
    add_wall(stage, vec3(-3, -1.5, -12), vec3(6, 0, 0), vec3(0, 3, 0), 1.4, square,
             MODEL_WRAP_CLAMP);
    stage_add(stage, suite_crate(stage, 0.6, odd));
}

static void room_move(double time, struct scene_instant *out)
{
    struct xform turn = xform_mul(xform_turn_y(0.5 * sin(9 * time)), xform_turn_z(0.9 * time));
    stage_camera(out, xform_mul(xform_move(0.4, 0.2, 0.8 - sin(3 * time)), turn), 64);
    struct xform at = xform_move(0.9 * cos(9 * time), -0.2, -3.4);
    stage_place(out, 5, xform_mul(at, xform_mul(xform_turn_y(7 * time), xform_turn_x(5 * time))));
}

/* ------------------------------------------------------------------ slivers: hardly any pixels */

static void slivers_build(struct stage *stage)
{
    enum { STEPS = 360 };
    uint32_t seed = 19;
    struct build b = build_begin(stage, BUILD_FACE_COLOR);
    uint32_t middle = build_vertex(&b, vec3(0.013, 0.007, 0), vec3(0, 0, 1), 0, 0);
    for (int i = 0; i < STEPS; i++) {
        double a = 2 * PI * i / STEPS, r = i & 1 ? 1.5 : 0.9;
        build_vertex(&b, vec3(r * cos(a), r * sin(a), 0), vec3(0, 0, 1), 0, 0);
    }
    for (uint32_t i = 0; i < STEPS; i++) {
        random_color(&b, &seed);
        build_triangle(&b, middle, middle + 1 + i, middle + 1 + (i + 1) % STEPS);
    }
    stage_add(stage, finish_unlit(&b));

    b = build_begin(stage, BUILD_FACE_COLOR);
    for (int i = 0; i < 80; i++) {
        double length = within(&seed, 0.6, 2.2), half = within(&seed, 0.001, 0.012);
        struct xform at = xform_move(within(&seed, -1.6, 1.6), within(&seed, -1.2, 1.2),
                                     within(&seed, -0.4, 0.6));
        b.at = xform_mul(at, xform_mul(xform_turn_z(within(&seed, 0, 2 * PI)),
                                       xform_turn_y(within(&seed, -1, 1))));
        random_color(&b, &seed);
        build_quad(&b, vec3(-length, -half, 0), vec3(length, -half, 0), vec3(length, half, 0),
                   vec3(-length, half, 0));
    }
    struct scene_surface *s = finish_unlit(&b);
    if (s != NULL)
        s->material.double_sided = true;
    stage_add(stage, s);
}

static void slivers_move(double time, struct scene_instant *out)
{
    struct xform away = xform_move(0.05, -0.02, -3.1);
    stage_place(out, 0, xform_mul(away, xform_turn_z(5.7 * time)));
    stage_place(out, 1, xform_mul(away, xform_turn_z(-8.9 * time)));
}

/* ------------------------------------------------------------------ boxes: through each other */

enum { BOXES = 6 };

static void boxes_build(struct stage *stage)
{
    static const uint32_t paint[BOXES] = {
        0xe9443a, 0xf3b52c, 0x2f6fd0, 0x3fa796, 0xf4f0e2, 0x8a3ffc,
    };
    for (int i = 0; i < BOXES; i++) {
        struct build b = build_begin(stage, BUILD_COLOR);
        build_color(&b, paint[i]);
        build_box(&b, vec3(-1.5, -0.32, -0.32), vec3(1.5, 0.32, 0.32));
        stage_add(stage, build_finish(&b));
    }
}

static void boxes_move(double time, struct scene_instant *out)
{
    for (int i = 0; i < BOXES; i++) {
        double x = 0.5 * cos(1.1 * i + 8 * time), y = 0.4 * sin(1.7 * i + 11 * time);
        struct xform turn = xform_mul(xform_turn_z(0.9 * i + 9.4 * time),
                                      xform_turn_y(0.7 * i - 6.3 * time));
        stage_place(out, i, xform_mul(xform_move(x, y, -3.3), turn));
    }
}

/* ------------------------------------------------------------------ leaves: cutouts, and panes
 * of glass */

static const struct image *leaf_image(struct stage *stage)
{
    enum { EDGE = 32 };
    struct image *image = stage_image(stage, EDGE, EDGE);
    for (int y = 0; image != NULL && y < EDGE; y++)
        for (int x = 0; x < EDGE; x++) {
            double u = (x + 0.5) / EDGE * 2 - 1, v = (y + 0.5) / EDGE;
            double half = 0.8 * sin(PI * v) * (0.75 + 0.25 * cos(18 * v));
            bool vein = fabs(u) < 0.06 || fabs(fabs(u) - (0.9 * v - 0.3)) < 0.05;
            stage_texel(image, x, y, vein ? 0xcfe08a : 0x3d8f3a);
            image->rgba[4 * (y * EDGE + x) + 3] = (uint8_t)(fabs(u) < half ? 255 : 40);
        }
    return image;
}

static const struct image *glass_image(struct stage *stage)
{
    struct image *image = stage_image(stage, 16, 16);
    for (int y = 0; image != NULL && y < 16; y++)
        for (int x = 0; x < 16; x++) {
            stage_texel(image, x, y, (x / 4 + y / 4) & 1 ? 0xff5d8f : 0x48bfe3);
            image->rgba[4 * (y * 16 + x) + 3] = (uint8_t)(40 + 12 * x);
        }
    return image;
}

static void leaves_build(struct stage *stage)
{
    uint32_t seed = 8;
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < 8; i++) {
        build_color(&b, i & 1 ? 0xe9dcc0 : 0x7a5a3c);
        build_box(&b, vec3(-6 + 1.5 * i, -4.5, -3.0), vec3(-4.5 + 1.5 * i, 4.5, -2.8));
    }
    stage_add(stage, build_finish(&b));

    b = build_begin(stage, BUILD_NORMAL | BUILD_UV);
    for (int i = 0; i < 36; i++) {
        struct xform at = xform_move(within(&seed, -1.7, 1.7), within(&seed, -1.3, 1.3),
                                     within(&seed, -0.8, 0.5));
        b.at = xform_mul(at, xform_mul(xform_turn_z(within(&seed, 0, 2 * PI)),
                                       xform_turn_y(within(&seed, -2.2, 2.2))));
        build_quad(&b, vec3(-0.3, -0.45, 0), vec3(0.3, -0.45, 0), vec3(0.3, 0.45, 0),
                   vec3(-0.3, 0.45, 0));
    }
    struct scene_surface *s = build_finish(&b);
    if (s != NULL) {
        s->material.image = leaf_image(stage);
        s->material.alpha = MODEL_ALPHA_MASK;
        s->material.double_sided = true;
    }
    stage_add(stage, s);

    for (int i = 0; i < 3; i++) {
        b = build_begin(stage, BUILD_UV);
        build_quad(&b, vec3(-0.8, -0.9, 0), vec3(0.8, -0.9, 0), vec3(0.8, 0.9, 0),
                   vec3(-0.8, 0.9, 0));
        if ((s = finish_unlit(&b)) != NULL) {
            s->material.alpha = MODEL_ALPHA_BLEND;
            s->material.double_sided = true;
            s->material.image = i == 0 ? glass_image(stage) : NULL;
            s->material.base[i] = 0.3f;
            s->material.base[3] = i == 0 ? 1.0f : 0.45f;
        }
        stage_add(stage, s);
    }
}

static void leaves_move(double time, struct scene_instant *out)
{
    struct xform away = xform_move(0.1, 0, -3.9);
    stage_place(out, 0, away);
    struct xform turn = xform_mul(xform_turn_z(4 * time), xform_turn_y(0.7 * sin(9 * time)));
    stage_place(out, 1, xform_mul(away, turn));
    for (int i = 0; i < 3; i++) {
        struct xform at = xform_move(sin(11 * time + 2 * i), 0.3 * i - 0.3, 0.2 - 0.5 * i);
        stage_place(out, 2 + i, xform_mul(away, xform_mul(at, xform_turn_y(5 * time + i))));
    }
}

/* ------------------------------------------------------------------ terrain: through the near
 * plane */

static double hills(double x, double z)
{
    return 0.55 * sin(0.9 * x + 0.3) * cos(0.8 * z) + 0.25 * sin(2.3 * x - 1.7 * z);
}

static void terrain_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR | BUILD_NORMAL);
    build_color(&b, 0x6f9a4c);
    build_field(&b, -14, -26, 14, 10, 42, 54, hills);
    for (int i = 0; i < b.vertex_count; i++) {
        float y = b.position[3 * i + 1];
        if (y > 0.35f)
            build_color(&b, 0xe6e2d6);
        else
            build_color(&b, y < -0.3f ? 0x3a6ea5 : 0x7d9b4e);
        for (int k = 0; k < 4; k++)
            b.vertex_color[4 * i + k] = b.color[k];
    }
    stage_add(stage, build_finish(&b));
}

/* So low that crests pass before the near plane and behind the eye. */
static void terrain_move(double time, struct scene_instant *out)
{
    double x = 0.4 * sin(5 * time), z = 2 * cos(3.4 * time);
    struct xform pose = xform_mul(xform_move(x, hills(x, z) + 0.38, z), xform_turn_y(2.1 * time));
    stage_camera(out, xform_mul(pose, xform_turn_x(-0.1)), 66);
    out->camera.znear = 0.3;
}

/* ------------------------------------------------------------------ ortho: mirrored, from both
 * sides */

static void ortho_build(struct stage *stage)
{
    stage_add(stage, suite_car(stage, 0xe9443a));
    stage_add(stage, suite_car(stage, 0x2f6fd0));
    struct build b = build_begin(stage, BUILD_COLOR);
    double bowl[6] = {0.2, 0, 0.8, 0.3, 1.0, 0.9};
    build_color(&b, 0xf3b52c);
    build_lathe(&b, bowl, 3, 14);
    struct scene_surface *s = build_finish(&b);
    if (s != NULL)
        s->material.double_sided = true;
    stage_add(stage, s);
    b = build_begin(stage, BUILD_COLOR);
    build_color(&b, 0x9aa7a0);
    build_field(&b, -6, -6, 6, 6, 3, 3, NULL);
    stage_add(stage, build_finish(&b));
}

static void ortho_move(double time, struct scene_instant *out)
{
    struct vec3 eye = vec3(5 + 2 * sin(6 * time), 4.5, 6.5);
    stage_camera(out, xform_look(eye, vec3(0, 0.5, 0), vec3(0, 1, 0)), 60);
    out->camera.orthographic = true;
    out->camera.half_height = 2.6 + 0.2 * sin(13 * time);
    out->camera.znear = 1;
    out->camera.zfar = 20;
    struct xform car = xform_mul(xform_move(1.8 * sin(15 * time), 0, 1.1), xform_turn_y(0.2));
    stage_place(out, 0, car);
    struct xform mirror = xform_mul(xform_scale(-1.2, 1, 0.8), xform_turn_y(5 * time));
    stage_place(out, 1, xform_mul(xform_move(-1.2, 0.1, -1.4), mirror));
    stage_place(out, 2, xform_mul(xform_move(1.5, 0.3, -1.3), xform_turn_x(0.9 * sin(11 * time))));
}

/* ------------------------------------------------------------------ */

#define NIGHT 0x1b2433u

static const struct stage_kind trial_kinds[] = {
    {"test/floor256", 320, 240, 0.2, 0x9fb9cf, floor256_build, floor256_move},
    {"test/floor1000", 320, 240, 0.2, 0x9fb9cf, floor1000_build, floor1000_move},
    {"test/soup", 320, 240, 0.2, NIGHT, soup_build, soup_move},
    {"test/room", 320, 240, 0.2, NIGHT, room_build, room_move},
    {"test/slivers", 320, 240, 0.2, NIGHT, slivers_build, slivers_move},
    {"test/boxes", 320, 240, 0.2, NIGHT, boxes_build, boxes_move},
    {"test/leaves", 320, 240, 0.2, NIGHT, leaves_build, leaves_move},
    {"test/terrain", 320, 240, 0.2, 0x9fb9cf, terrain_build, terrain_move},
    {"test/ortho", 320, 240, 0.2, 0xd7e3ea, ortho_build, ortho_move},
};

bool trial_make(const char *name, struct scene *out, struct failure *f)
{
    return stage_open(trial_kinds, sizeof trial_kinds / sizeof *trial_kinds, name, out, f);
}

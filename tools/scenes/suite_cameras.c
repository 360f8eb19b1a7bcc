/* SPDX-License-Identifier: MIT */
/* suite_cameras.c - seven scenes of the quality suite in which the camera moves, and one where
 * nothing does. */
#include "tools/scenes/suite.h"

#include <math.h>

#define PI 3.14159265358979323846

/* At `eye`, turned by yaw about y, then pitch and roll. */
static struct xform aim(struct vec3 eye, double yaw, double pitch, double roll)
{
    struct xform turn = xform_mul(xform_turn_y(yaw), xform_mul(xform_turn_x(pitch),
                                                               xform_turn_z(roll)));
    return xform_mul(xform_move(eye.x, eye.y, eye.z), turn);
}

/* ------------------------------------------------------------------ pan */

static void pan_build(struct stage *stage)
{
    suite_round(stage, 5, 80, 4.5, true);
}

static void pan_move(double time, struct scene_instant *out)
{
    stage_camera(out, aim(vec3(0.1, 1.7, 0.2), 0.4 + 3.3 * time, -0.06, 0), 52);
}

/* ------------------------------------------------------------------ dolly: forward between
 * columns */

enum { DOLLY_HALF = 40 };

static void dolly_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = -DOLLY_HALF; i < DOLLY_HALF; i++) {
        double z = 2.0 * i;
        for (int k = 0; k < 3; k++) {
            double x = -2.7 + 1.8 * k;
            build_color(&b, (i + k) & 1 ? 0x5b6470 : 0xb9b3a2);
            build_quad(&b, vec3(x, 0, z + 2), vec3(x + 1.8, 0, z + 2), vec3(x + 1.8, 0, z),
                       vec3(x, 0, z));
        }
        for (int side = -1; side <= 1; side += 2) {
            double x = side * 2.75;
            build_color(&b, i & 1 ? 0x8a6f52 : 0xd9c9a3);
            build_box(&b, vec3(x - 0.22, 0, z + 0.2), vec3(x + 0.22, 2.9, z + 0.7));
            build_color(&b, i & 1 ? 0x496a88 : 0x6f93ad);
            x += 0.3 * side;
            build_box(&b, vec3(x - 0.1, 0, z + 0.7), vec3(x + 0.1, 2.2, z + 2.2));
        }
        build_color(&b, i & 1 ? 0x8a6f52 : 0xc9b48a);
        build_box(&b, vec3(-2.9, 2.9, z + 0.25), vec3(2.9, 3.2, z + 0.65));
    }
    stage_add(stage, build_finish(&b));
}

/* Columns repeat every four metres and a lap is 32 metres long, so that its end looks like its
 * start. */
static void dolly_move(double time, struct scene_instant *out)
{
    int lap;
    double speed = 15.3, s = suite_lap(time - 0.5, 32 / speed, &lap);
    stage_camera(out, aim(vec3(0.35, 1.45, 0.37 - speed * s), 0.05, -0.03, 0), 66);
    out->camera.epoch = lap;
}

/* ------------------------------------------------------------------ roll: about the line of
 * sight */

static void roll_build(struct stage *stage)
{
    suite_round(stage, 29, 80, 3.6, true);
}

static void roll_move(double time, struct scene_instant *out)
{
    stage_camera(out, aim(vec3(0.1, 2.1, 0.2), 1.3, -0.22, 0.35 + 9.5 * time), 64);
}

/* ------------------------------------------------------------------ fence_fg: a still fence
 * before a pan */

static void fence_fg_build(struct stage *stage)
{
    suite_round(stage, 43, 90, 4.0, true);
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < 9; i++) {
        double x = -0.84 + 0.21 * i;
        build_color(&b, i & 1 ? 0xf2efe6 : 0x1d2128);
        build_box(&b, vec3(x - 0.011, -0.7, -1.01), vec3(x + 0.011, 0.7, -0.99));
    }
    build_color(&b, 0xd8362c);
    build_box(&b, vec3(-1.2, 0.30, -1.03), vec3(1.2, 0.325, -1.01));
    build_box(&b, vec3(-1.2, -0.34, -1.03), vec3(1.2, -0.315, -1.01));
    stage_add(stage, build_finish(&b));
}

static void fence_fg_move(double time, struct scene_instant *out)
{
    struct xform camera = aim(vec3(0.1, 1.6, 0.2), 0.9 - 10.7 * time, -0.05, 0);
    stage_camera(out, camera, 52);
    stage_place(out, 1, camera);
}

/* ------------------------------------------------------------------ textured: everything has
 * texels */

static void textured_build(struct stage *stage)
{
    struct scene_surface *s;
    struct build b = build_begin(stage, BUILD_NORMAL | BUILD_UV);
    for (int i = 0; i < 4; i++) {
        b.at = xform_turn_y(PI / 2 * i + 0.13);
        for (int k = 0; k < 3; k++)
            build_quad(&b, vec3(-6 + 4 * k, 0, -6), vec3(-2 + 4 * k, 0, -6),
                       vec3(-2 + 4 * k, 4, -6), vec3(-6 + 4 * k, 4, -6));
    }
    if ((s = build_finish(&b)) != NULL)
        s->material.image = suite_tiles(stage, 64, 8, 0xf4e9c8, 0x243049);
    stage_add(stage, s);
    b.at = xform_turn_y(0.13);
    build_field(&b, -6, -6, 6, 6, 6, 6, NULL);
    for (int i = 0; i < 2 * b.vertex_count; i++)
        b.uv[i] *= 6;
    if ((s = build_finish(&b)) != NULL)
        s->material.image = suite_tiles(stage, 64, 4, 0xb8442f, 0xe8d9b0);
    stage_add(stage, s);
    stage_add(stage, suite_crate(stage, 0.8, suite_tiles(stage, 64, 4, 0xffc914, 0x17304a)));
}

static void textured_move(double time, struct scene_instant *out)
{
    stage_camera(out, aim(vec3(0.3, 1.7, 1.2), 0.25 - 3.2 * (time - 0.5), -0.08, 0), 60);
    struct xform at = xform_move(2.2 * sin(4 * (time - 0.5)) - 0.4, 1.5, -2.6);
    stage_place(out, 2, xform_mul(at, xform_mul(xform_turn_y(5 * time), xform_turn_x(0.5))));
}

/* ------------------------------------------------------------------ arena: a frame of a game */

enum { ARENA_CARS = 3 };

static void arena_build(struct stage *stage)
{
    static const uint32_t paint[ARENA_CARS] = {0xe9443a, 0xf3b52c, 0x2f6fd0};
    uint32_t seed = 9;
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int j = 0; j < 12; j++)
        for (int i = 0; i < 12; i++) {
            double x = -12 + 2.0 * i, z = -12 + 2.0 * j;
            build_color(&b, (i + j) & 1 ? 0x39434f : 0x98a1aa);
            build_quad(&b, vec3(x, 0, z + 2), vec3(x + 2, 0, z + 2), vec3(x + 2, 0, z),
                       vec3(x, 0, z));
        }
    for (int i = 0; i < 4; i++) {
        b.at = xform_turn_y(PI / 2 * i);
        for (int k = 0; k < 6; k++) {
            build_color(&b, k & 1 ? 0xc9ced4 : 0xb04a3a);
            build_box(&b, vec3(-12 + 4 * k, 0, -12.4), vec3(-8 + 4 * k, 1.5, -12));
        }
    }
    b.at = xform_identity();
    for (int i = 0; i < 16; i++) {
        double a = 2 * PI * i / 16 + 0.2, r = 9.4 + 1.6 * suite_random(&seed);
        build_color(&b, i % 3 == 0 ? 0x3fa796 : i % 3 == 1 ? 0xd9b44a : 0x8f9aa8);
        double half = 0.4 + 0.4 * suite_random(&seed);
        b.at = xform_mul(xform_move(r * sin(a), 0, r * cos(a)), xform_turn_y(3 * a));
        build_box(&b, vec3(-half, 0, -half), vec3(half, 0.8 + 2.4 * suite_random(&seed), half));
    }
    b.at = xform_identity();
    build_color(&b, 0x3b4250);
    build_drum(&b, 0.5, 0.4, 0, 1.4, 8);
    stage_add(stage, build_finish(&b));

    build_color(&b, 0xf4f0e2);
    build_box(&b, vec3(-3.0, -0.14, -0.16), vec3(3.0, 0.14, 0.16));
    build_color(&b, 0xd8362c);
    build_box(&b, vec3(2.6, -0.3, -0.3), vec3(3.2, 0.3, 0.3));
    build_box(&b, vec3(-3.2, -0.3, -0.3), vec3(-2.6, 0.3, 0.3));
    stage_add(stage, build_finish(&b));
    for (int i = 0; i < ARENA_CARS; i++)
        stage_add(stage, suite_car(stage, paint[i]));
    stage_add(stage, suite_ball(stage, 0.6, 0xfdf6e3, 0xe4572e));
}

static void arena_move(double time, struct scene_instant *out)
{
    double sweep = 0.5 + 1.4 * time;
    struct vec3 eye = vec3(9.3 * sin(sweep), 3.3, 9.3 * cos(sweep));
    stage_camera(out, xform_look(eye, vec3(0.1, 0.7, 0), vec3(0, 1, 0)), 55);
    stage_place(out, 1, xform_mul(xform_move(0, 1.6, 0), xform_turn_y(7.5 * time)));
    for (int i = 0; i < ARENA_CARS; i++) {
        double radius = 4.2 + 1.3 * i, angle = 2.1 * i - (2.6 - 0.4 * i) * time;
        struct xform at = xform_move(radius * sin(angle), 0, radius * cos(angle));
        stage_place(out, 2 + i, xform_mul(at, xform_turn_y(angle + PI)));
    }
    double hop = fabs(sin(3.3 * time));
    stage_place(out, 2 + ARENA_CARS, xform_mul(xform_move(-2.6, 0.6 + 1.9 * hop, 3.1),
                                               xform_turn_z(4 * time)));
}

/* ------------------------------------------------------------------ subpixel: a slow sideways
 * camera */

static void subpixel_build(struct stage *stage)
{
    suite_round(stage, 31, 30, 5.0, false);
}

static void subpixel_move(double time, struct scene_instant *out)
{
    stage_camera(out, aim(vec3(0.3, 1.8, 0.2), 0.7 + 0.102 * (time - 0.5), -0.07, 0), 52);
}

/* ------------------------------------------------------------------ still */

static void still_build(struct stage *stage)
{
    suite_yard(stage, 17);
    stage_add(stage, suite_car(stage, 0xe9443a));
    stage_add(stage, suite_ball(stage, 0.8, 0x2f6fd0, 0xf4e9c8));
}

static void still_move(double time, struct scene_instant *out)
{
    (void)time;
    stage_camera(out, xform_look(vec3(0.23, 2.37, 7.1), vec3(0.04, 1.31, 0), vec3(0, 1, 0)), 47);
    stage_place(out, 1, xform_mul(xform_move(-1.2, 0, 1.5), xform_turn_y(0.5)));
    stage_place(out, 2, xform_move(1.4, 0.8, 1.0));
}

/* ------------------------------------------------------------------ */

#define SKY 0xb7cfe0u

const struct stage_kind suite_camera_kinds[] = {
    {"suite/pan", 320, 240, 0.5, SKY, pan_build, pan_move},
    {"suite/dolly", 240, 240, 0.5, SKY, dolly_build, dolly_move},
    {"suite/roll", 240, 240, 0.5, SKY, roll_build, roll_move},
    {"suite/fence_fg", 240, 240, 0.5, SKY, fence_fg_build, fence_fg_move},
    {"suite/textured", 240, 240, 0.5, SKY, textured_build, textured_move},
    {"suite/arena", 320, 240, 0.5, SKY, arena_build, arena_move},
    {"suite/subpixel", 240, 240, 0.5, SKY, subpixel_build, subpixel_move},
    {"suite/still", 240, 240, 0.5, SKY, still_build, still_move},
};

const int suite_camera_count = sizeof suite_camera_kinds / sizeof *suite_camera_kinds;

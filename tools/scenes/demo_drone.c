/* SPDX-License-Identifier: MIT */
/* demo_drone.c - a quadrotor of 1.7 m, large enough that its blades show on a small screen. */
#include "tools/scenes/demo.h"

#include <math.h>

#define PI 3.14159265358979323846

#define WHITE 0xf4f6f8u
#define SLATE 0x39424fu
#define TEAL 0x1fa6a0u
#define ORANGE 0xf08a24u

static const double arm = 0.50;         /* of a rotor's axis, along x and along z */

static struct scene_surface *body(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    struct vec3 ring[4 * 8];
    static const double shape[4][3] = {     /* x, half width, half height */
        {-0.46, 0.10, 0.06}, {-0.26, 0.21, 0.12}, {0.20, 0.20, 0.13}, {0.48, 0.09, 0.06},
    };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 8; k++) {
            double a = -2 * PI * (k + 0.5) / 8;
            ring[8 * i + k] = vec3(shape[i][0], shape[i][2] * sin(a) * -1, shape[i][1] * cos(a));
        }
    build_color(&b, WHITE);
    build_loft(&b, ring, 4, 8);
    build_color(&b, TEAL);
    build_box(&b, vec3(-0.30, 0.085, -0.05), vec3(0.26, 0.135, 0.05));
    build_color(&b, SLATE);
    b.at = xform_move(0.34, -0.10, 0);
    build_ball(&b, 0.10, 8, 5);
    build_color(&b, 0x8fd3ff);
    build_box(&b, vec3(0.07, -0.04, -0.04), vec3(0.115, 0.04, 0.04));

    for (int i = 0; i < 4; i++) {
        double angle = PI / 4 + PI / 2 * i;
        b.at = xform_turn_y(angle);
        build_color(&b, SLATE);
        build_box(&b, vec3(0.12, -0.02, -0.035), vec3(arm * sqrt(2), 0.035, 0.035));
        b.at = xform_mul(b.at, xform_move(arm * sqrt(2), 0, 0));
        build_color(&b, i == 0 || i == 3 ? TEAL : ORANGE);
        build_drum(&b, 0.075, 0.06, -0.06, 0.085, 8);
    }
    b.at = xform_identity();
    build_color(&b, SLATE);
    for (int side = -1; side <= 1; side += 2) {
        double z = side * 0.22;
        build_box(&b, vec3(-0.30, -0.32, z - 0.02), vec3(0.30, -0.285, z + 0.02));
        build_box(&b, vec3(-0.18, -0.30, z - 0.015), vec3(-0.15, -0.05, z + 0.015));
        build_box(&b, vec3(0.15, -0.30, z - 0.015), vec3(0.18, -0.05, z + 0.015));
    }
    return build_finish(&b);
}

/* Two blades, wider at the root, with bright tips; `hand` +1 or -1 tells which way they are
 * pitched. */
static struct scene_surface *rotor(struct stage *stage, double hand)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    static const double shape[4][2] = {{0.02, 0.022}, {0.10, 0.052}, {0.32, 0.044}, {0.42, 0.030}};
    for (int blade = 0; blade < 2; blade++) {
        struct vec3 ring[4 * 4];
        b.at = xform_turn_y(PI * blade);
        for (int i = 0; i < 4; i++) {
            double x = shape[i][0], half = shape[i][1], twist = hand * (0.022 - 0.03 * x);
            struct vec3 *r = ring + 4 * i;
            r[0] = vec3(x, twist - 0.006, half);
            r[1] = vec3(x, -twist - 0.006, -half);
            r[2] = vec3(x, -twist + 0.006, -half);
            r[3] = vec3(x, twist + 0.006, half);
        }
        build_color(&b, SLATE);
        build_loft(&b, ring, 3, 4);
        build_color(&b, ORANGE);
        build_loft(&b, ring + 8, 2, 4);
    }
    b.at = xform_identity();
    build_color(&b, WHITE);
    build_drum(&b, 0.04, 0.02, -0.01, 0.04, 6);
    return build_finish(&b);
}

static struct scene_surface *shadow(struct stage *stage)
{
    struct build b = build_begin(stage, 0);
    build_vertex(&b, vec3(0, 0, 0), vec3(0, 1, 0), 0, 0);
    for (int k = 0; k < 16; k++) {
        double a = 2 * PI * k / 16, r = k % 4 == 2 ? 0.86 : k % 2 == 0 ? 0.46 : 0.70;
        build_vertex(&b, vec3(r * sin(a), 0, r * cos(a)), vec3(0, 1, 0), 0, 0);
    }
    for (uint32_t k = 0; k < 16; k++)
        build_triangle(&b, 0, 1 + k, 1 + (k + 1) % 16);
    return demo_shadow(&b, 0.35f);
}

int demo_drone(struct stage *stage)
{
    int first = stage_add(stage, body(stage));
    const struct scene_surface *hand[2] = {rotor(stage, 1), rotor(stage, -1)};
    for (int i = 0; i < 4; i++)
        stage_add(stage, hand[i % 2]);
    stage_add(stage, shadow(stage));
    return first;
}

void demo_drone_place(struct scene_instant *out, int first, struct xform world, double spin)
{
    stage_place(out, first + DRONE_BODY, world);
    for (int i = 0; i < 4; i++) {
        double angle = PI / 4 + PI / 2 * i, turn = i % 2 == 0 ? spin : PI / 3 - spin;
        struct xform at = xform_move(arm * sqrt(2) * cos(angle), 0.115,
                                     -arm * sqrt(2) * sin(angle));
        stage_place(out, first + DRONE_ROTOR + i,
                    xform_mul(world, xform_mul(at, xform_turn_y(turn))));
    }
    /* Along the light (0.36, 0.80, 0.48) down to the ground. */
    struct vec3 p = xform_point(world, vec3(0, 0, 0));
    double heading = atan2(-world.m[2], world.m[0]);
    struct xform ground = xform_move(p.x - 0.36 / 0.80 * p.y, 0.014, p.z - 0.48 / 0.80 * p.y);
    stage_place(out, first + DRONE_SHADOW, xform_mul(ground, xform_turn_y(heading)));
}

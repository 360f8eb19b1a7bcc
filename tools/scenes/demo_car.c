/* SPDX-License-Identifier: MIT */
/* demo_car.c - a small open-wheel racing car; the wheels are props of their own. */
#include "tools/scenes/demo.h"

#include <math.h>

#define PI 3.14159265358979323846

#define RED 0xd8362cu
#define DEEP_RED 0xa8242au
#define CREAM 0xf6ecd2u
#define CARBON 0x2a2d36u
#define STEEL 0xaab2bcu
#define TYRE 0x26262bu

/* Where the wheels turn. */
static const struct {
    double x, z;
} hub[4] = {{1.38, 0.86}, {1.38, -0.86}, {-1.32, 0.86}, {-1.32, -0.86}};

/* A cross section of the hull at x: half width, bottom, shoulder and top; the top is `roof` as
 * wide. */
static void section(struct vec3 *ring, double x, double half, double low, double shoulder,
                    double high, double roof)
{
    ring[0] = vec3(x, low, half * 0.8);
    ring[1] = vec3(x, low, -half * 0.8);
    ring[2] = vec3(x, shoulder, -half);
    ring[3] = vec3(x, high, -half * roof);
    ring[4] = vec3(x, high, half * roof);
    ring[5] = vec3(x, shoulder, half);
}

static void hull(struct build *b)
{
    struct vec3 ring[5 * 6];
    build_color(b, RED);
    section(ring, -1.75, 0.20, 0.34, 0.46, 0.56, 0.6);
    section(ring + 6, -1.20, 0.36, 0.20, 0.50, 0.76, 0.5);
    section(ring + 12, -0.42, 0.46, 0.16, 0.48, 0.80, 0.5);
    section(ring + 18, 0.10, 0.46, 0.16, 0.46, 0.66, 0.8);
    section(ring + 24, 0.62, 0.38, 0.18, 0.44, 0.62, 0.8);
    build_loft(b, ring, 5, 6);
    section(ring, 0.62, 0.38, 0.18, 0.44, 0.62, 0.8);
    section(ring + 6, 1.40, 0.26, 0.24, 0.40, 0.50, 0.7);
    section(ring + 12, 1.85, 0.19, 0.27, 0.36, 0.43, 0.7);
    build_loft(b, ring, 3, 6);
    build_color(b, CREAM);
    section(ring, 1.85, 0.19, 0.27, 0.36, 0.43, 0.7);
    section(ring + 6, 2.20, 0.10, 0.28, 0.32, 0.36, 0.7);
    build_loft(b, ring, 2, 6);
    /* Air box behind the driver, and a stripe along the nose. */
    section(ring, -1.15, 0.10, 0.72, 0.76, 0.80, 0.8);
    section(ring + 6, -0.62, 0.15, 0.74, 0.96, 1.04, 0.6);
    section(ring + 12, -0.40, 0.14, 0.74, 0.98, 1.06, 0.6);
    build_loft(b, ring, 3, 6);
    section(ring, 0.64, 0.10, 0.60, 0.625, 0.645, 1);
    section(ring + 6, 1.42, 0.07, 0.48, 0.505, 0.525, 1);
    section(ring + 12, 1.84, 0.05, 0.40, 0.435, 0.455, 1);
    build_loft(b, ring, 3, 6);
}

static void pods_and_cockpit(struct build *b)
{
    struct vec3 ring[3 * 6];
    for (int side = -1; side <= 1; side += 2) {
        struct xform at = b->at;
        b->at = xform_mul(at, xform_move(0, 0, side * 0.55));
        build_color(b, RED);
        section(ring, -1.00, 0.14, 0.18, 0.30, 0.40, 0.7);
        section(ring + 6, -0.55, 0.24, 0.14, 0.40, 0.54, 0.7);
        section(ring + 12, 0.28, 0.26, 0.14, 0.44, 0.58, 0.75);
        build_loft(b, ring, 3, 6);
        build_color(b, CARBON);
        section(ring, 0.28, 0.20, 0.20, 0.42, 0.53, 0.75);
        section(ring + 6, 0.29, 0.20, 0.20, 0.42, 0.53, 0.75);
        build_loft(b, ring, 2, 6);
        build_color(b, CREAM);
        double panel = side > 0 ? 0.22 : -0.26;
        build_box(b, vec3(-0.50, 0.28, panel), vec3(0.18, 0.44, panel + 0.04));
        b->at = at;
    }
    build_color(b, CARBON);
    build_box(b, vec3(-0.36, 0.62, -0.27), vec3(0.34, 0.69, 0.27));
    build_box(b, vec3(-1.6, 0.10, -0.62), vec3(1.0, 0.15, 0.62));
    build_color(b, 0x7fb6d6);
    build_box(b, vec3(0.34, 0.62, -0.22), vec3(0.42, 0.78, 0.22));
    build_color(b, CARBON);
    build_box(b, vec3(-0.30, 0.66, -0.15), vec3(0.10, 0.78, 0.15));
}

static void wings(struct build *b)
{
    struct vec3 ring[2 * 6];
    build_color(b, DEEP_RED);
    section(ring, 1.78, 1.02, 0.16, 0.18, 0.20, 1);
    section(ring + 6, 2.28, 0.94, 0.13, 0.15, 0.17, 1);
    build_loft(b, ring, 2, 6);
    build_color(b, CREAM);
    build_box(b, vec3(1.70, 0.13, 1.00), vec3(2.26, 0.36, 1.05));
    build_box(b, vec3(1.70, 0.13, -1.05), vec3(2.26, 0.36, -1.00));
    build_color(b, RED);
    section(ring, -2.10, 0.80, 1.04, 1.07, 1.10, 1);
    section(ring + 6, -1.66, 0.80, 0.96, 0.99, 1.02, 1);
    build_loft(b, ring, 2, 6);
    build_color(b, CREAM);
    build_box(b, vec3(-2.12, 0.60, 0.80), vec3(-1.60, 1.16, 0.85));
    build_box(b, vec3(-2.12, 0.60, -0.85), vec3(-1.60, 1.16, -0.80));
    build_color(b, CARBON);
    build_box(b, vec3(-1.92, 0.42, -0.10), vec3(-1.74, 1.00, 0.10));
}

/* Two arms from the hull to each wheel. */
static void suspension(struct build *b)
{
    build_color(b, CARBON);
    for (int i = 0; i < 4; i++) {
        double inner = hub[i].z > 0 ? 0.20 : -0.20, outer = hub[i].z * 0.82;
        double z0 = fmin(inner, outer), z1 = fmax(inner, outer);
        build_box(b, vec3(hub[i].x - 0.20, 0.36, z0), vec3(hub[i].x - 0.13, 0.41, z1));
        build_box(b, vec3(hub[i].x + 0.10, 0.45, z0), vec3(hub[i].x + 0.17, 0.50, z1));
    }
}

static struct scene_surface *body(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    hull(&b);
    pods_and_cockpit(&b);
    wings(&b);
    suspension(&b);
    build_color(&b, 0xf2c230);
    b.at = xform_move(-0.12, 0.88, 0);
    build_ball(&b, 0.185, 8, 6);
    build_color(&b, 0x20242c);
    build_box(&b, vec3(0.06, -0.04, -0.13), vec3(0.19, 0.07, 0.13));
    return build_finish(&b);
}

/* A bar across the face of a wheel, from radius r0 to r1, `half` wide, at height y. */
static void bar(struct build *b, double angle, double r0, double r1, double half, double y)
{
    struct xform at = b->at;
    b->at = xform_mul(at, xform_turn_y(angle));
    build_quad(b, vec3(r0, y, half), vec3(r1, y, half), vec3(r1, y, -half), vec3(r0, y, -half));
    b->at = at;
}

/* Lies along y; stands up when placed. Spokes and stripes on both faces make its turning
 * visible. */
static struct scene_surface *wheel(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    double r = CAR_WHEEL_RADIUS;
    build_color(&b, TYRE);
    double tread[8] = {r * 0.90, -0.19, r, -0.15, r, 0.15, r * 0.90, 0.19};
    build_lathe(&b, tread, 4, 16);
    for (int side = 0; side < 2; side++) {
        b.at = side == 0 ? xform_identity() : xform_turn_x(PI);
        build_color(&b, TYRE);
        build_drum(&b, 0, r * 0.90, 0.19, 0.19, 16);
        build_color(&b, 0x43464f);
        double well[4] = {r * 0.62, 0.195, 0, 0.197};
        build_lathe(&b, well, 2, 10);
        build_color(&b, 0xf2c230);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++) {
                double a0 = 2 * PI * i / 3 + 0.24 * k, a1 = a0 + 0.24, y = 0.198;
                double c0 = cos(a0), s0 = sin(a0), c1 = cos(a1), s1 = sin(a1);
                double inner = r * 0.70, outer = r * 0.80;
                build_quad(&b, vec3(inner * s0, y, inner * c0), vec3(outer * s0, y, outer * c0),
                           vec3(outer * s1, y, outer * c1), vec3(inner * s1, y, inner * c1));
            }
        build_color(&b, STEEL);
        for (int i = 0; i < 5; i++)
            bar(&b, 2 * PI * i / 5, 0.03, r * 0.64, 0.038, 0.205);
        build_color(&b, RED);
        b.at = xform_mul(b.at, xform_move(0, 0.2, 0));
        build_drum(&b, 0.07, 0.05, 0, 0.03, 8);
    }
    return build_finish(&b);
}

static struct scene_surface *shadow(struct stage *stage)
{
    struct build b = build_begin(stage, 0);
    struct vec3 ring[9] = {
        vec3(2.25, 0, 0.95), vec3(2.25, 0, -1.0), vec3(1.5, 0, -1.25), vec3(-1.2, 0, -1.5),
        vec3(-2.5, 0, -1.5), vec3(-2.55, 0, 0.3), vec3(-1.9, 0, 1.0), vec3(0, 0, 0.95),
        vec3(1.6, 0, 1.05),
    };
    for (int i = 0; i < 9; i++)
        build_vertex(&b, ring[i], vec3(0, 1, 0), 0, 0);
    for (uint32_t i = 1; i + 1 < 9; i++)
        build_triangle(&b, 0, i, i + 1);
    return demo_shadow(&b, 0.55f);
}

int demo_car(struct stage *stage)
{
    int first = stage_add(stage, body(stage));
    const struct scene_surface *w = wheel(stage);
    for (int i = 0; i < 4; i++)
        stage_add(stage, w);
    stage_add(stage, shadow(stage));
    return first;
}

void demo_car_place(struct scene_instant *out, int first, struct xform world, double rolled,
                    double steer)
{
    stage_place(out, first + CAR_BODY, world);
    for (int i = 0; i < 4; i++) {
        struct xform spin = xform_turn_z(-rolled / CAR_WHEEL_RADIUS);
        struct xform at = xform_move(hub[i].x, CAR_WHEEL_RADIUS, hub[i].z);
        if (i < 2)
            at = xform_mul(at, xform_turn_y(steer));
        stage_place(out, first + CAR_WHEEL + i,
                    xform_mul(world, xform_mul(at, xform_mul(spin, xform_turn_x(PI / 2)))));
    }
    stage_place(out, first + CAR_SHADOW, xform_mul(world, xform_move(0, 0.012, 0)));
}

/* SPDX-License-Identifier: MIT */
/* suite_objects.c - twelve scenes of the quality suite in which things move before a still
 * camera. */
#include "tools/scenes/suite.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Where the still camera of most scenes stands. */
static void yard_camera(struct scene_instant *out)
{
    stage_camera(out, xform_look(vec3(0.23, 2.37, 7.1), vec3(0.04, 1.31, 0), vec3(0, 1, 0)), 47);
}

/* Seconds since the middle of a lap of one second, before the still camera; draws from `first` on start over with it. */
static double yard_lap(double time, struct scene_instant *out, int first)
{
    int lap;
    double s = suite_lap(time - 0.5, 1.0, &lap);
    yard_camera(out);
    for (int i = first; i < out->draw_count; i++)
        suite_cut(out, i, lap);
    return s;
}

/* ------------------------------------------------------------------ translate: along a line */

static void translate_build(struct stage *stage)
{
    suite_yard(stage, 11);
    stage_add(stage, suite_plane(stage, 0xe9443a, 0xf7f3e6));
}

static void translate_move(double time, struct scene_instant *out)
{
    double s = yard_lap(time, out, 1);
    struct xform at = xform_move(0.2 + 22.0 * s, 1.9 - 3.2 * s, 1.2);
    at = xform_mul(at, xform_mul(xform_turn_z(-0.14), xform_turn_x(0.5)));
    stage_place(out, 1, at);
}

/* ------------------------------------------------------------------ propeller: blades that turn */

static void propeller_build(struct stage *stage)
{
    suite_yard(stage, 23);
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int blade = 0; blade < 3; blade++) {
        static const double shape[4][3] = {     /* radius, half chord, twist */
            {0.2, 0.10, 0.10}, {0.8, 0.30, 0.12}, {1.9, 0.26, 0.06}, {2.5, 0.12, 0.03},
        };
        struct vec3 ring[4 * 4];
        b.at = xform_turn_z(2 * PI * blade / 3);
        for (int i = 0; i < 4; i++) {
            double x = shape[i][0], half = shape[i][1], twist = shape[i][2];
            ring[4 * i] = vec3(x, -half, twist + 0.02);
            ring[4 * i + 1] = vec3(x, -half, twist - 0.02);
            ring[4 * i + 2] = vec3(x, half, -twist - 0.02);
            ring[4 * i + 3] = vec3(x, half, -twist + 0.02);
        }
        build_color(&b, blade == 0 ? 0xf6c12d : 0xf4f0e2);
        build_loft(&b, ring, 3, 4);
        build_color(&b, 0xd23a34);
        build_loft(&b, ring + 8, 2, 4);
    }
    b.at = xform_turn_x(PI / 2);
    build_color(&b, 0x2b3a55);
    double hub[8] = {0.34, -0.25, 0.36, 0.15, 0.20, 0.45, 0, 0.55};
    build_lathe(&b, hub, 4, 12);
    stage_add(stage, build_finish(&b));
}

static void propeller_move(double time, struct scene_instant *out)
{
    yard_camera(out);
    struct xform at = xform_mul(xform_move(0.15, 1.45, 1.0), xform_turn_y(0.25));
    stage_place(out, 1, xform_mul(at, xform_turn_z(0.3 + 24.0 * time)));
}

/* ------------------------------------------------------------------ cross: two paths that cross */

static void cross_build(struct stage *stage)
{
    suite_yard(stage, 37);
    stage_add(stage, suite_plane(stage, 0x2f6fd0, 0xf3d24a));
    stage_add(stage, suite_car(stage, 0xe9443a));
}

static void cross_move(double time, struct scene_instant *out)
{
    double s = yard_lap(time, out, 1);
    struct xform plane = xform_mul(xform_move(0.5 + 25.0 * s, 1.5 + 9.5 * s, 1.6),
                                   xform_turn_z(0.36));
    stage_place(out, 1, xform_mul(plane, xform_turn_x(0.6)));
    struct xform car = xform_mul(xform_move(-0.4 - 27.0 * s, 0.35, 2.1 + 2.0 * s),
                                 xform_turn_y(PI + 0.1));
    stage_place(out, 2, xform_mul(car, xform_scale(1.35, 1.35, 1.35)));
}

/* ------------------------------------------------------------------ fence_obj: a ball behind a
 * fence */

static void fence_obj_build(struct stage *stage)
{
    suite_yard(stage, 41);
    struct build b = build_begin(stage, BUILD_COLOR);
    for (int i = 0; i < 15; i++) {
        double x = -3.6 + 0.5 * i;
        build_color(&b, i & 1 ? 0xf2efe6 : 0xd9d3c0);
        build_box(&b, vec3(x - 0.055, 0, 2.2), vec3(x + 0.055, 2.35, 2.26));
    }
    build_color(&b, 0x7a5a3c);
    build_box(&b, vec3(-3.9, 0.45, 2.16), vec3(3.9, 0.58, 2.2));
    build_box(&b, vec3(-3.9, 1.75, 2.16), vec3(3.9, 1.88, 2.2));
    stage_add(stage, build_finish(&b));
    stage_add(stage, suite_ball(stage, 1.25, 0x14213d, 0xfff4d6));
}

static void fence_obj_move(double time, struct scene_instant *out)
{
    double s = yard_lap(time, out, 2);
    struct xform at = xform_move(0.3 + 33.0 * s, 1.35 + 3.2 * s, 0.6);
    at = xform_mul(at, xform_turn_z(-0.6));
    stage_place(out, 2, xform_mul(at, xform_turn_x(1.2)));
}

/* ------------------------------------------------------------------ enter: into the frame */

static void enter_build(struct stage *stage)
{
    suite_yard(stage, 53);
    stage_add(stage, suite_car(stage, 0xf3b52c));
    stage_add(stage, suite_ball(stage, 0.62, 0x2bb3a8, 0x14304a));
}

static void enter_move(double time, struct scene_instant *out)
{
    double s = yard_lap(time, out, 1);
    struct xform car = xform_mul(xform_move(-3.1 + 27.0 * s, 0.1, 1.4), xform_turn_y(-0.03));
    stage_place(out, 1, xform_mul(car, xform_scale(1.6, 1.6, 1.6)));
    struct xform ball = xform_move(2.05, 3.35 - 24.0 * s, 1.2);
    stage_place(out, 2, xform_mul(ball, xform_turn_x(0.8)));
}

/* ------------------------------------------------------------------ near: through the near
 * plane */

/* A lorry drives past so close that its side crosses the near plane, over a floor that does so
 * as well. */
static void near_build(struct stage *stage)
{
    suite_yard(stage, 61);
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, 0x9c978a);
    build_quad(&b, vec3(-14, -0.02, 14), vec3(14, -0.02, 14), vec3(14, -0.02, -14),
               vec3(-14, -0.02, -14));
    stage_add(stage, build_finish(&b));
    for (int i = 0; i < 14; i++) {
        double x = -4.2 + 0.42 * i;
        build_color(&b, i & 1 ? 0xe3d5b4 : 0xb5583a);
        build_box(&b, vec3(x, 0.4, -0.8), vec3(x + 0.42, 1.55, 0.8));
    }
    build_color(&b, 0x2b4c8c);
    build_box(&b, vec3(1.8, 0.4, -0.75), vec3(3.1, 1.9, 0.75));
    build_color(&b, 0x23252c);
    for (int i = 0; i < 6; i++) {
        struct xform at = xform_move(-3.3 + 2.9 * (i % 3), 0.45, i < 3 ? -0.7 : 0.7);
        b.at = xform_mul(at, xform_turn_x(PI / 2));
        build_drum(&b, 0.45, 0.45, -0.12, 0.12, 10);
    }
    stage_add(stage, build_finish(&b));
}

static void near_move(double time, struct scene_instant *out)
{
    int lap;
    double s = suite_lap(time - 0.5, 1.2, &lap);
    stage_camera(out, xform_look(vec3(0.23, 1.83, 4.6), vec3(0.04, 1.2, 0), vec3(0, 1, 0)), 62);
    struct xform at = xform_move(0.9 - 5.6 * s, 0, 2.25 + 2.0 * s);
    stage_place(out, 2, xform_mul(at, xform_turn_y(PI + 0.35)));
    out->camera.znear = 1.35;
    suite_cut(out, 2, lap);
}

/* ------------------------------------------------------------------ long: streaks of 72 and 92
 * px */

static void long_build(struct stage *stage)
{
    suite_yard(stage, 71);
    stage_add(stage, suite_plane(stage, 0xfdf6e3, 0xe9443a));
    stage_add(stage, suite_ball(stage, 0.62, 0x1d2b53, 0xffd23f));
}

static void long_move(double time, struct scene_instant *out)
{
    double s = yard_lap(time, out, 1);
    struct xform plane = xform_mul(xform_move(0.1 + 123.0 * s, 2.05 + 17.0 * s, 0.9),
                                   xform_turn_x(0.55));
    plane = xform_mul(plane, xform_turn_z(0.12));
    stage_place(out, 1, xform_mul(plane, xform_scale(0.72, 0.72, 0.72)));
    struct xform ball = xform_move(0.2 - 89.0 * s, 0.85 + 12.0 * s, 1.4);
    stage_place(out, 2, xform_mul(ball, xform_turn_z(0.5)));
}

/* ------------------------------------------------------------------ skin: a figure that bends */

enum { LIMBS = 5, LIMB_SIDES = 9, LIMB_RINGS = 9, LIMB_VERTICES = LIMB_SIDES * LIMB_RINGS };

/* Each limb hangs from its root along -y and bends at half its length: trunk, arms, legs. */
static const struct limb {
    double x, y, length, radius;
    uint32_t upper, lower;
} limbs[LIMBS] = {
    {0, 2.55, 1.35, 0.40, 0xe9443a, 0xe9443a},
    {0.44, 2.42, 1.35, 0.17, 0xf3b52c, 0xf2c79c}, {-0.44, 2.42, 1.35, 0.17, 0xf3b52c, 0xf2c79c},
    {0.20, 1.36, 1.36, 0.20, 0x2b4c8c, 0x1d2333}, {-0.20, 1.36, 1.36, 0.20, 0x2b4c8c, 0x1d2333},
};

struct bend {
    struct xform root, joint;       /* of the limb; and of its lower half, about the bend */
};

static double smooth_step(double low, double high, double x)
{
    double t = fmin(fmax((x - low) / (high - low), 0), 1);
    return t * t * (3 - 2 * t);
}

static struct vec3 limb_point(const struct limb *limb, int ring, int side)
{
    double along = (double)ring / (LIMB_RINGS - 1), angle = 2 * PI * side / LIMB_SIDES;
    double r = limb->radius * (1 - 0.35 * along) * pow(sin(PI * (0.03 + 0.94 * along)), 0.35);
    return vec3(r * sin(angle), -limb->length * along, r * cos(angle));
}

/* Two bones, blended over the middle third. */
static struct vec3 limb_bent(const struct limb *limb, const struct bend *bend, int ring, int side)
{
    struct vec3 p = limb_point(limb, ring, side), q = vec3(p.x, p.y + limb->length / 2, p.z);
    double weight = smooth_step(0.33, 0.67, (double)ring / (LIMB_RINGS - 1));
    q = xform_point(bend->joint, q);
    q.y -= limb->length / 2;
    p = vec3_add(vec3_scale(p, 1 - weight), vec3_scale(q, weight));
    return xform_point(bend->root, p);
}

static void skin_build(struct stage *stage)
{
    suite_yard(stage, 83);
    struct build b = build_begin(stage, BUILD_COLOR | BUILD_NORMAL);
    for (int i = 0; i < LIMBS; i++) {
        uint32_t first = (uint32_t)b.vertex_count;
        b.at = xform_move(limbs[i].x, limbs[i].y, 0);
        for (int ring = 0; ring < LIMB_RINGS; ring++)
            for (int side = 0; side < LIMB_SIDES; side++) {
                struct vec3 p = limb_point(&limbs[i], ring, side);
                build_color(&b, ring < LIMB_RINGS / 2 ? limbs[i].upper : limbs[i].lower);
                build_vertex(&b, p, vec3(p.x, 0, p.z), 0, 0);
            }
        for (uint32_t ring = 0; ring + 1 < LIMB_RINGS; ring++)
            for (uint32_t side = 0; side < LIMB_SIDES; side++) {
                uint32_t high = first + ring * LIMB_SIDES, low = high + LIMB_SIDES;
                uint32_t next = (side + 1) % LIMB_SIDES;
                build_triangle(&b, low + side, low + next, high + next);
                build_triangle(&b, low + side, high + next, high + side);
            }
    }
    stage_add_soft(stage, build_finish(&b));
    b = build_begin(stage, BUILD_COLOR | BUILD_NORMAL);
    build_color(&b, 0xf2c79c);
    build_ball(&b, 0.30, 12, 8);
    stage_add(stage, build_finish(&b));
}

static void skin_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    double beat = 2 * PI * 3.2 * time, s = sin(beat), c = cos(beat);
    struct bend bend[LIMBS];
    struct xform hip = xform_move(0.1, 0.12 * fabs(s), 0.9);
    for (int i = 0; i < LIMBS; i++)
        bend[i].joint = xform_identity();

    /* The trunk hangs from the neck, so it is turned about the hip as a whole. */
    struct xform lean = xform_mul(xform_move(0, 1.25, 0), xform_mul(xform_turn_z(0.42 * s),
                                                                    xform_move(0, -1.25, 0)));
    for (int i = 0; i < LIMBS; i++) {
        struct xform at = xform_move(limbs[i].x, limbs[i].y, 0);
        double side = limbs[i].x > 0 ? 1 : -1;
        if (i == 0) {
            bend[i].joint = xform_turn_z(-0.30 * s);
        } else if (i < 3) {
            at = xform_mul(at, xform_turn_z(side * (1.5 + 0.9 * s * side)));
            bend[i].joint = xform_turn_z(side * (0.7 + 0.6 * c));
        } else {
            at = xform_mul(at, xform_turn_x(side * 0.5 * s));
            bend[i].joint = xform_turn_x(0.5 - 0.45 * side * s);
        }
        bend[i].root = xform_mul(hip, i < 3 ? xform_mul(lean, at) : at);
    }

    float *position = stage_soft_position(out, 1);
    for (int i = 0; i < LIMBS; i++)
        for (int v = 0; v < LIMB_VERTICES; v++) {
            struct vec3 p = limb_bent(&limbs[i], &bend[i], v / LIMB_SIDES, v % LIMB_SIDES);
            float *to = position + 3 * (i * LIMB_VERTICES + v);
            to[0] = (float)p.x;
            to[1] = (float)p.y;
            to[2] = (float)p.z;
        }
    suite_normals(stage->prop[1].surface, position, stage_soft_normal(out, 1));
    stage_place(out, 2, xform_mul(xform_mul(hip, lean), xform_move(0, 2.86, 0)));
    yard_camera(out);
}

/* ------------------------------------------------------------------ swarm: 64 small balls */

enum { SWARM = 64 };

static void swarm_build(struct stage *stage)
{
    static const uint32_t paint[4] = {0xf4e9c8, 0xe4572e, 0xffc914, 0x17bebb};
    suite_yard(stage, 97);
    const struct scene_surface *ball[4];
    for (int i = 0; i < 4; i++) {
        struct build b = build_begin(stage, BUILD_COLOR | BUILD_NORMAL);
        build_color(&b, paint[i]);
        build_ball(&b, 0.21, 8, 6);
        ball[i] = build_finish(&b);
    }
    for (int i = 0; i < SWARM; i++)
        stage_add(stage, ball[i % 4]);
}

static void swarm_move(double time, struct scene_instant *out)
{
    yard_camera(out);
    uint32_t seed = 2024;
    for (int i = 0; i < SWARM; i++) {
        double radius = 0.6 + 2.3 * sqrt(suite_random(&seed)), speed = 11 + 8 * suite_random(&seed);
        double phase = 2 * PI * suite_random(&seed), tilt = 1.2 * (suite_random(&seed) - 0.5);
        double angle = phase + (i & 1 ? speed : -speed) * time / sqrt(radius);
        struct xform ring = xform_mul(xform_move(0.1, 1.95, 1.1), xform_turn_x(1.3 + tilt));
        stage_place(out, 1 + i, xform_mul(xform_mul(ring, xform_turn_z(tilt)),
                                          xform_move(radius * sin(angle), 0, radius * cos(angle))));
    }
}

/* ------------------------------------------------------------------ teleport: somewhere else */

static void teleport_build(struct stage *stage)
{
    suite_yard(stage, 101);
    stage_add(stage, suite_car(stage, 0x2f6fd0));
}

/* Every 14 frames the car is put elsewhere: three quarters of a frame before the frame of the
 * scene, so before any exposure of 180 degrees opens, and goes on driving at its own speed. */
static void teleport_move(double time, struct scene_instant *out)
{
    int lap;
    double period = 14 / 30.0, since = suite_lap(time - 0.5 + 0.75 / 30 - period / 2, period, &lap);
    double start = lap & 1 ? -4.6 : 0.1, lane = lap & 1 ? -1.3 : 1.0;
    yard_camera(out);
    stage_place(out, 1, xform_move(start + 6.0 * (since + period / 2), 0, lane));
    suite_cut(out, 1, lap);
}

/* ------------------------------------------------------------------ morph: from one shape to
 * another */

struct morph {
    const struct scene_surface *ball;
};

static void morph_build(struct stage *stage)
{
    struct morph *m = stage_alloc(stage, sizeof *m);
    suite_yard(stage, 113);
    const struct scene_surface *ball = suite_ball(stage, 1.2, 0x5b21b6, 0xffd166);
    if (m != NULL)
        m->ball = ball;
    stage->extra = m;
    stage_add_soft(stage, ball);
}

/* Between a star, a cube and a ball by two weights. */
static void morph_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct morph *m = stage->extra;
    double star = 0.5 + 0.5 * sin(2 * PI * 6.1 * time), cube = 0.5 + 0.5 * cos(2 * PI * 4.4 * time);
    float *position = stage_soft_position(out, 1);
    for (int i = 0; i < m->ball->vertex_count; i++) {
        const float *p = m->ball->position + 3 * (size_t)i;
        double x = (double)p[0], y = (double)p[1], z = (double)p[2];
        double angle = atan2(x, y), wave = 0.42 * cos(5 * angle) * (1 - fabs(z) / 1.2);
        double box = 1.0 / fmax(fmax(fabs(x), fabs(y)), fabs(z)) - 1;
        double factor = 1 + star * wave + cube * 0.55 * box;
        position[3 * i] = (float)(x * factor);
        position[3 * i + 1] = (float)(y * factor);
        position[3 * i + 2] = (float)(z * factor);
    }
    suite_normals(m->ball, position, stage_soft_normal(out, 1));
    stage_place(out, 1, xform_mul(xform_move(0.1, 1.5, 1.4), xform_turn_y(0.7)));
    yard_camera(out);
}

/* ------------------------------------------------------------------ cubic: along a curve */

static void cubic_build(struct stage *stage)
{
    suite_yard(stage, 127);
    stage_add(stage, suite_ball(stage, 0.5, 0x1f6f78, 0xf3d24a));
}

/* A closed curve of Catmull-Rom pieces through eight points, eight pieces per second. */
static void cubic_move(double time, struct scene_instant *out)
{
    static const double through[8][3] = {
        {-2.1, 0.8, 1.0}, {-1.2, 2.6, 0.4}, {0.2, 1.1, 1.5}, {1.1, 2.7, 0.9},
        {2.2, 1.2, 1.2}, {1.0, 0.7, 2.2}, {-0.1, 2.0, 1.8}, {-1.3, 0.9, 2.0},
    };
    double at = fmod(time - 0.2, 1.0) * 8;
    if (at < 0)
        at += 8;
    int piece = (int)at & 7;
    double t = at - floor(at), p[3];
    for (int k = 0; k < 3; k++) {
        double a = through[(piece + 7) & 7][k], b = through[piece][k];
        double c = through[(piece + 1) & 7][k], d = through[(piece + 2) & 7][k];
        p[k] = b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
    }
    yard_camera(out);
    stage_place(out, 1, xform_mul(xform_move(p[0], p[1], p[2]), xform_turn_x(1.1)));
}

/* ------------------------------------------------------------------ */

#define SKY 0xb7cfe0u

const struct stage_kind suite_object_kinds[] = {
    {"suite/translate", 240, 240, 0.5, SKY, translate_build, translate_move},
    {"suite/propeller", 240, 240, 0.5, SKY, propeller_build, propeller_move},
    {"suite/cross", 240, 240, 0.5, SKY, cross_build, cross_move},
    {"suite/fence_obj", 240, 240, 0.5, SKY, fence_obj_build, fence_obj_move},
    {"suite/enter", 240, 240, 0.5, SKY, enter_build, enter_move},
    {"suite/near", 240, 240, 0.5, SKY, near_build, near_move},
    {"suite/long", 240, 240, 0.5, SKY, long_build, long_move},
    {"suite/skin", 240, 240, 0.5, SKY, skin_build, skin_move},
    {"suite/swarm", 240, 240, 0.5, SKY, swarm_build, swarm_move},
    {"suite/teleport", 240, 240, 0.5, SKY, teleport_build, teleport_move},
    {"suite/morph", 240, 240, 0.5, SKY, morph_build, morph_move},
    {"suite/cubic", 240, 240, 0.5, SKY, cubic_build, cubic_move},
};

const int suite_object_count = sizeof suite_object_kinds / sizeof *suite_object_kinds;

/* SPDX-License-Identifier: MIT */
/* failures_space.c - scenes fail/... in perspective: things pass the eye, the camera turns, orbits
 * and takes things along. */
#include "tools/scenes/failures.h"

#include "tools/scenes/suite.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

static double radians(double degrees)
{
    return degrees * PI / 180;
}

static int noise_wall(struct stage *stage, uint32_t seed, double half_width, double half_height,
                      double scale)
{
    return fail_plane(stage, fail_noise(stage, seed, 0x182840, 0xf4e6c0), half_width, half_height,
                      scale);
}

/* ------------------------------------------------------------------ 11 near, pass */

static void near_build(struct stage *stage)
{
    noise_wall(stage, 11, 16, 12, 1.0 / 16);
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, 0xe0402a);
    build_quad(&b, vec3(0.04, -0.05, 0), vec3(0.16, -0.05, 0), vec3(0.16, 0.07, 0),
               vec3(0.04, 0.07, 0));
    struct scene_surface *s = fail_unlit(&b);
    if (s != NULL)
        s->material.double_sided = true;
    stage_add(stage, s);
}

static void quad_before_the_eye(double z, struct scene_instant *out)
{
    stage_camera(out, xform_identity(), 60);
    out->camera.znear = 0.1;
    out->camera.zfar = 20;
    stage_place(out, 0, xform_move(0, 0, -8));
    stage_place(out, 1, xform_move(0, 0, z));
}

/* A frame ago it was 2 behind the eye, now it is 0.5 before it. */
static void near_move(double time, struct scene_instant *out)
{
    quad_before_the_eye(-0.5 - 2.5 * fail_shutters(time), out);
}

/* From 1.75 before the eye to 0.75 behind it. */
static void pass_move(double time, struct scene_instant *out)
{
    quad_before_the_eye(-0.5 + 2.5 * fail_shutters(time), out);
}

/* ------------------------------------------------------------------ 17 billboard */

enum { FLAG_COLUMNS = 12, FLAG_ROWS = 8 };

static void billboard_build(struct stage *stage)
{
    noise_wall(stage, 17, 12, 8, 1.0 / 16);
    fail_plane(stage, fail_noise(stage, 18, 0x601010, 0xffd0a0), 0.6, 0.75, 1.0 / 64);
    struct build b = build_begin(stage, BUILD_COLOR | BUILD_NORMAL);
    b.at = xform_turn_x(PI / 2);
    build_color(&b, 0x2f6fd0);
    build_field(&b, 0, -0.7, 2.2, 0.7, FLAG_COLUMNS, FLAG_ROWS, NULL);
    struct scene_surface *s = fail_unlit(&b);
    if (s != NULL)
        s->material.double_sided = true;
    stage_add_soft(stage, s);
}

/* The camera orbits by 10 degrees per frame; the billboard always faces it, the flag waves. */
static void billboard_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct scene_surface *flag = stage->prop[2].surface;
    double u = fail_shutters(time), angle = radians(10) * u;
    struct xform turn = xform_turn_y(angle);
    struct vec3 eye = xform_direction(turn, vec3(0, 0, 7));
    struct xform camera = xform_look(eye, vec3(0, 0, 0), vec3(0, 1, 0));
    stage_camera(out, camera, 45);
    stage_place(out, 0, xform_move(0, 0, -1.6));
    camera.m[12] = -0.8;
    camera.m[13] = 0.2;
    camera.m[14] = 2.2;
    stage_place(out, 1, camera);
    stage_place(out, 2, xform_move(0.2, 0.3, 0.4));
    float *position = stage_soft_position(out, 2);
    for (int i = 0; i < flag->vertex_count; i++) {
        double x = (double)flag->position[3 * i], y = (double)flag->position[3 * i + 1];
        position[3 * i] = flag->position[3 * i];
        position[3 * i + 1] = (float)(y + 0.12 * x * sin(2.5 * x + 1.6 * u));
        position[3 * i + 2] = (float)(0.2 * x * cos(2.5 * x - 1.6 * u));
    }
    float *normal = stage_soft_normal(out, 2);
    suite_normals(flag, position, normal);
}

/* ------------------------------------------------------------------ 24 still */

static void still_build(struct stage *stage)
{
    noise_wall(stage, 24, 12, 8, 1.0 / 16);
    stage_add(stage, suite_car(stage, 0xe0402a));
    fail_plane(stage, fail_noise(stage, 22, 0x601010, 0xffd0a0), 0.8, 0.8, 1.0 / 40);
}

static void still_move(double time, struct scene_instant *out)
{
    (void)time;
    stage_camera(out, xform_look(vec3(0.7, 1.1, 4.3), vec3(0, 0.4, 0), vec3(0, 1, 0)), 52);
    stage_place(out, 0, xform_move(0, 0, -4));
    stage_place(out, 1, xform_mul(xform_move(0.3, -0.4, 0), xform_turn_y(0.7)));
    stage_place(out, 2, xform_mul(xform_move(-1.2, 0.9, -1), xform_turn_y(-0.5)));
}

/* ------------------------------------------------------------------ 25 ground */

static void ground_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_UV);
    b.at = xform_turn_x(-PI / 2);
    build_quad(&b, vec3(-90, -10, 0), vec3(90, -10, 0), vec3(90, 60, 0), vec3(-90, 60, 0));
    for (int i = 0; i < b.vertex_count; i++) {
        b.uv[2 * i] = b.position[3 * i] / 16;
        b.uv[2 * i + 1] = b.position[3 * i + 2] / 16;
    }
    struct scene_surface *s = fail_unlit(&b);
    if (s != NULL) {
        s->material.image = fail_noise(stage, 29, 0x506050, 0xb0b890);
        s->material.bilinear = true;
    }
    stage_add(stage, s);
}

/* Sideways over a ground that reaches from below the camera to the horizon. */
static void ground_move(double time, struct scene_instant *out)
{
    double u = fail_shutters(time);
    struct xform pose = xform_mul(xform_move(0.4 * u, 1.3, 0), xform_turn_x(-0.32));
    stage_camera(out, pose, 55);
    out->camera.znear = 0.2;
    out->camera.zfar = 60;
}

/* ------------------------------------------------------------------ 28 zoom */

/* At 200 units one unit is one pixel of 144 rows. */
static void zoom_build(struct stage *stage)
{
    noise_wall(stage, 30, 512, 384, 1);
    fail_plane(stage, fail_noise(stage, 32, 0x601010, 0xffd0a0), FAIL_INSET_HALF / 2.0,
               FAIL_INSET_HALF / 2.0, 0.5);
}

/* The wall comes 10 % nearer, the inset at 100 units stands still before the camera. */
static void zoom_move(double time, struct scene_instant *out)
{
    double u = fail_shutters(time);
    stage_camera(out, xform_identity(), 2 * atan(72.0 / 200) * 180 / PI);
    out->camera.znear = 10;
    out->camera.zfar = 400;
    stage_place(out, 0, xform_move(0, 0, -200 / (1 + 0.1 * u)));
    stage_place(out, 1, xform_move(0, 0, -100));
}

/* ------------------------------------------------------------------ 29 sky */

#define SKY_AWAY 60.0

/* Ground, posts on it as far away as the stars, and the stars: squares and posts are as wide. */
static void sky_build(struct stage *stage)
{
    struct build b = build_begin(stage, BUILD_COLOR);
    build_color(&b, 0x405030);
    build_quad(&b, vec3(-300, -2, 20), vec3(300, -2, 20), vec3(300, -2, -SKY_AWAY),
               vec3(-300, -2, -SKY_AWAY));
    for (int i = -4; i <= 4; i++) {
        b.at = xform_mul(xform_turn_y(-radians(12) * i), xform_move(0, 0, -SKY_AWAY));
        build_color(&b, 0xfff4d8);
        build_quad(&b, vec3(-0.6, -2, 0), vec3(0.6, -2, 0), vec3(0.6, 6, 0), vec3(-0.6, 6, 0));
        build_quad(&b, vec3(-0.6, 11, 0), vec3(0.6, 11, 0), vec3(0.6, 15, 0), vec3(-0.6, 15, 0));
    }
    stage_add(stage, fail_unlit(&b));
}

/* The camera turns by 5 degrees. */
static void sky_move(double time, struct scene_instant *out)
{
    double u = fail_shutters(time);
    stage_camera(out, xform_mul(xform_turn_y(-radians(5) * u), xform_turn_x(radians(5))), 45);
    out->camera.zfar = 2 * SKY_AWAY;
}

/* ------------------------------------------------------------------ 30 attached */

static void attached_build(struct stage *stage)
{
    stage_add(stage, suite_car(stage, 0xe0402a));
}

/* The camera turns and drives until FAIL_STOP_FRAME, and takes the car along. */
static void attached_move(double time, struct scene_instant *out)
{
    double u = fmin(fail_shutters(time), FAIL_STOP_FRAME);
    struct xform pose = xform_mul(xform_move(0.31 * u, 0.05 * u, 0.43 * u),
                                  xform_mul(xform_turn_y(0.07 * u), xform_turn_x(0.02 * u)));
    stage_camera(out, pose, 55);
    struct xform held = xform_mul(xform_move(0.3, -0.7, -3.2), xform_turn_y(0.8));
    stage_place(out, 0, xform_mul(pose, held));
}

/* ------------------------------------------------------------------ 32 arm */

enum { ARM_RINGS = 17, ARM_SIDES = 12 };

static void arm_build(struct stage *stage)
{
    noise_wall(stage, 33, 12, 8, 1.0 / 16);
    struct build b = build_begin(stage, BUILD_COLOR);
    struct vec3 ring[ARM_RINGS * ARM_SIDES];
    for (int i = 0; i < ARM_RINGS; i++)
        for (int k = 0; k < ARM_SIDES; k++) {
            double a = 2 * PI * k / ARM_SIDES;
            ring[i * ARM_SIDES + k] = vec3(0.22 * sin(a), 2.6 * i / (ARM_RINGS - 1), 0.22 * cos(a));
        }
    build_color(&b, 0xf2c79c);
    build_loft(&b, ring, ARM_RINGS, ARM_SIDES);
    for (int i = 0; i < b.vertex_count; i++)
        if (i / ARM_SIDES / 2 % 2 == 1)
            memcpy(b.vertex_color + 4 * (size_t)i, (float[4]){0.1f, 0.3f, 0.6f, 1}, 16);
    stage_add_soft(stage, build_finish(&b));
    stage_add(stage, suite_ball(stage, 0.6, 0x5b21b6, 0xffd166));
}

/* Two bones: the lower turns by 40 degrees about the elbow, blended over a fifth of the length. The
 * ball is stretched unevenly while it turns. */
static void arm_move(double time, struct scene_instant *out)
{
    const struct stage *stage = stage_of(out);
    const struct scene_surface *arm = stage->prop[1].surface;
    double u = fail_shutters(time), angle = radians(20 + 40 * u);
    stage_camera(out, xform_move(0, 0, 6), 45);
    stage_place(out, 0, xform_move(0, 0, -3));
    float *position = stage_soft_position(out, 1);
    for (int i = 0; i < arm->vertex_count; i++) {
        double x = (double)arm->position[3 * i], y = (double)arm->position[3 * i + 1] - 1.3;
        double weight = fmin(fmax(0.5 + y / 0.52, 0), 1), c = cos(angle), s = sin(angle);
        position[3 * i] = (float)(x + weight * (c * x - s * y - x));
        position[3 * i + 1] = (float)(1.3 + y + weight * (s * x + c * y - y));
        position[3 * i + 2] = arm->position[3 * i + 2];
    }
    stage_place(out, 1, xform_move(0.6, -1.6, 0));
    struct xform stretch = xform_scale(1 + 0.4 * u, 1 - 0.2 * u, 1);
    struct xform ball = xform_mul(xform_turn_z(0.6 * u), xform_mul(stretch, xform_turn_x(0.5)));
    stage_place(out, 2, xform_mul(xform_move(-1.5, -0.9, 0), ball));
}

/* ------------------------------------------------------------------ 36 far */

static void far_build(struct stage *stage)
{
    noise_wall(stage, 36, 12, 8, 1.0 / 16);
    stage_add(stage, suite_car(stage, 0xe0402a));
}

/* Camera and car move. */
static void far_move(double time, struct scene_instant *out)
{
    double u = fail_shutters(time);
    stage_camera(out, xform_mul(xform_move(0.1 * u, 0.4, 4.2), xform_turn_y(0.03 * u)), 52);
    stage_place(out, 0, xform_move(0, 0, -4));
    stage_place(out, 1, xform_mul(xform_move(0.5 * u, -0.4, 0), xform_turn_y(0.7 - 0.1 * u)));
}

/* ------------------------------------------------------------------ */

const struct stage_kind failure_space_kinds[] = {
    {"fail/near", 128, 96, FAIL_TIME, 0, near_build, near_move},
    {"fail/pass", 128, 96, FAIL_TIME, 0, near_build, pass_move},
    {"fail/billboard", 192, 144, FAIL_TIME, 0, billboard_build, billboard_move},
    {"fail/still", 192, 144, FAIL_TIME, 0, still_build, still_move},
    {"fail/ground", 128, 128, FAIL_TIME, 0x90b0d0, ground_build, ground_move},
    {"fail/zoom", 192, 144, FAIL_TIME, 0, zoom_build, zoom_move},
    {"fail/sky", 192, 144, FAIL_TIME, 0x183058, sky_build, sky_move},
    {"fail/attached", 128, 96, FAIL_TIME, 0x304058, attached_build, attached_move},
    {"fail/arm", 192, 144, FAIL_TIME, 0, arm_build, arm_move},
    {"fail/far", 128, 96, FAIL_TIME, 0, far_build, far_move},
};

const int failure_space_count = sizeof failure_space_kinds / sizeof *failure_space_kinds;

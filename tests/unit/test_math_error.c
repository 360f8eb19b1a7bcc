/* SPDX-License-Identifier: MIT */
/* test_math_error.c - the largest errors of smear_math.h against double precision, as its comments state them. For
 * hosts; test_math.c holds what is exact. */
#include <smear_math.h>

#include "tests/host.h"

#define STEP (1.0 / (1 << 24))
#define TAU 6.283185307179586476925

enum { TRIES = 200000 };

/* Of all magnitudes. */
static int32_t random_i32(void)
{
    const int32_t x = (int32_t)random_u32();
    return x >> random_u32() % 31u;
}

static smear_vec3 random_vec(void)
{
    const int32_t x = random_i32(), y = random_i32(), z = random_i32();
    return smear_vec(x, y, z);
}

static double radians(uint32_t angle)
{
    return angle / 4294967296.0 * TAU;
}

/* ------------------------------------------------------------------ in double precision */

struct vector { double v[3]; };
struct matrix { double m[9]; };

static struct vector vector(smear_vec3 p)
{
    return (struct vector){ { p.x, p.y, p.z } };
}

/* Brings a vector to length one, and returns how long it was; a vector of length 0 stays. */
static double normalize(struct vector *a)
{
    return dot3(a->v, a->v) > 0 ? unit3(a->v) : 0;
}

static struct matrix multiply(struct matrix a, struct matrix b)
{
    struct matrix out;
    product3(out.m, a.m, b.m);
    return out;
}

static struct matrix rotation(struct vector axis, double angle)
{
    struct matrix out;
    turn3(out.m, axis.v, angle);
    return out;
}

static const struct vector axes[3] = { { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } };

/* ------------------------------------------------------------------ errors */

static double larger(double a, double b)
{
    return fabs(a) > fabs(b) ? fabs(a) : fabs(b);
}

/* Largest difference of a basis from a matrix, in steps of q24. */
static double error_of(const smear_transform *t, struct matrix want)
{
    double worst = 0;
    for (int i = 0; i < 9; i++)
        worst = larger(worst, t->basis[i] - want.m[i] / STEP);
    return worst;
}

/* Largest difference from 0 or 1 of products of two rows or two columns, in steps of q24. */
static double skew_of(const smear_transform *t)
{
    double worst = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int32_t *m = t->basis, *a = m + 3 * i, *b = m + 3 * j;
            const int64_t one = i == j ? (int64_t)1 << 48 : 0;
            const int64_t rows = (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
            const int64_t columns = (int64_t)m[i] * m[j] + (int64_t)m[3 + i] * m[3 + j] + (int64_t)m[6 + i] * m[6 + j];
            worst = larger(worst, (double)(rows - one) * STEP);
            worst = larger(worst, (double)(columns - one) * STEP);
        }
    return worst;
}

static void test_sine_and_cosine_err_by_less_than_06_of_a_step(void)
{
    double worst = 0;
    for (uint64_t angle = 0; angle < (uint64_t)1 << 32; angle += 2999) {
        worst = larger(worst, smear_sin((uint32_t)angle) - sin(radians((uint32_t)angle)) / STEP);
        worst = larger(worst, smear_cos((uint32_t)angle) - cos(radians((uint32_t)angle)) / STEP);
    }
    CHECK_CLOSE(worst, 0, 0.58);
}

static void test_rotations_about_x_y_and_z_err_by_less_than_06_of_a_step(void)
{
    double worst = 0, skew = 0;
    for (int i = 0; i < TRIES; i++) {
        const uint32_t angle = random_u32();
        const smear_transform turns[3] = { smear_rotate_x(angle), smear_rotate_y(angle), smear_rotate_z(angle) };
        for (int k = 0; k < 3; k++) {
            worst = larger(worst, error_of(&turns[k], rotation(axes[k], radians(angle))));
            skew = larger(skew, skew_of(&turns[k]));
        }
    }
    CHECK_CLOSE(worst, 0, 0.58);
    CHECK_CLOSE(skew, 0, 1.6);
}

static void test_rotations_about_any_axis_err_by_less_than_12_steps(void)
{
    double worst = 0, skew = 0;
    for (int i = 0; i < TRIES; i++) {
        const uint32_t angle = random_u32();
        const smear_vec3 axis = random_vec();
        const smear_transform t = smear_rotate_axis(axis, angle);
        struct vector unit = vector(axis);
        if (normalize(&unit) == 0)
            continue;
        worst = larger(worst, error_of(&t, rotation(unit, radians(angle))));
        skew = larger(skew, skew_of(&t));
    }
    CHECK_CLOSE(worst, 0, 1.2);
    CHECK_CLOSE(skew, 0, 2.5);
}

static void test_euler_angles_err_by_less_than_a_step(void)
{
    double worst = 0, skew = 0;
    for (int i = 0; i < TRIES; i++) {
        const uint32_t yaw = random_u32(), pitch = random_u32(), roll = random_u32();
        const smear_transform t = smear_from_euler(yaw, pitch, roll);
        const struct matrix x = rotation(axes[0], radians(pitch)), y = rotation(axes[1], radians(yaw));
        worst = larger(worst, error_of(&t, multiply(y, multiply(x, rotation(axes[2], radians(roll))))));
        skew = larger(skew, skew_of(&t));
    }
    CHECK_CLOSE(worst, 0, 0.8);
    CHECK_CLOSE(skew, 0, 2.5);
}

static void test_quaternions_of_any_length_err_by_less_than_a_step(void)
{
    double worst = 0, skew = 0;
    for (int i = 0; i < TRIES; i++) {
        const smear_vec3 v = random_vec();
        const int32_t w = random_i32();
        const smear_transform t = smear_from_quaternion(v.x, v.y, v.z, w);
        struct vector axis = vector(v);
        const double sine = normalize(&axis);
        worst = larger(worst, error_of(&t, rotation(axis, 2 * atan2(sine, w))));
        skew = larger(skew, skew_of(&t));
    }
    CHECK_CLOSE(worst, 0, 1);
    CHECK_CLOSE(skew, 0, 2.5);
}

static void test_composed_entries_and_points_are_the_nearest(void)
{
    double worst = 0, worst_origin = 0, worst_point = 0;
    for (int i = 0; i < TRIES; i++) {
        smear_transform a, b;
        struct matrix ma, mb;
        for (int k = 0; k < 9; k++) {
            a.basis[k] = random_i32() >> 4;         /* products of +-8 stay within 128 with some to spare */
            b.basis[k] = random_i32() >> 5;
            ma.m[k] = a.basis[k] * STEP;
            mb.m[k] = b.basis[k] * STEP;
        }
        for (int k = 0; k < 3; k++) {
            a.origin[k] = random_i32() >> 1;
            b.origin[k] = random_i32() >> 6;
        }
        const smear_transform t = smear_compose(a, b);
        const smear_vec3 p = smear_apply(a, smear_vec(b.origin[0], b.origin[1], b.origin[2]));
        worst = larger(worst, error_of(&t, multiply(ma, mb)));
        for (int k = 0; k < 3; k++) {
            const struct vector row = { { ma.m[3 * k], ma.m[3 * k + 1], ma.m[3 * k + 2] } };
            const struct vector at = { { b.origin[0], b.origin[1], b.origin[2] } };
            const double want = dot3(row.v, at.v) + a.origin[k];
            worst_origin = larger(worst_origin, t.origin[k] - want);
            worst_point = larger(worst_point, (k == 0 ? p.x : k == 1 ? p.y : p.z) - want);
        }
    }
    CHECK_CLOSE(worst, 0, 0.5001);
    CHECK_CLOSE(worst_origin, 0, 0.5001);
    CHECK_CLOSE(worst_point, 0, 0.5001);
}

static void test_cameras_err_by_less_than_the_stated_at_any_angle_from_up(void)
{
    double along = 0, across = 0, skew = 0;
    for (int i = 0; i < TRIES; i++) {
        const smear_vec3 eye = random_vec(), target = random_vec(), up = random_vec();
        const smear_transform t = smear_look_at(eye, target, up);
        struct vector z = { { (double)eye.x - target.x, (double)eye.y - target.y, (double)eye.z - target.z } };
        struct vector u = vector(up);
        skew = larger(skew, skew_of(&t));
        if (normalize(&z) == 0 || normalize(&u) == 0)
            continue;
        struct vector x, y;
        cross3(x.v, u.v, z.v);
        const double sine = normalize(&x);
        if (sine < 2e-6)
            continue;
        cross3(y.v, z.v, x.v);
        for (int k = 0; k < 3; k++) {
            along = larger(along, t.basis[3 * k + 2] - z.v[k] / STEP);
            across = larger(across, fmax(fabs(t.basis[3 * k] - x.v[k] / STEP), fabs(t.basis[3 * k + 1] - y.v[k] / STEP)) * sine);
        }
    }
    CHECK_CLOSE(along, 0, 0.6);
    CHECK_CLOSE(across, 0, 0.8);
    CHECK_CLOSE(skew, 0, 2.5);
}

static void test_focal_lengths_of_a_degree_and_more_err_by_less_than_the_stated(void)
{
    double worst = 0, worst_small = 0;
    for (uint32_t fov = SMEAR_DEGREES(1); fov < SMEAR_DEGREES(179.9); fov += 4999) {
        const double want = 65536 / tan(radians(fov) / 2), off = fabs(smear_focal_from_fov(fov) - want);
        worst = larger(worst, off / (want / (1 << 20) + 0.5));
        if (fov > SMEAR_DEGREES(20))
            worst_small = larger(worst_small, off);
    }
    CHECK_CLOSE(worst, 0, 1);
    CHECK_CLOSE(worst_small, 0, 0.6);
}

/* What smear_begin takes for a camera. */
static int flush(void *user, const smear_band *band)
{
    (void)user;
    (void)band;
    return 0;
}

static void test_every_camera_is_accepted_by_smear_begin(void)
{
    smear_desc desc = { .width = 16, .height = 16, .max_triangles = 16, .max_draws = 2, .flush = flush };
    const size_t bytes = smear_memory_size(&desc);
    void *memory = malloc(bytes);
    smear_context *ctx;
    if (CHECK(memory != NULL) && CHECK_EQ(smear_init(&ctx, &desc, memory, bytes), SMEAR_OK))
        for (int i = 0; i < 2000; i++) {
            const smear_vec3 eye = random_vec(), target = i % 7 == 0 ? eye : random_vec();
            const smear_vec3 up = i % 5 == 0 ? smear_vec(0, 0, 0) : random_vec();
            smear_camera camera = smear_perspective(random_u32() >> 1, 1 + (int32_t)(random_u32() >> 2), 0);
            camera.pose = smear_look_at(eye, target, up);
            if (!CHECK_EQ(smear_begin(ctx, &(smear_frame){ .camera = &camera }), SMEAR_OK))
                break;
        }
    free(memory);
}

#include "build/suites/math_error.h"

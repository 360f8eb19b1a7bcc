/* SPDX-License-Identifier: MIT */
/* test_arc.c - poses between two poses, against rotations in double precision. */
#include "geometry/arc.h"

#include "tests/host.h"

/* ------------------------------------------------------------------ rotations in double */

struct spin {
    double axis[3], angle;
};

static struct spin random_spin(double angle)
{
    struct spin s = { { uniform(-1, 1), uniform(-1, 1), uniform(-1, 1) }, angle };
    unit3(s.axis);
    return s;
}

/* An object at rest in `rest`, whose axes have scales that change, turns about `spin`. */
struct motion {
    double rest[9];             /* a rotation, maybe mirrored */
    double scale[3], growth[3]; /* along the object's axes: now, and per frame */
    struct spin spin;           /* per frame */
    double origin[3], velocity[3];
};

static void motion_at(double basis[9], double origin[3], const struct motion *m, double time)
{
    double turn[9], stretched[9];
    turn3(turn, m->spin.axis, m->spin.angle * time);
    for (int i = 0; i < 9; i++)
        stretched[i] = m->rest[i] * (m->scale[i % 3] + m->growth[i % 3] * time);
    product3(basis, turn, stretched);
    for (int i = 0; i < 3; i++)
        origin[i] = m->origin[i] + m->velocity[i] * time;
}

static int32_t to_fixed(double value, double one)
{
    double v = floor(value * one + 0.5);
    return v > 2147483647.0 ? INT32_MAX : v < -2147483647.0 ? -INT32_MAX : (int32_t)v;
}

static smear_transform transform_at(const struct motion *m, double time)
{
    double basis[9], origin[3];
    smear_transform t;
    motion_at(basis, origin, m, time);
    for (int i = 0; i < 9; i++)
        t.basis[i] = to_fixed(basis[i], 16777216.0);
    for (int i = 0; i < 3; i++)
        t.origin[i] = to_fixed(origin[i], 65536.0);
    return t;
}

static struct motion random_motion(double angle)
{
    struct motion m;
    struct spin rest = random_spin(uniform(0, 6.28));
    turn3(m.rest, rest.axis, rest.angle);
    m.spin = random_spin(angle);
    for (int i = 0; i < 3; i++) {
        m.scale[i] = 1;
        m.growth[i] = 0;
        m.origin[i] = uniform(-1000, 1000);
        m.velocity[i] = uniform(-10, 10);
    }
    return m;
}

/* Largest error of an entry of the basis, in units of 2^-20, and of the origin in steps of 2^-16. */
static double worst_basis, worst_origin;

static void measure(const struct motion *m, double time, double scale)
{
    smear_transform before = transform_at(m, -1), now = transform_at(m, 0), out;
    double basis[9], origin[3];
    smear_arc_between(&out, &before, &now, to_fixed(time, 16777216.0));
    motion_at(basis, origin, m, time);
    for (int i = 0; i < 9; i++)
        worst_basis = fmax(worst_basis, fabs(out.basis[i] / 16777216.0 - basis[i]) * 1048576.0 / scale);
    for (int i = 0; i < 3; i++)
        worst_origin = fmax(worst_origin, fabs(out.origin[i] - origin[i] * 65536.0));
}

/* ------------------------------------------------------------------ tests */

static void test_poses_between_lie_on_the_arc(void)
{
    random_state = 1;
    worst_basis = worst_origin = 0;
    for (int n = 0; n < 20000; n++) {
        struct motion m = random_motion(uniform(0.01, 3.1));
        measure(&m, uniform(-1, 0), 1);
    }
    CHECK_CLOSE(worst_basis, 0.0, 0.25);
    CHECK_CLOSE(worst_origin, 0.0, 1.6);
}

static void test_cameras_stay_rotations(void)
{
    random_state = 8;
    for (int n = 0; n < 2000; n++) {
        struct motion m = random_motion(uniform(0.05, 3.1));
        smear_transform before = transform_at(&m, -1), now = transform_at(&m, 0), out;
        smear_arc_between(&out, &before, &now, to_fixed(uniform(-2, 1), 16777216.0));
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) {
                double dot = 0;
                for (int i = 0; i < 3; i++)
                    dot += out.basis[3 * i + j] / 16777216.0 * out.basis[3 * i + k] / 16777216.0;
                CHECK_CLOSE(dot, j == k ? 1.0 : 0.0, 1.0 / (1 << 20));
            }
    }
}

static void linear(smear_transform *out, const smear_transform *before, const smear_transform *now, double time)
{
    for (int i = 0; i < 9; i++)
        out->basis[i] = to_fixed(now->basis[i] + ((double)now->basis[i] - before->basis[i]) * time, 1);
    for (int i = 0; i < 3; i++)
        out->origin[i] = to_fixed(now->origin[i] + ((double)now->origin[i] - before->origin[i]) * time, 1);
}

static bool is_linear(const smear_transform *before, const smear_transform *now, double time)
{
    smear_transform out, want;
    smear_arc_between(&out, before, now, to_fixed(time, 16777216.0));
    linear(&want, before, now, time);
    bool ok = true;
    for (int i = 0; i < 9; i++)
        ok = ok && CHECK_NEAR(out.basis[i], want.basis[i], 1);
    for (int i = 0; i < 3; i++)
        ok = ok && CHECK_NEAR(out.origin[i], want.origin[i], 1);
    return ok;
}

static void test_shears_zeros_and_mirrorings_are_linear(void)
{
    random_state = 9;
    for (int n = 0; n < 400; n++) {
        struct motion m = random_motion(uniform(0.1, 3.1));
        smear_transform before = transform_at(&m, -1), now = transform_at(&m, 0);
        double time = uniform(-4, 4);
        smear_transform *t = n & 1 ? &before : &now;
        int j = (int)(random_u32() % 3u);
        for (int i = 0; i < 3; i++) {
            int32_t *e = &t->basis[3 * i + j];
            *e = n % 3 == 0 ? *e + t->basis[3 * i + (j + 1) % 3] / 64       /* sheared */
               : n % 3 == 1 ? 0 : -*e;                                      /* flat, mirrored */
        }
        END_UNLESS(is_linear(&before, &now, time));
    }
    smear_transform still = SMEAR_IDENTITY;
    is_linear(&still, &still, 0.5);
}

#include "build/suites/arc.h"

/* SPDX-License-Identifier: MIT */
/* test_curve.c - curves through two and three poses, against motion in double precision; and what is kept for them. */
#include "curves/curve.h"
#include "geometry/pose.h"
#include "geometry/shot.h"

#include "tests/host.h"

enum { ONE = 1 << 24 };

/* ------------------------------------------------------------------ motion in double */

/* Turns evenly about a pivot, which moves evenly and, along the axis or where nothing turns, falls. */
struct motion {
    double axis[3], angle;      /* radians per frame */
    double pivot[3], velocity[3], fall[3];
    double arm[3];              /* from the pivot to the object's origin, now */
};

static void motion_at(double basis[9], double origin[3], const struct motion *m, double time)
{
    turn3(basis, m->axis, m->angle * time);
    for (int i = 0; i < 3; i++)
        origin[i] = m->pivot[i] + m->velocity[i] * time + m->fall[i] * time * time / 2 + dot3(basis + 3 * i, m->arm);
}

static smear_transform pose(const struct motion *m, double time)
{
    double basis[9], origin[3];
    smear_transform t;
    motion_at(basis, origin, m, time);
    for (int i = 0; i < 9; i++)
        t.basis[i] = (int32_t)floor(basis[i] * 16777216.0 + 0.5);
    for (int i = 0; i < 3; i++)
        t.origin[i] = (int32_t)floor(origin[i] * 65536.0 + 0.5);
    return t;
}

static struct motion random_motion(double angle)
{
    struct motion m = { .angle = angle };
    double length = 0;
    for (int i = 0; i < 3; i++) {
        m.axis[i] = uniform(-1, 1);
        length += m.axis[i] * m.axis[i];
        m.pivot[i] = uniform(-100, 100);
        m.velocity[i] = uniform(-1, 1);
    }
    for (int i = 0; i < 3; i++)
        m.axis[i] /= sqrt(length);
    return m;
}

/* How far the curve is from the motion at a time: entries of the basis in 2^-20, the origin in 2^-16. */
struct error {
    double basis, origin;
};

static struct error error_at(const struct smear_curve *c, const struct motion *m, double time)
{
    double basis[9], origin[3];
    smear_transform out;
    struct error e = { 0, 0 };
    smear_curve_at(&out, c, (int32_t)floor(time * ONE + 0.5));
    motion_at(basis, origin, m, floor(time * ONE + 0.5) / ONE);
    for (int i = 0; i < 9; i++)
        e.basis = fmax(e.basis, fabs(out.basis[i] / 16777216.0 - basis[i]) * 1048576.0);
    for (int i = 0; i < 3; i++)
        e.origin = fmax(e.origin, fabs(out.origin[i] / 65536.0 - origin[i]) * 65536.0);
    return e;
}

/* The worst of them over times of exposures of up to two frames. */
static struct error worst_error(const struct motion *m, int poses, uint8_t path)
{
    const smear_transform now = pose(m, 0), last = pose(m, -1), older = pose(m, -2);
    struct smear_curve c;
    struct error worst = { 0, 0 };
    smear_curve_find(&c, &now, &last, poses == 3 ? &older : NULL, path);
    for (int k = -8; k <= 8; k++) {
        const struct error e = error_at(&c, m, k / 8.0);
        worst.basis = fmax(worst.basis, e.basis);
        worst.origin = fmax(worst.origin, e.origin);
    }
    return worst;
}

/* ------------------------------------------------------------------ curves */

static void test_three_poses_tell_a_fall(void)
{
    random_state = 4;
    for (int n = 0; n < 200; n++) {
        struct motion m = random_motion(0);
        m.velocity[0] = 2;
        for (int i = 0; i < 3; i++)
            m.fall[i] = uniform(-0.3, 0.3);
        CHECK_CLOSE(worst_error(&m, 3, SMEAR_PATH_CURVE).origin, 0.0, 4.0);
    }
}

/* ------------------------------------------------------------------ history */

static struct smear_history history_of(void *memory, bool one_pose)
{
    struct smear_history h = { .frame = 0 };
    struct smear_arena a = { memory, 0 };
    smear_history_lay_out(&h, &a, 4, one_pose);
    smear_history_clear(&h);
    return h;
}

/* Keeps pose `number` of an id in the next frame; returns how many past ones it had, after a look at them. */
static int keep(struct smear_history *h, uint32_t id, int number, bool cut)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    smear_transform now = identity, past[2] = { identity, identity };
    h->frame++;
    now.origin[0] = number;
    const int count = smear_history_keep(h, smear_history_find(h, id), id, &now, cut, past);
    for (int i = 0; i < count; i++)
        CHECK_EQ(past[i].origin[0], number - 1 - i);
    return count;
}

static void test_two_poses_are_kept_of_each_id(void)
{
    static uint64_t memory[256];
    struct smear_history h = history_of(memory, false);
    for (int n = 0; n < 5; n++)
        CHECK_EQ(keep(&h, 9, n, false), n < 2 ? n : 2);
    struct smear_history one = history_of(memory, true);
    for (int n = 0; n < 5; n++)
        CHECK_EQ(keep(&one, 9, n, false), n < 1 ? n : 1);
}

static void test_no_curve_leads_over_a_cut(void)
{
    static uint64_t memory[256];
    struct smear_history h = history_of(memory, false);
    keep(&h, 9, 0, false);
    keep(&h, 9, 1, false);
    CHECK_EQ(keep(&h, 9, 2, true), 2);      /* a cut draw has no motion, whatever is known */
    CHECK_EQ(keep(&h, 9, 3, false), 1);
    CHECK_EQ(keep(&h, 9, 4, false), 2);
}

static void test_a_frame_without_the_id_forgets_it(void)
{
    static uint64_t memory[256];
    struct smear_history h = history_of(memory, false);
    for (int n = 0; n < 3; n++)
        keep(&h, 9, n, false);
    h.frame++;
    CHECK_EQ(keep(&h, 9, 4, false), 0);
    CHECK_EQ(keep(&h, 9, 5, false), 1);
    CHECK_EQ(keep(&h, 9, 6, false), 2);
    /* Others take its place when there is no other: nothing of it is theirs. */
    h.frame += 2;
    for (uint32_t id = 20; id < 24; id++) {
        smear_transform past[2], now = SMEAR_IDENTITY;
        CHECK_EQ(smear_history_keep(&h, smear_history_find(&h, id), id, &now, false, past), 0);
    }
    CHECK_EQ(smear_history_find(&h, 9), -1);        /* all four places are in use */
}

static void test_the_id_alone_is_kept_where_no_pose_is_given(void)
{
    static uint64_t memory[256];
    struct smear_history h = history_of(memory, false);
    CHECK_EQ(smear_history_find(&h, 0), -1);
    for (h.frame = 1; h.frame < 4; h.frame++)
        for (uint32_t id = 20; id < 24; id++) {
            smear_transform past[2];
            const int32_t at = smear_history_find(&h, id);
            CHECK(at >= 0 && !smear_history_has(&h, at, id));
            CHECK_EQ(smear_history_keep(&h, at, id, NULL, false, past), 0);
            CHECK(smear_history_find(&h, id) == at && smear_history_has(&h, at, id));
        }
    h.frame--;
    CHECK_EQ(smear_history_find(&h, 24), -1);       /* all four places are in use */
}

#include "build/suites/curve.h"

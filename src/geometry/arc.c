/* SPDX-License-Identifier: MIT */
/* arc.c - interpolation of poses by rotation. It is done once per draw and pose, so 64-bit products are fine here.
 *
 * With Q the rotation from `before` to `now`, a pose at time t is Q^t (now + t (now - Q before)): what is
 * left when the turn is taken out changes linearly, then the turn is put back. */
#include "geometry/arc.h"

#include "base/fixmath.h"

/* Axes count as orthogonal up to this cosine, q30: 2^-12. */
enum { ARC_SKEW = 1 << 18 };

enum { CORDIC_STEPS = 26, CORDIC_GAIN = 652032874 };       /* the inverse of the gain, q30 */

static const int32_t arctangent[CORDIC_STEPS] = {          /* of 2^-i */
    536870912, 316933406, 167458907, 85004756, 42667331, 21354465, 10679838, 5340245, 2670163, 1335087,
    667544, 333772, 166886, 83443, 41722, 20861, 10430, 5215, 2608, 1304, 652, 326, 163, 81, 41, 20
};

/* Returns the angle of (x, y), both >= 0 and of a length of 2^29 to 2^30: 0 .. a quarter turn, to 2^-24 radians. */
static uint32_t angle_of(int32_t x, int32_t y)
{
    int32_t angle = 0;
    for (int i = 0; i < CORDIC_STEPS; i++) {
        int32_t dx = y >> i, dy = x >> i;
        if (y > 0) {
            x += dx;
            y -= dy;
            angle += arctangent[i];
        } else {
            x -= dx;
            y += dy;
            angle -= arctangent[i];
        }
    }
    return (uint32_t)max_i32(angle, 0);
}

void smear_turn_cosine_sine(uint32_t angle, int32_t *cosine, int32_t *sine)
{
    /* Without a half turn, what is left lies within a quarter to either side. */
    bool turned = angle - 0x40000000u < 0x80000000u;
    int32_t rest = (int32_t)(turned ? angle - 0x80000000u : angle), x = CORDIC_GAIN, y = 0;
    for (int i = 0; i < CORDIC_STEPS; i++) {
        int32_t dx = y >> i, dy = x >> i;
        if (rest >= 0) {
            x -= dx;
            y += dy;
            rest -= arctangent[i];
        } else {
            x += dx;
            y -= dy;
            rest += arctangent[i];
        }
    }
    *cosine = turned ? -x : x;
    *sine = turned ? -y : y;
}

/* ------------------------------------------------------------------ the turn between two poses */

/* Brings a vector to length one, q30. *length is what it was after a shift to 30 bits by *shift: left, or right if
 * negative. Returns false for a vector without length. */
static bool normalize(int32_t out[3], const int32_t in[3], uint32_t *length, int *shift)
{
    uint32_t largest = 0;
    for (int i = 0; i < 3; i++)
        largest = max_u32(largest, (uint32_t)magnitude(in[i]));
    if (largest == 0)
        return false;
    *shift = count_leading_zeros(largest) - 2;              /* 30 bits */
    for (int i = 0; i < 3; i++)
        out[i] = *shift >= 0 ? in[i] * (1 << *shift) : in[i] >> -*shift;
    *length = sqrt_floor_64((uint64_t)dot_wide(out, 1, out, 1));
    int zeros = count_leading_zeros(*length);
    int32_t r = (int32_t)recip_norm_precise(*length << zeros);      /* 1 / length = r 2^(zeros - 61) */
    for (int i = 0; i < 3; i++)
        out[i] = mul_shift(out[i], r, 31 - zeros);
    return true;
}

/* Returns the dot product of q30 vectors, q30. */
static int32_t dot(const int32_t a[3], const int32_t b[3]) { return (int32_t)(dot_wide(a, 1, b, 1) >> 30); }

/* Whether axes at right angles are left-handed: x times y then points away from z, not nearly so. 14 bits tell. */
static bool is_left_handed(int32_t axis[3][3])
{
    int32_t a[3][3], sum = 0;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            a[j][i] = axis[j][i] >> 16;
    for (int i = 0; i < 3; i++) {
        int i1 = i == 2 ? 0 : i + 1, i2 = i == 0 ? 2 : i - 1;
        sum += ((a[0][i1] * a[1][i2] - a[0][i2] * a[1][i1]) >> 14) * a[2][i];
    }
    return sum < 0;
}

void smear_axes_find(struct smear_axes *axes, const smear_transform *t)
{
    axes->are_square = false;
    for (int j = 0; j < 3; j++) {
        const int32_t column[3] = { t->basis[j], t->basis[3 + j], t->basis[6 + j] };
        uint32_t length;
        int shift;
        if (!normalize(axes->axis[j], column, &length, &shift))
            return;
    }
    for (int j = 0; j < 3; j++)
        if (abs_i32(dot(axes->axis[j], axes->axis[j == 2 ? 0 : j + 1])) > ARC_SKEW)
            return;
    axes->are_square = true;
    axes->are_left_handed = is_left_handed(axes->axis);
}

/* Finds the quaternion w x y z, of any length, of a rotation in q28. Its largest component is 4 c^2 >= 1 and the others
 * are 4 c times theirs, so nothing cancels. w >= 0: it turns by at most half a turn. */
static void quaternion_of(int32_t q[4], int32_t m[3][3])
{
    const int32_t one = 1 << 28;
    const int32_t square[4] = {
        one + m[0][0] + m[1][1] + m[2][2], one + m[0][0] - m[1][1] - m[2][2],
        one - m[0][0] + m[1][1] - m[2][2], one - m[0][0] - m[1][1] + m[2][2]
    };
    int largest = 0;
    for (int i = 1; i < 4; i++)
        if (square[i] > square[largest])
            largest = i;
    for (int i = 0; i < 4; i++) {
        if (i == largest) {
            q[i] = square[i];
        } else if (i == 0 || largest == 0) {
            int axis = i + largest - 1, j = axis == 2 ? 0 : axis + 1, k = axis == 0 ? 2 : axis - 1;
            q[i] = m[k][j] - m[j][k];
        } else {
            q[i] = m[i - 1][largest - 1] + m[largest - 1][i - 1];
        }
    }
    if (q[0] < 0)
        for (int i = 0; i < 4; i++)
            q[i] = -q[i];
}

/* Finds axis and angle. Returns false when there is no turn, or none to speak of. */
static bool find_turn(struct smear_turn *turn, const struct smear_axes *before, const struct smear_axes *now)
{
    int32_t m[3][3], q[4];
    if (!before->are_square || !now->are_square || before->are_left_handed != now->are_left_handed)
        return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m[i][j] = (int32_t)(dot_wide(&now->axis[0][i], 3, &before->axis[0][j], 3) >> 32);
    quaternion_of(q, m);
    uint32_t length;
    int shift;
    if (!normalize(turn->axis, q + 1, &length, &shift) || shift > 13)       /* |v| < 2^-13 of w: no turn */
        return false;
    turn->angle = 2 * angle_of(q[0], (int32_t)(shift >= 0 ? length >> shift : length << -shift));
    return true;
}

void smear_turn_between(struct smear_turn *turn, const struct smear_axes *before, const struct smear_axes *now)
{
    turn->turns = find_turn(turn, before, now);
}

/* ------------------------------------------------------------------ poses */

int32_t smear_arc_scaled(int32_t now, int32_t other, uint32_t scale)
{
    return narrow_sat(now + (((int64_t)other - now) * (int32_t)scale >> 8));
}

int32_t smear_arc_number(int32_t before, int32_t now, int32_t time)
{
    SMEAR_ASSERT(time >= -(1 << 30) && time <= 1 << 30);
    return narrow_sat(now + ((((int64_t)now - before) * time + (1 << 23)) >> 24));
}

/* Finds Q - 1 for a turn about the axis n by an angle of which cosine and sine are given, q29: sin [n] + (1 - cos) (n n' - 1). */
static void rotation(int32_t m[3][3], const int32_t axis[3], int32_t c, int32_t s)
{
    int64_t versine = ((int64_t)1 << 30) - c;               /* 0 .. 2, q30 */
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            int64_t nn = (mul_wide(axis[i], axis[j]) >> 30) - (i == j ? 1 << 30 : 0);
            m[i][j] = m[j][i] = (int32_t)(nn * versine >> 31);
        }
    for (int i = 0; i < 3; i++) {
        int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        int32_t sn = mul_shift(s, axis[i], 31);
        m[k][j] += sn;
        m[j][k] -= sn;
    }
}

static void turn_basis(int32_t out[9], int32_t m[3][3], const int32_t basis[9])
{
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
            out[3 * i + j] = narrow_sat(basis[3 * i + j] + ((dot_wide(m[i], 1, basis + j, 3) + (1 << 28)) >> 29));
}

void smear_turn_whole(int32_t basis[9], struct smear_turn *turn, const smear_transform *before)
{
    int32_t m[3][3];
    for (int i = 0; i < 9; i++)
        basis[i] = before->basis[i];
    if (turn->turns) {
        smear_turn_cosine_sine(turn->angle, &turn->cosine, &turn->sine);
        rotation(m, turn->axis, turn->cosine, turn->sine);
        turn_basis(basis, m, before->basis);
    }
}

void smear_turn_part(int32_t basis[9], const struct smear_turn *turn, const int32_t turned[9],
                     const smear_transform *now, int32_t time, uint32_t angle)
{
    int32_t m[3][3], rest[9], cosine, sine;
    for (int i = 0; i < 9; i++)
        rest[i] = smear_arc_number(turned[i], now->basis[i], time);
    for (int i = 0; i < 9; i++)
        basis[i] = rest[i];
    if (turn->turns) {
        smear_turn_cosine_sine(angle, &cosine, &sine);
        rotation(m, turn->axis, cosine, sine);
        turn_basis(basis, m, rest);
    }
}

void smear_arc_between(smear_transform *out, const smear_transform *before, const smear_transform *now,
                       int32_t time)
{
    struct smear_axes axes[2];
    struct smear_turn turn;
    int32_t origin[3], turned[9];
    if (time == 0 || time == -(1 << 24)) {
        *out = time == 0 ? *now : *before;
        return;
    }
    smear_axes_find(&axes[0], before);
    smear_axes_find(&axes[1], now);
    smear_turn_between(&turn, &axes[0], &axes[1]);
    for (int i = 0; i < 3; i++)
        origin[i] = smear_arc_number(before->origin[i], now->origin[i], time);
    smear_turn_whole(turned, &turn, before);
    smear_turn_part(out->basis, &turn, turned, now, time, turn_angle(&turn, time));
    for (int i = 0; i < 3; i++)
        out->origin[i] = origin[i];
}

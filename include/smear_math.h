/* SPDX-License-Identifier: MIT */
/* smear_math.h - what a program needs to place things and aim a camera, in integers. Header only.
 *
 *     smear_transform pose = smear_compose(smear_move(0, 0, SMEAR_Q16(-6)), smear_rotate_y(angle));
 *     smear_camera camera = smear_perspective(SMEAR_DEGREES(50), SMEAR_Q16(0.1), 0);
 *     camera.pose = smear_look_at(smear_vec(0, SMEAR_Q16(2.5), SMEAR_Q16(6)), smear_vec(0, 0, 0), smear_vec(0, 1, 0));
 *
 *     angle += SMEAR_TURNS(1.0 / 90);                 a turn in 90 frames
 *
 * What there is.
 *     constants      SMEAR_Q16 SMEAR_Q24 SMEAR_TURNS SMEAR_DEGREES
 *     angles         smear_sin smear_cos
 *     transforms     smear_move smear_scale smear_rotate_x smear_rotate_y smear_rotate_z smear_rotate_axis
 *                    smear_from_euler smear_from_quaternion smear_compose smear_apply smear_inverse_rigid
 *     shadows        smear_shadow_on smear_blob_under
 *     cameras        smear_look_at smear_focal_from_fov smear_perspective
 *
 * What it does not. No floating point at run time, no 64-bit division, no tables, no state. The bits are equal on all
 * machines, whatever their multipliers.
 *
 * Numbers. Lengths are Q16.16 world units and entries of a basis Q8.24, as in smear.h. An angle is a uint32_t in
 * 2^-32 of a turn, so it wraps by itself; it turns counter-clockwise seen from the tip of its axis (+Y up, a camera
 * looks along its own -Z). Results that do not fit are clamped to +-(2^31 - 1).
 *
 * Errors are those against the exact result of the given integers, in steps of 2^-24, and are tested
 * (test_math_error.c). Products of two rows or columns of a rotation made here differ from 0 or 1 by less than 2.5
 * steps, 2^-22.6. Composing rotations adds half a step at each: count an angle and make the rotation anew rather
 * than turn a pose a little further in every frame. */
#ifndef SMEAR_MATH_H
#define SMEAR_MATH_H

#include "smear.h"

/* Constants, folded by the compiler; x is a literal or made of literals. They may stand in static initialisers. */
#define SMEAR_Q16(x) ((int32_t)((x) * 65536.0 + ((x) < 0 ? -0.5 : 0.5)))        /* lengths, -32768 .. 32767.9999 */
#define SMEAR_Q24(x) ((int32_t)((x) * 16777216.0 + ((x) < 0 ? -0.5 : 0.5)))     /* factors, -128 .. 127.9999 */
#define SMEAR_TURNS(x) ((uint32_t)(int64_t)((x) * 4294967296.0 + ((x) < 0 ? -0.5 : 0.5)))   /* angles of any size */
#define SMEAR_DEGREES(x) SMEAR_TURNS((x) / 360.0)

/* A place or direction. Q16.16 world units; a direction may have any length. */
typedef struct smear_vec3 {
    int32_t x, y, z;
} smear_vec3;

static inline smear_vec3 smear_vec(int32_t x, int32_t y, int32_t z)
{
    smear_vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

/* ------------------------------------------------------------------ arithmetic */

/* Names that begin with smear_math_ serve this header only. */

/* a b / 2^32, to nearest. */
static inline uint32_t smear_math_mulh(uint32_t a, uint32_t b)
{
#if SMEAR_HAS_MUL64
    return (uint32_t)(((uint64_t)a * b + 0x80000000u) >> 32);
#else
    const uint32_t ah = a >> 16, bh = b >> 16, al = a & 0xffffu, bl = b & 0xffffu;
    const uint32_t cross1 = ah * bl, cross2 = al * bh;
    const uint32_t low = (al * bl >> 16) + (cross1 & 0xffffu) + (cross2 & 0xffffu) + 0x8000u;
    return ah * bh + (cross1 >> 16) + (cross2 >> 16) + (low >> 16);
#endif
}

/* a b / 2^32, to nearest: of two q30 the product in q28. */
static inline int32_t smear_math_product(int32_t a, int32_t b)
{
    uint32_t high = smear_math_mulh((uint32_t)a, (uint32_t)b);
    if (a < 0)
        high -= (uint32_t)b;
    if (b < 0)
        high -= (uint32_t)a;
    return (int32_t)high;
}

static inline int32_t smear_math_narrow(int64_t x)
{
    return x > INT32_MAX ? INT32_MAX : x < -INT32_MAX ? -INT32_MAX : (int32_t)x;
}

/* q28 to q24, to nearest. */
static inline int32_t smear_math_q24(int32_t q28)
{
    return (q28 + 8) >> 4;
}

/* Row `r` of a basis times (x, y, z), to nearest. Terms lose 8 of 24 bits before they are added: any three fit. */
static inline int64_t smear_math_row(const int32_t r[3], int32_t x, int32_t y, int32_t z)
{
    const int64_t sum = ((int64_t)r[0] * x >> 8) + ((int64_t)r[1] * y >> 8) + ((int64_t)r[2] * z >> 8);
    return (sum + (1 << 15)) >> 16;
}

/* Sine in q30, error below 5 steps, 2^-27.6.
 *
 * Half a turn away and mirrored, every angle lies within a quarter turn, t = 0 .. 1 of it. There sin(pi/2 t) is
 * t (c0 - t^2 (c1 - t^2 (c2 - t^2 (c3 - t^2 c4)))) with c of least largest error, 2^-28.1, by Remez' exchange. Each
 * factor t^2 is in q30, so each coefficient has two bits more than the one before it: q30, q32 .. q38. */
static inline int32_t smear_math_sin(uint32_t angle)
{
    const int negative = (int)(angle >> 31);
    uint32_t t = angle & 0x7fffffffu, squared, p;
    if (t > 0x40000000u)
        t = 0x80000000u - t;
    squared = smear_math_mulh(t << 1, t << 1);
    p = 321073058u - smear_math_mulh(41457241u, squared);
    p = 1369037671u - smear_math_mulh(p, squared);
    p = 2774391505u - smear_math_mulh(p, squared);
    p = 1686629674u - smear_math_mulh(p, squared);
    p = smear_math_mulh(p << 1, t << 1);
    return negative ? -(int32_t)p : (int32_t)p;
}

static inline int32_t smear_math_cos(uint32_t angle)
{
    return smear_math_sin(angle + 0x40000000u);
}

/* Brings `count` (3 or 4) numbers of any size to a vector of length one in q30, with errors of a few steps. Returns 0,
 * and leaves v alone, where all are 0.
 *
 * A shift brings the largest to 31 bits; `squared`, the sum of squares / 2^32, then lies in [2^28, 2^32), and after a
 * shift by 2, where it is small, in [1, 4) of q30. There 1.066 - 0.152 squared is within 9 % of its 1/sqrt, and each of
 * four steps y (3 - squared y^2) / 2 squares that error. */
static inline int smear_math_normalize(int32_t *v, int count)
{
    uint32_t size[4], all = 0, squared = 0, y;
    int i, shift = 0, step;
    for (i = 0; i < count; i++) {
        size[i] = v[i] < 0 ? 0u - (uint32_t)v[i] : (uint32_t)v[i];
        all |= size[i];
    }
    if (all == 0)
        return 0;
    while (all << shift < 0x40000000u)
        shift++;
    for (i = 0; i < count; i++) {
        size[i] = all >> 31 ? size[i] >> 1 : size[i] << shift;
        squared += smear_math_mulh(size[i], size[i]);
    }
    shift = squared < 0x40000000u;
    squared <<= shift << 1;
    y = 2289217569u - smear_math_mulh(squared, 1305670058u);         /* q31 */
    for (step = 0; step < 4; step++) {
        const uint32_t one = smear_math_mulh(squared, smear_math_mulh(y, y) << 1);       /* q29 */
        y = smear_math_mulh(y, (0x60000000u - one) << 1) << 1;
    }
    for (i = 0; i < count; i++) {
        const int32_t unit = (int32_t)(smear_math_mulh(size[i], y) << shift);
        v[i] = v[i] < 0 ? -unit : unit;
    }
    return 1;
}

/* The rotation of a quaternion of length one in q30, v = x y z w. */
static inline smear_transform smear_math_rotation(const int32_t v[4])
{
    const int32_t one = 1 << 28;
    const int32_t xx = smear_math_product(v[0], v[0]), xy = smear_math_product(v[0], v[1]);
    const int32_t xz = smear_math_product(v[0], v[2]), xw = smear_math_product(v[0], v[3]);
    const int32_t yy = smear_math_product(v[1], v[1]), yz = smear_math_product(v[1], v[2]);
    const int32_t yw = smear_math_product(v[1], v[3]), zz = smear_math_product(v[2], v[2]);
    const int32_t zw = smear_math_product(v[2], v[3]);
    smear_transform t = SMEAR_IDENTITY;
    t.basis[0] = smear_math_q24(one - 2 * (yy + zz));
    t.basis[1] = smear_math_q24(2 * (xy - zw));
    t.basis[2] = smear_math_q24(2 * (xz + yw));
    t.basis[3] = smear_math_q24(2 * (xy + zw));
    t.basis[4] = smear_math_q24(one - 2 * (xx + zz));
    t.basis[5] = smear_math_q24(2 * (yz - xw));
    t.basis[6] = smear_math_q24(2 * (xz - yw));
    t.basis[7] = smear_math_q24(2 * (yz + xw));
    t.basis[8] = smear_math_q24(one - 2 * (xx + yy));
    return t;
}

/* eye - target, halved where a difference does not fit. */
static inline void smear_math_difference(int32_t out[3], smear_vec3 eye, smear_vec3 target)
{
    const int64_t x = (int64_t)eye.x - target.x, y = (int64_t)eye.y - target.y, z = (int64_t)eye.z - target.z;
    const int fits = x == (int32_t)x && y == (int32_t)y && z == (int32_t)z;
    out[0] = (int32_t)(fits ? x : x >> 1);
    out[1] = (int32_t)(fits ? y : y >> 1);
    out[2] = (int32_t)(fits ? z : z >> 1);
}

/* A camera's x, which is up x z brought to length one in q30. z has that length already, `up` any. Products are exact,
 * so x is at a right angle to z however close `up` is to it. Returns 0 where up is 0 or its sine with z below 2^-20. */
static inline int smear_math_right(int32_t out[3], smear_vec3 up, const int32_t z[3])
{
    int32_t u[3];
    int64_t cross[3];
    uint64_t all = 0;
    int i, shift = 0;
    u[0] = up.x;
    u[1] = up.y;
    u[2] = up.z;
    if (!smear_math_normalize(u, 3))
        return 0;
    cross[0] = (int64_t)u[1] * z[2] - (int64_t)u[2] * z[1];
    cross[1] = (int64_t)u[2] * z[0] - (int64_t)u[0] * z[2];
    cross[2] = (int64_t)u[0] * z[1] - (int64_t)u[1] * z[0];
    for (i = 0; i < 3; i++)
        all |= cross[i] < 0 ? 0u - (uint64_t)cross[i] : (uint64_t)cross[i];
    for (; all > INT32_MAX; all >>= 1)
        shift++;
    if (shift < 10)         /* each below 2^40 in q60 */
        return 0;
    for (i = 0; i < 3; i++)
        out[i] = (int32_t)(cross[i] >> shift);
    return smear_math_normalize(out, 3);
}

/* ------------------------------------------------------------------ angles */

/* Sine and cosine, q24: -2^24 .. 2^24. They err by less than 0.58 of a step, 2^-24.7, and are exact where they are
 * whole or a half. */
static inline int32_t smear_sin(uint32_t angle)
{
    return (smear_math_sin(angle) + 32) >> 6;
}

static inline int32_t smear_cos(uint32_t angle)
{
    return (smear_math_cos(angle) + 32) >> 6;
}

/* ------------------------------------------------------------------ transforms */

/* A translation by Q16.16 units. Exact. */
static inline smear_transform smear_move(int32_t x, int32_t y, int32_t z)
{
    smear_transform t = SMEAR_IDENTITY;
    t.origin[0] = x;
    t.origin[1] = y;
    t.origin[2] = z;
    return t;
}

/* A scale by Q8.24 factors, SMEAR_Q24(1.5). Exact. */
static inline smear_transform smear_scale(int32_t x, int32_t y, int32_t z)
{
    smear_transform t = SMEAR_IDENTITY;
    t.basis[0] = x;
    t.basis[4] = y;
    t.basis[8] = z;
    return t;
}

/* Rotations about the axes: x takes +Y towards +Z (a camera looks up), y takes +Z towards +X (a camera looks to its
 * left), z takes +X towards +Y (a camera tilts to its left). Entries err as smear_sin does. */
static inline smear_transform smear_rotate_x(uint32_t angle)
{
    smear_transform t = SMEAR_IDENTITY;
    t.basis[4] = t.basis[8] = smear_cos(angle);
    t.basis[7] = smear_sin(angle);
    t.basis[5] = -t.basis[7];
    return t;
}

static inline smear_transform smear_rotate_y(uint32_t angle)
{
    smear_transform t = SMEAR_IDENTITY;
    t.basis[0] = t.basis[8] = smear_cos(angle);
    t.basis[2] = smear_sin(angle);
    t.basis[6] = -t.basis[2];
    return t;
}

static inline smear_transform smear_rotate_z(uint32_t angle)
{
    smear_transform t = SMEAR_IDENTITY;
    t.basis[0] = t.basis[4] = smear_cos(angle);
    t.basis[3] = smear_sin(angle);
    t.basis[1] = -t.basis[3];
    return t;
}

/* A rotation from a quaternion x y z w of any length: Q15, Q30, 1/32767. All 0: the identity. Entries err by
 * less than a step. */
static inline smear_transform smear_from_quaternion(int32_t x, int32_t y, int32_t z, int32_t w)
{
    int32_t v[4];
    v[0] = x;
    v[1] = y;
    v[2] = z;
    v[3] = w;
    if (!smear_math_normalize(v, 4))
        v[3] = 1 << 30;
    return smear_math_rotation(v);
}

/* A rotation about an axis of any length: the quaternion of half the angle. An axis of 0: the identity. Entries err
 * by less than 1.2 steps. */
static inline smear_transform smear_rotate_axis(smear_vec3 axis, uint32_t angle)
{
    const int32_t sine = smear_math_sin(angle >> 1);
    int32_t v[4];
    v[0] = axis.x;
    v[1] = axis.y;
    v[2] = axis.z;
    v[3] = smear_math_cos(angle >> 1);
    if (smear_math_normalize(v, 3)) {
        v[0] = smear_math_product(v[0], sine) * 4;
        v[1] = smear_math_product(v[1], sine) * 4;
        v[2] = smear_math_product(v[2], sine) * 4;
    } else {
        v[3] = 1 << 30;
    }
    return smear_math_rotation(v);
}

/* A rotation from Euler angles: first by roll about z, then by pitch about x, then by yaw about y, all axes of the
 * world: rotate_y(yaw) rotate_x(pitch) rotate_z(roll). A camera turns left, up, and tilts to its left. Entries err by
 * less than 0.8 of a step. */
static inline smear_transform smear_from_euler(uint32_t yaw, uint32_t pitch, uint32_t roll)
{
    const int32_t cy = smear_math_cos(yaw), sy = smear_math_sin(yaw);
    const int32_t cx = smear_math_cos(pitch), sx = smear_math_sin(pitch);
    const int32_t cz = smear_math_cos(roll), sz = smear_math_sin(roll);
    const int32_t sxsz = smear_math_product(sx, sz) * 4, sxcz = smear_math_product(sx, cz) * 4;
    smear_transform t = SMEAR_IDENTITY;
    t.basis[0] = smear_math_q24(smear_math_product(cy, cz) + smear_math_product(sy, sxsz));
    t.basis[1] = smear_math_q24(smear_math_product(sy, sxcz) - smear_math_product(cy, sz));
    t.basis[2] = smear_math_q24(smear_math_product(sy, cx));
    t.basis[3] = smear_math_q24(smear_math_product(cx, sz));
    t.basis[4] = smear_math_q24(smear_math_product(cx, cz));
    t.basis[5] = -((sx + 32) >> 6);
    t.basis[6] = smear_math_q24(smear_math_product(cy, sxsz) - smear_math_product(sy, cz));
    t.basis[7] = smear_math_q24(smear_math_product(sy, sz) + smear_math_product(cy, sxcz));
    t.basis[8] = smear_math_q24(smear_math_product(cy, cx));
    return t;
}

/* Where a transform takes a point, to nearest. */
static inline smear_vec3 smear_apply(smear_transform t, smear_vec3 p)
{
    return smear_vec(smear_math_narrow(smear_math_row(t.basis, p.x, p.y, p.z) + t.origin[0]),
                     smear_math_narrow(smear_math_row(t.basis + 3, p.x, p.y, p.z) + t.origin[1]),
                     smear_math_narrow(smear_math_row(t.basis + 6, p.x, p.y, p.z) + t.origin[2]));
}

/* First b, then a: the transform that takes p to apply(a, apply(b, p)). Each entry is the exact one to nearest (but
 * for 2^-14 of a step). Where an object is placed: smear_compose(move, smear_compose(rotate, scale)); what is fixed to
 * another: smear_compose(parent, child). */
static inline smear_transform smear_compose(smear_transform a, smear_transform b)
{
    smear_transform t;
    int i, j;
    for (i = 0; i < 3; i++) {
        const int32_t *row = a.basis + 3 * i;
        for (j = 0; j < 3; j++)
            t.basis[3 * i + j] = smear_math_narrow(smear_math_row(row, b.basis[j], b.basis[3 + j], b.basis[6 + j]));
        t.origin[i] = smear_math_narrow(smear_math_row(row, b.origin[0], b.origin[1], b.origin[2]) + a.origin[i]);
    }
    return t;
}

/* What undoes a rotation and translation (no scale, no shear): the world as a camera sees it. The rotation is exact,
 * the origin to nearest. */
static inline smear_transform smear_inverse_rigid(smear_transform t)
{
    smear_transform inverse;
    int i, j;
    for (i = 0; i < 3; i++) {
        for (j = 0; j < 3; j++)
            inverse.basis[3 * i + j] = t.basis[3 * j + i];
        inverse.origin[i] = smear_math_narrow(-smear_math_row(inverse.basis + 3 * i, t.origin[0], t.origin[1],
                                                              t.origin[2]));
    }
    return inverse;
}

/* ------------------------------------------------------------------ shadows, of smear_scene.h */

/* Where the blob lies for something of that radius, 127 units at most, above the ground. */
static inline smear_transform smear_blob_under(smear_vec3 thing, int32_t ground, int32_t radius)
{
    const int32_t factor = radius > 127 * 65536 ? 127 * SMEAR_BASIS_ONE : radius * 256;
    smear_transform t = smear_scale(factor, SMEAR_BASIS_ONE, factor);
    t.origin[0] = thing.x;
    t.origin[1] = ground;
    t.origin[2] = thing.z;
    return t;
}

/* Takes every place to where its shadow falls on the plane through `point` at right angles to `normal`, in light that comes from
 * `light`. Both may have any length. A 512th of heights is left, so that the sides that light meets are the fronts. Light along the
 * plane or from below it is taken for one from two degrees above. */
static inline smear_transform smear_shadow_on(smear_vec3 point, smear_vec3 normal, smear_vec3 light)
{
    int32_t n[3], l[3], i, j;
    int32_t cosine, over, height;
    smear_transform t;
    n[0] = normal.x;
    n[1] = normal.y;
    n[2] = normal.z;
    l[0] = light.x;
    l[1] = light.y;
    l[2] = light.z;
    if (!smear_math_normalize(n, 3))
        n[1] = 1 << 30;
    if (!smear_math_normalize(l, 3))
        l[1] = 1 << 30;
    cosine = smear_math_product(n[0], l[0]) + smear_math_product(n[1], l[1]) + smear_math_product(n[2], l[2]);       /* q28 */
    if (cosine < 1 << 23)
        cosine = 1 << 23;
    over = (int32_t)(0x7fffffffu / ((uint32_t)cosine >> 13));       /* q16 of 1 / cosine: then by a step of Newton's */
    over = (int32_t)((int64_t)over * ((1 << 29) - ((int64_t)over * cosine >> 16)) >> 20);                            /* q24 */
    height = smear_math_narrow(((int64_t)n[0] * point.x + (int64_t)n[1] * point.y + (int64_t)n[2] * point.z) >> 30);
    for (i = 0; i < 3; i++) {
        int32_t along = (int32_t)((int64_t)l[i] * over >> 30);          /* q24: per unit of height above the plane */
        along -= along >> 9;
        for (j = 0; j < 3; j++)
            t.basis[3 * i + j] = (i == j ? SMEAR_BASIS_ONE : 0) - (int32_t)((int64_t)along * n[j] >> 30);
        t.origin[i] = smear_math_narrow((int64_t)along * height >> 24);
    }
    return t;
}

/* ------------------------------------------------------------------ cameras */

/* A camera's pose: at `eye`, its -Z towards `target`, its Y as near to `up` (of any length) as can be. Also places an
 * object whose front is -Z. Z errs by less than 0.6 of a step, X and Y by less than 0.8 over the sine of the angle
 * between up and view; the three are at right angles however small that is.
 *
 * Where eye and target are one, it looks along the world's -Z. Where up is 0 or lies along the view, -Z is up instead
 * (a camera that looks straight down has north on top), and where the view is along that, +Y. */
static inline smear_transform smear_look_at(smear_vec3 eye, smear_vec3 target, smear_vec3 up)
{
    smear_transform t = smear_move(eye.x, eye.y, eye.z);
    int32_t x[3], z[3];
    int i;
    smear_math_difference(z, eye, target);
    if (!smear_math_normalize(z, 3))
        z[2] = 1 << 30;
    if (!smear_math_right(x, up, z) && !smear_math_right(x, smear_vec(0, 0, -1), z))
        smear_math_right(x, smear_vec(0, 1, 0), z);
    for (i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        t.basis[3 * i] = (x[i] + 32) >> 6;
        t.basis[3 * i + 1] = smear_math_q24(smear_math_product(z[j], x[k]) - smear_math_product(z[k], x[j]));
        t.basis[3 * i + 2] = (z[i] + 32) >> 6;
    }
    return t;
}

/* smear_camera.focal of a vertical field of view: 1 / tan(fov / 2) in Q16.16. fov is above 0 and below half a turn;
 * beyond that the result is clamped to 1 .. 2^31 - 1. It errs by less than half a step of 2^-16 and, from a degree on,
 * 2^-20 of itself. */
static inline int32_t smear_focal_from_fov(uint32_t fov)
{
    const uint32_t sine = (uint32_t)smear_math_sin(fov >> 1);
    int32_t cosine = smear_math_cos(fov >> 1);
    uint32_t focal, rest;
    int bit;
    if (cosine <= 0)
        return 1;
    if (sine <= (uint32_t)cosine >> 15)
        return INT32_MAX;
    focal = (uint32_t)cosine / sine;
    rest = (uint32_t)cosine % sine;
    for (bit = 0; bit < 16; bit++) {
        rest <<= 1;
        focal = focal << 1 | (rest >= sine);
        rest -= rest >= sine ? sine : 0;
    }
    focal += rest << 1 >= sine && focal != INT32_MAX;
    return focal > 0 ? (int32_t)focal : 1;
}

/* A camera with a perspective, at the origin and looking along -Z until its pose is set. Planes are distances in
 * Q16.16, far_plane 0 for none. */
static inline smear_camera smear_perspective(uint32_t fov, int32_t near_plane, int32_t far_plane)
{
#ifdef __cplusplus
    smear_camera camera = {};
#else
    smear_camera camera = { 0 };
#endif
    camera.pose = smear_move(0, 0, 0);
    camera.focal = smear_focal_from_fov(fov);
    camera.near_plane = near_plane;
    camera.far_plane = far_plane;
    return camera;
}

#endif

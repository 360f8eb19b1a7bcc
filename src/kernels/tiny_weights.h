/* SPDX-License-Identifier: MIT */
/* tiny_weights.h - tiny triangles: their edge functions are the weights of the corners, which become depth codes. */
#ifndef SMEAR_KERNELS_TINY_WEIGHTS_H
#define SMEAR_KERNELS_TINY_WEIGHTS_H

#include "base/fixmath.h"

/* What turns edge functions into weights. */
struct tiny_scale {
    uint32_t recip;             /* q16 of 1 / normalised area, rounded down */
    int up;
};

static inline struct tiny_scale tiny_scale_make(int32_t area)
{
    int up = count_leading_zeros((uint32_t)area);
    return (struct tiny_scale){ (recip_norm((uint32_t)area << up) >> 14) - 1u, up };
}

/* Returns e / area in q16, rounded down by up to 2^-14: three weights that add up to one are never negative, so
 * what they weigh stays between its vertices. */
static inline uint32_t tiny_weight(struct tiny_scale s, int32_t e)
{
    return ((uint32_t)e << s.up >> 16) * s.recip >> 15;
}

/* Returns floor(a w / 2^16) for a weight below one. */
static inline int32_t tiny_times(int32_t a, uint32_t w)
{
#if SMEAR_HAS_MUL64
    return (int32_t)((int64_t)a * (int64_t)w >> 16);
#else
    return (a >> 16) * (int32_t)w + (int32_t)(((uint32_t)a & 0xffffu) * w >> 16);
#endif
}

/* Returns the nearest depth code (smear_depth_units) of units q11. */
static inline uint32_t tiny_code(int32_t units)
{
    return units < 32768 << 11 ? (uint32_t)(units + 0x400) >> 11
                               : ((uint32_t)units + ((32768u - 2048u) << 15) + 0x4000u) >> 15;
}

/* Returns the nearest depth code (smear_depth_units) at weights w1 and w2, from units q11. */
static inline uint32_t tiny_depth(int32_t q0, int32_t q1, int32_t q2, uint32_t w1, uint32_t w2)
{
    return tiny_code(q0 + tiny_times(q1 - q0, w1) + tiny_times(q2 - q0, w2));
}

/* Whether depths differ so little that colours may be mixed on the screen: off by at most 1/128 of their range. */
static inline bool tiny_is_even(int32_t q0, int32_t q1, int32_t q2)
{
    int32_t low = min_i32(q0, min_i32(q1, q2)), high = max_i32(q0, max_i32(q1, q2));
    return high - low <= low >> 5;
}

#endif

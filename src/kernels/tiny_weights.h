/* SPDX-License-Identifier: MIT */
/* tiny_weights.h - tiny triangles: their edge functions are the weights of the corners, which become depth codes. */
#ifndef SMEAR_KERNELS_TINY_WEIGHTS_H
#define SMEAR_KERNELS_TINY_WEIGHTS_H

#include "base/fixmath.h"
#include "kernels/kernels.h"

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

SMEAR_INLINE struct tiny_channel tiny_channel_of(uint32_t c0, uint32_t c1, uint32_t c2, uint32_t round)
{
    c0 &= 0xffffu;
    return (struct tiny_channel){ (int32_t)(c1 & 0xffffu) - (int32_t)c0, (int32_t)(c2 & 0xffffu) - (int32_t)c0, (c0 << 14) + round };
}

/* Makes red, blue and green of two words of each corner: red and green, blue. */
SMEAR_INLINE void tiny_channels(struct tiny_channel channel[3], const uint32_t *c0, const uint32_t *c1, const uint32_t *c2,
                                smear_transfer transfer)
{
    const uint32_t round = channel_round(transfer) << 6;
    channel[0] = tiny_channel_of(c0[0], c1[0], c2[0], round);
    channel[1] = tiny_channel_of(c0[1], c1[1], c2[1], round);
    channel[2] = tiny_channel_of(c0[0] >> 16, c1[0] >> 16, c2[0] >> 16, round);
}

/* Returns one channel, 8 bits of a code or 12 of linear light. */
SMEAR_INLINE uint32_t tiny_channel_at(const struct tiny_channel *c, uint32_t w1, uint32_t w2, bool linear)
{
    return (c->base + (uint32_t)(c->to1 * (int32_t)(w1 >> 2)) + (uint32_t)(c->to2 * (int32_t)(w2 >> 2))) >> (linear ? 18 : 22);
}

/* Returns the pixel at weights w1 and w2. Linear light is looked up by its floor, codes are rounded: they are the upper byte, so they are
 * at most 0xff00 and stay below 2^30. */
SMEAR_INLINE uint32_t tiny_color(const struct tiny_channel channel[3], uint32_t w1, uint32_t w2, bool linear)
{
    const uint32_t r = tiny_channel_at(&channel[0], w1, w2, linear), b = tiny_channel_at(&channel[1], w1, w2, linear),
                   g = tiny_channel_at(&channel[2], w1, w2, linear);
    return linear ? pixel_make(0, smear_srgb_encode[r], smear_srgb_encode[g], smear_srgb_encode[b]) : pixel_make(0, r, g, b);
}

/* Whether depths differ so little that colours may be mixed on the screen: off by at most 1/128 of their range. */
static inline bool tiny_is_even(int32_t q0, int32_t q1, int32_t q2)
{
    int32_t low = min_i32(q0, min_i32(q1, q2)), high = max_i32(q0, max_i32(q1, q2));
    return high - low <= low >> 5;
}

#endif

/* SPDX-License-Identifier: MIT */
/* wide_lanes.h - numbers beyond 32 bits in lanes of eight: products, and shifts that saturate. */
#ifndef SMEAR_KERNELS_WIDE_LANES_H
#define SMEAR_KERNELS_WIDE_LANES_H

#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* Products of 64 bits, by their words. */
struct product8 {
    lanes8i high;
    lanes8 low;
};

SMEAR_AVX2_INLINE struct product8 product8_of(lanes8i a, lanes8i b)
{
    const __m256i even = _mm256_mul_epi32((__m256i)a, (__m256i)b);
    const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32));
    return (struct product8){ (lanes8i)_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa),
                              (lanes8)_mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xaa) };
}

/* Returns the lower word of a product without its last `bits`, 1 .. 31; where that is not all of it `beyond` is set. */
SMEAR_AVX2_INLINE lanes8i product8_without(struct product8 p, int bits, lanes8i *beyond)
{
    const lanes8i rest = (lanes8i)((lanes8)p.high << (32 - bits) | p.low >> bits);
    *beyond |= rest >> (32 - bits) != p.high;
    return rest;
}

/* Returns scale_sat(a, shift) for |a| < 2^30 and shift of -31 .. 31; where it saturates `beyond` is set. */
SMEAR_AVX2_INLINE lanes8i lanes8i_scale(lanes8i a, lanes8i shift, lanes8i *beyond)
{
    const lanes8i up = lanes8i_max(shift, lanes8i_all(0)), down = lanes8i_max(-shift, lanes8i_all(0));
    const lanes8 half = lanes8_left(lanes8_all(1), down) >> 1;
    *beyond |= lanes8i_abs(a) > (lanes8i)lanes8_right(lanes8_all(INT32_MAX), up);
    const lanes8i sum = (lanes8i)((lanes8)a + half);
    return lanes8i_left(lanes8i_right(sum, down), up);
}

/* Returns a - b; where that has more than 32 bits `beyond` is set. */
SMEAR_AVX2_INLINE lanes8i lanes8i_less(lanes8i a, lanes8i b, lanes8i *beyond)
{
    const lanes8i rest = (lanes8i)((lanes8)a - (lanes8)b);
    *beyond |= ((a ^ b) & (a ^ rest)) < 0;
    return rest;
}
#endif

#endif

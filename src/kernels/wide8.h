/* SPDX-License-Identifier: MIT */
/* wide8.h - numbers of 64 bits of eight triangles, and what raster/setup.c makes of them: slopes of planes, to the same bits. */
#ifndef SMEAR_KERNELS_WIDE8_H
#define SMEAR_KERNELS_WIDE8_H

#include "kernels/lanes8.h"
#include "kernels/poses.h"

#if SMEAR_AVX2

/* Those of even and of odd triangles. */
struct wide8 {
    __m256i even, odd;
};

SMEAR_AVX2_INLINE struct wide8 wide8_times(lanes8i a, lanes8i b)
{
    return (struct wide8){ _mm256_mul_epi32((__m256i)a, (__m256i)b),
                           _mm256_mul_epi32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32)) };
}

SMEAR_AVX2_INLINE struct wide8 wide8_of(lanes8i a) { return wide8_times(a, lanes8i_all(1)); }

/* Returns a b - c d. */
SMEAR_AVX2_INLINE struct wide8 wide8_cross(lanes8i a, lanes8i b, lanes8i c, lanes8i d)
{
    const struct wide8 ab = wide8_times(a, b), cd = wide8_times(c, d);
    return (struct wide8){ _mm256_sub_epi64(ab.even, cd.even), _mm256_sub_epi64(ab.odd, cd.odd) };
}

/* All ones where it is negative. */
SMEAR_AVX2_INLINE lanes8i wide8_signs(const struct wide8 *a)
{
    return (lanes8i)_mm256_blend_epi32(_mm256_srli_epi64(a->even, 32), a->odd, 0xaa) >> 31;
}

SMEAR_AVX2_INLINE __m256i wide8_size(__m256i a)
{
    const __m256i sign = _mm256_cmpgt_epi64(_mm256_setzero_si256(), a);
    return _mm256_sub_epi64(_mm256_xor_si256(a, sign), sign);
}

/* A number without its sign, 62 bits: the upper and the lower 31 of them. */
struct halves8 {
    lanes8 high, low;
    lanes8i has_high;
    lanes8i zeros;                  /* leading ones of 64 bits that are not set */
    lanes8 top;                     /* the highest 31 bits from the first one on */
};

SMEAR_AVX2_INLINE struct halves8 halves8_of(__m256i even, __m256i odd)
{
    struct halves8 h;
    const __m256i high = _mm256_blend_epi32(_mm256_srli_epi64(even, 31), _mm256_slli_epi64(odd, 1), 0xaa);
    const __m256i low = _mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xaa);
    h.high = (lanes8)high & 0x7fffffffu;
    h.low = (lanes8)low & 0x7fffffffu;
    h.has_high = (lanes8i)h.high > 0;
    const lanes8 first = lanes8_choose(h.has_high, h.high, h.low);
    const lanes8i zeros = lanes8i_zeros((lanes8i)first);
    h.zeros = zeros + lanes8i_choose(h.has_high, lanes8i_all(1), lanes8i_all(32));
    h.top = lanes8_left(first, zeros - 1) | ((lanes8)h.has_high & lanes8_right(h.low, 32 - zeros));
    return h;
}

/* Returns scale_sat(g, shift) for g that is not negative. */
SMEAR_AVX2_INLINE lanes8i scaled8(lanes8i g, lanes8i shift)
{
    const lanes8i up = lanes8i_max(shift, lanes8i_all(0)), down = lanes8i_max(-shift, lanes8i_all(0));
    const lanes8i most = lanes8i_all(INT32_MAX);
    const lanes8i rounded = lanes8i_right(g, down) + (lanes8i)(lanes8_right((lanes8)g, down - 1) & 1u);
    return lanes8i_choose(rounded > lanes8i_right(most, up), most, lanes8i_left(rounded, up));
}

/* gradient() of setup.c */
SMEAR_AVX2_INLINE lanes8i gradient8(struct wide8 n, lanes8i recip, lanes8i zeros)
{
    const struct halves8 h = halves8_of(wide8_size(n.even), wide8_size(n.odd));
    const lanes8i shift = lanes8i_max(lanes8i_min(zeros - h.zeros - 20, lanes8i_all(31)), lanes8i_all(-31));
    const lanes8i sign = wide8_signs(&n);
    return (scaled8(lanes8i_mulh((lanes8i)h.top, recip), shift) ^ sign) - sign;
}

/* recip_norm_precise */
SMEAR_AVX2_INLINE lanes8 recip_precise8(lanes8 m)
{
    const lanes8 r = lanes8_recip_norm(m);
    const lanes8i error = (lanes8i)((1u << 29) - lanes8_mulh(m, r));
    return r + (lanes8)((lanes8i)((r >> 12) * (lanes8)error) >> 17);
}

/* part_of() of setup.c: floor(slope part / 2^8). */
SMEAR_AVX2_INLINE lanes8i part8(lanes8i slope, lanes8i part)
{
    return (slope >> 8) * part + ((slope & 255) * part >> 8);
}

/* Vertex i of all triangles. */
struct corner8 {
    lanes8i x, y, depth;
};

SMEAR_AVX2_INLINE struct corner8 corner8_of(const struct poses *p, int i)
{
    return (struct corner8){ lanes8i_load(p->word[i][0]), lanes8i_load(p->word[i][1]), lanes8i_load(p->word[i][2]) };
}

#endif
#endif

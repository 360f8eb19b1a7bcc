/* SPDX-License-Identifier: MIT */
/* words8.h - eight words at once by AVX2: arithmetic, look-ups in tables and planes of narrower elements, and what base/fixmath.h
 * has for one number, to the same bits. For variants of whole loops: avx2.h. */
#ifndef SMEAR_KERNELS_WORDS8_H
#define SMEAR_KERNELS_WORDS8_H

#include "base/fixmath.h"
#include "base/noise.h"
#include "kernels/avx2.h"

#if SMEAR_AVX2

/* They are written to memory and read from it by w8_load and w8_store alone. */
typedef uint32_t smear_w8u __attribute__((vector_size(32)));
typedef int32_t smear_w8i __attribute__((vector_size(32)));

#define W8_FUNCTION static inline __attribute__((always_inline)) SMEAR_AVX2_FUNCTION

W8_FUNCTION smear_w8u w8u_all(uint32_t a) { return (smear_w8u)_mm256_set1_epi32((int)a); }
W8_FUNCTION smear_w8i w8i_all(int32_t a) { return (smear_w8i)_mm256_set1_epi32(a); }
W8_FUNCTION smear_w8i w8i_steps(void) { return (smear_w8i){ 0, 1, 2, 3, 4, 5, 6, 7 }; }
W8_FUNCTION smear_w8i w8i_load(const void *p) { return (smear_w8i)_mm256_loadu_si256((const __m256i *)p); }
W8_FUNCTION smear_w8u w8u_load(const void *p) { return (smear_w8u)_mm256_loadu_si256((const __m256i *)p); }
W8_FUNCTION void w8_store(void *p, smear_w8u a) { _mm256_storeu_si256((__m256i *)p, (__m256i)a); }

/* Loads eight halves. */
W8_FUNCTION smear_w8u w8u_load_halves(const void *p)
{
    return (smear_w8u)_mm256_cvtepu16_epi32(_mm_loadu_si128((const __m128i *)p));
}

W8_FUNCTION smear_w8i w8i_min(smear_w8i a, smear_w8i b) { return (smear_w8i)_mm256_min_epi32((__m256i)a, (__m256i)b); }
W8_FUNCTION smear_w8i w8i_max(smear_w8i a, smear_w8i b) { return (smear_w8i)_mm256_max_epi32((__m256i)a, (__m256i)b); }

/* Chooses per element: a where `which` is all ones, b where it is 0. */
W8_FUNCTION smear_w8i w8i_choose(smear_w8i which, smear_w8i a, smear_w8i b)
{
    return (smear_w8i)_mm256_blendv_epi8((__m256i)b, (__m256i)a, (__m256i)which);
}

W8_FUNCTION smear_w8u w8u_choose(smear_w8i which, smear_w8u a, smear_w8u b)
{
    return (smear_w8u)_mm256_blendv_epi8((__m256i)b, (__m256i)a, (__m256i)which);
}

W8_FUNCTION bool w8_any(smear_w8i a) { return !_mm256_testz_si256((__m256i)a, (__m256i)a); }

/* Whether a and b are equal, element by element. */
W8_FUNCTION bool w8_equal(smear_w8u a, smear_w8u b)
{
    return !w8_any((smear_w8i)(a ^ b));
}

/* Shifts by 0 .. 31 each; from 32 on nothing is left. */
W8_FUNCTION smear_w8u w8u_left(smear_w8u a, smear_w8i bits) { return (smear_w8u)_mm256_sllv_epi32((__m256i)a, (__m256i)bits); }
W8_FUNCTION smear_w8u w8u_right(smear_w8u a, smear_w8i bits) { return (smear_w8u)_mm256_srlv_epi32((__m256i)a, (__m256i)bits); }

/* Returns floor(a b / 2^32). */
W8_FUNCTION smear_w8u w8u_mulh(smear_w8u a, smear_w8u b)
{
    const __m256i even = _mm256_mul_epu32((__m256i)a, (__m256i)b);
    const __m256i odd = _mm256_mul_epu32(_mm256_srli_epi64((__m256i)a, 32), _mm256_srli_epi64((__m256i)b, 32));
    return (smear_w8u)_mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xaa);
}

/* Returns a.x b.x + a.y b.y of pairs of signed halves. */
W8_FUNCTION smear_w8i w8i_dot(smear_w8u a, smear_w8u b) { return (smear_w8i)_mm256_madd_epi16((__m256i)a, (__m256i)b); }

/* Takes the lower halves of a, beside those of b as the upper ones; and of their upper halves. */
W8_FUNCTION smear_w8u w8u_low_halves(smear_w8u a, smear_w8u b)
{
    return (smear_w8u)_mm256_blend_epi16((__m256i)a, (__m256i)(b << 16), 0xaa);
}

W8_FUNCTION smear_w8u w8u_high_halves(smear_w8u a, smear_w8u b)
{
    return (smear_w8u)_mm256_blend_epi16((__m256i)(a >> 16), (__m256i)b, 0xaa);
}

/* ------------------------------------------------------------------ look-ups */

/* Reads words; indices are of either sign. */
W8_FUNCTION smear_w8u w8u_gather(const void *words, smear_w8i at)
{
    return (smear_w8u)_mm256_i32gather_epi32((const int *)words, (__m256i)at, 4);
}

/* Reads halves before which there is another one: the half lies in the upper part of each word. */
W8_FUNCTION smear_w8u w8u_gather_upper(const void *halves, smear_w8i at)
{
    return (smear_w8u)_mm256_i32gather_epi32((const int *)((const char *)halves - 2), (__m256i)at, 2);
}

/* The same with indices from 0 on of an array of two halves or more: nothing before or behind it is read. */
W8_FUNCTION smear_w8u w8u_gather_upper_from_0(const void *halves, smear_w8i at)
{
    const smear_w8i first = at == w8i_all(0);
    return w8u_left(w8u_gather_upper(halves, at - first), (smear_w8i)((smear_w8u)first & 16u));
}

/* Reads halves of a table of an even number of them. */
W8_FUNCTION smear_w8u w8u_of_halves(const void *table, smear_w8u at)
{
    return w8u_right(w8u_gather(table, (smear_w8i)(at >> 1)), (smear_w8i)(at << 4 & 16u)) & 0xffffu;
}

/* Reads bytes of a table of a multiple of four. */
W8_FUNCTION smear_w8u w8u_of_bytes(const void *table, smear_w8u at)
{
    return w8u_right(w8u_gather(table, (smear_w8i)(at >> 2)), (smear_w8i)(at << 3 & 24u)) & 0xffu;
}

W8_FUNCTION smear_w8i w8i_of_bytes(const void *table, smear_w8u at)
{
    return (smear_w8i)w8u_left(w8u_gather(table, (smear_w8i)(at >> 2)), (smear_w8i)(~at << 3 & 24u)) >> 24;
}

/* ------------------------------------------------------------------ fixmath.h */

/* Returns the place of the highest bit of x < 2^16; 0 for 0 as for 1. */
W8_FUNCTION smear_w8i w8i_log2(smear_w8u x)
{
    const __m256i low = _mm256_setr_epi8(0, 0, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3, 3, 3, 0, 0, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 3,
                                         3, 3, 3);
    const __m256i high = _mm256_setr_epi8(0, 4, 5, 5, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7, 7, 0, 4, 5, 5, 6, 6, 6, 6, 7, 7, 7, 7,
                                          7, 7, 7, 7);
    const smear_w8i eight = ((smear_w8i)x > 255) & 8;
    const smear_w8u byte = w8u_right(x, eight);
    const __m256i l = _mm256_shuffle_epi8(low, (__m256i)(byte & 15u)), h = _mm256_shuffle_epi8(high, (__m256i)(byte >> 4));
    return (smear_w8i)_mm256_max_epu8(l, h) + eight;
}

/* Returns recip_norm(m). */
W8_FUNCTION smear_w8u w8u_recip_norm(smear_w8u m)
{
    const smear_w8u r = w8u_of_halves(smear_recip_seed, m >> 22 & 511u);
    const smear_w8i error = (smear_w8i)(w8u_all(0x80000000u) - (m >> 11) * r);
    return (r << 19) + (smear_w8u)((smear_w8i)(r * (smear_w8u)(error >> 4)) >> 8);
}

/* Returns sqrt_q3(x) for x < 2^20. */
W8_FUNCTION smear_w8u w8u_sqrt_q3(smear_w8u x)
{
    const smear_w8i a = (smear_w8i)x;
    const smear_w8i shift = -((a >= 1 << 10) + (a >= 1 << 12) + (a >= 1 << 14) + (a >= 1 << 16) + (a >= 1 << 18));
    return w8u_left(w8u_of_bytes(smear_sqrt_q3, w8u_right(x, shift + shift)), shift);
}

/* Returns noise_of(inner). */
W8_FUNCTION smear_w8u w8u_noise_of(smear_w8u inner)
{
    return (inner * 53u - ((inner >> 16) * 35822u >> 5)) >> 16;
}

#endif
#endif

/* SPDX-License-Identifier: MIT */
/* lanes8.h - eight words, or sixteen halves, in the lanes of AVX2, for variants of sums and pixels (avx2.h). */
#ifndef SMEAR_KERNELS_LANES8_H
#define SMEAR_KERNELS_LANES8_H

#include "kernels/avx2.h"

#if SMEAR_AVX2
#include "base/tables.h"

typedef uint32_t lanes8 __attribute__((vector_size(32)));
typedef int32_t lanes8i __attribute__((vector_size(32)));

static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_load(const uint32_t *p)
{
    return (lanes8)_mm256_loadu_si256((const __m256i *)(const void *)p);
}

static inline SMEAR_AVX2_FUNCTION void lanes8_store(uint32_t *p, lanes8 a)
{
    _mm256_storeu_si256((__m256i *)(void *)p, (__m256i)a);
}

/* Stores the elements whose mask has its highest bit set. */
static inline SMEAR_AVX2_FUNCTION void lanes8_store_some(uint32_t *p, lanes8 a, lanes8 mask)
{
    _mm256_maskstore_epi32((int *)(void *)p, (__m256i)mask, (__m256i)a);
}

static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_all(uint32_t a)
{
    return (lanes8)_mm256_set1_epi32((int)a);
}

static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_numbers(void)
{
    return (lanes8)_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
}

/* Whether any bit is set. */
static inline SMEAR_AVX2_FUNCTION bool lanes8_any(lanes8 a) { return _mm256_testz_si256((__m256i)a, (__m256i)a) == 0; }

/* Whether all bits are set. */
static inline SMEAR_AVX2_FUNCTION bool lanes8_all_set(lanes8 a)
{
    return _mm256_testc_si256((__m256i)a, _mm256_set1_epi32(-1)) != 0;
}

/* Takes the elements of a where the mask is set, else those of b. */
static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_choose(lanes8i mask, lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_blendv_epi8((__m256i)b, (__m256i)a, (__m256i)mask);
}

/* Multiply halves: a b modulo 2^16, a b / 2^16. */
static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_mul16(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_mullo_epi16((__m256i)a, (__m256i)b);
}

static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_mulh16(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_mulhi_epu16((__m256i)a, (__m256i)b);
}

/* Takes the means of halves, rounded up. */
static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_mean16(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_avg_epu16((__m256i)a, (__m256i)b);
}

static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_min16(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_min_epu16((__m256i)a, (__m256i)b);
}

static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_max16(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_max_epu16((__m256i)a, (__m256i)b);
}

/* Eight halves as words. */
static inline SMEAR_AVX2_FUNCTION lanes8i lanes8_of_u16(const uint16_t *p)
{
    return (lanes8i)_mm256_cvtepu16_epi32(_mm_loadu_si128((const __m128i *)(const void *)p));
}

/* The numbers of the first four and the last four of n = 4 .. 8 pixels; and how these are loaded and stored. */
static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_numbers_few(int32_t n)
{
    const __m256i last = _mm256_inserti128_si256(_mm256_setzero_si256(), _mm_set1_epi32(n - 4), 1);
    return (lanes8)_mm256_add_epi32(_mm256_setr_epi32(0, 1, 2, 3, 0, 1, 2, 3), last);
}

static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_load_few(const uint32_t *p, int32_t n)
{
    return (lanes8)_mm256_inserti128_si256(_mm256_castsi128_si256((__m128i)v4u_load(p)), (__m128i)v4u_load(p + n - 4), 1);
}

static inline SMEAR_AVX2_FUNCTION void lanes8_store_few(uint32_t *p, lanes8 a, int32_t n)
{
    v4u_store(p, (smear_v4u)_mm256_castsi256_si128((__m256i)a));
    v4u_store(p + n - 4, (smear_v4u)_mm256_extracti128_si256((__m256i)a, 1));
}

static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_mul32(lanes8 a, lanes8 b)
{
    return (lanes8)_mm256_mullo_epi32((__m256i)a, (__m256i)b);
}

/* first + number step */
static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_ramp(uint32_t first, uint32_t step, lanes8 numbers)
{
    return lanes8_all(first) + lanes8_mul32(lanes8_all(step), numbers);
}

/* Looks linear light 0 .. 4095 up in smear_srgb_encode: words are gathered, so that none lies beyond the table. */
static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_encode(lanes8 light)
{
    const __m256i words = _mm256_i32gather_epi32((const int *)(const void *)smear_srgb_encode, (__m256i)(light >> 2), 4);
    return (lanes8)_mm256_srlv_epi32(words, (__m256i)(light << 3 & 24u)) & 255u;
}

/* Looks codes up in smear_srgb_decode, likewise. */
static inline SMEAR_AVX2_FUNCTION lanes8 lanes8_decode(lanes8 code)
{
    const __m256i words = _mm256_i32gather_epi32((const int *)(const void *)smear_srgb_decode, (__m256i)(code >> 1), 4);
    return (lanes8)_mm256_srlv_epi32(words, (__m256i)(code << 4 & 16u)) & 0xffffu;
}
#endif

#endif

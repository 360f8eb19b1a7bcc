/* SPDX-License-Identifier: MIT */
/* vector.h - four words or eight halves at once, where the compiler and the core have them: what vector variants of
 * kernels are written in, each of which gives the same bits as its scalar reference. */
#ifndef SMEAR_VECTOR_H
#define SMEAR_VECTOR_H

#include "base/base.h"

#if SMEAR_VECTORS && defined(__SSE2__)
#include <emmintrin.h>
#endif

#if SMEAR_VECTORS
typedef uint32_t smear_v4u __attribute__((vector_size(16)));
typedef int32_t smear_v4i __attribute__((vector_size(16)));
typedef int16_t smear_v8i __attribute__((vector_size(16)));
typedef uint16_t smear_v8u __attribute__((vector_size(16)));
typedef uint64_t smear_v2u __attribute__((vector_size(16)));

static inline smear_v4u v4u_load(const uint32_t *p)
{
    smear_v4u v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}

static inline void v4u_store(uint32_t *p, smear_v4u v) { __builtin_memcpy(p, &v, sizeof v); }

static inline smear_v8i v8i_load(const uint16_t *p)
{
    smear_v8i v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}

/* Loads four halves; the others are 0. */
static inline smear_v8i v4_of_8i_load(const uint16_t *p)
{
    smear_v8i v = { 0, 0, 0, 0, 0, 0, 0, 0 };
    __builtin_memcpy(&v, p, sizeof v / 2);
    return v;
}

static inline bool v4u_any(smear_v4u a)
{
    const smear_v2u half = (smear_v2u)a;
    return (half[0] | half[1]) != 0;
}

static inline smear_v4i v4i_of_u16(const uint16_t *p)
{
#ifdef __SSE2__
    return (smear_v4i)_mm_unpacklo_epi16((__m128i)v4_of_8i_load(p), _mm_setzero_si128());
#else
    return (smear_v4i){ p[0], p[1], p[2], p[3] };
#endif
}

/* Chooses per element: a where `which` is all ones, b where it is 0. */
static inline smear_v4u v4u_choose(smear_v4i which, smear_v4u a, smear_v4u b) { return (a & (smear_v4u)which) | (b & ~(smear_v4u)which); }

static inline smear_v8i v8i_all(int16_t a) { return (smear_v8i){ a, a, a, a, a, a, a, a }; }

/* Chooses per element: a where `which` is all ones, b where it is 0. */
static inline smear_v8i v8i_choose(smear_v8i which, smear_v8i a, smear_v8i b) { return (a & which) | (b & ~which); }

static inline smear_v8i v8i_min(smear_v8i a, smear_v8i b)
{
#ifdef __SSE2__
    return (smear_v8i)_mm_min_epi16((__m128i)a, (__m128i)b);
#else
    return v8i_choose((smear_v8i)(a < b), a, b);
#endif
}

static inline smear_v8i v8i_max(smear_v8i a, smear_v8i b)
{
#ifdef __SSE2__
    return (smear_v8i)_mm_max_epi16((__m128i)a, (__m128i)b);
#else
    return v8i_choose((smear_v8i)(a < b), b, a);
#endif
}

static inline void v8i_store(uint16_t *p, smear_v8i v) { __builtin_memcpy(p, &v, sizeof v); }

/* Takes the upper halves of the words of a, then of b. */
static inline smear_v8i v8i_upper(smear_v4u a, smear_v4u b)
{
#ifdef __SSE2__
    return (smear_v8i)_mm_packs_epi32(_mm_srai_epi32((__m128i)a, 16), _mm_srai_epi32((__m128i)b, 16));
#else
    const smear_v8i x = (smear_v8i)a, y = (smear_v8i)b;
    return (smear_v8i){ x[1], x[3], x[5], x[7], y[1], y[3], y[5], y[7] };
#endif
}

/* Takes each of elements 0 .. 3 twice; v4i_twice_high each of 4 .. 7. */
static inline smear_v4i v4i_twice_low(smear_v8i a) { return (smear_v4i)(smear_v8i){ a[0], a[0], a[1], a[1], a[2], a[2], a[3], a[3] }; }
static inline smear_v4i v4i_twice_high(smear_v8i a) { return (smear_v4i)(smear_v8i){ a[4], a[4], a[5], a[5], a[6], a[6], a[7], a[7] }; }

/* Multiplies 16-bit halves: a b modulo 2^16; v4u_mulh16 a b / 2^16. */
static inline smear_v4u v4u_mul16(smear_v4u a, smear_v4u b) { return (smear_v4u)((smear_v8u)a * (smear_v8u)b); }

static inline smear_v4u v4u_mulh16(smear_v4u a, smear_v4u b)
{
#ifdef __SSE2__
    return (smear_v4u)_mm_mulhi_epu16((__m128i)a, (__m128i)b);
#else
    smear_v4u low = (a & 0xffffu) * (b & 0xffffu) >> 16, high = (a >> 16) * (b >> 16) & 0xffff0000u;
    return low | high;
#endif
}

static inline smear_v4u v4u_all(uint32_t a) { return (smear_v4u){ a, a, a, a }; }
static inline smear_v4i v4i_all(int32_t a) { return (smear_v4i){ a, a, a, a }; }

static inline smear_v4i v4i_min(smear_v4i a, smear_v4i b) { return (smear_v4i)v4u_choose(a < b, (smear_v4u)a, (smear_v4u)b); }
static inline smear_v4i v4i_max(smear_v4i a, smear_v4i b) { return (smear_v4i)v4u_choose(a < b, (smear_v4u)b, (smear_v4u)a); }

/* Takes the highest bit of each element: that of element 0 is bit 0. */
static inline uint32_t v4i_signs(smear_v4i a)
{
#ifdef __SSE2__
    return (uint32_t)_mm_movemask_ps(_mm_castsi128_ps((__m128i)a));
#else
    const smear_v4u sign = (smear_v4u)a >> 31;
    return sign[0] | sign[1] << 1 | sign[2] << 2 | sign[3] << 3;
#endif
}

static inline smear_v4i v4i_load(const int32_t *p) { return (smear_v4i)v4u_load((const uint32_t *)p); }

/* Shuffles, as their results say. */
static inline smear_v4i v4i_spread(smear_v4i a, int i) { return (smear_v4i){ a[i], a[i], a[i], a[i] }; }
static inline smear_v4i v4i_turned(smear_v4i a) { return (smear_v4i){ a[2], a[3], a[0], a[1] }; }
static inline smear_v4i v4i_low(smear_v4i a, smear_v4i b) { return (smear_v4i){ a[0], b[0], a[1], b[1] }; }
static inline smear_v4i v4i_high(smear_v4i a, smear_v4i b) { return (smear_v4i){ a[2], b[2], a[3], b[3] }; }
static inline smear_v4i v4i_low_pairs(smear_v4i a, smear_v4i b) { return (smear_v4i){ a[0], a[1], b[0], b[1] }; }
static inline smear_v4i v4i_evens(smear_v4i a, smear_v4i b) { return (smear_v4i){ a[0], a[2], b[0], b[2] }; }
static inline smear_v4i v4i_high_pairs(smear_v4i a, smear_v4i b) { return (smear_v4i){ a[2], a[3], b[2], b[3] }; }
static inline smear_v4i v4i_lasts(smear_v4i a, smear_v4i b, smear_v4i c, smear_v4i d)
{
    return v4i_high_pairs(v4i_high(a, b), v4i_high(c, d));
}
static inline smear_v8i v8i_uppers(smear_v8i a) { return (smear_v8i){ a[1], a[3], a[1], a[3], a[4], a[5], a[6], a[7] }; }

/* Multiplies elements 0 and 2, modulo 2^32; what elements 1 and 3 become is of no use. */
static inline smear_v4i v4i_even(smear_v4i a, smear_v4i b)
{
#ifdef __SSE2__
    return (smear_v4i)_mm_mul_epu32((__m128i)a, (__m128i)b);
#else
    return (smear_v4i)((smear_v4u)a * (smear_v4u)b);
#endif
}

/* Loads pairs of halves, each from an address of its own. */
static inline smear_v8i v8i_of_pairs(const int16_t *a, const int16_t *b, const int16_t *c, const int16_t *d)
{
    uint32_t pair[4];
    __builtin_memcpy(&pair[0], a, 4);
    __builtin_memcpy(&pair[1], b, 4);
    __builtin_memcpy(&pair[2], c, 4);
    __builtin_memcpy(&pair[3], d, 4);
    return (smear_v8i)(smear_v4u){ pair[0], pair[1], pair[2], pair[3] };
}

/* Multiplies halves and adds the products of each pair: exact unless all four are -2^15. */
static inline smear_v4i v8i_dot(smear_v8i a, smear_v8i b)
{
#ifdef __SSE2__
    return (smear_v4i)_mm_madd_epi16((__m128i)a, (__m128i)b);
#else
    const smear_v4i x = (smear_v4i)a, y = (smear_v4i)b;
    return (x << 16 >> 16) * (y << 16 >> 16) + (x >> 16) * (y >> 16);
#endif
}

/* Returns floor(a b / 2^32) for b >= 0. */
static inline smear_v4i v4i_mulh(smear_v4i a, smear_v4i b)
{
#ifdef __SSE2__
    const __m128i x = (__m128i)a, y = (__m128i)b;
    const __m128i even = _mm_srli_epi64(_mm_mul_epu32(x, y), 32);
    const __m128i odd = _mm_mul_epu32(_mm_srli_epi64(x, 32), _mm_srli_epi64(y, 32));
    const __m128i high = _mm_or_si128(even, _mm_and_si128(odd, _mm_set_epi32(-1, 0, -1, 0)));
    return (smear_v4i)_mm_sub_epi32(high, _mm_and_si128(_mm_srai_epi32(x, 31), y));
#else
    smear_v4i high;
    for (int i = 0; i < 4; i++)
        high[i] = (int32_t)((int64_t)a[i] * b[i] >> 32);
    return high;
#endif
}

/* Narrows words to halves that saturate: those of a, then those of b. */
static inline smear_v8i v4i_narrow(smear_v4i a, smear_v4i b)
{
#ifdef __SSE2__
    return (smear_v8i)_mm_packs_epi32((__m128i)a, (__m128i)b);
#else
    const smear_v4i least = v4i_all(INT16_MIN), most = v4i_all(INT16_MAX);
    const smear_v8i x = (smear_v8i)v4i_max(v4i_min(a, most), least), y = (smear_v8i)v4i_max(v4i_min(b, most), least);
    return (smear_v8i){ x[0], x[2], x[4], x[6], y[0], y[2], y[4], y[6] };
#endif
}

/* Makes words of elements 0 and 4, 1 and 5, 2 and 6, 3 and 7: the first of them in the lower half. */
static inline smear_v4u v8i_pairs(smear_v8i a)
{
#ifdef __SSE2__
    return (smear_v4u)_mm_unpacklo_epi16((__m128i)a, _mm_srli_si128((__m128i)a, 8));
#else
    return (smear_v4u)(smear_v8i){ a[0], a[4], a[1], a[5], a[2], a[6], a[3], a[7] };
#endif
}

/* Stores element i of each of four vectors one after the other, for i = 0 .. 3. */
static inline void v4i_store_columns(int32_t out[16], smear_v4i a, smear_v4i b, smear_v4i c, smear_v4i d)
{
    const smear_v4i ab = v4i_low(a, b), cd = v4i_low(c, d), AB = v4i_high(a, b), CD = v4i_high(c, d);
    v4u_store((uint32_t *)out, (smear_v4u)v4i_low_pairs(ab, cd));
    v4u_store((uint32_t *)out + 4, (smear_v4u)v4i_high_pairs(ab, cd));
    v4u_store((uint32_t *)out + 8, (smear_v4u)v4i_low_pairs(AB, CD));
    v4u_store((uint32_t *)out + 12, (smear_v4u)v4i_high_pairs(AB, CD));
}

/* Returns what is left of halves without a sign where b is taken away, 0 at least. */
static inline smear_v8u v8u_less(smear_v8u a, smear_v8u b)
{
#ifdef __SSE2__
    return (smear_v8u)_mm_subs_epu16((__m128i)a, (__m128i)b);
#else
    return (a - b) & (smear_v8u)(a > b);
#endif
}

/* Whether all bits are set, of masks that are all ones or 0. */
static inline bool v4u_all_set(smear_v4u a)
{
#ifdef __SSE2__
    return _mm_movemask_epi8((__m128i)a) == 0xffff;
#else
    return !v4u_any(~a);
#endif
}

/* Shifts 16-bit halves. */
static inline smear_v4u v4u_right16(smear_v4u a, int bits) { return (smear_v4u)((smear_v8u)a >> bits); }
static inline smear_v4u v4u_left16(smear_v4u a, int bits) { return (smear_v4u)((smear_v8u)a << bits); }

/* Takes the means of 16-bit halves, rounded up. */
static inline smear_v4u v4u_mean16(smear_v4u a, smear_v4u b)
{
#ifdef __SSE2__
    return (smear_v4u)_mm_avg_epu16((__m128i)a, (__m128i)b);
#else
    return (a | b) - ((a ^ b) >> 1 & 0x7fff7fffu);
#endif
}

/* And of bytes. */
static inline smear_v4u v4u_mean8(smear_v4u a, smear_v4u b)
{
#ifdef __SSE2__
    return (smear_v4u)_mm_avg_epu8((__m128i)a, (__m128i)b);
#else
    return (a | b) - ((a ^ b) >> 1 & 0x7f7f7f7fu);
#endif
}
#endif

#endif

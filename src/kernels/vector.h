/* SPDX-License-Identifier: MIT */
/* vector.h - four words or eight halves at once, where the compiler and the core have them: what vector variants of
 * kernels are written in, each of which gives the same bits as its scalar reference. */
#ifndef SMEAR_VECTOR_H
#define SMEAR_VECTOR_H

#include "base/base.h"

#ifndef SMEAR_VECTORS
#if defined(__GNUC__) && (defined(__SSE2__) || defined(__ARM_NEON) || defined(__wasm_simd128__))
#define SMEAR_VECTORS 1
#else
#define SMEAR_VECTORS 0
#endif
#endif

#if SMEAR_VECTORS && defined(__SSE2__)
#include <emmintrin.h>
#endif

#if SMEAR_VECTORS
typedef uint32_t smear_v4u __attribute__((vector_size(16)));

static inline smear_v4u v4u_load(const uint32_t *p)
{
    smear_v4u v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
}

static inline void v4u_store(uint32_t *p, smear_v4u v)
{
    __builtin_memcpy(p, &v, sizeof v);
}

typedef int32_t smear_v4i __attribute__((vector_size(16)));
typedef int16_t smear_v8i __attribute__((vector_size(16)));

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
    typedef uint64_t v2u __attribute__((vector_size(16)));
    const v2u half = (v2u)a;
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
static inline smear_v4u v4u_choose(smear_v4i which, smear_v4u a, smear_v4u b)
{
    return (a & (smear_v4u)which) | (b & ~(smear_v4u)which);
}

static inline smear_v8i v8i_all(int16_t a)
{
    return (smear_v8i){ a, a, a, a, a, a, a, a };
}

/* Chooses per element: a where `which` is all ones, b where it is 0. */
static inline smear_v8i v8i_choose(smear_v8i which, smear_v8i a, smear_v8i b)
{
    return (a & which) | (b & ~which);
}

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

static inline void v8i_store(uint16_t *p, smear_v8i v)
{
    __builtin_memcpy(p, &v, sizeof v);
}

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
static inline smear_v4i v4i_twice_low(smear_v8i a)
{
#ifdef __SSE2__
    return (smear_v4i)_mm_unpacklo_epi16((__m128i)a, (__m128i)a);
#else
    return (smear_v4i)(smear_v8i){ a[0], a[0], a[1], a[1], a[2], a[2], a[3], a[3] };
#endif
}

static inline smear_v4i v4i_twice_high(smear_v8i a)
{
#ifdef __SSE2__
    return (smear_v4i)_mm_unpackhi_epi16((__m128i)a, (__m128i)a);
#else
    return (smear_v4i)(smear_v8i){ a[4], a[4], a[5], a[5], a[6], a[6], a[7], a[7] };
#endif
}

/* Multiplies 16-bit halves: a b modulo 2^16; v4u_mulh16 a b / 2^16. */
static inline smear_v4u v4u_mul16(smear_v4u a, smear_v4u b)
{
    typedef uint16_t v8 __attribute__((vector_size(16)));
    return (smear_v4u)((v8)a * (v8)b);
}

static inline smear_v4u v4u_mulh16(smear_v4u a, smear_v4u b)
{
#ifdef __SSE2__
    return (smear_v4u)_mm_mulhi_epu16((__m128i)a, (__m128i)b);
#else
    smear_v4u low = (a & 0xffffu) * (b & 0xffffu) >> 16, high = (a >> 16) * (b >> 16) & 0xffff0000u;
    return low | high;
#endif
}
#endif

#endif

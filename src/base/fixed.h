/* SPDX-License-Identifier: MIT */
/* fixed.h - fixed-point types and the only helpers that narrow, saturate, wrap or take high products.
 *
 * A type is storage plus fraction bits: i32q16 holds value x 2^16. A helper without a suffix cannot overflow for the
 * stated ranges (a CHECK=1 build asserts it) and rounds toward minus infinity. One with _sat clamps; with _wrap,
 * overflow is meant and computed through unsigned. */
#ifndef SMEAR_FIXED_H
#define SMEAR_FIXED_H

#include "base/base.h"

typedef int32_t i32q8;      /* [-2^23, 2^23)      step 1/256 px      screen positions (guard band: 4096 px) */
typedef int32_t i32q11;     /* [-2^20, 2^20)      step 1/2048        depth units, 1/w */
typedef int32_t i32q16;     /* [-32768, 32768)    step 1/65536       world units, colours, texels */
typedef int32_t i32q24;     /* [-128, 128)        step 2^-24         basis of a transform */
typedef int64_t i64q32;     /* [-2^31, 2^31)      step 2^-32         composed transforms, once per draw */
typedef uint16_t u16lin;    /* [0, 1]             step 1/65535       linear light */
typedef uint8_t u8code;     /* [0, 255]                              sRGB-encoded light */

/* Sums and products that may wrap: the planes of a triangle are exact modulo 2^32. */
static inline int32_t add_wrap(int32_t a, int32_t b) { return (int32_t)((uint32_t)a + (uint32_t)b); }
static inline int32_t sub_wrap(int32_t a, int32_t b) { return (int32_t)((uint32_t)a - (uint32_t)b); }
static inline int32_t mul_wrap(int32_t a, int32_t b) { return (int32_t)((uint32_t)a * (uint32_t)b); }
static inline int32_t shl_wrap(int32_t a, int shift) { return (int32_t)((uint32_t)a << shift); }

#if SMEAR_COPY_ELSEWHERE
int32_t mulh_i32(int32_t a, int32_t b);
uint32_t mulh_u32(uint32_t a, uint32_t b);
int32_t scale_sat(int32_t a, int shift);
int32_t narrow_sat(int64_t a);
int64_t mul_wide(int32_t a, int32_t b);
int64_t cross_wide(int32_t ax, int32_t ay, int32_t bx, int32_t by);
int64_t dot_wide(const int32_t *a, int a_step, const int32_t *b, int b_step);
#else
/* Returns the high word of the signed product: floor(a b / 2^32). */
SMEAR_SHARED int32_t mulh_i32(int32_t a, int32_t b)
{
    return SMEAR_HAS_MUL64 ? (int32_t)((int64_t)a * b >> 32) : mulh_i32_narrow(a, b);
}

/* Returns the high word of the unsigned product. */
SMEAR_SHARED uint32_t mulh_u32(uint32_t a, uint32_t b)
{
    return SMEAR_HAS_MUL64 ? (uint32_t)((uint64_t)a * b >> 32) : mulh_u32_narrow(a, b);
}

/* Returns a 2^shift for shift in -31 .. 31, rounded to nearest when it shrinks, clamped when it grows. */
SMEAR_SHARED int32_t scale_sat(int32_t a, int shift)
{
    if (shift <= 0) {
        if (shift == 0)
            return a;
        return (a >> -shift) + (int32_t)((uint32_t)a >> (-shift - 1) & 1u);
    }
    int32_t limit = INT32_MAX >> shift;
    return a > limit ? INT32_MAX : a < -limit ? -INT32_MAX : shl_wrap(a, shift);
}

SMEAR_SHARED int32_t narrow_sat(int64_t a)
{
    return a > INT32_MAX ? INT32_MAX : a < -INT32_MAX ? -INT32_MAX : (int32_t)a;
}

/* Returns a b. */
SMEAR_SHARED int64_t mul_wide(int32_t a, int32_t b)
{
    if (SMEAR_HAS_MUL64)
        return (int64_t)a * b;
    return (int64_t)((uint64_t)(uint32_t)mulh_i32(a, b) << 32 | (uint32_t)mul_wrap(a, b));
}

/* Returns the third component of the cross product of two vectors. */
SMEAR_SHARED int64_t cross_wide(int32_t ax, int32_t ay, int32_t bx, int32_t by) { return mul_wide(ax, by) - mul_wide(ay, bx); }

/* Returns the dot product of two vectors whose components lie some words apart, as those of columns of a matrix do, modulo 2^64. */
SMEAR_SHARED int64_t dot_wide(const int32_t *a, int a_step, const int32_t *b, int b_step)
{
    return (int64_t)((uint64_t)mul_wide(a[0], b[0]) + (uint64_t)mul_wide(a[a_step], b[b_step])
                     + (uint64_t)mul_wide(a[2 * a_step], b[2 * b_step]));
}
#endif

/* Returns floor(a b / 2^shift) for shift in 1 .. 31, modulo 2^32. */
static inline int32_t mul_shift(int32_t a, int32_t b, int shift)
{
    if (SMEAR_HAS_MUL64)
        return (int32_t)((int64_t)a * b >> shift);
    return (int32_t)((uint32_t)mulh_i32(a, b) << (32 - shift) | (uint32_t)mul_wrap(a, b) >> shift);
}

/* Returns |a|, also for the least number. */
static inline uint64_t magnitude(int64_t a) { return a < 0 ? 0u - (uint64_t)a : (uint64_t)a; }

#endif

/* SPDX-License-Identifier: MIT */
/* fixmath.h - reciprocals, lengths and roots in fixed point. Errors are stated and tested (test_fixmath.c). */
#ifndef SMEAR_FIXMATH_H
#define SMEAR_FIXMATH_H

#include "base/fixed.h"
#include "base/tables.h"

/* Returns floor(a / b) for b > 0, and the remainder in [0, b). */
static inline int32_t divide_floor(int32_t a, int32_t b, int32_t *remainder)
{
    /* Exact: |q b| <= |a|, and where r < 0, q > INT32_MIN. Wrapping words say so to whoever sees only ranges. */
    int32_t q = a / b, r = sub_wrap(a, mul_wrap(q, b));
    if (r < 0) {
        q = sub_wrap(q, 1);
        r = add_wrap(r, b);
    }
    *remainder = r;
    return q;
}

#if SMEAR_COPY_ELSEWHERE
int count_leading_zeros(uint32_t x);
int count_leading_zeros_64(uint64_t x);
uint32_t recip_norm(uint32_t m);
uint32_t recip_norm_precise(uint32_t m);
int32_t ratio_q30(int64_t a, int64_t c);
uint32_t sqrt_floor_64(uint64_t x);
uint32_t sqrt_q3(uint32_t x);
#else
/* Counts the leading zeros of x > 0. */
SMEAR_SHARED int count_leading_zeros(uint32_t x)
{
    if (SMEAR_HAS_CLZ)
        return __builtin_clz(x);
    int n = 0;
    if (x < 0x10000u) { n += 16; x <<= 16; }
    if (x < 0x1000000u) { n += 8; x <<= 8; }
    if (x < 0x10000000u) { n += 4; x <<= 4; }
    if (x < 0x40000000u) { n += 2; x <<= 2; }
    return n + (int)(~x >> 31);
}

/* Counts the leading zeros of x > 0, of 64 bits. */
SMEAR_SHARED int count_leading_zeros_64(uint64_t x)
{
    uint32_t high = (uint32_t)(x >> 32);
    return high != 0 ? count_leading_zeros(high) : 32 + count_leading_zeros((uint32_t)x);
}

/* Returns 2^61 / m for a normalised m in [2^31, 2^32): a number in [2^29 - 2^11, 2^30], relative error below 2^-18.
 *
 * The seed r has 9.4 good bits in 11. m r is 2^31 (1 + e) with |e| < 2^-9.4; one Newton
 * step r (1 - e) squares the error. All products fit 32 bits: m is cut to 21 bits, r
 * has 11, and r x (e >> 4) stays below 2^30. */
SMEAR_SHARED uint32_t recip_norm(uint32_t m)
{
    uint32_t r = smear_recip_seed[m >> 22 & 511u];
    int32_t error = (int32_t)(0x80000000u - (m >> 11) * r);
    return (uint32_t)((int32_t)(r << 19) + ((int32_t)r * (error >> 4) >> 8));
}

/* Returns 2^61 / m with a relative error below 2^-26: one more Newton step, on the high product. */
SMEAR_SHARED uint32_t recip_norm_precise(uint32_t m)
{
    uint32_t r = recip_norm(m);
    int32_t error = (int32_t)((1u << 29) - mulh_u32(m, r));         /* 2^29 e, |error| < 2^12 */
    return (uint32_t)((int32_t)r + ((int32_t)(r >> 12) * error >> 17));
}

/* Returns a / c in q30 for 0 <= a <= c, c > 0. It is for loops over vertices, not over pixels. */
SMEAR_SHARED int32_t ratio_q30(int64_t a, int64_t c)
{
    SMEAR_ASSERT(a >= 0 && c > 0 && a <= c);
    int shift = count_leading_zeros_64((uint64_t)c);
    uint32_t cn = (uint32_t)((uint64_t)c << shift >> 32), an = (uint32_t)((uint64_t)a << shift >> 33);
    /* an / cn with an in q31 of cn's scale: (2^31 a') (2^61 / c') / 2^32 = 2^29 ... in [0, 2^29]. */
    uint32_t q = mulh_u32(an, recip_norm_precise(cn)) << 2;
    return (int32_t)min_u32(q, 1u << 30);
}

/* Returns floor(sqrt(x)), exactly: one bit per step. */
static inline uint32_t sqrt_by_bits(uint64_t x)
{
    uint64_t root = 0, bit = (uint64_t)1 << 62;
    while (bit > x)
        bit >>= 2;
    while (bit != 0) {
        if (x >= root + bit) {
            x -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
        bit >>= 2;
    }
    return (uint32_t)root;
}

/* Does so by Heron's rule, r + (n - r^2) / 2r, for n in [2^60, 2^62): a line is within 3 %, then errors of 2^-11, 2^-22
 * and less than what the quotients lack. What is left are a few steps of x's own root. */
static inline uint32_t sqrt_by_reciprocals(uint64_t x)
{
    if (x == 0)
        return 0;
    const int shift = (count_leading_zeros_64(x) & ~1) - 2;
    const uint64_t n = shift >= 0 ? x << shift : x >> 2;
    const uint32_t high = (uint32_t)(n >> 32);
    uint32_t r = min_u32(11244u + ((high >> 14) * 11244u >> 15), 32767u);
    r = (r << 16) + ((uint32_t)mulh_i32((int32_t)(high - r * r), (int32_t)recip_norm(r << 17)) << 3);
    const int32_t recip = (int32_t)recip_norm(r << 1);              /* 2^60 / r */
    r += (uint32_t)(mulh_i32((int32_t)((int64_t)(n - (uint64_t)r * r) >> 21), recip) >> 8);
    r += (uint32_t)(mulh_i32((int32_t)((int64_t)(n - (uint64_t)r * r) >> 9), recip) >> 20);
    r = min_u32(r, 0x7fffffffu);
    r = shift >= 0 ? r >> (shift >> 1) : r << 1;
    while ((uint64_t)r * r > x)
        r--;
    while (x - (uint64_t)r * r > (uint64_t)r * 2u)
        r++;
    return r;
}

/* Returns floor(sqrt(x)), exactly. */
SMEAR_SHARED uint32_t sqrt_floor_64(uint64_t x)
{
    return SMEAR_SMALL_FILE ? sqrt_by_bits(x) : sqrt_by_reciprocals(x);
}

/* Returns 8 sqrt(x) for x < 2^20, relative error below 2^-8 plus 1/2 step. */
SMEAR_SHARED uint32_t sqrt_q3(uint32_t x)
{
    int shift = 0;
    while (x >= 1024u) {
        x >>= 2;
        shift++;
    }
    return (uint32_t)smear_sqrt_q3[x] << shift;
}
#endif

#endif

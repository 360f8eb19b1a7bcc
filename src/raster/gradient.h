/* SPDX-License-Identifier: MIT */
/* gradient.h - how attributes change from pixel to pixel. */
#ifndef SMEAR_RASTER_GRADIENT_H
#define SMEAR_RASTER_GRADIENT_H

#include "base/fixmath.h"

/* Products of 64 bits: where the core has none, from two of 32. */
static inline int64_t product(int32_t a, int32_t b)
{
#if SMEAR_HAS_MUL64
    return (int64_t)a * b;
#else
    return (int64_t)((uint64_t)(uint32_t)mulh_i32(a, b) << 32 | (uint32_t)mul_wrap(a, b));
#endif
}

/* a b - c d for edges b and d: those shorter than 128 px take products of 16 bits. */
static inline int64_t cross(int32_t a, int32_t b, int32_t c, int32_t d)
{
#if !SMEAR_HAS_MUL64 && !SMEAR_ONE_COPY
    if ((((uint32_t)b + 32768u) | ((uint32_t)d + 32768u)) < 65536u) {
        int32_t high = (int32_t)((uint32_t)((a >> 16) * b) - (uint32_t)((c >> 16) * d));
        int32_t low1 = (int32_t)((uint32_t)a & 0xffffu) * b, low2 = (int32_t)((uint32_t)c & 0xffffu) * d;
        return ((int64_t)low1 - low2) + (int64_t)((uint64_t)(int64_t)high << 16);
    }
#endif
    return product(a, b) - product(c, d);
}

/* n 256 / area with n = a1 y2 - a2 y1 (or a2 x1 - a1 x2): change per pixel of an attribute that changes by a1 and a2 along the two
 * edges; to nearest, clamped. recip: 2^61 / area, whose highest bit was shifted up by so many zeros. */
SMEAR_INLINE int32_t gradient_of(int64_t n, uint32_t recip, int area_zeros)
{
    if (n == 0)
        return 0;
    uint64_t size = n < 0 ? 0u - (uint64_t)n : (uint64_t)n;
    int zeros; /* n = top 2^(33 - zeros) */
#if UINTPTR_MAX > 0xffffffffu || SMEAR_ONE_COPY
    zeros = count_leading_zeros_64(size);
    uint32_t high = (uint32_t)(size << zeros >> 32);
#else
    uint32_t high = (uint32_t)(size >> 32), low = (uint32_t)size;
    if (high != 0) {
        zeros = count_leading_zeros(high);
        high = high << zeros | low >> 1 >> (31 - zeros);
    } else {
        zeros = count_leading_zeros(low);
        high = low << zeros;
        zeros += 32;
    }
#endif
    int32_t top = (int32_t)(high >> 1);
    int32_t g = mulh_i32(top, (int32_t)recip);
    g = scale_sat(g, clamp_i32(area_zeros - zeros - 20, -31, 31));
    return n < 0 ? -g : g;
}

/* (frac q8) x slope / 256, exact floor without a wide product. */
static inline int32_t slope_part(int32_t slope, int32_t frac)
{
    return mul_wrap(slope >> 8, frac) + ((slope & 255) * frac >> 8);
}

#endif

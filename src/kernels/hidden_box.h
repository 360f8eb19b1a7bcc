/* SPDX-License-Identifier: MIT */
/* hidden_box.h - a box of pixels that something nearer hides. */
#ifndef SMEAR_KERNELS_HIDDEN_BOX_H
#define SMEAR_KERNELS_HIDDEN_BOX_H

#include "base/pixel.h"
#include "kernels/kernels.h"
#include "kernels/vector.h"

/* Of two depths, halved, less the two of `least` the highest bit stays where they are no less. */
#define HIDDEN_PAIR(I) all &= (pair[I] >> 1 | top) - least

/* Whether all depths of `rows` rows of n >= 1 pairs, one `stride` pairs below the other, are 2 half at least; half is 2^15 - 1 at most.
 * Pairs lie on multiples of four bytes. 2 1/2 instructions a pixel. */
SMEAR_INLINE bool hidden_box_unrolled(const pixel_word *depth, ptrdiff_t stride, int32_t n, int32_t rows, uint32_t half)
{
    const uint32_t least = half * 0x10001u;
    uint32_t top = 0x80008000u;
    SMEAR_KEEP_VALUE(top);              /* in a register */
    for (; rows > 0; rows--, depth += stride) {
        const pixel_word *pair = depth, *const end = depth + n;
        uint32_t all = top;
        if (n & 1) {
            HIDDEN_PAIR(0);
            pair++;
        }
        if (n & 2) {
            HIDDEN_PAIR(0);
            HIDDEN_PAIR(1);
            pair += 2;
        }
        for (; pair != end; pair += 4) {
            HIDDEN_PAIR(0);
            HIDDEN_PAIR(1);
            HIDDEN_PAIR(2);
            HIDDEN_PAIR(3);
        }
        if (all != top)
            return false;
    }
    return true;
}

#if SMEAR_VECTORS
/* Four pairs at once, of which the last four of a row may have been seen before. */
SMEAR_INLINE bool hidden_box_lanes(const pixel_word *depth, ptrdiff_t stride, int32_t n, int32_t rows, uint32_t half)
{
    const smear_v8u least = (smear_v8u)v8i_all((int16_t)(2 * half));
    if (n < 4)
        return hidden_box_unrolled(depth, stride, n, rows, half);
    for (; rows > 0; rows--, depth += stride) {
        const uint16_t *const row = (const uint16_t *)(const void *)depth;
        smear_v8u less = v8u_less(least, (smear_v8u)v8i_load(row + 2 * n - 8));
        for (int32_t i = 0; i < n - 4; i += 4)
            less |= v8u_less(least, (smear_v8u)v8i_load(row + 2 * i));
        if (v4u_any((smear_v4u)less))
            return false;
    }
    return true;
}
#define hidden_box hidden_box_lanes
#else
#define hidden_box hidden_box_unrolled
#endif

#endif

/* SPDX-License-Identifier: MIT */
/* tiny_cover.h - which of a box of up to 2 x 2 pixels a triangle covers. */
#ifndef SMEAR_KERNELS_TINY_COVER_H
#define SMEAR_KERNELS_TINY_COVER_H

#include "kernels/kernels.h"

/* In assembly all of its pixels are kept, which takes no test. */
#define TINY_COVER_ARMV7EM (SMEAR_ASM_ARMV7EM && !SMEAR_SMALL_CODE)

/* A pixel that a triangle covers, and its edge functions there: twice the areas opposite to corners 1 and 2, q16. */
struct covered {
    int32_t x, y, e1, e2;
};

/* What a triangle covers in a box of up to TINY_BOX pixels a side. */
enum { TINY_BOX = 2, COVERED_KEPT = TINY_COVER_ARMV7EM ? TINY_BOX * TINY_BOX : 2 };
struct tiny_cover {
    int32_t area;                   /* twice the area, q16 px */
    int32_t count;                  /* centres covered */
    struct covered covered[COVERED_KEPT];       /* the first of them, row by row */
};

/* 0 for edges that go up (left ones) or right (top ones), whose centres count, else -1. */
static inline int32_t tiny_cover_bias(int32_t dx, int32_t dy) { return (dx - dy * 65536 - 1) >> 31; }

/* Counts a pixel of which no edge function is negative, and keeps it while there is room. */
SMEAR_INLINE void tiny_cover_keep(struct tiny_cover *t, int32_t x, int32_t y, int32_t e0, int32_t e1, int32_t e2)
{
    if ((e0 | e1 | e2) < 0)
        return;
    if (t->count < COVERED_KEPT)
        t->covered[t->count] = (struct covered){ x, y, e1, e2 };
    t->count++;
}

/* Corners are x and y, q8 px, clockwise, less than 16 px from the box and from each other. The box, which is not empty, is its first
 * pixel and that behind its last one. */
static inline void tiny_cover_reference(struct tiny_cover *t, const int32_t *box, const int32_t *v0, const int32_t *v1,
                                        const int32_t *v2)
{
    const int32_t x1 = v1[0] - v0[0], y1 = v1[1] - v0[1], x2 = v2[0] - v0[0], y2 = v2[1] - v0[1];
    t->area = x1 * y2 - x2 * y1;
    t->count = 0;
    for (int32_t y = box[1]; y < box[3]; y++)
        for (int32_t x = box[0]; x < box[2]; x++) {
            const int32_t cx = x * 256 + 128 - v0[0], cy = y * 256 + 128 - v0[1];
            const int32_t e1 = y2 * cx - x2 * cy, e2 = x1 * cy - y1 * cx;
            const int32_t e0 = t->area - e1 - e2 + tiny_cover_bias(x2 - x1, y2 - y1);
            tiny_cover_keep(t, x, y, e0, e1 + tiny_cover_bias(-x2, -y2), e2 + tiny_cover_bias(x1, y1));
        }
}

#endif

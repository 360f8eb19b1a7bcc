/* SPDX-License-Identifier: MIT */
/* batch_cover.h - which pixels a triangle covers in a box of up to TINY_BOX pixels a side. */
#ifndef SMEAR_BATCH_COVER_H
#define SMEAR_BATCH_COVER_H

#include "geometry/tiny.h"
#include "geometry/vertex.h"

/* A pixel that a triangle covers, and its edge functions there: twice the areas opposite to corners 1 and 2, q16. */
struct covered {
    int32_t x, y, e1, e2;
};

enum { TINY_BOX = 2, COVERED_KEPT = 2 };
struct tiny_cover {
    int32_t area;                   /* twice the area, q16 px */
    int32_t count;                  /* centres covered */
    struct covered covered[COVERED_KEPT];       /* the first of them, row by row */
};

/* Counts a pixel of which no edge function is negative, and keeps it while there is room. */
SMEAR_INLINE void tiny_cover_keep(struct tiny_cover *t, int32_t x, int32_t y, int32_t e0, int32_t e1, int32_t e2)
{
    if ((e0 | e1 | e2) < 0)
        return;
    if (t->count < COVERED_KEPT)
        t->covered[t->count] = (struct covered){ x, y, e1, e2 };
    t->count++;
}

/* Finds which centres of the box are covered: one after the other where size counts. */
static inline void cover(struct tiny_cover *t, const struct box *box, const struct smear_screen *v0, const struct smear_screen *v1,
                         const struct smear_screen *v2)
{
    const int32_t x = box->x0, y = box->y0;
    const int32_t x1 = v1->x - v0->x, y1 = v1->y - v0->y, x2 = v2->x - v0->x, y2 = v2->y - v0->y;
    struct tiny_edges e;
    t->area = x1 * y2 - x2 * y1;
    t->count = 0;
    tiny_start(&e, v0->x, v0->y, x1, y1, x2, y2, t->area, x, y);
    if (SMEAR_SMALL_CODE) {
        for (int32_t row = y; row < box->y1; row++) {
            int32_t e0 = e.e0, e1 = e.e1, e2 = e.e2;
            for (int32_t column = x; column < box->x1; column++) {
                tiny_cover_keep(t, column, row, e0, e1, e2);
                e0 += e.right0;
                e1 += e.right1;
                e2 += e.right2;
            }
            e.e0 += e.down0;
            e.e1 += e.down1;
            e.e2 += e.down2;
        }
        return;
    }
    const bool wide = box->x1 - x > 1;
    tiny_cover_keep(t, x, y, e.e0, e.e1, e.e2);
    if (wide)
        tiny_cover_keep(t, x + 1, y, e.e0 + e.right0, e.e1 + e.right1, e.e2 + e.right2);
    if (box->y1 - y > 1) {
        e.e0 += e.down0;
        e.e1 += e.down1;
        e.e2 += e.down2;
        tiny_cover_keep(t, x, y + 1, e.e0, e.e1, e.e2);
        if (wide)
            tiny_cover_keep(t, x + 1, y + 1, e.e0 + e.right0, e.e1 + e.right1, e.e2 + e.right2);
    }
}

#endif

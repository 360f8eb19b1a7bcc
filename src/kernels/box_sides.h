/* SPDX-License-Identifier: MIT */
/* box_sides.h - where rows of a triangle begin and end within a box of few columns, by its edge functions. */
#ifndef SMEAR_KERNELS_BOX_SIDES_H
#define SMEAR_KERNELS_BOX_SIDES_H

#include "kernels/kernels.h"

/* Edge functions at a row's first column; what they change by from column to column and from row to row. */
struct box_sides {
    int32_t e[3], right[3], down[3];
    int32_t left, columns;      /* of the box, columns >= 1 */
    int32_t width;              /* of the frame */
};

/* Sides of n > 0 rows: of the pixels where no function is negative, which lie side by side. A row without any begins and
 * ends where the box ends. The functions go on by so many rows. */
static inline void box_sides(struct span_side *side, struct box_sides *b, int32_t n)
{
    const int32_t right = b->left + b->columns;
    for (struct span_side *const end = side + n; side != end; side++) {
        int32_t e0 = b->e[0], e1 = b->e[1], e2 = b->e[2], x = b->left;
        while ((e0 | e1 | e2) < 0 && ++x < right) {
            e0 += b->right[0];
            e1 += b->right[1];
            e2 += b->right[2];
        }
        side->left = max_i32(x, 0);
        if (x < right)
            do {
                e0 += b->right[0];
                e1 += b->right[1];
                e2 += b->right[2];
            } while (++x < right && (e0 | e1 | e2) >= 0);
        side->edge = x;
        side->right = min_i32(x, b->width);
        for (int k = 0; k < 3; k++)
            b->e[k] += b->down[k];
    }
}

#endif

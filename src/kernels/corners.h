/* SPDX-License-Identifier: MIT */
/* corners.h - a triangle's corners from top to bottom. */
#ifndef SMEAR_KERNELS_CORNERS_H
#define SMEAR_KERNELS_CORNERS_H

#include "base/fixmath.h"

/* x and y, q8 px; and the rows between them: the first ones whose centres lie below each. */
struct corners {
    const int32_t *top, *middle, *bottom;
    int32_t first, knee, end;
    bool whole_is_left;             /* the side without the middle corner */
};

/* Clockwise from the top, the next corner lies right of the long edge, so that is the left one; each swap turns the triangle over. */
SMEAR_INLINE void corners_sort(struct corners *c, const int32_t *const corner[3])
{
    const int32_t *top = corner[0], *middle = corner[1], *bottom = corner[2], *swap;
    bool whole_is_left = true;
    if (middle[1] < top[1]) {
        swap = top;
        top = middle;
        middle = swap;
        whole_is_left = false;
    }
    if (bottom[1] < middle[1]) {
        swap = middle;
        middle = bottom;
        bottom = swap;
        whole_is_left = !whole_is_left;
        if (middle[1] < top[1]) {
            swap = top;
            top = middle;
            middle = swap;
            whole_is_left = !whole_is_left;
        }
    }
    c->top = top;
    c->middle = middle;
    c->bottom = bottom;
    c->first = (top[1] + 127) >> 8;
    c->knee = (middle[1] + 127) >> 8;
    c->end = (bottom[1] + 127) >> 8;
    c->whole_is_left = whole_is_left;
}

/* Of rows [y0, y1). */
SMEAR_INLINE void corners_find(struct corners *c, const int32_t *const corner[3], int32_t y0, int32_t y1)
{
    corners_sort(c, corner);
    c->first = max_i32(c->first, y0);
    c->end = min_i32(c->end, y1);
    c->knee = clamp_i32(c->knee, c->first, max_i32(c->end, c->first));
}

#endif

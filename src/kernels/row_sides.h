/* SPDX-License-Identifier: MIT */
/* row_sides.h - where rows of a triangle begin and end. */
#ifndef SMEAR_KERNELS_ROW_SIDES_H
#define SMEAR_KERNELS_ROW_SIDES_H

#include "kernels/avx2.h"
#include "kernels/corners.h"
#include "kernels/edge_walk.h"
#include "kernels/span_side.h"

/* The most rows of a call, a multiple of eight. */
enum { ROW_SIDES = 64 };

/* Sides of n > 0 rows from y on, all of which are drawn, in a frame of `width` columns. */
static inline void row_sides_reference(struct span_side *side, const struct corners *c, int32_t y, int32_t n, int32_t width)
{
    for (struct span_side *const end = side + n; side != end; side++, y++) {
        struct edge_walk whole, part;
        edge_start(&whole, c->top, c->bottom, y);
        edge_start(&part, y < c->knee ? c->top : c->middle, y < c->knee ? c->middle : c->bottom, y);
        side->left = max_i32(edge_pixel(c->whole_is_left ? &whole : &part), 0);
        side->edge = edge_pixel(c->whole_is_left ? &part : &whole);
        side->right = min_i32(side->edge, width);
    }
}

#if SMEAR_AVX2
/* The same: sides of a multiple of eight are stored. A quarter of the instructions of edge_left and edge_right. */
void smear_row_sides_avx2(struct span_side *side, const struct corners *c, int32_t y, int32_t n, int32_t width);
#endif

#endif

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

/* A triangle's sides from some row on, made ready for that and those below: corners are not looked at again. */
struct carried_sides {
    uint64_t x[3], step[3];         /* in that row: px q42, as in struct edge_walk. The long one, and those above the middle corner
                                     * and below it, as far as they have rows */
    int32_t y, knee;                /* the row, and the first one below the middle corner */
};
enum { SIDE_LONG, SIDE_ABOVE, SIDE_BELOW };

/* Makes those of a triangle whose corners are clockwise; row y lies below the topmost. */
void smear_sides_carry_avx2(struct carried_sides *c, const int32_t *const corner[3], int32_t y);

static inline void carried_sides_go(struct carried_sides *c, int32_t rows)
{
    c->y += rows;
    for (int i = 0; i < 3; i++)
        c->x[i] += c->step[i] * (uint64_t)(int64_t)rows;
}

/* Those of n > 0 rows from row c->y on, none below the bottom corner, as above. */
void smear_row_sides_carried_avx2(struct span_side *side, const struct carried_sides *c, int32_t n, int32_t width);
#endif

#endif

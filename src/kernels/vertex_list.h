/* SPDX-License-Identifier: MIT */
/* vertex_list.h - vertices of a mesh on the screen, one after the other, and beside which of its sides they lie. */
#ifndef SMEAR_KERNELS_VERTEX_LIST_H
#define SMEAR_KERNELS_VERTEX_LIST_H

#include "kernels/places.h"

/* By assembly on ARM7, where places before the division need not be kept. */
#define VERTEX_LISTS (SMEAR_ASM_ARM && SMEAR_FAST_STACK)

enum { LISTED_LEFT = 1, LISTED_RIGHT = 2, LISTED_TOP = 4, LISTED_BOTTOM = 8, LISTED_GUARD = 64, LISTED_GUARD_PX = 2048 };

struct listed_vertex {
    uint32_t tag, stored;           /* stored: 0 */
    struct smear_screen screen;
    int32_t sides;                  /* LISTED_LEFT ... */
};

static inline int32_t listed_sides(const struct smear_screen *p, const struct place_setup *s)
{
    const int32_t dx = p->x - s->x, dy = p->y - s->y, guard = LISTED_GUARD_PX << 8;
    const int32_t sides = (p->x < 0 ? LISTED_LEFT : 0) | (p->x > 2 * s->x ? LISTED_RIGHT : 0) | (p->y < 0 ? LISTED_TOP : 0)
                        | (p->y > 2 * s->y ? LISTED_BOTTOM : 0);
    return sides | (sides != 0 && (abs_i32(dx) > guard || abs_i32(dy) > guard) ? LISTED_GUARD : 0);
}

/* Finds vertices of three coordinates each, with the numbers [tag, end), one at least; the frame is smaller than twice the guard
 * band. Returns the number of the first one that takes more than what most of them take: it lies before the near plane or behind the far
 * plane, or so near to the eye or so far from it that shifts change their direction. Else `end`. */
static inline uint32_t vertex_list_reference(struct listed_vertex *out, const int16_t *v, uint32_t tag, uint32_t end,
                                             const struct place_setup *s)
{
    for (; tag != end; tag++, v += 3, out++) {
        int32_t row[3];
        for (int i = 0; i < 3; i++) {
            const int32_t *const m = s->m[i];
            row[i] = (int32_t)(((int64_t)v[0] * m[0] + (int64_t)v[1] * m[1] + (int64_t)v[2] * m[2]) >> 16) + m[3];
        }
        if (row[2] < s->near_distance || row[2] > s->far_distance)
            return tag;
        const int zeros = count_leading_zeros((uint32_t)row[2]), down = 21 - zeros, up = s->depth_shift + zeros;
        if (down <= 0 || up > 0)
            return tag;
        const int32_t r = (int32_t)recip_norm((uint32_t)row[2] << zeros);
        out->screen.x = s->x + scale_sat(mulh_i32(row[0], r), -down);
        out->screen.y = s->y + scale_sat(mulh_i32(row[1], r), -down);
        out->screen.depth = clamp_i32(scale_sat(mulh_i32(s->depth_mantissa, r), max_i32(up, -31)), s->depth_least, s->depth_most);
        out->tag = tag;
        out->stored = 0;
        out->sides = listed_sides(&out->screen, s);
    }
    return end;
}

#endif

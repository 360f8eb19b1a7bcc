/* SPDX-License-Identifier: MIT */
/* box_sides.c - see box_sides.h: the columns of a row at once. */
#include "kernels/box_sides.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* Edge functions in eight columns. */
struct box_lanes {
    lanes8 e[3];
};

SMEAR_AVX2_INLINE struct box_lanes box_lanes_start(const struct box_sides *b, uint32_t first)
{
    const lanes8 column = lanes8_numbers() + first;
    return (struct box_lanes){ { lanes8_ramp((uint32_t)b->e[0], (uint32_t)b->right[0], column),
                                 lanes8_ramp((uint32_t)b->e[1], (uint32_t)b->right[1], column),
                                 lanes8_ramp((uint32_t)b->e[2], (uint32_t)b->right[2], column) } };
}

/* Bits of the columns where one is negative. */
SMEAR_AVX2_INLINE uint32_t box_lanes_outside(const struct box_lanes *l)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps((__m256i)(l->e[0] | l->e[1] | l->e[2])));
}

SMEAR_AVX2_INLINE void box_lanes_down(struct box_lanes *l, const lanes8 down[3])
{
    l->e[0] += down[0];
    l->e[1] += down[1];
    l->e[2] += down[2];
}

SMEAR_AVX2_INLINE void box_sides_rows(struct span_side *side, struct box_sides *b, int32_t n, bool wide)
{
    const lanes8 down[3] = { lanes8_all((uint32_t)b->down[0]), lanes8_all((uint32_t)b->down[1]), lanes8_all((uint32_t)b->down[2]) };
    const uint32_t all = (1u << b->columns) - 1u, beyond = 1u << b->columns;
    const int32_t x = b->left, width = b->width;
    struct box_lanes first = box_lanes_start(b, 0), second = first;
    if (wide)
        second = box_lanes_start(b, 8);
    for (struct span_side *const end = side + n; side != end; side++) {
        uint32_t outside = box_lanes_outside(&first);
        if (wide)
            outside |= box_lanes_outside(&second) << 8;
        const uint32_t inside = all & ~outside;
        const int32_t left = x + (int32_t)_tzcnt_u32(inside | beyond), edge = left + __builtin_popcount(inside);
        side->left = max_i32(left, 0);
        side->right = min_i32(edge, width);
        side->edge = edge;
        box_lanes_down(&first, down);
        if (wide)
            box_lanes_down(&second, down);
    }
}

SMEAR_AVX2_FUNCTION void smear_box_sides_avx2(struct span_side *side, struct box_sides *b, int32_t n)
{
    if (b->columns <= 8)
        box_sides_rows(side, b, n, false);
    else
        box_sides_rows(side, b, n, true);
    for (int k = 0; k < 3; k++)
        b->e[k] = add_wrap(b->e[k], mul_wrap(n, b->down[k]));
}
#endif

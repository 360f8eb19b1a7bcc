/* SPDX-License-Identifier: MIT */
/* row_blocks.c - see row_blocks.h. Constants are fitted to the scenes of `smear-bench promise`. */
#include "temporal/row_blocks.h"

struct smear_closing smear_closing_of(int32_t x, int32_t y, int32_t unlike)
{
    enum {
        LEFT = 13,              /* q8: of the squared error where all goes alike: instants are sharp, pixels square */
        UNLIKE_LOG2 = 6,        /* the rest goes with the square of what is unlike, q8 */
        FLOOR = 11744051        /* q24: 0.7 of what an instant per pixel of the path leaves */
    };
    const uint32_t square = (uint32_t)(x * x + y * y) + 1u, apart = (uint32_t)min_i32(unlike, 32767) * (uint32_t)min_i32(unlike, 32767);
    struct smear_closing c = { 256, 0, 0, unlike };
    if (apart >> 1 >= 2 * square || unlike == INT16_MAX)
        return c;
    c.left = min_u32(LEFT + apart / max_u32(square >> UNLIKE_LOG2, 1), 256);
    c.floor = min_u32(FLOOR / square, 65536);
    c.last = closed_instants((256 - c.left) * 256, max_u32(c.floor, 1));
    return c;
}

struct smear_closing smear_block_closing(const struct smear_row_blocks *b, int32_t column, int32_t row, int32_t rows)
{
    enum { SPARSE = BLOCK_PX * BLOCK_PX * 3 / 8 };      /* pixels: there is more to be seen of what lies behind */
    static const int8_t beside[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };
    const struct smear_block *here = block_at(b, column, row);
    /* Instants of a curve go on along its chord in the middle alone. */
    int32_t unlike = block_curvature(here);
    for (int i = 0; i < 4; i++) {
        const int32_t c = column + beside[i][0], r = row + beside[i][1];
        if (c < 0 || c >= b->columns || r < 0 || r >= rows)
            continue;
        const struct smear_block *there = block_at(b, c, r);
        if (there->depth != 0)
            unlike = max_i32(unlike, max_i32(abs_i32(here->x - there->x), abs_i32(here->y - there->y)));
    }
    if (here->last != 0 && here->last < SPARSE && 2 * unlike > max_i32(abs_i32(here->x), abs_i32(here->y)))
        return (struct smear_closing){ 256, 0, 0, unlike };
    return smear_closing_of(here->x, here->y, unlike);
}

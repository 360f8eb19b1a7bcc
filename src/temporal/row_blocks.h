/* SPDX-License-Identifier: MIT */
/* row_blocks.h - how what is seen in the middle of the exposure moves, by blocks of 8 x 8 pixels of a tile row, and how well
 * gaps between instants close there. */
#ifndef SMEAR_ROW_BLOCKS_H
#define SMEAR_ROW_BLOCKS_H

#include "base/fixmath.h"

enum {
    BLOCK_SHIFT = 3,
    BLOCK_PX = 1 << BLOCK_SHIFT,
    BLOCK_INSTANTS_MAX = 47     /* gaps between more are never closed */
};

struct smear_block {
    int16_t x, y;               /* displacement of the nearest moving surface in the block's middle, 1/16 px */
    uint16_t depth;             /* of that surface: larger is nearer. 0: none is there */
    uint8_t curvature;          /* by how much the displacement changes along the path, about: block_curvature() */
    uint8_t last;               /* gaps are closed where there are no more instants than so many. Before that is known: pixels of
                                 * the small triangles that lie there, where the surface is one of them; else 0 */
};

struct smear_row_blocks {
    struct smear_block *block;  /* row after row */
    int32_t columns;
};

/* Curvatures are kept in steps of 1/4 px up to 48 px, then of 4 px; the largest is one with which nothing is closed. */
enum { CURVATURE_FINE = 192, CURVATURE_MAX = 255, CURVATURE_COARSE_LOG2 = 4 };

/* Returns what is kept of a curvature, 1/16 px, and the way back. */
static inline uint8_t block_curvature_of(int32_t curvature)
{
    const int32_t steps = curvature >> 2;
    return (uint8_t)(steps < CURVATURE_FINE ? steps : min_i32(CURVATURE_FINE + ((steps - CURVATURE_FINE) >> CURVATURE_COARSE_LOG2),
                                                              CURVATURE_MAX - 1));
}

static inline int32_t block_curvature(const struct smear_block *b)
{
    const int32_t c = b->curvature;
    return c < CURVATURE_FINE ? c << 2 : c == CURVATURE_MAX ? INT16_MAX
                                                            : (CURVATURE_FINE + ((c - CURVATURE_FINE) << CURVATURE_COARSE_LOG2)) << 2;
}

/* Blocks beside each other in a row of pixels, and above each other in a tile row. */
static inline int32_t block_columns(int32_t width) { return (width + BLOCK_PX - 1) >> BLOCK_SHIFT; }
static inline int32_t block_rows(int32_t tile) { return (tile + BLOCK_PX - 1) >> BLOCK_SHIFT; }

static inline struct smear_block *block_at(const struct smear_row_blocks *b, int32_t column, int32_t row)
{
    return &b->block[row * b->columns + column];
}

/* Returns floor(sqrt(n / d)) for n <= 2^22 and d > 0, BLOCK_INSTANTS_MAX at most: the largest number whose square times d is not
 * above n. */
static inline int32_t closed_instants(uint32_t n, uint32_t d)
{
    uint32_t k = 0;
    if (d > n)
        return 0;
    for (uint32_t bit = d < 1u << 20 ? 32 : 2; bit != 0; bit >>= 1)     /* 2: n / d is 4 at most */
        if ((k + bit) * (k + bit) * d <= n)
            k += bit;
    return min_i32((int32_t)k, BLOCK_INSTANTS_MAX);
}

/* What closing the gaps leaves of the squared error of one instant: with N of them, left / N^2, what is rounded, as taps lie on pixels,
 * but 1 / 2 N^2 at most where instants are not a pixel apart, and the floor, which no number of instants takes away. */
struct smear_closing {
    uint32_t left;              /* q8; 256: gaps are not closed */
    uint32_t rounded;           /* q16 */
    uint32_t floor;             /* q16 */
    int32_t last;               /* instants up to which it pays, where nothing else is known; 0: never */
    int32_t unlike;             /* by how much the displacement is not what it is beside it, 1/16 px */
};

/* Of a displacement that is `unlike` that of things beside it, or what it is at other times, by so much, all 1/16 px. */
struct smear_closing smear_closing_of(int32_t x, int32_t y, int32_t unlike);

/* Of a block with a surface. `rows`: of blocks. */
struct smear_closing smear_block_closing(const struct smear_row_blocks *b, int32_t column, int32_t row, int32_t rows);

#endif

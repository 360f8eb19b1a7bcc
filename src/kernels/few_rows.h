/* SPDX-License-Identifier: MIT */
/* few_rows.h - rows of a textured triangle of few pixels: what they are drawn by. */
#ifndef SMEAR_KERNELS_FEW_ROWS_H
#define SMEAR_KERNELS_FEW_ROWS_H

#include "kernels/kernels.h"

/* Planes: codes q16; coordinates; light, 16 bits q15; how much larger 1/w is than at v[0], q15. */
enum few_plane { FEW_DEPTH, FEW_U, FEW_V, FEW_BLUE, FEW_ALPHA, FEW_RED, FEW_GREEN, FEW_BEND, FEW_PLANES };

/* All three edge functions (geometry/tiny.h) in a word, from bits 0, 21 and 43 on: their lower 8 bits are the same in all pixels, and left
 * out. One that is negative makes that above it lower by one; but then the pixel is outside anyway. */
struct few_values {
    uint64_t edges;
    int32_t plane[FEW_PLANES];
};

/* Opaque texels with turns: copied into pixels of 16 or of 32 bits; such of 32 bits in white linear light, into pixels of 32 bits; of 16 in
 * white encoded light, into pixels of 16; in white light. And any. */
enum few_kind { FEW_NARROW, FEW_WIDE, FEW_LINEAR, FEW_NARROW_LIT, FEW_WHITE, FEW_ANY };

struct few_box {
    struct few_values at, down, right;      /* of the first row's first pixel; `at` goes on to the row behind the last one */
    uint32_t columns;                       /* the pixel behind them is outside */
    uint16_t *depth;                        /* of a row's first pixel */
    uint32_t depth_bytes;                   /* from row to row */
    uint16_t *depth_end;
};

/* What triangles of a segment have in common. */
struct few_texels {
    uint32_t width, height;         /* of the texture, powers of two from 2 on; coordinates are turns q32 and FEW_TURN */
    uint32_t middle;                /* address of the middle texel */
    uint32_t word[7];               /* few_words_take */
    const void *texels;
    uint16_t *depth;                /* of the first pixel, and what is drawn there */
    void *pixels;
    uint8_t up, uv_shift;           /* from mesh units q15 to coordinates; mesh units of a turn */
    uint8_t color;                  /* words to colours of vertices, or 0 */
    bool lit, linear, flat_depth;
};

/* Boxes of at most so many columns and rows. */
enum { FEW_PX = 16 };

/* Loops of a core's own are there, and such of light. */
#define FEW_ROWS_LOOP (SMEAR_ASM_ARMV7EM || (SMEAR_ASM_ARMV6M && !SMEAR_SMALL_FILE))
#define FEW_LIGHT_LOOP (!SMEAR_ASM_ARMV6M)
/* What is a function of its own where that leaves registers to what follows: elsewhere a call takes more. */
#if SMEAR_ASM_ARMV6M
#define FEW_APART SMEAR_INLINE
#else
#define FEW_APART static SMEAR_NOINLINE
#endif
#define FEW_TURN (SMEAR_ASM_ARMV7EM ? INT32_MIN : 0)

/* Whether an edge function is negative. */
static inline bool few_outside(uint64_t edges)
{
    if (SMEAR_ON_64)
        return (edges & (1ull << 20 | 1ull << 41 | 1ull << 63)) != 0;
    const uint32_t high = (uint32_t)(edges >> 32), both = high | (uint32_t)edges << 11;
    return SMEAR_SMALL_FILE ? (int32_t)(both | high << 22) < 0 : (both & (1u << 31 | 1u << 9)) != 0;
}

#endif

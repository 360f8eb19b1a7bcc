/* SPDX-License-Identifier: MIT */
/* late_blocks.h - blocks of pixels that are written late, or never: where memory is slow, and most of a sharp frame is faces of one
 * colour, each block says so in its first pixels.
 *
 * A block is eight pixels from a column on that is a multiple of eight, and their depths. Where LATE_COLOR is set in its first pixel, all
 * have that colour, and depth codes of the form (z + i dz) >> 16, modulo 2^16: z and dz lie in the next two pixels, or are 0 where
 * LATE_CLEAR is set, too. Nothing else is written, of depths nothing. Without LATE_COLOR all is written, and the first top byte is 0. */
#ifndef SMEAR_KERNELS_LATE_BLOCKS_H
#define SMEAR_KERNELS_LATE_BLOCKS_H

#include "kernels/fill.h"

#if SMEAR_LATE_BLOCKS
enum { LATE_BLOCK = 8 };
#define LATE_COLOR 0x80000000u
#define LATE_CLEAR 0x40000000u

/* Makes blocks one behind the other of this colour, of depth 0. */
static inline void late_clear(uint32_t *pixels, uint32_t color, int32_t blocks)
{
    const uint32_t first = LATE_COLOR | LATE_CLEAR | color;
    for (; blocks >= 4; blocks -= 4, pixels += 4 * LATE_BLOCK)
        pixels[0] = pixels[LATE_BLOCK] = pixels[2 * LATE_BLOCK] = pixels[3 * LATE_BLOCK] = first;
    for (; blocks > 0; blocks--, pixels += LATE_BLOCK)
        *pixels = first;
}

static inline uint32_t late_depth_pair(uint32_t z, uint32_t dz)
{
    return z >> 16 | ((z + dz) & 0xffff0000u);
}

/* Writes what is not written of a block, whose depths lie at a multiple of four bytes. */
static inline void late_settle(uint32_t *pixels, uint16_t *depth)
{
    const uint32_t first = pixels[0];
    if ((first & LATE_COLOR) == 0)
        return;
    const bool clear = (first & LATE_CLEAR) != 0;
    const uint32_t z = clear ? 0 : pixels[1], dz = clear ? 0 : pixels[2];
    pixel_word *const pair = (pixel_word *)(void *)depth;
    fill_eights(pixels, first & 0xffffffu, 1);
    pair[0] = late_depth_pair(z, dz);
    pair[1] = late_depth_pair(z + 2 * dz, dz);
    pair[2] = late_depth_pair(z + 4 * dz, dz);
    pair[3] = late_depth_pair(z + 6 * dz, dz);
}

/* The same of all blocks of a row that columns [a, b) touch; pixel 0 of the row may lie outside the memory. */
static inline void late_settle_run(uint32_t *pixels, uint16_t *depth, int32_t a, int32_t b)
{
    for (int32_t x = a & ~(LATE_BLOCK - 1); x < b; x += LATE_BLOCK)
        late_settle(pixels + x, depth + x);
}

/* Whether n pixels with these depth codes, 16.16, are nearer than depth 0 for certain: codes neither pass 0 nor come to it. */
static inline bool late_is_sure(uint32_t z, uint32_t dz, int32_t n)
{
    const uint32_t last = z + dz * (uint32_t)(n - 1);
    const bool falls = dz >> 31 != 0;
    const uint32_t least = falls ? last : z, most = falls ? z : last;
    return n < 256 && dz + (1u << 24) < 1u << 25 && least <= most && least >= 0x10000u;
}
#endif

#endif

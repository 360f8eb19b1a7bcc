/* SPDX-License-Identifier: MIT */
/* timemask_slots.h - who is seen in a pixel in which time slots: an A-buffer over time.
 *
 * A pixel has three entries, each with the slots it holds, a colour, and a depth code that goes evenly with time. A slot is
 * in at most one entry: the nearer of two takes it. What no entry holds shows the still scene. When a fourth is needed,
 * the two most alike become one, coloured by their shares. */
#ifndef SMEAR_TIMEMASK_SLOTS_H
#define SMEAR_TIMEMASK_SLOTS_H

#include "fixmath.h"
#include "pixel.h"
#include "timemask_cover.h"

enum { TIMEMASK_ENTRIES = 3 };

/* Entries of a block: e of pixel p at p * TIMEMASK_ENTRIES + e, rows TIMEMASK_BLOCK apart. */
struct timemask_slots {
    uint32_t *held;             /* a bit per slot, 0: free */
    uint32_t *color;            /* 0xSSRRGGBB, S: the depth's slope */
    uint16_t *depth;            /* code in the middle of the exposure */
    uint32_t pixels;
    int32_t slots_log2;         /* of the whole exposure */
    bool linear;
};

static inline size_t timemask_slots_bytes(uint32_t pixels)
{
    return (size_t)TIMEMASK_ENTRIES * pixels * (2 * sizeof(uint32_t) + sizeof(uint16_t));
}

/* Over `memory` of that size, aligned for words. */
void smear_timemask_slots_place(struct timemask_slots *b, void *memory, uint32_t pixels, int32_t slots_log2, bool linear);

/* Frees all entries. */
void smear_timemask_slots_clear(struct timemask_slots *b);

/* Slope of a depth code, in 1/16 per slot, in 8 bits: sign, exponent, 3 bits of mantissa. */
uint32_t smear_timemask_slope(int32_t slope);

static inline int32_t timemask_slope_of(uint32_t color)
{
    int32_t exponent = (int32_t)(color >> 27 & 15u), mantissa = (int32_t)(color >> 24 & 7u);
    int32_t size = exponent == 0 ? mantissa : (8 + mantissa) << (exponent - 1);
    return (int32_t)color < 0 ? -size : size;
}

/* A fragment that holds the slots of `mask` (at least one) before others are asked. Colour with the slope's 8 bits on top;
 * depth code in the middle of the exposure; slope as timemask_slope_of has it. */
void smear_timemask_slots_add(struct timemask_slots *b, uint32_t pixel, uint32_t mask, uint32_t color, uint32_t depth,
                              int32_t slope);

/* The pixel over the still scene's colour. */
uint32_t smear_timemask_slots_mean(const struct timemask_slots *b, uint32_t pixel, uint32_t still);

#endif

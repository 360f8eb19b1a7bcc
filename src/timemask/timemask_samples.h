/* SPDX-License-Identifier: MIT */
/* timemask_samples.h - who is seen in a pixel in which time samples: an A-buffer over time.
 *
 * A pixel has up to five entries, each with the time samples it holds, a colour, and a depth code that goes evenly with
 * time. A sample is in at most one entry: the nearer of two takes it. What no entry holds shows the background. When a
 * sixth is needed, the two most alike become one, coloured by their shares. */
#ifndef SMEAR_TIMEMASK_SAMPLES_H
#define SMEAR_TIMEMASK_SAMPLES_H

#include "base/fixmath.h"
#include "base/pixel.h"
#include "timemask/timemask_cover.h"

enum { TIMEMASK_ENTRIES = 5 };

/* Entries of a block: e of pixel p at e * pixels + p. */
struct timemask_samples {
    uint32_t *any;              /* samples held by some entry */
    uint32_t *held;             /* a bit per sample, never 0 in use */
    uint32_t *color;            /* 0xSSRRGGBB, S: the depth's slope */
    uint16_t *depth;            /* code in the middle of the exposure */
    uint16_t *farthest;         /* no entry is farther than this in a sample it holds */
    uint8_t *count;             /* entries in use */
    int32_t pixels_log2;
    int32_t samples_log2;       /* of the whole exposure */
    bool linear;
};

/* What may be seen of a moving triangle in a pixel. */
struct timemask_fragment {
    uint32_t mask;              /* samples, at least one */
    uint32_t color;             /* as it is kept */
    int32_t depth;              /* code in the middle of the exposure */
    int32_t slope;              /* timemask_slope_of(color) */
    int32_t low;                /* code it keeps above */
};

static inline size_t timemask_samples_bytes(uint32_t pixels)
{
    return pixels
         * (TIMEMASK_ENTRIES * (2 * sizeof(uint32_t) + sizeof(uint16_t)) + sizeof(uint32_t) + sizeof(uint16_t)
            + 1);
}

/* Over `memory` of that size, aligned for words. */
void smear_timemask_samples_place(struct timemask_samples *b, void *memory, int32_t pixels_log2,
                                  int32_t samples_log2, bool linear);

/* Frees all entries. */
void smear_timemask_samples_clear(struct timemask_samples *b);

/* Slope of a depth code, in 1/16 per sample, in 8 bits: sign, exponent, 3 bits of mantissa. */
uint32_t smear_timemask_slope(int32_t slope);

static inline int32_t timemask_slope_of(uint32_t color)
{
    int32_t exponent = (int32_t)(color >> 27 & 15u), mantissa = (int32_t)(color >> 24 & 7u);
    int32_t size = exponent == 0 ? mantissa : (8 + mantissa) << (exponent - 1);
    return (int32_t)color < 0 ? -size : size;
}

/* Whether an entry is of the same colour and, as far as that matters, the same surface. */
static inline bool timemask_is_same(const struct timemask_samples *b, uint32_t at, uint32_t color,
                                    int32_t depth)
{
    return (b->color[at] ^ color) << 8 == 0 && abs_i32((int32_t)b->depth[at] - depth) <= depth >> 6;
}

/* timemask_samples_add, where others have a say or entries run out. */
void smear_timemask_samples_contest(struct timemask_samples *b, uint32_t pixel,
                                    const struct timemask_fragment *f);

/* `high`: code that is not exceeded. */
SMEAR_INLINE void timemask_samples_add(struct timemask_samples *b, uint32_t pixel, struct timemask_fragment f,
                                       int32_t high)
{
    uint32_t any = b->any[pixel], n = b->count[pixel];
    int32_t farthest = b->farthest[pixel];
    if ((any & f.mask) != 0 && high <= farthest) {
        f.mask &= ~any;
        if (f.mask == 0)
            return;
    }
    if ((any & f.mask) != 0 || n == TIMEMASK_ENTRIES) {
        const struct timemask_fragment contested = f;
        smear_timemask_samples_contest(b, pixel, &contested);
        return;
    }
    uint32_t at = (n << b->pixels_log2) + pixel, before = at - (1u << b->pixels_log2);
    b->any[pixel] = any | f.mask;
    if (f.low < farthest)
        b->farthest[pixel] = (uint16_t)f.low;
    if (n != 0 && timemask_is_same(b, before, f.color, f.depth)) {
        b->held[before] |= f.mask;
        return;
    }
    b->held[at] = f.mask;
    b->color[at] = f.color;
    b->depth[at] = (uint16_t)f.depth;
    b->count[pixel] = (uint8_t)(n + 1);
}

/* Depth code at or beyond which nothing new is seen in rows of `width`
 * pixels, `stride` apart: 0 while samples are free. */
int32_t smear_timemask_samples_hidden(const struct timemask_samples *b, int32_t width, int32_t rows,
                                      int32_t stride);

/* The pixel over the background's colour. */
uint32_t smear_timemask_samples_mean(const struct timemask_samples *b, uint32_t pixel, uint32_t background);

#endif

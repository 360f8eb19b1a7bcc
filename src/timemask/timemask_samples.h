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

/* Adds what is seen; `high`: code that is not exceeded. */
void smear_timemask_samples_add(struct timemask_samples *b, uint32_t pixel, struct timemask_fragment f, int32_t high);

/* Depth code at or beyond which nothing new is seen in rows of `width`
 * pixels, `stride` apart: 0 while samples are free. */
int32_t smear_timemask_samples_hidden(const struct timemask_samples *b, int32_t width, int32_t rows,
                                      int32_t stride);

/* The pixel over the background's colour. */
uint32_t smear_timemask_samples_mean(const struct timemask_samples *b, uint32_t pixel, uint32_t background);

#endif

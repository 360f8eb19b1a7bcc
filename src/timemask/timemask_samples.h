/* SPDX-License-Identifier: MIT */
/* timemask_samples.h - what is seen in a pixel, and in which samples of the exposure: a few entries, each of a colour, a course of
 * depths and a bit for each sample that it holds. */
#ifndef SMEAR_TIMEMASK_SAMPLES_H
#define SMEAR_TIMEMASK_SAMPLES_H

#include "base/pixel.h"

enum { TIMEMASK_ENTRIES = 5 };

struct timemask_entry {
    uint32_t held;              /* a bit per sample, never 0 in use */
    uint32_t color;             /* 0xRRGGBB */
    uint16_t start, end;        /* depth codes in the first sample of the exposure and in the last; evenly between */
};

struct timemask_pixel {
    struct timemask_entry entry[TIMEMASK_ENTRIES];
    uint32_t count;             /* entries in use */
};

static inline uint32_t timemask_count(uint32_t m)
{
    m -= m >> 1 & 0x55555555u;
    m = (m & 0x33333333u) + (m >> 2 & 0x33333333u);
    return ((m + (m >> 4)) & 0x0f0f0f0fu) * 0x01010101u >> 24;
}

/* Adds what a triangle shows in a pixel, where it is nearer than what was there: `last` is the number of the last sample. */
void smear_timemask_add(struct timemask_pixel *p, struct timemask_entry fresh, int32_t last, smear_transfer transfer);

/* Returns the mean of the entries and, in the rest of 2^samples_log2 samples, the background. */
uint32_t smear_timemask_mean(const struct timemask_pixel *p, uint32_t background, int samples_log2, smear_transfer transfer);

#endif

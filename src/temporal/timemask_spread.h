/* SPDX-License-Identifier: MIT */
/* timemask_spread.h - pixels from samples that lie apart.
 *
 * What moves by d px has no detail along its way that is finer than about d: a step becomes a
 * ramp d px long. Samples d/4 px apart and straight lines between them say nearly all of it. The
 * still scene below has all its detail: what moving triangles add up to is spread, and each pixel's still
 * colour is added for the rest of the exposure. */
#ifndef SMEAR_TIMEMASK_SPREAD_H
#define SMEAR_TIMEMASK_SPREAD_H

#include "temporal/timemask_samples.h"

struct timemask_sums {
    uint32_t word[TIMEMASK_WIDTH][TIMEMASK_SUM_WORDS];
};

struct timemask_spread {
    const struct timemask_samples *slots;
    int32_t right, down;            /* from a sample to the next */
    int32_t across_log2, down_log2; /* px between samples; both together at most 3 */
    int32_t width;                  /* pixels; samples go on to that at or beyond the last one */
    /* Depth codes: where the still scene is at `front` or nearer it hides all
     * moving triangles, where it is farther than `back` none. */
    int32_t front, back;
    /* Sums of the rows of samples above and below: at [y & 1]. */
    struct timemask_sums sum[2];
};

/* A row of pixels: y of the block, over still colours and depths. Rows
 * are asked for from 0 on, one after the other. */
void smear_timemask_spread(struct timemask_spread *s, int32_t y, uint32_t *out, const uint32_t *color,
                           const uint16_t *depth);

#endif

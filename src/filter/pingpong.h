/* SPDX-License-Identifier: MIT */
/* pingpong.h - a blur in passes of few taps each, spaced closer from pass to pass: 8 and 8 taps gather like 64.
 *
 * After Sousa's directional blurs (GDC 2008, 2013) and their use for motion: velocity and depth are looked
 * up where the result goes, taps that are nearer than that are left out, so that what is in front does not
 * bleed over what is behind. Taps lie at even steps to both sides, and a pass covers just one step of the
 * one before it: then no position counts twice, and the passes are a box. Wide steps come first: the
 * narrow ones even out what falls between pixels. */
#ifndef SMEAR_PINGPONG_H
#define SMEAR_PINGPONG_H

#include "filter/filter.h"
#include "smear.h"

enum { PINGPONG_PASSES_MAX = 3 };

/* One pass over a frame. */
struct smear_pass {
    int32_t taps;
    /* Streaks of so many pixels or fewer are left to the last pass, which then takes all passes' taps: no
     * steps of passes fit between their pixels. */
    int32_t direct_up_to, all_taps, direct_spacing;
    bool is_last;
    int32_t spacing;            /* half the distance of two taps, as a share of half the exposure's displacement: q20 */
    int32_t reach;              /* rows above and below that it may read */
    int32_t jitter;             /* q8 of `spacing` to either side */
    int32_t bias;               /* q8 of the distance; at most 255: no tap is left out */
    bool spread;                /* moving things come over what is static */
};

/* Plans the passes of a frame; returns how many there are. Zeros in p that mean a default have been resolved. */
int smear_pingpong_plan(struct smear_pass pass[PINGPONG_PASSES_MAX], const smear_pingpong *p, int32_t reach);

/* Makes one pass over the rows [y0, y1) of tile `column` in tile row `row`. It reads `in`, a plane like the window's
 * colour, and writes to `out`: a plane like the window's where `stride` is 0, else the tile's first pixel in row y0,
 * with rows `stride` pixels apart. Returns the taps taken. */
uint32_t smear_pingpong_pass(uint32_t *out, int32_t stride, const uint32_t *in, const struct smear_window *w,
                             const struct smear_row_table *rows, const struct smear_pass *pass, int32_t row,
                             int32_t column, int32_t y0, int32_t y1,
                             const struct smear_blur_settings *settings);

#endif

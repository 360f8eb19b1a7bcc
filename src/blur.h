/* SPDX-License-Identifier: MIT */
/* blur.h - what a blur reads and writes.
 *
 * A blur reads the window (only), writes one tile of finished pixels into memory of the job's own, and never works
 * in place: what a neighbour still has to read is never overwritten. Tiles may be done in any order on any core. */
#ifndef SMEAR_BLUR_H
#define SMEAR_BLUR_H

#include "window.h"

struct smear_blur_settings {
    bool linear;                /* average linear light, else codes */
    bool orthographic;          /* depth units are even in distance */
    int32_t samples;            /* wanted taps */
    bool dense;                 /* plain means: a tap per pixel of the way, not one per two */
    uint8_t flags;              /* SMEAR_FENCE | ... */
    /* Orthographic only: distance over range at units 0, in q16: where "5 % nearer" is. */
    uint32_t far_over_range;
};

/* Rows of the window by pixel row: offset of its first pixel in the planes, with rows beyond the frame standing for the
 * nearest inside it. Entry i is row first + i. */
struct smear_row_table {
    const uint32_t *offset;
    int32_t first;
};

/* Reconstruction filter [McGuire12], [Guertin14], as in Post Processing Stack v2. Writes tile x tile pixels (those
 * inside the frame) to `out`, rows `tile` apart. Returns the taps taken. */
uint32_t smear_blur_reconstruct(uint32_t *out, const struct smear_window *w,
                                const struct smear_row_table *rows, int32_t row, int32_t column,
                                const struct smear_blur_settings *settings);

/* Plain mean along each pixel's own velocity, for tiles in whose reach all motion is alike or changes without
 * a step. */
uint32_t smear_blur_uniform(uint32_t *out, const struct smear_window *w,
                            const struct smear_row_table *rows, int32_t row, int32_t column,
                            const struct smear_blur_settings *settings);

/* The tile as it is. */
void smear_blur_copy(uint32_t *out, const struct smear_window *w, int32_t row, int32_t column);

#endif

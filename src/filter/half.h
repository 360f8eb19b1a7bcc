/* SPDX-License-Identifier: MIT */
/* half.h - a window at half the size, with colour, depth and velocity of 2 x 2 pixels each, and its result at full
 * size.
 *
 * A filter runs in it as in any window, on a quarter of the pixels, with half the reach. Its result is blended with the
 * frame by how fast each pixel moves: a static pixel keeps all its detail, bit for bit, but gets what the blur changes
 * there; a moving one gets the blur and, of the detail within 2 x 2 pixels, keeps what lies across its motion. */
#ifndef SMEAR_HALF_H
#define SMEAR_HALF_H

#include "raster/window.h"

/* Fills tile `column` of tile row `row` from the window of the whole frame: with the mean colour (of linear light, or
 * of codes) and with the depth and velocity of the nearest pixel. */
void smear_half_reduce(const struct smear_window *half, const struct smear_window *full, int32_t row,
                       int32_t column, bool linear);

/* Writes the tile of the whole frame to `out`, rows full->tile apart: `blurred` is the
 * tile of half the size, rows half->tile apart. */
void smear_half_blend(uint32_t *out, const uint32_t *blurred, const struct smear_window *half,
                      const struct smear_window *full, int32_t row, int32_t column);

#endif

/* SPDX-License-Identifier: MIT */
/* half.h - a window at half the size: colour, depth and velocity of 2 x 2 pixels each; and the way back.
 *
 * A filter runs in it as in any window, on a quarter of the pixels, with half the reach. Its result goes over
 * the whole frame by how fast each pixel moves: what stands still and is not touched by the blur keeps all
 * its detail, bit for bit; where the blur changes it, it gets the change; what moves gets the blur, and keeps
 * of the detail within 2 x 2 pixels what lies across its motion. */
#ifndef SMEAR_HALF_H
#define SMEAR_HALF_H

#include "raster/window.h"

/* Fills tile `column` of tile row `row` from the window of the whole frame: mean colour (of linear light, or
 * of codes), the depth and the velocity of the nearest. */
void smear_half_reduce(const struct smear_window *half, const struct smear_window *full, int32_t row,
                       int32_t column, bool linear);

/* Writes the tile of the whole frame to `out`, rows full->tile apart: `blurred` is the
 * tile of half the size, rows half->tile apart. */
void smear_half_blend(uint32_t *out, const uint32_t *blurred, const struct smear_window *half,
                      const struct smear_window *full, int32_t row, int32_t column);

#endif

/* SPDX-License-Identifier: MIT */
/* smooth.h - tiles in which all that can be seen during the exposure moves as one: the sharp picture already holds what
 * passes by, and a mean along each pixel's own way is the blurred one.
 *
 * A surface point at m in the middle of the exposure is at m + v(m) s + b s^2, s from -1/2 to 1/2. With v(m) affine over
 * the tile, what a pixel p sees at time s was at p - v(p) s + (J v - b) s^2 in the middle, J the gradient of v: exact for
 * planes seen under small turns, and for a camera that turns or rolls exact whatever the depth, silhouettes too. */
#ifndef SMEAR_SMOOTH_H
#define SMEAR_SMOOTH_H

#include "mover.h"

/* The motion of a tile. */
struct smear_smooth_field {
    int32_t x, y;               /* displacement from open to close at the tile's middle, q8 px */
    int32_t xx, xy, yx, yy;     /* its change per pixel: of x along x, of x along y ...; q16 */
    int32_t bend_x, bend_y;     /* q8 px: of the way to the middle, times s^2 */
    int32_t reach_x, reach_y;   /* how far from the tile's border pixels may be taken, px */
};

/* Finds the field of the movers of a tile, whose ways are at most `travel` (q8 px) long. False when one of them departs
 * from it by more than `tolerance` (q8 px) where it may be seen. */
bool smear_smooth_fit(struct smear_smooth_field *field, const struct smear_geometry *geometry,
                      const struct smear_mover *mover, uint32_t count, int32_t column, int32_t x0, int32_t y0,
                      int32_t tile, int32_t travel, int32_t tolerance);

/* Where pixels are taken from: the sharp picture, row `first` + i of the frame at offset[i]. */
struct smear_smooth_source {
    const uint32_t *color;
    const uint32_t *offset;
    int32_t first;
};

/* Writes the tile's pixels [x0, x1) x [y0, y1) to `out`, rows `stride` apart: the mean of `taps` (even) places along each
 * pixel's way. All must lie in the source. Returns the samples taken. */
uint32_t smear_smooth_tile(uint32_t *out, int32_t stride, const struct smear_smooth_source *source,
                           const struct smear_smooth_field *field, int32_t x0, int32_t y0, int32_t x1, int32_t y1,
                           int32_t tile, int32_t taps, bool linear);

#endif

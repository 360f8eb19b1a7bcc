/* SPDX-License-Identifier: MIT */
/* smooth.h - tiles in which all that moves during the exposure moves as one: the movers' sharp picture already holds what
 * passes by, and a mean along each pixel's own way, over the still scene, is the blurred one.
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
    uint16_t farthest;          /* depth code that no mover falls below */
};

/* A tile: pixels [x0, x1) x [y0, y1) of the frame. */
struct smear_smooth_area {
    int32_t x0, y0, x1, y1;
    int32_t tile, tile_shift;   /* edge, also of tiles that the frame's border cuts */
};

/* Movers of a tile row. */
struct smear_smooth_list {
    const struct smear_mover *mover;
    uint32_t count;
};

/* Finds the field of the movers of a tile, whose ways are at most `travel` (q8 px) long, and of all that lie where they
 * come from. list[0] is the tile's own row, others are its neighbours. False when a mover departs from the field by more
 * than `tolerance` (q8 px), or when there are too many for the work memory. */
bool smear_smooth_fit(struct smear_smooth_field *field, const struct smear_smooth_area *area,
                      const struct smear_geometry *geometry, const struct smear_smooth_list *list, int lists,
                      int32_t travel, int32_t tolerance, void *work, uint32_t work_bytes);

/* Where pixels are taken from. Movers as they are in the middle of the exposure: row `first` + i of the frame at offset[i],
 * depth and colour 0 where there is none. The still scene from the tile's first pixel on, rows `stride` apart. */
struct smear_smooth_source {
    const uint32_t *color;
    const uint16_t *depth;
    const uint32_t *offset;
    int32_t first;
    const uint32_t *still;
    const uint16_t *still_depth;
    int32_t stride;
};

/* Writes the tile's pixels to `out`, rows a tile apart. Where all have one way and no still surface lies before a mover: the
 * mean along it by sums that slide, whatever its length. Else the mean of `taps` places (2 .. 64) along each pixel's own
 * way, by depth. All must lie in the source, within the field's reach of the tile. Returns the samples taken. */
uint32_t smear_smooth_tile(uint32_t *out, const struct smear_smooth_source *source,
                           const struct smear_smooth_field *field, const struct smear_smooth_area *area, int32_t taps,
                           bool linear);

#endif

/* SPDX-License-Identifier: MIT */
/* sharp.h - tile rows of the sharp instant, which other methods build on. */
#ifndef SMEAR_SHARP_H
#define SMEAR_SHARP_H

#include "display/damage.h"
#include "ports/camera_velocity.h"

/* How drawn rows get velocities for what does not move itself, from depth and two cameras; or null. */
struct smear_depth_velocity {
    struct smear_reprojection reprojection;
    int32_t step;               /* smear_filter.camera_step */
};

/* Draws opaque triangles of tile row `row` into the window: colour, depth and, where the method reads them,
 * velocities. */
void smear_sharp_draw_row(struct smear_rows *rows, int row, const struct smear_depth_velocity *by_depth);

/* Draws, converts and hands out the tile rows [first, end), a part of the frame that has been assembled. `direct`: as
 * the display's own pixels, straight into the band. Of frames that `damage` compares, tiles that the display lacks, by way of the
 * window. Returns as smear_band_flush. */
int smear_sharp_rows(struct smear_rows *rows, struct smear_damage *damage, bool direct, int first, int end);

/* Whether frames of the context can be drawn directly; draws may still forbid it. */
bool smear_sharp_may_be_direct(const smear_desc *desc, bool has_window);

#endif

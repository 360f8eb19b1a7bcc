/* SPDX-License-Identifier: MIT */
/* lane_carried.h - triangles of copied texels that go on in the next rows, as kernels take them. */
#ifndef SMEAR_LANE_CARRIED_H
#define SMEAR_LANE_CARRIED_H

#include "kernels/corners.h"
#include "kernels/texel_rows.h"
#include "raster/texture_rows.h"

#if SMEAR_LANE_ROWS
/* What rows of copied texels need of a triangle, from row y on, in place of its setup. */
struct texel_carried {
    int32_t y;
    uint32_t z, dz, dz_down;    /* depth codes 16.16 at column 0 of row y, and their steps */
    bool curved;
    union {
        struct texel_curves curves;
        struct texel_planes planes;
    } at;                       /* row 0 is row y */
};

/* Makes that of row y of a triangle which smear_lane_rows_choose() has found rows for; false where they need more than this.
 * `cut`: the target's columns may cut rows off. */
bool smear_lane_carry(struct texel_carried *c, const struct setup *s, int32_t y, bool cut);

/* Draws the target's rows [corners->first, corners->end), none of them above row y, which becomes the last ones' first. */
void smear_lane_carried(struct texel_carried *c, const struct smear_raster_target *target, const struct smear_sampler *sampler,
                        const struct corners *corners, int32_t width);
#endif

#endif

/* SPDX-License-Identifier: MIT */
/* lane_carried.h - triangles of copied texels that go on in the next rows, as kernels take them. */
#ifndef SMEAR_LANE_CARRIED_H
#define SMEAR_LANE_CARRIED_H

#include "kernels/row_sides.h"
#include "kernels/texel_rows.h"
#include "raster/texture_rows.h"

#if SMEAR_LANE_ROWS
/* What rows of copied texels need of a triangle, from the row of its sides on, in place of its setup. */
struct texel_carried {
    struct carried_sides sides;
    uint32_t z, dz, dz_down;    /* depth codes 16.16 at column 0 of that row, and their steps */
    union {
        struct texel_curves curves;
        struct texel_planes planes;
    } at;                       /* row 0 is that row */
};

/* Whether rows that smear_lane_rows_choose() has found for a triangle need no more than this. `cut`: the target's columns may cut
 * them off. Then makes that of row y: returns whether they are by curves, else by places. */
bool smear_lane_carries(const struct setup *s, bool cut);
bool smear_lane_carry(struct texel_carried *c, const struct setup *s, int32_t y);

/* Draw the target's rows [y, end) in a frame of `width` columns, none of them above the row of sides, which goes on to them. */
void smear_lane_curves_on(struct texel_carried *c, const struct smear_raster_target *target, const struct smear_sampler *m, int32_t y,
                          int32_t end, int32_t width);
void smear_lane_places_on(struct texel_carried *c, const struct smear_raster_target *target, const struct smear_sampler *m, int32_t y,
                          int32_t end, int32_t width);
#endif

#endif

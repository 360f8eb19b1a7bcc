/* SPDX-License-Identifier: MIT */
/* subframe_gap.h - means of some tiles' sums, over the gap between one instant and the next. */
#ifndef SMEAR_SUBFRAME_GAP_H
#define SMEAR_SUBFRAME_GAP_H

#include "temporal/subframe_tile.h"
#include "temporal/subframes.h"

struct smear_tile_plan;

/* Puts means in place of the background where anything was summed, which is within `all`. Gaps are closed as the plan's
 * blocks say, unless it is null. */
void smear_subframe_average(const struct subframes *f, const struct subframe_box *all, const struct smear_tile_plan *plan);

#endif

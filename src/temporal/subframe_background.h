/* SPDX-License-Identifier: MIT */
/* subframe_background.h - what does not move in some tiles, as it is copied into their work planes. */
#ifndef SMEAR_SUBFRAME_BACKGROUND_H
#define SMEAR_SUBFRAME_BACKGROUND_H

#include "kernels/depth_range.h"
#include "temporal/subframe_tile.h"

/* Copies its colours and depths. */
void smear_subframe_take_background(const struct subframes *f);

/* Copies its depths in a box and, where tiles begin with whole words, perhaps one pixel more to either side. */
void smear_subframe_restore_depth(const struct subframes *f, const struct subframe_box *b);

/* The range of its depth codes in a box of the work planes, and up to `margin` pixels beyond. */
struct depth_range smear_subframe_depths(const struct subframes *f, const struct subframe_box *b, int32_t margin);

#endif

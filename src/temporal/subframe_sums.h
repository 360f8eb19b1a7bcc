/* SPDX-License-Identifier: MIT */
/* subframe_sums.h - sums of some tiles over instants. */
#ifndef SMEAR_SUBFRAME_SUMS_H
#define SMEAR_SUBFRAME_SUMS_H

#include "temporal/subframe_tile.h"

/* The first instant sets the sums of its box, which need not be emptied. */
static inline bool sums_are_set(const struct subframes *f) { return PACKED_SETS && !sums_light(f) && !f->blends; }

/* Empties the sums wherever they will be read, but for those in the box that the first instant sets. */
void smear_subframe_sums_clear(const struct subframes *f, const struct subframe_box *set);

/* Brings sums of the light of `before` instants to what f->instants add, both at most LIGHT_WHOLE: by bits that are 0. */
void smear_subframe_sums_rescale(const struct subframes *f, uint32_t before);

/* Adds the box of instant k to the sums, or sets them, and makes its colours background again. */
void smear_subframe_sums_add(const struct subframes *f, const struct subframe_box *box, uint32_t k, bool sets);

#endif

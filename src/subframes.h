/* SPDX-License-Identifier: MIT */
/* subframes.h - a tile's own moving triangles drawn again at several instants. */
#ifndef SMEAR_SUBFRAMES_H
#define SMEAR_SUBFRAMES_H

#include "mover.h"

/* Bytes of work memory per worker for tiles of this edge. */
size_t smear_subframes_work(int32_t tile);

/* The mean of `instants` (1 .. 1024) sharp instants at the middles of slots of equal weight. Still opaque surfaces are
 * taken from `still`; movers and all blended draws are drawn at every instant. Returns the samples taken. */
uint32_t smear_subframes_tile(const struct smear_moving_tile *t, int32_t instants);

#endif

/* SPDX-License-Identifier: MIT */
/* subframes.h - the moving triangles of some tiles drawn again at several instants. */
#ifndef SMEAR_SUBFRAMES_H
#define SMEAR_SUBFRAMES_H

#include "kernels/light_sums.h"
#include "temporal/moving.h"

/* Instants of which codes add up in 16 bits: without SMEAR_WITH_LINEAR there are no more. */
enum {
    SMEAR_PACKED_INSTANTS = PACKED_INSTANTS_MAX,
    SMEAR_SUBFRAMES_MOST = SMEAR_WITH_LINEAR ? (int)LIGHT_INSTANTS_MAX : (int)PACKED_INSTANTS_MAX
};

/* How all moving triangles of a tile go on from one instant to the next, nearly, in 1/16 px. */
struct smear_step {
    int16_t x, y;
};

/* Returns the bytes of work memory per worker for tiles that are `width` pixels wide together, and `height` high. */
size_t smear_subframes_work(int32_t width, int32_t height);

struct smear_tile_plan;

/* Writes the mean of `instants` (1 .. 1024) sharp instants, which stand in the middles of sub-intervals of equal weight.
 * Static opaque surfaces come from the background; moving triangles and all blended draws are drawn at every instant.
 * With a plan (tile_method.h), not null, it is asked how many there are when the middle one is drawn, and gaps between
 * instants are closed, unless something is blended there. Where the row's triangles do not find room at once, t->moving and
 * t->blend are others afterwards. Returns the samples taken. */
uint32_t smear_subframes_tiles(struct smear_tile_run *t, int32_t instants, const struct smear_tile_plan *plan);

/* Finds depths in the middle of the exposure of what is opaque, of columns [x0, x1) of the tiles, when their pixels are done.
 * Returns them, in the work memory, in rows like those of `out`. */
uint16_t *smear_subframes_depth(const struct smear_tile_run *t, int32_t x0, int32_t x1);

#endif

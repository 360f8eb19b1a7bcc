/* SPDX-License-Identifier: MIT */
/* timemask.h - a tile blurred by the time each moving triangle covers each pixel. */
#ifndef SMEAR_TIMEMASK_H
#define SMEAR_TIMEMASK_H

#include "temporal/moving.h"

/* Bytes of work memory per worker: 7.4 kB, whatever the tile. */
size_t smear_timemask_work(int32_t tile);

struct smear_timemask_settings {
    int32_t samples;            /* 8, 16 or 32 */
    int32_t curvature;               /* q8 px: an edge may be off by this much where paths are
                                 * bent; else the shutter is split */
    int32_t edge;               /* what an edge may err where it turns: 2^-edge px of contrast
                                 * squared, per px of its length */
    int32_t tap;                /* q8 px of travel per texel taken along it, at least 1 */
};

/* Draws a tile of opaque moving triangles that have paths on the screen: what else there is, is for subframes.h. Returns the
 * fragments taken. */
uint32_t smear_timemask_tile(const struct smear_tile_run *t, const struct smear_timemask_settings *settings);

#endif

/* SPDX-License-Identifier: MIT */
/* streak.h - a group of draws blurred along one velocity, over the background: the two-camera approach with known
 * coverage and depth. */
#ifndef SMEAR_STREAK_H
#define SMEAR_STREAK_H

#include "layers/layer.h"

/* A velocity as lines of pixels along it, one pixel per step of its longer axis. A difference of two sums
 * along a line is the mean around each of its pixels, whatever the length. */
struct smear_streak {
    bool upright;               /* steps go down, not right */
    int32_t slope;              /* of the other axis, q16, within -1 .. 1 */
    int32_t half;               /* whole pixels on both sides of the middle one */
    uint32_t inner, rest;       /* the weight of a pixel beyond the whole ones is `rest`, of a whole one inner + rest,
                                 * a power of two */
    uint32_t length;            /* sum of the weights, 128 .. 256 */
    uint32_t over;              /* 2^22 / length, rounded up */
    int32_t node;               /* log2 of the steps from one node to the next: means are taken there and mixed
                                 * between */
    int32_t reach_x, reach_y;   /* px from a pixel to the farthest that its mean takes */
};

/* Returns half the length of the longest streak, px. */
static inline int32_t streak_half_max(int32_t width)
{
    return clamp_i32(width >> 2, 16, 120);
}

/* Makes the streak of a displacement in q8 px. One that is longer than `half_max` on both sides, or reaches more than
 * `reach` rows up and down, is shortened. */
void smear_streak_make(struct smear_streak *s, int32_t vx, int32_t vy, int32_t half_max, int32_t reach);

/* Returns the bytes of work memory per worker for tiles of this edge. */
size_t smear_streak_work(int32_t tile);

/* Merges the area; returns how many pixels it went over. */
uint32_t smear_streak_merge(const struct smear_streak *s, const struct smear_layer_area *a);

#endif

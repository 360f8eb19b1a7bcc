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

/* What a streak is made of, and where it is merged. */
struct smear_streak_area {
    const uint32_t *color;      /* rows of the group (layer.h): columns [x0, x1) are drawn */
    const uint16_t *depth;
    int32_t stride, x0, x1, rows, tile;
    const int16_t *row_first, *row_end;     /* the columns of each row within which something is drawn */
    int32_t top;                /* the first row to be finished */
    int32_t margin;             /* the frame's first column */
    uint32_t *background;       /* first pixel of the frame's row to be finished */
    uint16_t *background_depth;
    int32_t background_stride;
    /* Groups pass through each other in columns [mixed0, mixed1) of the group's planes. `over` has what was merged
     * there before (colours times coverage, coverage in the top byte), `over_depth` about its depth codes; their
     * rows are those of the frame. */
    uint32_t *over;
    uint16_t *over_depth;
    int32_t mixed0, mixed1;
    bool marks;                 /* groups are merged after this one: it writes both */
    uint32_t marked_from;       /* the groups after this one have no depth codes below this */
    int32_t left, right, height;            /* columns and rows of the frame to be finished */
    uint32_t nearest, farthest; /* depth codes that the group keeps to; beyond all codes where it lies over all */
    void *work;                 /* smear_streak_work() */
    bool linear;
};

/* Returns the bytes of work memory per worker for tiles of this edge. */
size_t smear_streak_work(int32_t tile);

/* Merges the area; returns how many pixels it went over. */
uint32_t smear_streak_merge(const struct smear_streak *s, const struct smear_streak_area *a);

#endif

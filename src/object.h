/* SPDX-License-Identifier: MIT */
/* object.h - a group of draws blurred along one velocity, over the still scene: the two-camera approach with known
 * coverage and depth. */
#ifndef SMEAR_OBJECT_H
#define SMEAR_OBJECT_H

#include "fixed.h"

/* A velocity as lines of pixels along it, one pixel per step of its longer axis: a sum that slides along a line gives
 * the mean around each of its pixels, whatever the length. */
struct smear_streak {
    bool upright;               /* steps go down, not right */
    int32_t slope;              /* of the other axis, q16, within -1 .. 1 */
    int32_t half;               /* whole pixels on both sides of the middle one, at most SMEAR_STREAK_HALF */
    uint32_t rest;              /* share of the ones beyond, q8 */
    uint32_t length;            /* q8 px */
    uint32_t over;              /* 2^30 / length, rounded up */
    int32_t reach_x, reach_y;   /* px from a pixel to the farthest that its mean takes */
};

/* Sums of codes fit 16 bits. */
enum { SMEAR_STREAK_HALF = 127 };

/* Of a displacement in q8 px; what is too long, or reaches more than `reach` rows up and down, is shortened. */
void smear_streak_make(struct smear_streak *s, int32_t vx, int32_t vy, int32_t reach);

/* Where a streak is merged. */
struct smear_streak_area {
    const uint32_t *color;      /* rows of the group (layer.h): columns [x0, x1) are drawn, nothing lies beyond */
    const uint16_t *depth;
    int32_t stride, x0, x1, rows;
    int32_t top;                /* which of them is the first to be finished */
    int32_t margin;             /* and which column is the frame's first */
    uint32_t *still;            /* first pixel of the frame's row to be finished */
    const uint16_t *still_depth;
    int32_t still_stride;
    int32_t left, right, height;        /* columns and rows of the frame to be finished */
    uint16_t nearest, farthest; /* depth codes the group keeps to */
    const int32_t *offset, *still_offset;
    bool linear;
};

/* Fills the tables of an area: `offset` of every step along a line, from its start, and `still_offset` in the still
 * rows; as many as there are columns, or rows. */
void smear_streak_tables(const struct smear_streak *s, const struct smear_streak_area *a, int32_t *offset,
                         int32_t *still_offset);

/* Merges. Returns the pixels it went over. */
uint32_t smear_streak_merge(const struct smear_streak *s, const struct smear_streak_area *a);

#endif

/* SPDX-License-Identifier: MIT */
/* subframe_pose.h - a triangle of some tiles at an instant. */
#ifndef SMEAR_SUBFRAME_POSE_H
#define SMEAR_SUBFRAME_POSE_H

#include "temporal/subframe_tile.h"

/* A triangle with its vertices at an instant. */
struct posed {
    const struct smear_segment *segment;
    uint32_t color;
    const int32_t *v[3];        /* `record`, or the vertices themselves where they do not move */
    struct bounds bounds;       /* of the vertices */
    struct subframe_box box;       /* within the tiles */
    int count, next;            /* corners of what was cut (space.h), and the next one of its fan */
    struct path_record record[SMEAR_CLIP_MAX];          /* without paths, which come last */
};

/* False where the triangle is not seen in the tiles at this time, 0 .. SHUTTER_CLOSE: elsewhere, or turned away. */
bool smear_subframe_pose(struct posed *p, const struct subframes *f, uint32_t triangle, int32_t time);

/* Goes on to the next triangle that is left of one that was cut. False where there is none. */
bool smear_subframe_pose_next(struct posed *p, const struct subframes *f);

#endif

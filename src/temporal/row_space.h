/* SPDX-License-Identifier: MIT */
/* row_space.h - how triangles with paths in space (geometry/space.h) move from place to place of the middle of the exposure. */
#ifndef SMEAR_ROW_SPACE_H
#define SMEAR_ROW_SPACE_H

#include "geometry/space.h"

/* Values that change evenly from pixel to pixel: `at` the pixel that is looked at, and by how much per step to the right and
 * down. */
struct smear_even {
    int64_t at, right, down;
};

/* A plane in the middle of the exposure and where its pixels come from and go: a homography to open and one to close. Values of
 * each group have one factor of their own, which their quotients lose. */
struct smear_plane_motion {
    struct smear_even side[3];          /* how far inside of each side: none is below 0 on the triangle */
    struct smear_even pose[2][3];       /* X, Y, W at open and at close */
    int32_t depth[3];                   /* of the vertices of an orthographic camera, q11 >> 14 */
    int32_t nearness, nearness_shift;   /* else: from the sum of the sides to that of a pixel */
    bool is_even;                       /* orthographic */
    int32_t width, height, coarse;
};

/* Where a pixel of the plane goes: its displacement from open to close, and how far the path's middle lies off the chord,
 * twice, all 1/16 px; and its depth, as blocks have it. */
struct smear_place_motion {
    int32_t x, y, bend;
    uint16_t depth;
};

enum { PLACE_UNKNOWN = INT16_MAX };     /* bend of what comes from behind the eye or goes there, without a displacement */

/* Finds the motion of a triangle's plane from the middle of pixel (x, y) on, in steps of `step` pixels. False where it is not
 * seen in the middle of the exposure. */
bool smear_plane_motion_make(struct smear_plane_motion *m, struct smear_space *space, const int32_t *const record[3],
                             int32_t x, int32_t y, int32_t step);

/* Goes on by a step to the right, or down. */
void smear_plane_motion_right(struct smear_plane_motion *m);
void smear_plane_motion_down(struct smear_plane_motion *m);

/* Finds the motion at a pixel, which lies at (x, y). False where the triangle does not cover it in the middle of the exposure. */
bool smear_plane_motion_at(struct smear_place_motion *out, const struct smear_plane_motion *m, int32_t x, int32_t y);

#endif

/* SPDX-License-Identifier: MIT */
/* space.h - triangles that no parabola on the screen follows.
 *
 * A vertex whose distance from the eye hardly changes moves along a parabola on the screen (path.h). One that passes the near
 * plane, or comes nearer by a large part of its distance, does not: it has a path in space. Its record keeps three places
 * before the division, and between them it moves along the parabola through those, which is exact for all that goes straight; where
 * the camera turns far, along the arc, which is exact for what stands still before a camera that does nothing else: with t the turn to
 * either side and u the phase, middle + (close - open) / 2 sin(t u) / sin t + (open + close - 2 middle) / 2 (1 - cos(t u)) / (1 - cos t).
 * A triangle with such a vertex is cut at the planes and divided at each instant anew.
 *
 * Its vertices that have a path on the screen keep that besides, and are there where it is seen whole: where they are for
 * triangles beside it, so that no gap opens. */
#ifndef SMEAR_SPACE_H
#define SMEAR_SPACE_H

#include "geometry/clip.h"
#include "geometry/path.h"

/* What the paths in space of a segment share. A place is X, Y, W in the segment's scale; before an orthographic camera X, Y and a W that
 * is one unit in a scale of their own (flat_depth), and the distance in the segment's. */
struct smear_space {
    const struct smear_segment *segment;
    struct smear_depths depths;
    struct smear_viewport viewport;
    uint32_t seen;                      /* draws that smear_subframe_pose found in the tiles, a bit for each */
    uint32_t turn;                      /* smear_shot.turn */
    int32_t phase, along, bent;         /* of the phase that was asked for last, q16: smear_space_at */
};

void smear_space_make(struct smear_space *space, const struct smear_bins *g, const struct smear_segment *s, int32_t width,
                      int32_t height);

/* Brings a place from the scales of a projection to that of the space, 2^up times as large. */
void smear_space_scale(struct smear_homogeneous *h, int up, int distance_up);

/* Stores the three places of a vertex. */
void smear_space_store(uint32_t *record, const struct smear_segment *s, const struct smear_homogeneous *open,
                       const struct smear_homogeneous *middle, const struct smear_homogeneous *close);

/* Words of a path on the screen, behind the record of a vertex that has one in space, too: in the middle, at open, at close. */
enum { SCREEN_PATH_WORDS = 3 * PATH_POSE_WORDS };

/* Words that a triangle takes besides its records: one of its vertices at least has no path on the screen. */
enum { SPACE_ROOM = 2 * SCREEN_PATH_WORDS };

/* Returns how much farther than a parabola's the lines along the path at its ends meet from the middle, q14. */
int32_t smear_space_bulge(const struct smear_space *space);

/* Finds the place of a vertex at a phase of the exposure (path_phase). */
void smear_space_at(struct smear_homogeneous *h, struct smear_space *space, const int32_t *record, int32_t phase);

/* Finds the corners of what is seen of a triangle at a phase, in the triangle's order, as records without paths: returns how
 * many there are, 0 to SMEAR_CLIP_MAX. `in_space`: the vertices that have no path on the screen, a bit for each; `shift`: of the
 * others along x and y, q8 px, where their way leaves it. */
int smear_space_pose(struct path_record out[SMEAR_CLIP_MAX], struct smear_space *space, const int32_t *const record[3],
                     unsigned in_space, int32_t phase, const int32_t shift[2]);

#endif

/* SPDX-License-Identifier: MIT */
/* clip.h - cuts a triangle at the near and far plane and at the guard band, in homogeneous space. */
#ifndef SMEAR_CLIP_H
#define SMEAR_CLIP_H

#include "transform.h"

/* Values in use; an array has room for one at least. */
enum {
    CLIP_POSES = SMEAR_WITH_RECONSTRUCT || SMEAR_WITH_SUBFRAMES ? 2 : 0,
    CLIP_COLORS = SMEAR_WITH_GOURAUD ? 4 : 0
};
#define CLIP_ROOM(count) ((count) > 0 ? (count) : 1)

/* All that is interpolated along a cut edge. Poses other than the present one are cut at the same place of
 * the surface, so that velocities stay right up to the near plane. */
struct smear_clip_vertex {
    struct smear_homogeneous now;
    struct smear_homogeneous pose[CLIP_ROOM(CLIP_POSES)];   /* open, close: each in its own
                                                             * projection's scale */
    int32_t uv[2];                                          /* mesh units */
    int32_t color[CLIP_ROOM(CLIP_COLORS)];                  /* 0 .. 65535 */
};

/* A triangle cut by six planes has at most nine corners. Cut in three poses,
 * it may have more, of which none is likely. */
#define SMEAR_CLIP_MAX (SMEAR_WITH_SUBFRAMES ? 12 : 9)

/* Clips the convex polygon vertex[0 .. count-1] in place; returns how many corners it has then, 0 when
 * nothing is left. `codes` is the union of the three outcodes: only those planes are looked at. The first
 * `poses` of a vertex's poses are in use. An edge is always cut from its inner towards its outer end, so two
 * triangles that share it get the same new vertex, bit for bit. */
int smear_clip_polygon(struct smear_clip_vertex vertex[SMEAR_CLIP_MAX], int count,
                       const struct smear_projection *projection, int codes, int poses);

#endif

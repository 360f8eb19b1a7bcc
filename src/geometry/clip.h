/* SPDX-License-Identifier: MIT */
/* clip.h - cuts a triangle at the near and far plane and at the guard band, in homogeneous space. */
#ifndef SMEAR_CLIP_H
#define SMEAR_CLIP_H

#include "geometry/transform.h"

/* How many poses and colour channels are in use. */
enum {
    CLIP_POSES = SMEAR_WITH_RECONSTRUCT ? 2 : 0,
    CLIP_COLORS = SMEAR_WITH_GOURAUD ? 4 : 0
};
/* Arrays have room for one at least. */
#define CLIP_ROOM(count) ((count) > 0 ? (count) : 1)

/* All that is interpolated along a cut edge: words, of which a polygon has the first ones. Poses other than the present one are cut
 * at the same place of the surface, so that velocities stay right up to the near plane. */
struct smear_clip_vertex {
    struct smear_homogeneous now;
    int32_t uv[2];                                          /* mesh units; 0 where there is no texture */
    int32_t color[CLIP_ROOM(CLIP_COLORS)];                  /* 0 .. 65535; 0 where there is none */
    struct smear_homogeneous pose[CLIP_ROOM(CLIP_POSES)];   /* open, close; each in its own projection's scale */
};

/* A triangle cut by six planes has at most nine corners. */
#define SMEAR_CLIP_MAX 9

/* The triangle's own vertices stay where they are; a cut makes two corners before those outside it are given up. */
#define SMEAR_CLIP_ROOM (3 + SMEAR_CLIP_MAX + 2)

/* A convex polygon: its corners are vertex[order[0]], vertex[order[1]] ... Nothing is moved when a corner goes. */
struct smear_clip_polygon {
    int count;
    uint8_t words;              /* of a vertex that are in use */
    uint8_t order[SMEAR_CLIP_MAX];
    struct smear_clip_vertex vertex[SMEAR_CLIP_ROOM];
};

static inline struct smear_clip_vertex *clip_corner(struct smear_clip_polygon *p, int i)
{
    return &p->vertex[p->order[i]];
}

/* Starts with the triangle of vertex[0 .. 2], which the caller fills in. */
void smear_clip_start(struct smear_clip_polygon *p, int poses, bool colored);

/* Clips the polygon; `count` is 0 when nothing is left. `codes` is the union of the outcodes of its corners: only
 * those planes are looked at. An edge is always cut from its inner towards its outer end, so two triangles
 * that share it get the same new vertex, bit for bit. */
void smear_clip_polygon(struct smear_clip_polygon *p, const struct smear_depths *depths, int codes);

/* Finds where the corners are on the screen. Those that are vertices of the triangle stay at `place`, where they are for
 * triangles beside it; null: that is not known. */
static inline void clip_project(struct smear_screen out[SMEAR_CLIP_MAX], struct smear_clip_polygon *p,
                                const struct smear_screen *const place[3],
                                const struct smear_depths *depths, const struct smear_viewport *viewport)
{
    for (int i = 0; i < p->count; i++) {
        const int corner = p->order[i];
        if (corner < 3 && place[corner] != NULL) {
            out[i] = *place[corner];
            continue;
        }
        smear_project(&out[i], depths, &p->vertex[corner].now, viewport);
        screen_clamp(&out[i], viewport);
    }
}

#endif

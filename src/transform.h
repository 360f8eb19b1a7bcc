/* SPDX-License-Identifier: MIT */
/* transform.h - a vertex from mesh steps to the screen. */
#ifndef SMEAR_TRANSFORM_H
#define SMEAR_TRANSFORM_H

#include "matrix.h"

/* Positions on the screen stay within 2048 px of its centre: triangles that reach further are clipped. Edges are then
 * at most 2^20 steps of q8 long, which the exact edge walk of raster.c relies on. */
#define SMEAR_GUARD_PX 2048

/* Depth units in q11 of every vertex that is drawn: the near plane, and two units for all that is too far to tell
 * apart. The margins keep planes of triangles from leaving 0 .. 65535 by rounding (raster.c). */
#define SMEAR_DEPTH_MAX ((int32_t)(SMEAR_DEPTH_NEAR * 2048u))
#define SMEAR_DEPTH_MIN 4096

/* Where a vertex lies. A triangle whose vertices share a bit is not seen. */
enum {
    OUT_LEFT = 1, OUT_RIGHT = 2, OUT_TOP = 4, OUT_BOTTOM = 8,
    OUT_NEAR = 16, OUT_FAR = 32,
    OUT_GUARD = 64          /* not a reason to reject: needs clipping */
};
#define OUT_REJECT (OUT_LEFT | OUT_RIGHT | OUT_TOP | OUT_BOTTOM | OUT_NEAR | OUT_FAR)
#define OUT_CLIP (OUT_NEAR | OUT_FAR | OUT_GUARD)

/* Homogeneous position in a projection's scale. */
struct smear_homogeneous {
    int32_t x, y, w;
    int32_t distance;       /* w for perspective */
};

struct smear_screen {
    i32q8 x, y;             /* from the top left corner of the frame */
    i32q11 depth;           /* units: proportional to 1/w for perspective */
};

struct smear_viewport {
    int32_t width, height;  /* pixels */
};

static inline int32_t transform_row(const int32_t m[4], const int16_t v[3])
{
    return mul_i16_q16(v[0], m[0]) + mul_i16_q16(v[1], m[1]) + mul_i16_q16(v[2], m[2]) + m[3];
}

static inline void smear_transform_vertex(struct smear_homogeneous *out,
                                          const struct smear_projection *p, const int16_t v[3])
{
    out->x = transform_row(p->m[0], v);
    out->y = transform_row(p->m[1], v);
    out->w = transform_row(p->m[2], v);
    out->distance = p->orthographic ? transform_row(p->m[3], v) : out->w;
}

/* Divides. w > 0 is promised; the result is clamped far outside the guard band. */
void smear_project(struct smear_screen *out, const struct smear_projection *p,
                   const struct smear_homogeneous *in, const struct smear_viewport *viewport);

/* The sides a projected vertex lies beyond. */
static inline int outcode_sides(const struct smear_screen *s, const struct smear_viewport *viewport)
{
    int code = 0;
    if (s->x < 0)
        code |= OUT_LEFT;
    if (s->x > viewport->width << 8)
        code |= OUT_RIGHT;
    if (s->y < 0)
        code |= OUT_TOP;
    if (s->y > viewport->height << 8)
        code |= OUT_BOTTOM;
    if (code != 0) {
        int32_t dx = s->x - (viewport->width << 7), dy = s->y - (viewport->height << 7);
        const int32_t guard = SMEAR_GUARD_PX << 8;
        if (dx < -guard || dx > guard || dy < -guard || dy > guard)
            code |= OUT_GUARD;
    }
    return code;
}

#endif

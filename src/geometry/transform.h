/* SPDX-License-Identifier: MIT */
/* transform.h - a vertex from mesh steps to the screen. */
#ifndef SMEAR_TRANSFORM_H
#define SMEAR_TRANSFORM_H

#include "base/fixmath.h"
#include "geometry/matrix.h"
#include "kernels/places.h"

/* Homogeneous position in a projection's scale. */
struct smear_homogeneous {
    int32_t x, y, w;
    int32_t distance;       /* w for perspective */
};

/* Positions on the screen stay within 2048 px of its centre: triangles that reach further are clipped. Edges
 * are then at most 2^20 steps of q8 long, which the exact edge walk of raster.c relies on. */
#define SMEAR_GUARD_PX 2048

/* Depth units in q11 of every vertex that is drawn: the near plane, and two units for all that is too far to
 * tell apart. The margins keep planes of triangles from leaving 0 .. 65535 by rounding (raster.c). */
#define SMEAR_DEPTH_MAX ((int32_t)(SMEAR_DEPTH_NEAR * 2048u))
#define SMEAR_DEPTH_MIN 4096

/* Where a vertex lies. A triangle whose vertices share a bit is not seen. */
enum {
    OUT_LEFT = 1, OUT_RIGHT = 2, OUT_TOP = 4, OUT_BOTTOM = 8,
    OUT_NEAR = 16, OUT_FAR = 32,
    OUT_GUARD = 64,         /* not a reason to reject: needs clipping */
    OUT_UNKNOWN = 128       /* no such vertex */
};
#define OUT_REJECT (OUT_LEFT | OUT_RIGHT | OUT_TOP | OUT_BOTTOM | OUT_NEAR | OUT_FAR)
#define OUT_CLIP (OUT_NEAR | OUT_FAR | OUT_GUARD)

static inline void homogeneous_add(struct smear_homogeneous *sum, const struct smear_homogeneous *term)
{
    sum->x += term->x;
    sum->y += term->y;
    sum->w += term->w;
    sum->distance += term->distance;
}

struct smear_viewport {
    int32_t width, height;  /* pixels */
};

/* Returns a row of struct smear_projection for a vertex in steps of 2^-up. Without a wide multiply, the two halves of the factors are
 * summed one by one: the lower ones have 14 bits, so three products fit. */
static inline int32_t transform_row(const int32_t m[4], const int16_t v[3], int up)
{
    const int high_up = SMEAR_HAS_MUL64 ? up + 16 : up;     /* a sum's high word takes no shift */
    const int32_t x = shl_wrap(v[0], high_up), y = shl_wrap(v[1], high_up), z = shl_wrap(v[2], high_up);
    if (SMEAR_HAS_MUL64)
        return (int32_t)(((uint64_t)((int64_t)x * m[0]) + (uint64_t)((int64_t)y * m[1]) + (uint64_t)((int64_t)z * m[2])) >> 32) + m[3];
    uint32_t high = (uint32_t)(x * (m[0] >> 16)) + (uint32_t)(y * (m[1] >> 16)) + (uint32_t)(z * (m[2] >> 16));
    int32_t low = x * (int32_t)((uint32_t)m[0] << 16 >> 18) + y * (int32_t)((uint32_t)m[1] << 16 >> 18)
                + z * (int32_t)((uint32_t)m[2] << 16 >> 18);
    return (int32_t)(high + (uint32_t)(low >> 14)) + m[3];
}

static inline void transform_inline(struct smear_homogeneous *out, const struct smear_projection *p, const int16_t v[3])
{
    out->x = transform_row(p->m[0], v, p->depths.up);
    out->y = transform_row(p->m[1], v, p->depths.up);
    out->w = transform_row(p->m[2], v, p->depths.up);
    out->distance = is_orthographic(p) ? transform_row(p->m[3], v, p->depths.up) : out->w;
}

/* Does what transform_inline does, as a call. */
void smear_transform_vertex(struct smear_homogeneous *out, const struct smear_projection *p, const int16_t v[3]);

/* Returns a r 2^shift with r = 2^61 / m in [2^29, 2^30]. The high product comes first, so only the last bits are lost. */
static inline int32_t times_recip(int32_t a, uint32_t r, int shift)
{
    int32_t high = mulh_i32(a, (int32_t)r);
    if (shift < 0 && shift > -32)
        return (high + (1 << (-shift - 1))) >> -shift;      /* |high| < 2^30: no overflow */
    return scale_sat(high, clamp_i32(shift, -31, 31));
}

/* Returns the depth, q11, of a distance from an orthographic camera. */
static inline int32_t depth_even(const struct smear_depths *d, int32_t distance)
{
    return times_recip(sub_wrap(d->far_distance, distance), (uint32_t)d->depth_mantissa, d->depth_shift);
}

/* Divides a position by its w, which must be positive. |x| and |y| of the result stay below 2^30, far outside the guard
 * band: sums of two fit. */
void smear_project(struct smear_screen *out, const struct smear_depths *d, const struct smear_homogeneous *in,
                   const struct smear_viewport *viewport);

/* Does what smear_project does, without a call for what a camera with a perspective mostly sees. */
static inline void project_inline(struct smear_screen *out, const struct smear_depths *d,
                                  const struct smear_homogeneous *in, const struct smear_viewport *viewport)
{
    SMEAR_ASSERT(in->w > 0 && d->coarse == 0);
    int zeros = count_leading_zeros((uint32_t)in->w);
    const int down = 21 - zeros;
    if (down <= 0 || depths_are_even(d)) {
        const struct smear_homogeneous copy = *in;      /* elsewhere it is in registers */
        smear_project(out, d, &copy, viewport);
        return;
    }
    const int32_t r = (int32_t)recip_norm((uint32_t)in->w << zeros);        /* 1/w = r 2^(zeros - 61) */
    /* x r / 2^32 = x/w 2^(29 - zeros); q8 wants 2^8. */
    const int32_t half = 1 << (down - 1);
    out->x = (viewport->width << 7) + ((mulh_i32(in->x, r) + half) >> down);
    out->y = (viewport->height << 7) + ((mulh_i32(in->y, r) + half) >> down);
    const int up = d->depth_shift + zeros;
    int32_t depth = mulh_i32(d->depth_mantissa, r);
    if (up != 0)
        depth = scale_sat(depth, clamp_i32(up, -31, 31));
    out->depth = clamp_i32(depth, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX);
}

/* Returns the sides of a vertex that has no place on the screen: those of the planes through the eye and the frame's
 * borders that it lies beyond. All that lies beyond one of them is not seen, in front of the near plane or not. */
int smear_outcode_behind(struct smear_homogeneous h, const struct smear_viewport *viewport);

/* Brings a place that rounding left outside the guard band back to its border. */
static inline void screen_clamp(struct smear_screen *s, const struct smear_viewport *viewport)
{
    const int32_t guard = SMEAR_GUARD_PX << 8, x = viewport->width << 7, y = viewport->height << 7;
    s->x = clamp_i32(s->x, x - guard, x + guard);
    s->y = clamp_i32(s->y, y - guard, y + guard);
}

/* Returns the sides that a projected vertex lies beyond. */
static inline int outcode_sides_inline(const struct smear_screen *s, const struct smear_viewport *viewport)
{
    int32_t right = viewport->width << 8, bottom = viewport->height << 8;
    if ((uint32_t)s->x <= (uint32_t)right && (uint32_t)s->y <= (uint32_t)bottom)
        return 0;
    int code = (s->x < 0 ? OUT_LEFT : 0) | (s->x > right ? OUT_RIGHT : 0) | (s->y < 0 ? OUT_TOP : 0) | (s->y > bottom ? OUT_BOTTOM : 0);
    int32_t dx = s->x - (right >> 1), dy = s->y - (bottom >> 1);
    const int32_t guard = SMEAR_GUARD_PX << 8;
    if (dx < -guard || dx > guard || dy < -guard || dy > guard)
        code |= OUT_GUARD;
    return code;
}

/* Does so as a call. */
int smear_outcode_sides(const struct smear_screen *s, const struct smear_viewport *viewport);

#endif

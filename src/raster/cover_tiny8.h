/* SPDX-License-Identifier: MIT */
/* cover_tiny8.h - tiny triangles of a list, eight at once (kernels/tiny8.h): which have what they need in common, and
 * their pixels. */
#ifndef SMEAR_COVER_TINY8_H
#define SMEAR_COVER_TINY8_H

#include "kernels/tiny8.h"
#include "raster/cover_tiny.h"

#if SMEAR_AVX2

/* Whether a target's lists may be drawn so: pixels say nothing but colour and depth, and lie in rows that do not go round. */
static inline bool tiny8_suit(const struct smear_raster_target *t)
{
    const struct smear_plane_rows *rows = &t->window_rows;
    return !target_has_velocity(t) && rows->ring_row + (t->y1 - t->y0) <= rows->ring && rows->stride < 1 << 15
        && smear_has_avx2();
}

/* Draws pixels [i, end) that are nearer than what is there. */
SMEAR_INLINE void tiny8_put_kind(const struct smear_raster_target *t, const struct tiny8_look *l, const struct tiny8_pixels *p,
                                 int32_t i, int32_t end, bool copied, bool narrow)
{
    uint16_t *const depth = t->depth, *const direct = t->direct;
    uint32_t *const color = t->color;
    const void *const texels = l->texels;
    for (; i < end; i++) {
        const int32_t at = p->at[i];
        const uint32_t code = p->code[i], pixel = p->pixel[i];
        if (code <= depth[at])
            continue;
        depth[at] = (uint16_t)code;
        if (narrow)
            direct[at] = copied ? ((const uint16_t *)texels)[pixel] : (uint16_t)pixel;
        else
            color[at] = copied ? ((const uint32_t *)texels)[pixel] & 0xffffffu : pixel;
    }
}

static inline void tiny8_put(const struct smear_raster_target *t, const struct tiny8_look *l, const struct tiny8_pixels *p,
                             int32_t i, int32_t end)
{
    if (l->kind == TINY8_COPIED && l->narrow)
        tiny8_put_kind(t, l, p, i, end, true, true);
    else if (l->kind == TINY8_COPIED)
        tiny8_put_kind(t, l, p, i, end, true, false);
    else if (l->narrow)
        tiny8_put_kind(t, l, p, i, end, false, true);
    else
        tiny8_put_kind(t, l, p, i, end, false, false);
}

#endif
#endif

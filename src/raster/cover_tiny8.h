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

/* False where the texture's bits are not told by shifts of mesh units. */
static inline bool tiny8_texture(struct tiny8_look *l, const struct smear_sampler *m)
{
    if (!m->turns || m->levels != 0)
        return false;
    l->texels = m->texels;
    l->palette = m->palette;
    l->format = m->format;
    l->from_u = 15 + m->uv_shift - m->log2_width;
    l->from_v = l->from_u - m->log2_height;
    l->mask_u = (1u << m->log2_width) - 1u;
    l->mask_v = ((1u << m->log2_height) - 1u) << m->log2_width;
    l->width = (uint32_t)m->width;
    l->height = (uint32_t)m->height;
    l->span = ((uint32_t)max_i32(m->width, m->height) << 16 >> m->uv_shift) + 1u;
    l->uv_shift = m->uv_shift;
    return l->from_v >= 0;
}

/* Tells what triangles of a segment have in common. False where they are drawn one by one. */
static SMEAR_NOINLINE bool tiny8_look(struct tiny8_look *l, const struct smear_raster_frame *frame,
                                      const struct smear_raster_target *t, const struct smear_segment *segment)
{
    const struct smear_raster_draw *draw = &frame->draw[segment->draw];
    const struct smear_plane_rows *rows = &t->window_rows;
    if (!draw_is_opaque(draw) || segment_moves(segment) != 0)
        return false;
    l->vertex = bins_vertex(frame->bins, segment, 0);
    l->color = segment_gouraud(segment) ? segment->color : 0;
    l->perspective = !segment_flat_depth(segment);
    l->even = l->perspective && segment_by_vertices(segment);
    l->linear = frame_is_linear(frame);
    l->narrow = target_is_direct(t);
    l->x0 = t->x0;
    l->y0 = t->y0;
    l->x1 = t->x1;
    l->y1 = t->y1;
    l->at = target_row(rows, t, t->y0) - t->y0 * rows->stride;
    l->stride = rows->stride;
    l->most = SMALL_PX;
    l->kind = segment_gouraud(segment) ? TINY8_SHADED : TINY8_FLAT;
    if (!segment_textured(segment))
        return true;
    l->most = SMALL_TEXTURED_PX;
    l->white = segment->shade == SHADE_NONE;
    l->linear = l->linear && !l->white;
    l->kind = TINY8_LIT;
    if (l->white && draw->sampler.format == (l->narrow ? SMEAR_TEXEL_565 : SMEAR_TEXEL_8888))
        l->kind = TINY8_COPIED;
    return tiny8_texture(l, &draw->sampler);
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

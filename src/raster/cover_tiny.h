/* SPDX-License-Identifier: MIT */
/* cover_tiny.h - the pixels of triangles that have few: inlined where every triangle passes. */
#ifndef SMEAR_COVER_TINY_H
#define SMEAR_COVER_TINY_H

#include "raster/cover.h"
#include "raster/fog.h"
#include "raster/span.h"

static inline void edges_start(struct tiny_edges *e, const struct setup *s, int32_t area, int32_t x,
                               int32_t y)
{
    tiny_start(e, s->v[0][VERTEX_X], s->v[0][VERTEX_Y], s->x1, s->y1, s->x2, s->y2, area, x, y);
}

/* Boxes of a few pixels: attributes are weighed at each pixel by the edge functions themselves, which costs
 * less than their gradients. Untextured, opaque, no motion. */
enum { TINY_PIXELS = 32 };

/* `in_fog`: that of the frame. */
static inline bool cover_is_tiny(const struct setup *s, int32_t pixels, bool in_fog)
{
    return pixels <= TINY_PIXELS && !segment_textured(s->segment) && segment_moves(s->segment) == 0
        && draw_is_opaque(s->draw) && !(in_fog && fog_varies(s))
        && (!segment_by_vertices(s->segment) || segment_flat_depth(s->segment)
            || tiny_is_even(s->v[0][VERTEX_DEPTH], s->v[1][VERTEX_DEPTH], s->v[2][VERTEX_DEPTH]));
}

/* Red, green and blue of v[0], 16 bits, and how those of v[1] and v[2] differ. */
struct tiny_channels {
    int32_t value[3], to1[3], to2[3];
};

static inline uint32_t channels_mix(const struct tiny_channels *c, uint32_t w1, uint32_t w2, bool linear)
{
    int32_t a = (int32_t)(w1 >> 2), b = (int32_t)(w2 >> 2);
    return tiny_pixel(((uint32_t)c->value[0] << 14) + (uint32_t)(c->to1[0] * a + c->to2[0] * b),
                      ((uint32_t)c->value[1] << 14) + (uint32_t)(c->to1[1] * a + c->to2[1] * b),
                      ((uint32_t)c->value[2] << 14) + (uint32_t)(c->to1[2] * a + c->to2[2] * b), linear);
}

/* The same, in one part of fog. */
static SMEAR_NOINLINE struct tiny_channels channels_in_fog(struct tiny_channels c, const struct setup *s)
{
    const int32_t part = fog_even_part(s) >> 1;
    for (int i = 0; i < 3; i++) {
        const uint32_t code = frame_fog(s->frame)->color >> (16 - 8 * i) & 255u;
        const int32_t there = frame_is_linear(s->frame) ? smear_srgb_decode[code] : (int32_t)(code << 8);
        c.value[i] += (there - c.value[i]) * part >> 15;
        c.to1[i] -= c.to1[i] * part >> 15;
        c.to2[i] -= c.to2[i] * part >> 15;
    }
    return c;
}

SMEAR_INLINE void channels_start(struct tiny_channels *c, const struct setup *s, bool in_fog)
{
    int at = s->segment->color;
    for (int i = 0; i < 3; i++, at += i == 2) {
        int shift = i == 1 ? 16 : 0;
        int32_t value = (int32_t)((uint32_t)s->v[0][at] >> shift & 0xffffu);
        c->value[i] = value;
        c->to1[i] = (int32_t)((uint32_t)s->v[1][at] >> shift & 0xffffu) - value;
        c->to2[i] = (int32_t)((uint32_t)s->v[2][at] >> shift & 0xffffu) - value;
    }
    if (in_fog && fog_of(s) != FOG_NONE)
        *c = channels_in_fog(*c, s);
}

/* Draws a tiny triangle, of which only the edges are known, and twice the area. */
SMEAR_INLINE void cover_tiny(const struct setup *s, int32_t area, const struct pixel_box *box, bool in_fog)
{
    const struct smear_raster_target *t = s->target;
    const bool gouraud = segment_gouraud(s->segment);
    const int32_t q0 = s->v[0][VERTEX_DEPTH], q1 = s->v[1][VERTEX_DEPTH], q2 = s->v[2][VERTEX_DEPTH];
    const int32_t x0 = max_i32(box->left, t->x0), x1 = min_i32(box->right, t->x1), top = box->top, bottom = box->bottom;
    const struct tiny_scale scale = tiny_scale_make(area);
    struct tiny_channels channels;
    struct tiny_edges e;
    edges_start(&e, s, area, x0, top);
    if (gouraud)
        channels_start(&channels, s, in_fog);
    int32_t ring_row = t->window_rows.ring_row + (top - t->y0);
    for (int32_t y = top; y < bottom; y++, ring_row++, e.e0 += e.down0, e.e1 += e.down1, e.e2 += e.down2) {
        int32_t e0 = e.e0, e1 = e.e1, e2 = e.e2, x = x0;
        while ((e0 | e1 | e2) < 0 && ++x < x1) {
            e0 += e.right0;
            e1 += e.right1;
            e2 += e.right2;
        }
        if (x == x1)
            continue;
        if (ring_row >= t->window_rows.ring)
            ring_row -= t->window_rows.ring;
        int32_t at = ring_row * t->window_rows.stride + x - t->window_rows.x0, end = at + (x1 - x);
        target_settle(t, at - x, x, x1);
        do {
            uint32_t w1 = tiny_weight(scale, e1), w2 = tiny_weight(scale, e2);
            uint32_t code = tiny_depth(q0, q1, q2, w1, w2);
            if (code > t->depth[at]) {
                t->depth[at] = (uint16_t)code;
                target_put(t, at,
                           gouraud ? channels_mix(&channels, w1, w2, frame_is_linear(s->frame)) : s->color);
                if (setup_writes_velocity(s))
                    smear_velocity_still(t, at, s->velocity_unknown);
            }
            e0 += e.right0;
            e1 += e.right1;
            e2 += e.right2;
        } while (++at < end && (e0 | e1 | e2) >= 0);
    }
}

#endif

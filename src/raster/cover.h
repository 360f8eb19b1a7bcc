/* SPDX-License-Identifier: MIT */
/* cover.h - the pixels of a triangle. */
#ifndef SMEAR_COVER_H
#define SMEAR_COVER_H

#include "geometry/tiny.h"
#include "raster/setup.h"

/* Boxes of at most this many pixels in both directions are walked with edge functions (tiny.h), which fit 32 bits there. */
enum { SMALL_PX = 8 };

/* Pixels [left, right) of rows [top, bottom). */
struct pixel_box {
    int32_t left, right, top, bottom;
};

/* Draws a triangle whose gradients and planes are made, and makes those of its velocity where they are needed. The box holds
 * its pixels in the target's rows; `small`: the triangle has at most SMALL_PX columns and rows. */
void smear_cover(struct setup *s, const struct pixel_box *box, bool small);

/* Boxes of a few pixels: attributes are weighed at each pixel by the edge functions themselves, which costs
 * less than their gradients. Untextured, opaque, no motion. */
enum { TINY_PIXELS = 32 };

static inline bool cover_is_tiny(const struct setup *s, int32_t pixels)
{
    return pixels <= TINY_PIXELS && !segment_textured(s->segment) && segment_moves(s->segment) == 0
        && draw_is_opaque(s->draw)
        && (!segment_by_vertices(s->segment) || segment_flat_depth(s->segment)
            || tiny_is_even(s->v[0][VERTEX_DEPTH], s->v[1][VERTEX_DEPTH], s->v[2][VERTEX_DEPTH]));
}

/* Draws a tiny triangle, of which only the edges are known, and twice the area. */
void smear_cover_tiny(const struct setup *s, int32_t area, const struct pixel_box *box);

#endif

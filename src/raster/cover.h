/* SPDX-License-Identifier: MIT */
/* cover.h - the pixels of a triangle. */
#ifndef SMEAR_COVER_H
#define SMEAR_COVER_H

#include "raster/texture_rows.h"
#include "raster/tiny_draw.h"

/* Boxes of at most SMALL_PX pixels in both directions, or so many where they are textured, are walked with edge functions (tiny.h), which
 * fit 32 bits there; a texture's set-up is cheaper for them, too. */
enum { SMALL_TEXTURED_PX = 16 };

/* Whether a triangle is set up by smear_setup_small. */
static inline bool cover_is_small(const struct setup *s, bool small)
{
    return small && segment_textured(s->segment) && segment_moves(s->segment) == 0 && !fog_varies(s);
}

/* Does what smear_tiny_box does, and pixels that it draws have the velocity of what has no motion of its own. Velocities are there. */
void smear_velocity_tiny(struct tiny_look *l, const struct setup *s, const struct pixel_box *box, const struct tiny_depths *depths);

/* Chooses what draws a triangle's rows at once; `small`: it has at most so many columns and rows. */
void smear_cover_choose(struct setup *s, bool small);

/* Draws a triangle that is ready: gradients and planes are made, its rows chosen. The box holds its pixels in the target's
 * rows. */
void smear_cover(const struct setup *s, const struct pixel_box *box, bool small);

/* Whether smear_cover_texels may take a triangle whose box has so many pixels. */
static inline bool cover_has_texels(const struct setup *s, int32_t pixels)
{
    return pixels <= TINY_PIXELS && segment_textured(s->segment) && segment_moves(s->segment) == 0
        && !draw_is_blended(s->draw);
}

/* Draws such a triangle, of which only the edges are known, and twice the area. Returns false, and draws nothing, where that
 * would be too inexact. */
bool smear_cover_texels(const struct setup *s, int32_t area, const struct pixel_box *box);

#endif

/* SPDX-License-Identifier: MIT */
/* cover_texels.h - the pixels of textured triangles that have few. */
#ifndef SMEAR_COVER_TEXELS_H
#define SMEAR_COVER_TEXELS_H

#include "raster/cover.h"

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

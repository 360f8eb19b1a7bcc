/* SPDX-License-Identifier: MIT */
/* cover.h - the pixels of a triangle. */
#ifndef SMEAR_COVER_H
#define SMEAR_COVER_H

#include "geometry/tiny.h"
#include "raster/texture_rows.h"

/* Boxes of at most this many pixels in both directions are walked with edge functions (tiny.h), which fit 32 bits there; a
 * texture's set-up is cheaper for them, too. */
enum { SMALL_PX = 8, SMALL_TEXTURED_PX = 16 };

/* Whether a triangle is set up by smear_setup_small. */
static inline bool cover_is_small(const struct setup *s, bool small)
{
    return small && segment_textured(s->segment) && segment_moves(s->segment) == 0 && !fog_varies(s);
}

/* Pixels [left, right) of rows [top, bottom). */
struct pixel_box {
    int32_t left, right, top, bottom;
};

#if SMEAR_SPAN_ROWS
/* Chooses what draws a triangle's rows at once; `small`: it has at most so many columns and rows. */
void smear_cover_choose(struct setup *s, bool small);
#else
static inline void smear_cover_choose(struct setup *s, bool small)
{
    (void)s;
    (void)small;
}
#endif

/* Draws a triangle that is ready: gradients and planes are made, its rows chosen. The box holds its pixels in the target's
 * rows. */
void smear_cover(const struct setup *s, const struct pixel_box *box, bool small);

#endif

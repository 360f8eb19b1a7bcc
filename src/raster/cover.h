/* SPDX-License-Identifier: MIT */
/* cover.h - the pixels of a triangle. */
#ifndef SMEAR_COVER_H
#define SMEAR_COVER_H

#include "geometry/tiny.h"
#include "kernels/texel_rows.h"
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

/* Whether what was chosen for other columns may not do for these: loops in lanes need some. */
static inline bool cover_is_narrow(const struct smear_raster_target *t)
{
#if SMEAR_LANE_ROWS
    return t->x1 - t->x0 < TEXEL_ROWS_LEAST;
#else
    (void)t;
    return false;
#endif
}

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

#if SMEAR_AVX2
struct flat_carried;

/* Makes a flat triangle ready that is not small and has no velocity, for its rows from y on. */
void smear_cover_carry(const struct setup *s, struct flat_carried *f, int32_t y);

/* Tells which corner of a triangle is the topmost, and so on. */
int smear_cover_order(const struct setup *s);

/* Draws the target's rows up to `bottom` of one that has rows above them, and is not small, by `s->rows`. `cut`: columns of the
 * target may cut them off. */
void smear_cover_on(const struct setup *s, int order, int32_t bottom, bool cut);
#endif

#endif

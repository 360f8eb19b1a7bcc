/* SPDX-License-Identifier: MIT */
/* flat_list.h - triangles of a list that have one colour and no motion. */
#ifndef SMEAR_RASTER_FLAT_LIST_H
#define SMEAR_RASTER_FLAT_LIST_H

#include "raster/setup.h"

/* Where size counts, draw_any has all but points. */
enum { HAS_FLAT_ROWS = !SMEAR_SMALL_CODE };

/* Draws an opaque triangle of this colour, clockwise on the screen, where pixels say nothing but colour and depth. The bits are
 * those of setup.c and cover.c. False where it is tiny (tiny_draw.h): it is drawn there. `given`: the box of its vertices, or
 * null. `whole`: the target has all columns of the frame. `number`: by which it is kept for the rows below (kept.h), or
 * SMEAR_NO_TRIANGLE. */
bool smear_flat_triangle(const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color, const struct bounds *given,
                         bool whole, uint32_t number);

/* Draws the target's rows of one that is ready: not small, without velocity. */
void smear_flat_cover(const struct setup *s);

/* Returns the bytes that one takes that is kept. */
size_t smear_flat_kept_bytes(void);

#endif

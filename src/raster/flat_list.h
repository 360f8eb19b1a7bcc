/* SPDX-License-Identifier: MIT */
/* flat_list.h - triangles of a list that have one colour and no motion. */
#ifndef SMEAR_RASTER_FLAT_LIST_H
#define SMEAR_RASTER_FLAT_LIST_H

#include "kernels/flat_lines.h"
#include "raster/setup.h"

/* They are made ready on their own where a kernel draws their rows and size does not count: without what others need, that takes
 * half of the instructions. */
#define SMEAR_FLAT_LIST SMEAR_FLAT_LINES

#if SMEAR_FLAT_LIST
/* Draws an opaque triangle of this colour, clockwise on the screen, where pixels say nothing but colour and depth. The bits are those of
 * setup.c and cover.c. Nothing is kept of it for the next rows: to make it ready again takes less. False where it is tiny
 * (cover_tiny.h): it is drawn there. `whole`: the target has all columns of the frame. */
bool smear_flat_triangle(const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color, bool whole);

/* Draws the target's rows of one that is ready: not small, without velocity. */
void smear_flat_cover(const struct setup *s);
#endif

#endif

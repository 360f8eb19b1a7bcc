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
/* Whether pixels of a segment's triangles say nothing but one colour each, and depth. */
static inline bool flat_list_suits(const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                                   const struct smear_segment *segment)
{
    return !segment_textured(segment) && !segment_gouraud(segment) && segment_moves(segment) == 0
        && draw_is_opaque(&frame->draw[segment->draw]) && !frame_has_fog(frame) && !target_has_velocity(t);
}

/* Draws an opaque triangle of this colour, clockwise on the screen, where pixels say nothing but colour and depth. The bits are those of
 * setup.c and cover.c. Nothing is kept of it for the next rows: to make it ready again takes less. False where it is tiny
 * (cover_tiny.h): it is drawn there. `given`: the box of its vertices, or null. `whole`: the target has all columns of the frame. */
bool smear_flat_triangle(const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color, const struct bounds *given,
                         bool whole);

/* Draws the target's rows of one that is ready: not small, without velocity. */
void smear_flat_cover(const struct setup *s);
#endif

#endif

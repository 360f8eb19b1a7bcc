/* SPDX-License-Identifier: MIT */
/* flat_list.h - triangles of a list that have one colour and no motion. */
#ifndef SMEAR_RASTER_FLAT_LIST_H
#define SMEAR_RASTER_FLAT_LIST_H

#include "kernels/flat_lines.h"
#include "raster/setup.h"

/* Where lists have no loop for tiny ones (tiny_list.h), each entry is asked whether it is one. */
#define SMEAR_FLAT_ENTRIES SMEAR_ASM_ARM

/* Whether triangles of a segment have one colour each, are opaque, and have no motion of their own. */
static inline bool segment_is_flat(const struct smear_raster_frame *frame, const struct smear_segment *segment)
{
    return !segment_textured(segment) && !segment_gouraud(segment) && segment_moves(segment) == 0
        && draw_is_opaque(&frame->draw[segment->draw]);
}

/* Whether their pixels say nothing but that colour, and depth. */
static inline bool flat_list_suits(const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                                   const struct smear_segment *segment)
{
    return segment_is_flat(frame, segment) && !frame_has_fog(frame) && !target_has_velocity(t);
}

/* Draws an opaque triangle of this colour, clockwise on the screen, where pixels say nothing but colour and depth. The bits are
 * those of setup.c and cover.c. False where it is tiny (cover_tiny.h): it is drawn there. `given`: the box of its vertices, or
 * null. `whole`: the target has all columns of the frame. `number`: by which it is kept for the rows below (kept.h), or
 * SMEAR_NO_TRIANGLE. */
bool smear_flat_triangle(const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color, const struct bounds *given,
                         bool whole, uint32_t number);

/* Draws the target's rows of one that is ready: not small, without velocity. */
void smear_flat_cover(const struct setup *s);

/* Draws an entry of a list likewise. There is no fog, and the target has no velocity. False where it is another, or tiny. */
bool smear_flat_entry(const struct smear_raster_frame *frame, const struct smear_raster_target *target, const struct smear_triangle *t);

#endif

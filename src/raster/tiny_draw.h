/* SPDX-License-Identifier: MIT */
/* tiny_draw.h - triangles of few pixels, opaque and without a texture: their edge functions tell the covered centres and are the
 * weights of their corners there (kernels/tiny_box.h), which costs less than gradients. */
#ifndef SMEAR_TINY_DRAW_H
#define SMEAR_TINY_DRAW_H

#include "kernels/kernels.h"
#include "raster/setup.h"

/* Boxes of at most SMALL_PX columns and rows, and TINY_PIXELS pixels. */
enum { SMALL_PX = 8, TINY_PIXELS = 32 };

/* What such triangles of a segment have in common; numbers of the box are those of the last one drawn. */
struct tiny_look {
    int color;              /* in a record: the first of two words of colour */
    bool even;              /* depths must be nearly even (tiny_is_even) */
    struct tiny_box box;
};

/* The least and the largest depth of a triangle's vertices, units q11. */
struct tiny_depths {
    int32_t low, high;
};

static inline struct tiny_depths tiny_depths_of(const int32_t *const v[3])
{
    const int32_t a = v[0][VERTEX_DEPTH], b = v[1][VERTEX_DEPTH], c = v[2][VERTEX_DEPTH];
    return (struct tiny_depths){ min_i32(a, min_i32(b, c)), max_i32(a, max_i32(b, c)) };
}

/* Whether a triangle's colours may be mixed on the screen, as tiny_is_even has it. */
static inline bool tiny_suits(const struct tiny_look *l, const struct tiny_depths *d)
{
    return !l->even || d->high - d->low <= d->low >> 5;
}

/* False where a segment's triangles are others. */
static inline bool tiny_look_take(struct tiny_look *l, const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                                  const struct smear_segment *segment)
{
    if (segment_textured(segment) || segment_moves(segment) != 0 || !draw_is_opaque(&frame->draw[segment->draw]))
        return false;
    l->color = segment->color;
    l->even = segment_by_vertices(segment) && !segment_flat_depth(segment);
    l->box.shaded = segment_gouraud(segment);
    l->box.transfer = frame_transfer(frame);
    l->box.narrow = target_is_direct(t);
    l->box.stride = t->window_rows.stride;
    return true;
}

/* Draws one of this colour, or of colours that have the part of fog that `fog` (null: none; not where size counts) tells, and this box of
 * pixels, which may reach beyond the target. */
void smear_tiny_box(struct tiny_look *l, const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color,
                    const struct pixel_box *box, const struct tiny_depths *depths, const struct setup *fog);

/* Finds out whether a triangle is such a one, and draws it without fog. False where it is not. */
bool smear_tiny_draw(struct tiny_look *l, const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color);

#endif

/* SPDX-License-Identifier: MIT */
/* cover.h - the pixels of a triangle. */
#ifndef SMEAR_COVER_H
#define SMEAR_COVER_H

#include "raster/few_draw.h"
#include "raster/setup.h"
#include "raster/span.h"
#include "raster/tiny_draw.h"

/* Does what smear_tiny_box does, and pixels that it draws have the velocity of what has no motion of its own. Velocities are there. */
void smear_velocity_tiny(struct tiny_look *l, const struct setup *s, const struct pixel_box *box, const struct tiny_depths *depths);

/* Chooses what draws a triangle's rows at once; `small`: it has at most SMALL_PX columns and rows, or FEW_PX where it is textured. */
void smear_cover_choose(struct setup *s, bool small);

/* Draws a triangle that is ready: gradients and planes are made, its rows chosen. The box holds its pixels in the target's
 * rows. Spans of small ones are found by edge functions (tiny.h), which fit 32 bits there. */
void smear_cover(const struct setup *s, const struct pixel_box *box, bool small);

/* Where size counts, draw_any has all but points. */
enum { HAS_FLAT_ROWS = !SMEAR_SMALL_CODE };

/* Draws an opaque triangle of this colour, clockwise on the screen, where pixels say nothing but colour and depth. The bits are
 * those of setup.c and cover.c. False where it is tiny (tiny_draw.h): it is drawn there. `given`: the box of its vertices, or
 * null. `whole`: the target has all columns of the frame. `number`: by which it is kept for the rows below (kept.h), or
 * SMEAR_NO_TRIANGLE. */
bool smear_flat_triangle(const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color, const struct bounds *given,
                         bool whole, uint32_t number);

/* Draws the target's rows of a triangle of a list that is kept, of which rows just above were drawn last, in pixels of this kind. False for
 * others. */
bool smear_flat_go_on(const struct smear_raster_target *t, uint32_t number);

/* Darkens what lies behind a shadow's triangle of this colour, which may be tiny. */
void smear_flat_shadow(const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color, smear_transfer transfer);

/* Draws the target's rows of one that is ready: not small, without velocity. */
void smear_flat_cover(const struct setup *s);

/* Returns the bytes that one takes that is kept. */
size_t smear_flat_kept_bytes(void);

/* A triangle's corners from top to bottom, and the rows between them: the first ones whose centres lie below each. */
struct corners {
    const int32_t *top, *middle, *bottom;
    int32_t first, knee, end;
    bool whole_is_left;             /* the side without the middle corner */
};

/* Clockwise from the top, the next corner lies right of the long edge, so that is the left one; each swap turns the triangle over. */
SMEAR_INLINE void corners_sort(struct corners *c, const int32_t *const corner[3])
{
    const int32_t *top = corner[0], *middle = corner[1], *bottom = corner[2], *swap;
    bool whole_is_left = true;
    if (middle[1] < top[1]) {
        swap = top;
        top = middle;
        middle = swap;
        whole_is_left = false;
    }
    if (bottom[1] < middle[1]) {
        swap = middle;
        middle = bottom;
        bottom = swap;
        whole_is_left = !whole_is_left;
        if (middle[1] < top[1]) {
            swap = top;
            top = middle;
            middle = swap;
            whole_is_left = !whole_is_left;
        }
    }
    c->top = top;
    c->middle = middle;
    c->bottom = bottom;
    c->first = (top[1] + 127) >> 8;
    c->knee = (middle[1] + 127) >> 8;
    c->end = (bottom[1] + 127) >> 8;
    c->whole_is_left = whole_is_left;
}

/* Of rows [y0, y1). */
SMEAR_INLINE void corners_find(struct corners *c, const int32_t *const corner[3], int32_t y0, int32_t y1)
{
    corners_sort(c, corner);
    c->first = max_i32(c->first, y0);
    c->end = min_i32(c->end, y1);
    c->knee = clamp_i32(c->knee, c->first, max_i32(c->end, c->first));
}

#endif

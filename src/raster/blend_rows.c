/* SPDX-License-Identifier: MIT */
/* blend_rows.c - one colour without a texture, blended, in rows of a triangle. The same pixels as those of span.c. */
#include "raster/texture_rows.h"

#include "kernels/blend_rows.h"
#include "raster/lane_spans.h"

#if SMEAR_BLEND_ROWS

static void blend_rows_start(struct blend_rows *t, const struct setup *s, const struct span_rows *r)
{
    const struct smear_raster_target *target = s->target;
    const struct smear_plane_rows *c = &target->color_rows;
    int32_t ring_row = c->ring_row + (r->y - target->y0);
    if (ring_row >= c->ring)
        ring_row -= c->ring;
    *t = (struct blend_rows){
        .color = target->color + (ring_row * c->stride - c->x0), .depth = target->depth + r->at, .color_stride = c->stride,
        .depth_stride = target->window_rows.stride, .turn = c->ring - ring_row, .back = c->ring * c->stride, .x0 = target->x0,
        .x1 = target->x1, .over = s->color, .linear = frame_is_linear(s->frame)
    };
}

/* Adds a row's pixels [a, b), which lie in one slope of the depth code. */
static inline void spans_add_slope(struct texel_spans *spans, const struct setup *s, const struct span_rows *r, int32_t row, int32_t a,
                                   int32_t b)
{
    const int32_t units = plane_at(&s->depth, 0, r->y + row), here = add_wrap(units, mul_wrap(s->depth.dx, a));
    const enum depth_slope slope = here < SLOPE_BREAK ? SLOPE_FAR : SLOPE_NEAR;
    const struct row_run p = { a, b, code_from_units(units, slope), (uint32_t)step_from_units(s->depth.dx, slope) };
    spans_add(spans, r, row, &p);
}

/* Adds a row that may have the depth code's break, and is cut there, if it is seen. */
static inline void spans_add_row(struct texel_spans *spans, const struct setup *s, const struct span_rows *r, int32_t row)
{
    const int32_t a = max_i32(r->side[row].left, s->target->x0), b = min_i32(r->side[row].right, s->target->x1), dx = s->depth.dx;
    if (a >= b)
        return;
    const int32_t here = plane_at(&s->depth, a, r->y + row), last = add_wrap(here, mul_wrap(dx, b - 1 - a));
    int32_t stop = b;
    if ((last < SLOPE_BREAK) != (here < SLOPE_BREAK))
        stop = a + pixels_to_break(here, dx, b - a);
    spans_add_slope(spans, s, r, row, a, stop);
    if (stop < b)
        spans_add_slope(spans, s, r, row, stop, b);
}

/* All rows together. */
SMEAR_STATIC_ASSERT(2 * SPAN_ROWS <= TEXEL_SPANS, "a row makes two spans at most");

static void rows_blend(const struct setup *s, const struct span_rows *r)
{
    struct blend_rows t;
    struct texel_spans spans;
    blend_rows_start(&t, s, r);
    if (rows_are_plain(s)) {
        spans_of_rows(&spans, s, r);
        smear_blend_rows_avx2(&t, &spans);
        return;
    }
    spans.count = 0;
    for (int32_t row = 0; row < r->count; row++)
        spans_add_row(&spans, s, r, row);
    smear_blend_rows_avx2(&t, &spans);
}

smear_rows_fn *smear_blend_rows_choose(const struct setup *s)
{
    return draw_is_blended(s->draw) && !segment_gouraud(s->segment) && fog_of(s) == FOG_NONE
                && s->target->x1 - s->target->x0 >= BLEND_ROWS_LEAST && smear_has_avx2()
               ? rows_blend : NULL;
}
#endif

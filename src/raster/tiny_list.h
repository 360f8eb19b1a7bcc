/* SPDX-License-Identifier: MIT */
/* tiny_list.h - tiny triangles of a list, where they need no setup but that of their box (kernels/tiny_box.h). The bits are those
 * of cover_tiny.h, which draws what is not taken. */
#ifndef SMEAR_TINY_LIST_H
#define SMEAR_TINY_LIST_H

#include "kernels/points_list.h"
#include "kernels/tiny_corners.h"
#include "kernels/tiny_triangles.h"
#include "raster/cover_tiny.h"

/* Lists have a loop of their own for them, where size does not count: it does in a page, and in the GBA's fast memory. */
#if defined(__OPTIMIZE_SIZE__) || defined(__ARM_ARCH_4T__) || defined(__wasm__)
#define SMEAR_TINY_LIST 0
#else
#define SMEAR_TINY_LIST 1
#endif

#if SMEAR_TINY_LIST

/* What triangles of a segment have in common. */
struct tiny_look {
    int32_t x0, y0, x1, y1; /* of the target */
    int32_t wrap;           /* the row that lies first in its ring */
    int32_t at, ring;       /* pixel (x, y) lies at `at` + x + y stride, from `wrap` on `ring` pixels before */
    uint16_t *depth;
    void *pixels;
    int color; /* in a record: the first of two words of colour */
    bool even; /* depths must be nearly even */
    struct tiny_box box;
};

/* Whether a target's lists may be drawn so: pixels say nothing but colour and depth. */
static inline bool tiny_list_suits(const struct smear_raster_frame *frame, const struct smear_raster_target *t)
{
    return !frame_has_fog(frame) && !target_has_velocity(t);
}

SMEAR_STATIC_ASSERT(sizeof(struct point_entry) == sizeof(struct smear_triangle) && POINT_ENTRY == SMEAR_POINT
                        && offsetof(struct point_entry, kind) == offsetof(struct smear_triangle, segment)
                        && offsetof(struct point_entry, depth) == 2 * POINT_DEPTH
                        && offsetof(struct point_entry, next) == offsetof(struct smear_triangle, next)
                        && offsetof(struct point_entry, color) == offsetof(struct smear_triangle, color),
                    "points are entries of lists");

/* Where points of a list are drawn. False where rows of the plane go round. */
static inline bool tiny_points(struct points_plane *p, const struct smear_raster_frame *frame, const struct smear_raster_target *t)
{
    const struct smear_plane_rows *rows = &t->window_rows;
    const int32_t at = rows->ring_row * rows->stride + t->x0 - rows->x0;
    *p = (struct points_plane){ bins_triangle(frame->bins, 0), (uint32_t)t->x0, (uint32_t)(t->x1 - t->x0), (uint32_t)t->y0,
                                (uint32_t)(t->y1 - t->y0), rows->stride, t->depth + at,
                                target_is_direct(t) ? (void *)(t->direct + at) : t->color + at, 0, 0 };
    return rows->ring_row + (t->y1 - t->y0) <= rows->ring;
}

/* False where triangles of the segment are drawn one by one. */
static bool tiny_look(struct tiny_look *l, const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                      const struct smear_segment *segment)
{
    const struct smear_plane_rows *rows = &t->window_rows;
    if (segment_textured(segment) || segment_moves(segment) != 0 || !draw_is_opaque(&frame->draw[segment->draw]))
        return false;
    l->x0 = t->x0;
    l->y0 = t->y0;
    l->x1 = t->x1;
    l->y1 = t->y1;
    l->wrap = t->y0 + rows->ring - rows->ring_row;
    l->at = (rows->ring_row - t->y0) * rows->stride - rows->x0;
    l->ring = rows->ring * rows->stride;
    l->depth = t->depth;
    l->pixels = target_is_direct(t) ? (void *)t->direct : t->color;
    l->color = segment->color;
    l->even = segment_by_vertices(segment) && !segment_flat_depth(segment);
    l->box.stride = rows->stride;
    l->box.shaded = segment_gouraud(segment);
    l->box.linear = frame_is_linear(frame);
    l->box.narrow = target_is_direct(t);
    return true;
}

#if TINY_TRIANGLES
SMEAR_STATIC_ASSERT(sizeof(struct triangle_entry) == sizeof(struct smear_triangle)
                        && offsetof(struct triangle_entry, segment) == offsetof(struct smear_triangle, segment)
                        && offsetof(struct triangle_entry, next) == offsetof(struct smear_triangle, next)
                        && offsetof(struct triangle_entry, color) == offsetof(struct smear_triangle, color)
                        && (int)TINY_SIDE == (int)SMALL_PX && (int)TINY_AREA == (int)TINY_PIXELS,
                    "tiny triangles are entries of lists");

/* The same for a loop over them. False where it cannot draw them. */
static bool tiny_loop(struct tiny_triangles *t, const struct tiny_look *l, const struct points_plane *plane,
                      const struct smear_bins *bins, const struct smear_segment *segment)
{
    if (l->box.shaded && (l->box.linear || l->color != VERTEX_BASE_WORDS))
        return false;
    t->plane = *plane;
    t->vertex = bins_vertex(bins, segment, 0);
    t->segment = (uint32_t)(segment - bins->segment);
    t->even = l->even;
    t->shaded = l->box.shaded;
    t->narrow = l->box.narrow;
    tiny_triangles_begin(t);
    return true;
}
#endif

/* Draws rows [top, bottom) of a box whose first pixel is (x, top). */
static inline void tiny_rows(struct tiny_look *l, int32_t x, int32_t top, int32_t bottom)
{
    struct tiny_box *const b = &l->box;
    const int32_t at = l->at + top * b->stride + x - (top >= l->wrap ? l->ring : 0);
    b->depth = l->depth + at;
    b->pixels = pixel_after(l->pixels, at, b->narrow);
    b->rows = bottom - top;
    tiny_box(b);
}

/* Draws a triangle. False where it is not tiny, or its depth codes have their break in it. */
static SMEAR_NOINLINE bool tiny_draw(struct tiny_look *l, const int32_t *const v[3], uint32_t color)
{
    struct tiny_box *const b = &l->box;
    const int32_t *const v0 = v[0], *const v1 = v[1], *const v2 = v[2];
    struct tiny_span span;
    tiny_span(&span, v0, v1, v2);
    int32_t left = span.left, top = span.top, bottom = span.bottom;
    const int32_t right = span.right, low = span.low, high = span.high;
    if (right - left > SMALL_PX || bottom - top > SMALL_PX || (right - left) * (bottom - top) > TINY_PIXELS)
        return false;
    if (!tiny_codes(b, v0[VERTEX_DEPTH], low, high) || (l->even && high - low > low >> 5))
        return false;
    left = max_i32(left, l->x0);
    top = max_i32(top, l->y0);
    bottom = min_i32(bottom, l->y1);
    b->columns = min_i32(right, l->x1) - left;
    if (b->columns <= 0 || top >= bottom)
        return true;
    tiny_corners(b, v0, v1, v2, left, top);
    if (b->shaded) {
        const uint32_t *const c0 = (const uint32_t *)v0 + l->color, *const c1 = (const uint32_t *)v1 + l->color;
        tiny_colors(b, c0, c1, (const uint32_t *)v2 + l->color, b->linear ? 0 : 1u << 21);
    } else {
        b->color = b->narrow ? rgb565_nearest(color) : color & 0xffffffu;
    }
    for (int32_t end; top != bottom; top = end) {
        end = top < l->wrap ? min_i32(bottom, l->wrap) : bottom;
        tiny_rows(l, left, top, end);
    }
    return true;
}

#endif
#endif

/* SPDX-License-Identifier: MIT */
/* point.c - see point.h. */
#include "raster/point.h"

#include "kernels/points_list.h"

SMEAR_STATIC_ASSERT(sizeof(struct point_entry) == sizeof(struct smear_triangle) && POINT_ENTRY == SMEAR_POINT
                        && offsetof(struct point_entry, kind) == offsetof(struct smear_triangle, segment)
                        && offsetof(struct point_entry, depth) == 2 * POINT_DEPTH
                        && offsetof(struct point_entry, next) == offsetof(struct smear_triangle, next)
                        && offsetof(struct point_entry, color) == offsetof(struct smear_triangle, color),
                    "points are entries of lists");

bool smear_raster_points_make(struct points_plane *p, const struct smear_raster_frame *frame, const struct smear_raster_target *t)
{
    const struct smear_plane_rows *rows = &t->window_rows;
    const int32_t at = rows->ring_row * rows->stride + t->x0 - rows->x0;
    *p = (struct points_plane){ bins_triangle(frame->bins, 0), (uint32_t)t->x0, (uint32_t)(t->x1 - t->x0), (uint32_t)t->y0,
                                (uint32_t)(t->y1 - t->y0), rows->stride, t->depth + at,
                                target_is_direct(t) ? (void *)(t->direct + at) : t->color + at };
    return rows->ring_row + (t->y1 - t->y0) <= rows->ring && !target_has_velocity(t);
}

uint32_t smear_raster_points(const struct points_plane *p, uint32_t head, bool narrow)
{
    return narrow ? points_list(p, head, true) : points_list(p, head, false);
}

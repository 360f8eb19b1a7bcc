/* SPDX-License-Identifier: MIT */
/* point.h - triangles that were finished as one pixel. */
#ifndef SMEAR_RASTER_POINT_H
#define SMEAR_RASTER_POINT_H

#include "kernels/kernels.h"
#include "raster/span.h"

/* A finished pixel; in fog there are none. */
static inline void draw_point(const struct smear_raster_frame *frame,
                              const struct smear_raster_target *target, const struct smear_triangle *t,
                              bool moved)
{
    int32_t x = t->vertex[POINT_X], y = t->vertex[POINT_Y] - target->y0;
    if (x < target->x0 || x >= target->x1 || (uint32_t)y >= (uint32_t)(target->y1 - target->y0))
        return;
    int32_t ring_row = target->window_rows.ring_row + y;
    if (ring_row >= target->window_rows.ring)
        ring_row -= target->window_rows.ring;
    int32_t at = ring_row * target->window_rows.stride + x - target->window_rows.x0;
    if (t->vertex[POINT_DEPTH] <= target->depth[at])
        return;
    target->depth[at] = t->vertex[POINT_DEPTH];
    target_put(target, at, t->color);
    if (moved && target_has_velocity(target))
        smear_velocity_still(target, at, frame_has_depth_velocity(frame));
}

/* Takes what points of a list are drawn by at once. False where rows of the plane go round, or pixels say more than colour and depth. */
bool smear_raster_points_make(struct points_plane *p, const struct smear_raster_frame *frame, const struct smear_raster_target *t);

/* Draws points from entry `head` on; returns the first entry that is no point. */
uint32_t smear_raster_points(const struct points_plane *p, uint32_t head, bool narrow);

#endif

/* SPDX-License-Identifier: MIT */
/* camera_velocity.h - fills in the velocities that the camera's motion gives to what does not move itself. */
#ifndef SMEAR_CAMERA_VELOCITY_H
#define SMEAR_CAMERA_VELOCITY_H

#include "ports/reproject.h"
#include "raster/window.h"

/* How velocities are kept, as in struct smear_raster_frame. */
struct smear_camera_store {
    int32_t velocity_scale, inspect_scale, reach_q3;
    int32_t *inspect;           /* a plane like the window's; or null */
};

/* Pixels [x0, x1) x [y0, y1) of the window, cut at multiples of `step` (1, 2 or 4): those of unknown velocity
 * get that of their depth. The nearest and the middle of each step x step stand for all of it that is at most
 * 1/16 farther away. Marks the tiles that move. */
void smear_camera_velocity(const struct smear_window *w, const struct smear_reprojection *r,
                           const struct smear_camera_store *store, int32_t step, int32_t x0, int32_t x1,
                           int32_t y0, int32_t y1);

#endif

/* SPDX-License-Identifier: MIT */
/* camera_velocity.h - fills in the velocities that the camera's motion gives to what does not move itself. */
#ifndef SMEAR_CAMERA_VELOCITY_H
#define SMEAR_CAMERA_VELOCITY_H

#include "geometry/reproject.h"
#include "raster/window.h"

/* How velocities are stored, as in struct smear_raster_frame. */
struct smear_camera_store {
    int32_t velocity_scale, inspect_scale, reach_q3;
    int32_t *inspect;           /* a plane like the window's; or null */
};

/* Gives pixels of unknown velocity in [x0, x1) x [y0, y1) of the window that of their depth. Blocks of `step` x `step`
 * pixels (step is 1, 2 or 4) share one velocity, that of the nearest depth in the middle of the block; what is more
 * than 1/16 farther away gets its own. Marks the tiles that move. */
void smear_camera_velocity(const struct smear_window *w, const struct smear_reprojection *r,
                           const struct smear_camera_store *store, int32_t step, int32_t x0, int32_t x1,
                           int32_t y0, int32_t y1);

#endif

/* SPDX-License-Identifier: MIT */
/* reproject.h - how the camera's motion alone moves what is seen at a pixel, told from its depth.
 *
 * [GPUGems3] "Motion Blur as a Post-Processing Effect", GPU Gems 3, chapter 27: a pixel and its depth give a point, the
 * point gives a pixel of another camera. Nothing is done per vertex, so the cost does not depend on the scene. */
#ifndef SMEAR_REPROJECT_H
#define SMEAR_REPROJECT_H

#include "smear.h"

#include "base/fixed.h"

/* Where a pose's camera sees the point that the drawn instant shows at a place and depth. With places in
 * pixels from the frame's middle and u the depth's units, w = turn_w(x, y) + toward u is 1 where nothing
 * changes, and the displacement is (across(x, y) + aside u - place w) / w. */
struct smear_reprojection_pose {
    int32_t w_x, w_y;           /* q30 per pixel */
    int32_t w_1;                /* q27 */
    int32_t w_u;                /* q48 - w_shift */
    int32_t x[2], y[2];         /* the displacement along x, along y per pixel along x and along y, q27 */
    int32_t one[2];             /* q16 px */
    int32_t u[2];               /* q37 - u_shift, px */
    uint8_t w_shift, u_shift;
};

struct smear_reprojection {
    int32_t width, height;
    int poses;                                  /* displacement: minus the first's, plus the second's */
    struct smear_reprojection_pose pose[2];
};

/* Makes the reprojection of a frame. The drawn instant is the sum of the cameras now, open and close by `weight` (q24,
 * together one); velocity is measured from `open` to `close` or, without to_close, to `now`. All are of one kind. */
void smear_reproject_make(struct smear_reprojection *r, const smear_camera *now, const smear_camera *open,
                          const smear_camera *close, const int32_t weight[3], bool to_close, int32_t width,
                          int32_t height);

/* Finds the displacement between the poses, q8 px, of what has depth `units` (0: at infinity) at a place. The place is
 * in half pixels from the top left corner: a pixel's middle is odd. */
void smear_reproject(const struct smear_reprojection *r, int32_t x2, int32_t y2, uint32_t units,
                     int32_t out[2]);

/* The displacement over the exposure to first order, for blocks of pixels and vertices: what a reprojection divides by is taken
 * for 1, which leaves out the square of the part by which a distance changes to either side of the middle. With places (X, Y) in
 * pixels from the frame's middle and u the depth's units:
 *
 *     turn = X turn_x + Y turn_y + u turn_u
 *     dx   = X (along[0] + turn) + Y across[0] + one[0] + u aside[0]
 *     dy   = Y (along[1] + turn) + X across[1] + one[1] + u aside[1] */
struct smear_flow {
    int32_t width, height;
    int32_t turn_x, turn_y;     /* q22 per pixel */
    int32_t along[2], across[2];        /* q16 */
    int32_t one[2];             /* q16 px */
    int32_t turn_u, aside[2];   /* per unit, 11 bits, as units may have 20: q16 plus `down` bits */
    uint8_t turn_down, aside_down;
    uint32_t units_most;        /* nearer places go as far as this one */
};

/* Makes the flow of a reprojection; `exposure`: the displacement between its poses to the whole exposure's, q16. */
void smear_flow_make(struct smear_flow *f, const struct smear_reprojection *r, int32_t exposure);

/* Finds the displacement over the exposure, q8 px, of what has depth `units` at the middle of pixel (x, y). */
void smear_flow_at(const struct smear_flow *f, int32_t x, int32_t y, uint32_t units, int32_t out[2]);

#endif

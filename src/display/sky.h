/* SPDX-License-Identifier: MIT */
/* sky.h - what is asked of a sky, which lies in scene/: programs bring it by naming it. */
#ifndef SMEAR_DISPLAY_SKY_H
#define SMEAR_DISPLAY_SKY_H

#include "smear_scene.h"

#include "geometry/shot.h"
#include "raster/target.h"

struct smear_sky_kind {
    /* Takes in where the camera looks at an instant; null: over the exposure. `width`: of the frame. */
    void (*aim)(smear_sky *sky, const struct smear_shot *shot, const struct smear_instant *instant, int32_t width, smear_transfer transfer);
    /* Fills the target's pixels, not its depths, and `too`: as wide rows of its tile row, one behind the other; or null. What a pixel gets
     * does not depend on the target's sides. */
    void (*fill)(const smear_sky *sky, const struct smear_raster_target *t, uint32_t *too);
};

#endif

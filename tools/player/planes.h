/* SPDX-License-Identifier: MIT */
/* planes.h - depth and velocity of a frame, for files. */
#ifndef SMEAR_TOOLS_CLI_PLANES_H
#define SMEAR_TOOLS_CLI_PLANES_H

#include "tools/image/image.h"
#include "tools/player/device.h"

struct planes {
    struct device device;               /* draws for the planes alone */
    struct float_image depth;           /* along the view, scene units; background +infinity */
    struct float_image velocity;        /* vx, vy, 0 in pixels per frame, y down; background 0 */
    const struct presented *presented;  /* being drawn */
};

/* `planes` is released by planes_close in any case. */
bool planes_open(struct planes *planes, int width, int height, struct failure *f);
void planes_close(struct planes *planes);

/* Draws the frame at its own instant, whatever its method and exposure: depth is that of the sharp
 * frame, velocity that of the poses given, before any clamp. */
bool planes_draw(struct planes *planes, const struct presented *presented, struct failure *f);

#endif

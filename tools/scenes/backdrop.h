/* SPDX-License-Identifier: MIT */
/* backdrop.h - a picture's background that runs from one colour to another: a surface behind all else, which stands before the
 * camera wherever that goes. It is drawn by the library like any draw, so that edges before it are as smooth as all edges. */
#ifndef SMEAR_TOOLS_SCENES_BACKDROP_H
#define SMEAR_TOOLS_SCENES_BACKDROP_H

#include "tools/failure.h"

#include <smear.h>
#include <stdbool.h>
#include <stdint.h>

/* 0xRRGGBB at the top and at the bottom of the picture. */
struct backdrop_colors {
    bool is_wanted;
    uint32_t top, bottom;
};

enum { BACKDROP_ROWS = 12, BACKDROP_TRIANGLES = 2 * (BACKDROP_ROWS - 1) };

struct backdrop {
    int16_t position[BACKDROP_ROWS * 2 * 3];
    uint8_t color[BACKDROP_ROWS * 2 * 4];
    uint16_t index[BACKDROP_TRIANGLES * 3];
    smear_mesh mesh;
    smear_material material;
    smear_transform pose;
};

/* Places it before this camera, beyond `farthest`: world units along the view, at most 0 where nothing is drawn. `out` points into
 * the backdrop. Fails where no room is left between what is farthest and what fixed point ends at. */
bool backdrop_place(struct backdrop *backdrop, const struct backdrop_colors *colors, const smear_camera *camera, double farthest,
                    smear_draw *out, struct failure *f);

#endif

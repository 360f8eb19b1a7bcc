/* SPDX-License-Identifier: MIT */
/* wire.h - the edges of the triangles that a frame submits, over a picture. */
#ifndef SMEAR_TOOLS_VIEW_WIRE_H
#define SMEAR_TOOLS_VIEW_WIRE_H

#include "tools/scenes/present.h"

#include <stdint.h>

/* Front-facing triangles at the frame's own instant: grey where nothing but the camera may move,
 * orange where an earlier or later pose differs. Hidden edges are drawn, too. */
void wire_draw(const struct presented *presented, uint32_t *picture, int width, int height);

#endif

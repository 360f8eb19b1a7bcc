/* SPDX-License-Identifier: MIT */
/* assemble.h - from a draw to the triangles of the frame: transform, cull, clip, shade, bin. */
#ifndef SMEAR_ASSEMBLE_H
#define SMEAR_ASSEMBLE_H

#include "geometry/vertex.h"

/* Call before the draws of a frame, or of a part of it. */
void smear_assembler_reset(struct smear_assembler *a);

/* Adds the draw's triangles to the geometry, from a->resume on. Returns false when the store is full: what was added
 * stays, and a->resume tells what comes next. An empty store has room for something of any triangle. */
bool smear_assemble(struct smear_assembler *a, const struct smear_assembly *draw);

/* Adds the triangles of a draw with draw->path, like smear_assemble. Those that the near or far plane or the guard band cuts at some
 * instant, or whose vertices no parabola follows, are listed whole, to be cut at each instant (space.h). */
bool smear_assemble_path(struct smear_assembler *a, struct smear_assembly *draw);

#endif

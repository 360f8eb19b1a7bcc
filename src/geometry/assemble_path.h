/* SPDX-License-Identifier: MIT */
/* assemble_path.h - triangles of draws that move, with their places at three instants (path.h). */
#ifndef SMEAR_ASSEMBLE_PATH_H
#define SMEAR_ASSEMBLE_PATH_H

#include "geometry/vertex.h"

/* Adds the triangles of a draw with draw->path, like smear_assemble. Those that the near or far
 * plane or the guard band cuts at some instant, or whose vertices no parabola follows, are listed whole, to be cut at each
 * instant (space.h). */
bool smear_assemble_path(struct smear_assembler *a, struct smear_assembly *draw);

#endif

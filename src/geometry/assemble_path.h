/* SPDX-License-Identifier: MIT */
/* assemble_path.h - triangles of draws that move, with their places at three instants (path.h). */
#ifndef SMEAR_ASSEMBLE_PATH_H
#define SMEAR_ASSEMBLE_PATH_H

#include "geometry/vertex.h"

/* Adds the triangles of a draw with draw->path, like smear_assemble. Those that the guard band (or the near plane of an
 * orthographic camera) cuts at some instant lose what lies beyond it there, for the whole exposure. Those that pass the
 * near plane of a perspective are cut where nothing nearer is seen or, where that is nowhere, listed in intervals of
 * the exposure (smear_path_bounds.interval). */
bool smear_assemble_path(struct smear_assembler *a, struct smear_assembly *draw);

#endif

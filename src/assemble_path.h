/* SPDX-License-Identifier: MIT */
/* assemble_path.h - triangles of draws that move, with their places at three instants (path.h). */
#ifndef SMEAR_ASSEMBLE_PATH_H
#define SMEAR_ASSEMBLE_PATH_H

#include "record.h"

/* Adds the triangles of a draw with draw->path, like smear_assemble. Those that are cut by the near plane or
 * the guard band at some instant lose what lies beyond it there, for the whole exposure. */
bool smear_assemble_path(struct smear_assembler *a, const struct smear_assembly *draw, bool drop);

#endif

/* SPDX-License-Identifier: MIT */
/* transform.c - the perspective division, with 32-bit products only. */
#include "transform.h"

void smear_project(struct smear_screen *out, const struct smear_projection *p,
                   const struct smear_homogeneous *in, const struct smear_viewport *viewport)
{
    project_inline(out, p, in, viewport);
}

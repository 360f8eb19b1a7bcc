/* SPDX-License-Identifier: MIT */
/* transform.c - the perspective division, with 32-bit products only. */
#define SMEAR_PROJECT_IS_HERE 1
#include "transform.h"

void smear_project(struct smear_screen *out, const struct smear_projection *p,
                   const struct smear_homogeneous *in, const struct smear_viewport *viewport)
{
    project(out, p, in, viewport);
}

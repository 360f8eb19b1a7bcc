/* SPDX-License-Identifier: MIT */
/* flat_lines_bind.h - flat_lines by the form of this build: assembly, or runs. */
#ifndef SMEAR_KERNELS_FLAT_LINES_BIND_H
#define SMEAR_KERNELS_FLAT_LINES_BIND_H

#include "kernels/flat_lines_arm.h"
#include "kernels/flat_lines_armv6m.h"
#include "kernels/flat_lines_armv7em.h"

/* Draws as flat_lines_reference does. `narrow`: l->narrow, where that may be. */
SMEAR_INLINE void flat_lines(struct flat_lines *l, int32_t n, bool narrow)
{
#if SMEAR_ASM_ARMV6M
    (void)narrow;
    flat_lines_armv6m(l, n);
#elif SMEAR_ASM_ARMV7EM
    (void)narrow;
    flat_lines_armv7em(l, n);
#elif SMEAR_ASM_ARM
    flat_lines_arm(l, n, narrow);
#else
    if (narrow)
        flat_lines_runs(l, n, true);
    else
        flat_lines_runs(l, n, false);
#endif
}

#endif

/* SPDX-License-Identifier: MIT */
/* flat_lines_bind.h - flat_lines by the form of this build: assembly, or runs. */
#ifndef SMEAR_KERNELS_FLAT_LINES_BIND_H
#define SMEAR_KERNELS_FLAT_LINES_BIND_H

#include "kernels/flat_lines_arm.h"
#include "kernels/flat_lines_armv6m.h"
#include "kernels/flat_lines_armv7em.h"

/* Starts a side so many rows below its first one, whatever it is. */
static SMEAR_NOINLINE void flat_lines_start_any(struct flat_lines *l, int side, const int32_t *a, const int32_t *b, int32_t rows)
{
    struct edge_fine e;
    edge_fine_start(&e, a, b, rows);
    flat_lines_side(l, side, &e);
}

#if SMEAR_ASM_ARMV6M
/* Goes on by fewer rows than 65536, like edge_fine_pass. */
static SMEAR_NOINLINE void flat_lines_pass(struct flat_lines *l, int side, uint32_t rows)
{
    const uint32_t step = l->step[side][0], low = step * rows;
    const uint32_t high = ((step >> 16) * rows + ((step & 0xffffu) * rows >> 16)) >> 16;
    l->x[side][0] += low;
    l->x[side][1] += l->step[side][1] * rows + high + (l->x[side][0] < low);
}

/* Usual ones without what the others take of the stack and of registers. */
static SMEAR_NOINLINE bool flat_lines_start_usual(struct flat_lines *l, int side, const int32_t *a, const int32_t *b)
{
    return flat_lines_side_armv6m(l, side, a, b);
}
#endif

static inline void flat_lines_start(struct flat_lines *l, int side, const int32_t *a, const int32_t *b, int32_t rows)
{
#if SMEAR_ASM_ARMV6M
    if (flat_lines_start_usual(l, side, a, b)) {
        if (rows != 0)
            flat_lines_pass(l, side, (uint32_t)rows);
        return;
    }
#endif
    flat_lines_start_any(l, side, a, b, rows);
}

/* Draws pixels of n rows, one at least, from one side to before the other, if there are any, like flat_run. The next row is then that
 * below. `narrow`: l->narrow, where that may be. */
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

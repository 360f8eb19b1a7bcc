/* SPDX-License-Identifier: MIT */
/* pixel_steps.h - where pixels differ by more than a few codes. */
#ifndef SMEAR_KERNELS_PIXEL_STEPS_H
#define SMEAR_KERNELS_PIXEL_STEPS_H

#include "kernels/kernels.h"
#include "kernels/vector.h"

/* Whether some channel of two pixels differs by more than `least`. */
static inline bool is_step(uint32_t a, uint32_t b, int32_t least)
{
    for (int shift = 0; (a ^ b) != 0 && shift < 24; shift += 8)
        if (abs_i32((int32_t)(a >> shift & 255u) - (int32_t)(b >> shift & 255u)) > least)
            return true;
    return false;
}

/* Returns the first of pixels [i, n) that differs from its neighbour in another row so; n where none does. */
static inline int32_t next_step_reference(const uint32_t *a, const uint32_t *b, int32_t i, int32_t n, int32_t least)
{
    while (i < n && !is_step(a[i], b[i], least))
        i++;
    return i;
}

#if SMEAR_VECTORS
/* Whether some of four pixels do. */
static inline bool four_have_step(const uint32_t *a, const uint32_t *b, uint8_t least)
{
    typedef uint8_t v16 __attribute__((vector_size(16)));
    const v16 p = (v16)v4u_load(a), q = (v16)v4u_load(b), more = (v16)(p > q), d = ((p - q) & more) | ((q - p) & ~more);
    return v4u_any((smear_v4u)(d > least));
}

static inline int32_t next_step_vector(const uint32_t *a, const uint32_t *b, int32_t i, int32_t n, int32_t least)
{
    while (i + 4 <= n && !four_have_step(a + i, b + i, (uint8_t)least))
        i += 4;
    return next_step_reference(a, b, i, n, least);
}
#define next_step next_step_vector
#else
#define next_step next_step_reference
#endif

#endif

/* SPDX-License-Identifier: MIT */
/* hidden_run.h - pixels of a row that something nearer hides. */
#ifndef SMEAR_KERNELS_HIDDEN_RUN_H
#define SMEAR_KERNELS_HIDDEN_RUN_H

#include "kernels/kernels.h"

/* Returns how many of n >= 0 pixels are hidden before the first that is seen: pixel i has the depth code
 * (z + i dz) >> 16, modulo 2^16, and is seen where that is greater than depth[i]. */
SMEAR_INLINE int32_t hidden_run_reference(const uint16_t *depth, int32_t n, uint32_t z, uint32_t dz)
{
    int32_t i = 0;
    for (; i < n && z >> 16 <= depth[i]; i++)
        z += dz;
    return i;
}

#if SMEAR_VECTORS
/* Eight pixels a round, in the order of signed numbers. */
SMEAR_INLINE int32_t hidden_run_vector(const uint16_t *depth, int32_t n, uint32_t z, uint32_t dz)
{
    const smear_v8i sign = v8i_all(INT16_MIN);
    const smear_v4u step = { 4 * dz, 4 * dz, 4 * dz, 4 * dz };
    smear_v4u z4 = { z, z + dz, z + 2 * dz, z + 3 * dz };
    int32_t i = 0;
    if (n == 0 || z >> 16 > depth[0])
        return 0;
    for (; i + 8 <= n; i += 8, z4 += 2 * step) {
        const smear_v8i seen = (smear_v8i)((v8i_upper(z4, z4 + step) ^ sign) > (v8i_load(depth + i) ^ sign));
        if (v4u_any((smear_v4u)seen))
            break;
    }
    return i + hidden_run_reference(depth + i, n - i, z + (uint32_t)i * dz, dz);
}
#endif

SMEAR_INLINE int32_t hidden_run(const uint16_t *depth, int32_t n, uint32_t z, uint32_t dz)
{
#if SMEAR_VECTORS
    return hidden_run_vector(depth, n, z, dz);
#else
    return hidden_run_reference(depth, n, z, dz);
#endif
}

#endif

/* SPDX-License-Identifier: MIT */
/* depth_range.h - the range of a box's depths. */
#ifndef SMEAR_KERNELS_DEPTH_RANGE_H
#define SMEAR_KERNELS_DEPTH_RANGE_H

#include "kernels/vector.h"

struct depth_range {
    uint32_t least, most;       /* codes; of no depths 65535 and 0 */
};

/* Returns the range of `rows` rows of n depths, one `stride` depths below the other. */
SMEAR_INLINE struct depth_range depth_range_reference(const uint16_t *depth, ptrdiff_t stride, int32_t n, int32_t rows)
{
    struct depth_range r = { UINT16_MAX, 0 };
    for (; rows > 0; rows--, depth += stride)
        for (int32_t i = 0; i < n; i++) {
            r.least = min_u32(r.least, depth[i]);
            r.most = max_u32(r.most, depth[i]);
        }
    return r;
}

#if SMEAR_VECTORS
/* Eight at once, of which the last eight of a row may have been seen before. */
SMEAR_INLINE struct depth_range depth_range_lanes(const uint16_t *depth, ptrdiff_t stride, int32_t n, int32_t rows)
{
    const smear_v8i top = v8i_all(INT16_MIN);           /* lanes have signs */
    uint16_t least[8], most[8];
    if (n < 8 || rows <= 0)
        return depth_range_reference(depth, stride, n, rows);
    smear_v8i low = v8i_load(depth) ^ top, high = low;
    for (; rows > 0; rows--, depth += stride)
        for (int32_t i = 0; i < n; i += 8) {
            const smear_v8i next = v8i_load(depth + min_i32(i, n - 8)) ^ top;
            low = v8i_min(low, next);
            high = v8i_max(high, next);
        }
    v8i_store(least, low ^ top);
    v8i_store(most, high ^ top);
    return (struct depth_range){ depth_range_reference(least, 0, 8, 1).least, depth_range_reference(most, 0, 8, 1).most };
}
#endif

SMEAR_INLINE struct depth_range depth_range(const uint16_t *depth, ptrdiff_t stride, int32_t n, int32_t rows)
{
#if SMEAR_VECTORS
    return depth_range_lanes(depth, stride, n, rows);
#else
    return depth_range_reference(depth, stride, n, rows);
#endif
}

#endif

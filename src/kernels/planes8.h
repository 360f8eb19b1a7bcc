/* SPDX-License-Identifier: MIT */
/* planes8.h - edges, areas and depth planes of eight triangles at an instant: what raster/setup.c finds for one, to the same
 * bits. */
#ifndef SMEAR_KERNELS_PLANES8_H
#define SMEAR_KERNELS_PLANES8_H

#include "kernels/poses.h"

#if SMEAR_AVX2

struct planes8 {
    uint32_t far, near;             /* bit k: no vertex of triangle k reaches the break of the depth code; all do */
    int32_t x1[8], y1[8], x2[8], y2[8];     /* edges from vertex 0, q8 */
    uint32_t area_recip[8];         /* 2^61 / normalised area, twice the triangle's */
    int32_t area_zeros[8];          /* its leading zeros in 64 bits */
    int32_t at[8], dx[8], dy[8];    /* depth, q11: at the centre of pixel (0, 0), modulo 2^32, and per pixel */
};

/* Makes those of triangles that are seen; the others' are undefined. Depths are positive. */
void smear_planes8_avx2(struct planes8 *out, const struct poses *p, int32_t depth_break);

#endif
#endif

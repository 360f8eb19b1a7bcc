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

/* A triangle's first vertex and its edges from there, q8, and its area as above. */
struct plane_triangle {
    int32_t x, y, x1, y1, x2, y2;
    uint32_t area_recip;
    int32_t area_zeros;
};

/* Planes through eight values at each vertex of a triangle: smear_plane_make of raster/setup.c. Values and their differences have
 * 32 bits. */
struct plane_values {
    int32_t of[3][8];
};

struct plane_eight {
    int32_t at[8], dx[8], dy[8];    /* at the centre of pixel (0, 0), modulo 2^32, and per pixel */
};

void smear_plane_eight_avx2(struct plane_eight *out, const struct plane_triangle *t, const struct plane_values *v);

#endif
#endif

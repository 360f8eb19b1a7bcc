/* SPDX-License-Identifier: MIT */
/* flat_rows.h - depth-tested pixels of one colour in rows one below the other, between two edges. */
#ifndef SMEAR_KERNELS_FLAT_ROWS_H
#define SMEAR_KERNELS_FLAT_ROWS_H

#include "kernels/edge_walk.h"
#include "kernels/flat_run.h"

/* By assembly on Cortex-M0+ where size counts; on other cores flat_lines.h does. */
#define FLAT_ROWS (SMEAR_ASM_ARMV6M && SMEAR_SMALL_CODE)

/* Rows one below the other, and so much of their pixels as lies in columns [x0, x1). */
struct flat_rows {
    void *pixels;                   /* pixel 0 of the first row, which may lie outside the memory */
    uint16_t *depth;
    int32_t stride, rows;           /* pixels from row to row; how many rows */
    int32_t x0, x1;
    uint32_t z, dz, dz_down;        /* depth codes 16.16 at that pixel, and their steps */
    uint32_t color;
    bool narrow;
};

/* Draws pixels from one edge to before the other, if there are any, like flat_run. The edges go on by so many rows. */
static inline void flat_rows_reference(const struct flat_rows *r, struct edge_walk *left, struct edge_walk *right)
{
    for (int32_t i = 0; i < r->rows; i++, edge_step(left), edge_step(right)) {
        const int32_t a = max_i32(edge_pixel(left), r->x0), b = min_i32(edge_pixel(right), r->x1);
        const uint32_t z = r->z + r->dz_down * (uint32_t)i;
        for (int32_t x = a; x < b; x++)
            flat_pixel(r->pixels, r->depth, i * r->stride + x, z + r->dz * (uint32_t)x, r->color, r->narrow);
    }
}

#endif

/* SPDX-License-Identifier: MIT */
/* flat_face.h - depth-tested pixels of a triangle of one colour. */
#ifndef SMEAR_KERNELS_FLAT_FACE_H
#define SMEAR_KERNELS_FLAT_FACE_H

#include "kernels/corners.h"
#include "kernels/edge_walk.h"
#include "kernels/flat_run.h"

/* Where pixels lie: columns [x0, x1) of rows [y0, y1), which are FLAT_FACE_ROWS at most. */
enum { FLAT_FACE_ROWS = 64, FLAT_FACE_LEAST = 16 };
struct flat_area {
    void *pixels;                   /* pixel 0 of row y0, which may lie outside the memory */
    uint16_t *depth;
    int32_t stride;
    int32_t x0, x1, y0, y1;
    bool narrow;
};

struct flat_face {
    const int32_t *corner[3];       /* x and y, q8 px, clockwise */
    uint32_t z, dz, dz_down;        /* depth codes 16.16 at pixel 0 of row y0, and their steps */
    uint32_t color;
};

/* Draws the pixels whose centres lie in the triangle, like flat_run: those at its left and upper edges, too. */
static inline void flat_face_reference(const struct flat_area *a, const struct flat_face *f)
{
    struct corners c;
    corners_find(&c, f->corner, a->y0, a->y1);
    for (int32_t y = c.first; y < c.end; y++) {
        struct edge_walk whole, part;
        edge_start(&whole, c.top, c.bottom, y);
        edge_start(&part, y < c.knee ? c.top : c.middle, y < c.knee ? c.middle : c.bottom, y);
        const int32_t left = max_i32(edge_pixel(c.whole_is_left ? &whole : &part), a->x0);
        const int32_t right = min_i32(edge_pixel(c.whole_is_left ? &part : &whole), a->x1);
        const int32_t row = y - a->y0, at = row * a->stride + left;
        if (left < right)
            flat_run_reference(pixel_after(a->pixels, at, a->narrow), a->depth + at, right - left,
                               f->z + f->dz_down * (uint32_t)row + f->dz * (uint32_t)left, f->dz, f->color, a->narrow);
    }
}

#if SMEAR_AVX2
/* The same where columns are FLAT_FACE_LEAST at least: they may be written as they are. */
void smear_flat_face_avx2(const struct flat_area *a, const struct flat_face *f);
#endif

#endif

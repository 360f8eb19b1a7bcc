/* SPDX-License-Identifier: MIT */
/* texel_curve_rows.h - rows of narrow texels one below the other, whose coordinates are polynomials. */
#ifndef SMEAR_KERNELS_TEXEL_CURVE_ROWS_H
#define SMEAR_KERNELS_TEXEL_CURVE_ROWS_H

#include "kernels/kernels.h"
#include "kernels/texel_places.h"
#include "kernels/texels_draw.h"

/* Rows one below the other, and coordinates of their pixels. */
struct texel_curve_rows {
    const struct span_side *side;
    int32_t count;              /* of rows; at least one */
    int32_t y;                  /* polynomials are of x - x0 and of y, y + 1 and so on */
    uint32_t z;                 /* depth code 16.16 at column 0 of the first row */
    uint16_t *depth;            /* of that pixel, which may lie outside the memory */
    int32_t x0;
    uint32_t dz_down;           /* how z changes from row to row */
    int32_t stride;             /* bytes */
    struct curve u, v;
    uint32_t dz, ddu, ddv;      /* ddu is 2 dxx of u */
    int32_t to_depth;           /* bytes from a pixel to its depth */
    const void *texels;
};

#if TEXEL_CURVE_ROWS
SMEAR_STATIC_ASSERT(offsetof(struct texel_curve_rows, u) == 32 && offsetof(struct texel_curve_rows, dz) == 80
                        && sizeof(struct curve) == 24 && sizeof(struct span_side) == 12
                        && offsetof(struct span_side, right) == 4,
                    "the assembly knows struct texel_curve_rows and struct span_side");
#endif

static inline uint32_t curve_at(const struct curve *p, uint32_t x, uint32_t y, uint32_t *step)
{
    const uint32_t dxx = (uint32_t)p->dxx, dx = (uint32_t)p->dxy * y + (uint32_t)p->dx + dxx * x;
    *step = dx + dxx * (x + 1u);
    return (uint32_t)p->at + ((uint32_t)p->dyy * y + (uint32_t)p->dy) * y + dx * x;
}

/* Assembly begins each row by going on to the next one. */
static inline void texel_curve_rows_before(struct texel_curve_rows *r)
{
    r->y--;
    r->z -= r->dz_down;
    r->depth = (uint16_t *)((uintptr_t)r->depth - (uintptr_t)r->stride);
}

/* Draws rows from left to before right, where there are such pixels, as texels_draw does. Afterwards the rows are anything. */
static inline void texel_curve_rows_reference(struct texel_curve_rows *r, int log2_width, int log2_height)
{
    for (int32_t row = 0; row < r->count; row++) {
        const int32_t left = r->side[row].left, n = r->side[row].right - left, bytes = row * r->stride + 2 * left;
        struct texel_run run = { .dz = r->dz, .texels = r->texels };
        struct texcoord c = { .curvature_u = 0u - r->ddu, .curvature_v = 0u - r->ddv };
        c.u = curve_at(&r->u, (uint32_t)(left - r->x0), (uint32_t)(r->y + row), &c.du);
        c.v = curve_at(&r->v, (uint32_t)(left - r->x0), (uint32_t)(r->y + row), &c.dv);
        texcoord_run(&run, c);
        texel_run_start(&run, log2_width, log2_height);
        run.z = r->z + r->dz_down * (uint32_t)row + r->dz * (uint32_t)left;
        run.depth = (uint16_t *)((uintptr_t)r->depth + (uintptr_t)bytes);
        run.color = (void *)((uintptr_t)run.depth - (uintptr_t)r->to_depth);
        if (n > 0)
            texels_draw_reference(&run, n, log2_width, log2_height, TEXELS_NARROW);
    }
}

#endif

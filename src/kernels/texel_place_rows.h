/* SPDX-License-Identifier: MIT */
/* texel_place_rows.h - short rows of narrow texels one below the other, of which every pixel has a place of its own. */
#ifndef SMEAR_KERNELS_TEXEL_PLACE_ROWS_H
#define SMEAR_KERNELS_TEXEL_PLACE_ROWS_H

#include "kernels/kernels.h"
#include "kernels/texel_places.h"

/* Rows one below the other, and planes whose quotients are coordinates. */
struct texel_place_rows {
    const struct span_side *side;
    int32_t count;              /* of rows; at least one */
    int32_t y;                  /* of the first, as planes count */
    uint32_t z, dz_down;        /* depth codes 16.16 at its column 0; their change from row to row */
    uint16_t *depth;            /* of that pixel, which may lie outside the memory */
    int32_t stride;             /* bytes */
    int32_t longest;            /* pixels of a row; longer ones are left out */
    uint32_t dz;
    struct texel_plane q, u, v;
    const uint16_t *seed;       /* smear_recip_seed */
    int32_t up;
    int32_t from_u, from_v, to_v;       /* 32 less log2 of width and height; log2 of the width */
    const void *texels;
    int32_t to_color;           /* bytes from a depth to its pixel */
};

#if TEXEL_PLACE_ROWS
SMEAR_STATIC_ASSERT(offsetof(struct texel_place_rows, dz) == 32 && offsetof(struct texel_place_rows, v) == 60
                        && offsetof(struct texel_place_rows, to_color) == 96 && sizeof(struct texel_plane) == 12
                        && sizeof(struct span_side) == 12 && offsetof(struct span_side, right) == 4,
                    "the assembly knows struct texel_place_rows and struct span_side");
#endif

/* Assembly begins each row by going on to the next one. */
static inline void texel_place_rows_before(struct texel_place_rows *r)
{
    r->y--;
    r->z -= r->dz_down;
    r->depth = (uint16_t *)((uintptr_t)r->depth - (uintptr_t)r->stride);
}

/* Draws rows from left to before right, where there are such pixels. Afterwards the rows are anything. */
static inline void texel_place_rows_reference(struct texel_place_rows *r)
{
    for (int32_t row = 0; row < r->count; row++) {
        const int32_t left = r->side[row].left, right = r->side[row].right;
        uint16_t *const depth = (uint16_t *)((uintptr_t)r->depth + (uintptr_t)(row * r->stride));
        for (int32_t x = left; x < right && right - left <= r->longest; x++) {
            const int32_t y = r->y + row;
            const struct place place = place_divided(texel_plane_at(&r->q, x, y), texel_plane_at(&r->u, x, y),
                                                     texel_plane_at(&r->v, x, y), 0, false);
            const uint32_t u = (uint32_t)place.u << r->up >> r->from_u, v = (uint32_t)place.v << r->up >> r->from_v;
            texel_pixel((void *)((uintptr_t)(depth + x) + (uintptr_t)r->to_color), depth + x,
                        r->z + r->dz_down * (uint32_t)row + r->dz * (uint32_t)x, r->texels, NULL,
                        packed_uv(u << r->from_u, v << r->from_v), 32 - r->from_u, 32 - r->from_v, TEXELS_NARROW);
        }
    }
}

#endif

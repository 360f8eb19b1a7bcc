/* SPDX-License-Identifier: MIT */
/* flat_lines.h - depth-tested pixels of one colour in rows one below the other, between two edges. */
#ifndef SMEAR_KERNELS_FLAT_LINES_H
#define SMEAR_KERNELS_FLAT_LINES_H

#include "kernels/edge_walk.h"
#include "kernels/flat_run.h"
#include "kernels/fill.h"

/* Where the depth code breaks, units q11: below it they have 32 times as many codes 16.16, from it on twice. And the code there, of
 * which the half for rounding is part. */
#define FLAT_BREAK (32768u << 11)
#define FLAT_BREAK_CODE 0x80008000u

/* The code 16.16 of a pixel. */
SMEAR_INLINE uint32_t flat_code(uint32_t z, bool breaks)
{
    return !breaks ? z : FLAT_BREAK_CODE + ((int32_t)z < 0 ? z << 5 : z << 1);
}

/* The next row, and what changes from row to row: in the order in which assembly takes them. Of sides, the left one first, these are
 * the low and the high words of struct edge_fine; z of pixel 0, which may lie outside the memory, and its steps to the right and down, are
 * codes 16.16. */
struct flat_lines {
#if SMEAR_ASM_ARMV6M
    uint32_t step[2][2], x[2][2];
    int32_t x0, x1;                 /* columns */
    uint32_t dz_down;
    int32_t depth_bytes;            /* from row to row */
    uint32_t z;
    uint16_t *depth;
    uintptr_t to_pixels;            /* what pixels lie behind depth, or where they are wide twice depth */
    uint32_t dz;
#else
    uint32_t x[2][2], step[2][2];
    int32_t x0, x1;
    uintptr_t to_pixels;
    uint16_t *depth;
    uint32_t z, dz, dz_down;
    int32_t depth_bytes, row;
#endif
    uint32_t color;                 /* twice where pixels are narrow */
    bool narrow, breaks;            /* the codes have their break in them: z and steps are what flat_code takes */
    bool shadow;                    /* not for flat_lines: pixels, which are wide, are darkened by `color` and its alpha */
    smear_transfer transfer;
    uint32_t last, dark;            /* shadow: a pixel, and what it becomes */
};

static inline void flat_lines_side(struct flat_lines *l, int side, const struct edge_fine *e)
{
    l->x[side][0] = e->low;
    l->x[side][1] = (uint32_t)e->high;
    l->step[side][0] = e->step_low;
    l->step[side][1] = (uint32_t)e->step_high;
}

/* What references walk by. */
static inline void flat_lines_take_sides(const struct flat_lines *l, struct edge_fine side[2])
{
    for (int i = 0; i < 2; i++)
        side[i] = (struct edge_fine){ l->x[i][0], (int32_t)l->x[i][1], l->step[i][0], (int32_t)l->step[i][1] };
}

static inline void flat_lines_go_down(struct flat_lines *l, struct edge_fine side[2])
{
    edge_fine_step(&side[0]);
    edge_fine_step(&side[1]);
    l->z += l->dz_down;
    l->depth = (uint16_t *)(void *)((uint8_t *)l->depth + l->depth_bytes);
}

/* Draws pixels [a, b) of the next row, a < b. Those of a row whose codes have their break within it one by one. */
SMEAR_INLINE void flat_line(const struct flat_lines *l, int32_t a, int32_t b, bool narrow)
{
    void *const pixels = (void *)((uintptr_t)l->depth * (narrow ? 1u : 2u) + l->to_pixels);
    const uint32_t color = narrow ? l->color & 0xffffu : l->color;
    uint32_t z = l->z + l->dz * (uint32_t)a, dz = l->dz;
    if (l->breaks) {
        if (((z ^ (z + dz * (uint32_t)(b - a - 1))) >> 31) != 0) {
            for (int32_t x = a; x < b; x++, z += dz)
                flat_pixel(pixels, l->depth, x, flat_code(z, true), color, narrow);
            return;
        }
        dz <<= (int32_t)z < 0 ? 5 : 1;
        z = flat_code(z, true);
    }
    flat_run(pixel_after(pixels, a, narrow), l->depth + a, b - a, z, dz, color, narrow);
}

/* In runs of each row. */
SMEAR_INLINE void flat_lines_runs(struct flat_lines *l, int32_t n, bool narrow)
{
    struct edge_fine side[2];
    flat_lines_take_sides(l, side);
    for (; n > 0; n--) {
        const int32_t a = max_i32(edge_fine_pixel(&side[0]), l->x0), b = min_i32(edge_fine_pixel(&side[1]), l->x1);
        if (a < b)
            flat_line(l, a, b, narrow);
        flat_lines_go_down(l, side);
    }
    flat_lines_side(l, 0, &side[0]);
    flat_lines_side(l, 1, &side[1]);
}

#endif

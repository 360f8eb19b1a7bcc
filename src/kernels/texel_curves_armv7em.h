/* SPDX-License-Identifier: MIT */
/* texel_curves_armv7em.h - rows of narrow texels whose coordinates are polynomials, in assembly for Cortex-M4: a row takes a third of
 * the compiler's instructions, which keeps all on the stack that the pixels have no register for. */
#ifndef SMEAR_KERNELS_TEXEL_CURVES_ARMV7EM_H
#define SMEAR_KERNELS_TEXEL_CURVES_ARMV7EM_H

#include "kernels/span_side.h"
#include "kernels/texels_draw.h"

#if SMEAR_ASM_ARMV7EM

/* A polynomial of x and y, modulo 2^32. */
struct texel_polynomial {
    uint32_t dxy, dx, dyy, dy, at, dxx;
};

/* Rows one below the other, and coordinates of their pixels. */
struct texel_curve_rows {
    const struct span_side *side;
    int32_t count;              /* of rows; at least one */
    int32_t x0, y;              /* polynomials are of x - x0 and of y, y + 1 and so on */
    uint32_t z, dz_down;        /* depth codes 16.16 at column 0 of the first row; their change from row to row */
    uint16_t *depth;            /* of that pixel, which may lie outside the memory */
    int32_t stride;             /* bytes */
    struct texel_polynomial u, v;
    uint32_t dz, ddu, ddv;      /* ddu is 2 dxx of u */
    int32_t to_depth;           /* bytes from a pixel to its depth */
    const void *texels;
};

SMEAR_STATIC_ASSERT(offsetof(struct texel_curve_rows, u) == 32 && offsetof(struct texel_curve_rows, dz) == 80
                        && sizeof(struct texel_polynomial) == 24 && sizeof(struct span_side) == 12
                        && offsetof(struct span_side, right) == 4,
                    "the assembly knows struct texel_curve_rows and struct span_side");

static inline uint32_t texel_polynomial_at(const struct texel_polynomial *p, uint32_t x, uint32_t y, uint32_t *step)
{
    const uint32_t dx = p->dxy * y + p->dx + p->dxx * x;
    *step = dx + p->dxx * (x + 1u);
    return p->at + (p->dyy * y + p->dy) * y + dx * x;
}

/* Draws rows from left to before right, where there are such pixels, as texels_draw does. Afterwards the rows are anything. */
static inline void texel_curve_rows_reference(struct texel_curve_rows *r, int log2_width, int log2_height)
{
    for (int32_t row = 0; row < r->count; row++) {
        const int32_t left = r->side[row].left, n = r->side[row].right - left, bytes = row * r->stride + 2 * left;
        struct texel_run run = { .dz = r->dz, .ddu = r->ddu, .ddv = r->ddv, .texels = r->texels };
        run.u = texel_polynomial_at(&r->u, (uint32_t)(left - r->x0), (uint32_t)(r->y + row), &run.du);
        run.v = texel_polynomial_at(&r->v, (uint32_t)(left - r->x0), (uint32_t)(r->y + row), &run.dv);
        run.z = r->z + r->dz_down * (uint32_t)row + r->dz * (uint32_t)left;
        run.depth = (uint16_t *)((uintptr_t)r->depth + (uintptr_t)bytes);
        run.color = (void *)((uintptr_t)run.depth - (uintptr_t)r->to_depth);
        if (n > 0)
            texels_draw_reference(&run, n, log2_width, log2_height, TEXELS_NARROW);
    }
}

/* Of a polynomial dxy, dx, dyy, dy, at and dxx are in registers, x in r3 and y in r4: AT becomes the value, STEP the first change. */
#define ARMV7EM_POLYNOMIAL(DXY, DX, DYY, DY, AT, DXX, STEP) \
        "mla " DX ", " DXY ", r4, " DX "\n\t" \
        "mla " DY ", " DYY ", r4, " DY "\n\t" \
        "mla " AT ", " DY ", r4, " AT "\n\t" \
        "mla " DYY ", " DXX ", r3, " DX "\n\t" \
        "mla " DX ", " DXX ", r3, " DYY "\n\t" \
        "mla " AT ", " DYY ", r3, " AT "\n\t" \
        "add " STEP ", " DX ", " DXX "\n\t"

/* On the stack lie the end of a row, and the rows, whose members have come to the row before. */
static inline __attribute__((always_inline)) void texel_curve_rows_armv7em(struct texel_curve_rows *rows, int log2_width, int log2_height)
{
    rows->y--;
    rows->z -= rows->dz_down;
    rows->depth = (uint16_t *)((uintptr_t)rows->depth - (uintptr_t)rows->stride);
    register struct texel_curve_rows *r0 __asm__("r0") = rows;
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r0}\n\t"
        "sub sp, #4\n"
        "40: ldr r0, [sp, #4]\n"
        "41: ldm r0, {r1, r2, r3, r4, r5, r6, r7, r8}\n\t"
        "subs r2, r2, #1\n\t"
        "blt 42f\n\t"
        "ldrd r9, r10, [r1], #12\n\t"
        "adds r4, r4, #1\n\t"
        "add r5, r5, r6\n\t"
        "add r7, r7, r8\n\t"
        "stm r0, {r1, r2, r3, r4, r5}\n\t"
        "str r7, [r0, #24]\n\t"
        "subs lr, r10, r9\n\t"
        "ble 41b\n\t"
        "sub r3, r9, r3\n\t"
        "add r7, r7, r9, lsl #1\n\t"
        "ldr r1, [r0, #80]\n\t"
        "mla r5, r1, r9, r5\n\t"
        "adds r0, #32\n\t"
        "ldm r0!, {r2, r6, r8, r9, r10, r12}\n\t"
        ARMV7EM_POLYNOMIAL("r2", "r6", "r8", "r9", "r10", "r12", "r2")
        "ldm r0!, {r1, r6, r8, r9, r11, r12}\n\t"
        ARMV7EM_POLYNOMIAL("r1", "r6", "r8", "r9", "r11", "r12", "r3")
        "mov r9, r5\n\t"
        "ldm r0, {r1, r4, r5, r8, r12}\n\t"
        "sub r7, r7, r8\n\t"
        "add r0, r7, lr, lsl #1\n\t"
        "str r0, [sp]\n\t"
        ARMV7EM_BENT("40b")
        "42: add sp, #8"
        : "+r"(r0)
        : ARMV7EM_SIZES
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

#endif

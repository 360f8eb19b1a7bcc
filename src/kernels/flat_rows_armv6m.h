/* SPDX-License-Identifier: MIT */
/* flat_rows_armv6m.h - flat_rows in assembly for Cortex-M0 and M0+: the edges' numbers are loaded and stored many at once, and pixels
 * have all they need in low registers. Half of the instructions of a row, and four fifths of those of a pixel. */
#ifndef SMEAR_KERNELS_FLAT_ROWS_ARMV6M_H
#define SMEAR_KERNELS_FLAT_ROWS_ARMV6M_H

#include "kernels/flat_row_armv6m.h"
#include "kernels/flat_rows.h"

#if FLAT_ROWS && SMEAR_ASM_ARMV6M

/* What changes from row to row: z and depth. And what does not. */
struct flat_rows_walk {
    int32_t x0, x1;
    uint32_t dz_down;
    int32_t depth_bytes;            /* from row to row */
    uint32_t z;
    uint16_t *depth;
    uint32_t to_pixels;             /* pixels - depth, or where pixels are wide - 2 depth */
    uint32_t dz, color;
};

SMEAR_STATIC_ASSERT(offsetof(struct flat_rows_walk, dz_down) == 8 && offsetof(struct flat_rows_walk, z) == 16
                        && offsetof(struct flat_rows_walk, to_pixels) == 24 && offsetof(struct flat_rows_walk, color) == 32,
                    "the assembly knows struct flat_rows_walk");
SMEAR_STATIC_ASSERT(offsetof(struct edge_walk, x) == 0 && offsetof(struct edge_walk, rest) == 4
                        && offsetof(struct edge_walk, step_rest) == 12 && sizeof(struct edge_walk) == 20,
                    "the assembly knows struct edge_walk");

/* Takes the edge at r7: its pixel into register PIXEL, and goes on by a row. */
#define FLAT_ROWS_EDGE(PIXEL, LABEL)   \
    "ldm r7!, {r0, r1, r2, r3, r4}\n\t" \
    "asrs " PIXEL ", r0, #8\n\t"        \
    "adds r0, r0, r2\n\t"               \
    "adds r1, r1, r3\n\t"               \
    "ble " LABEL "f\n\t"                \
    "subs r1, r1, r4\n\t"               \
    "adds r0, #1\n" LABEL ": subs r7, #20\n\t" \
    "stm r7!, {r0, r1}\n\t"

/* struct flat_rows_walk in r8, rows in r9, edges in r10 and r11; the rest is of flat_row_armv6m.h. */
#define FLAT_ROWS_ARMV6M(STORE, DOUBLE, SINGLE, TWICE, THRICE, FOUR)                                                  \
    __asm__ volatile(".syntax unified\n\t"                                                                            \
                     "mov r8, r0\n\t"                                                                                 \
                     "mov r9, r1\n\t"                                                                                 \
                     "mov r10, r2\n\t"                                                                                \
                     "mov r11, r3\n"                                                                                  \
                     "1: mov r7, r10\n\t" FLAT_ROWS_EDGE("r5", "2") "mov r7, r11\n\t" FLAT_ROWS_EDGE("r6", "3")       \
                     "mov r7, r8\n\t"                                                                                 \
                     FLAT_ROW_ARMV6M(FLAT_ROW_PIXEL, STORE, DOUBLE, SINGLE, TWICE, THRICE, FOUR) \
                     "2:"                                                                                             \
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)                                                         \
                     :                                                                                                \
                     : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "cc", "memory")

static inline void flat_rows_armv6m(const struct flat_rows *r, struct edge_walk *left, struct edge_walk *right)
{
    const uint32_t pixels = (uint32_t)(uintptr_t)r->pixels, depth = (uint32_t)(uintptr_t)r->depth;
    struct flat_rows_walk walk = { r->x0, r->x1, r->dz_down, r->stride * 2, r->z, r->depth, pixels - depth * (r->narrow ? 1u : 2u),
                                   r->dz, r->color };
    register struct flat_rows_walk *r0 __asm__("r0") = &walk;
    register int32_t r1 __asm__("r1") = r->rows;
    register struct edge_walk *r2 __asm__("r2") = left;
    register struct edge_walk *r3 __asm__("r3") = right;
    if (r->narrow)
        FLAT_ROWS_ARMV6M("strh", "", "2", "4", "6", "8");
    else
        FLAT_ROWS_ARMV6M("str", "adds r2, r2, r1\n\t", "4", "8", "12", "16");
}

#endif

#endif

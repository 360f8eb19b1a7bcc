/* SPDX-License-Identifier: MIT */
/* flat_rows_armv7em.h - flat_rows in assembly for Cortex-M4: two pixels at once, and edges that stay in registers. Half of the
 * compiler's instructions of a row, and two thirds of those of a pixel. */
#ifndef SMEAR_KERNELS_FLAT_ROWS_ARMV7EM_H
#define SMEAR_KERNELS_FLAT_ROWS_ARMV7EM_H

#include "kernels/edge_sides.h"
#include "kernels/flat_rows.h"

#if SMEAR_ASM_ARMV7EM

/* How edges change, and what a row is made of. Rows have numbers from minus their count to -1. */
struct flat_rows_lines {
    int32_t step_left, rest_left, dy_left, step_right, rest_right, dy_right;
    int32_t x0, x1;
    void *pixels;               /* pixel 0 behind the last row */
    uint16_t *depth;
    uint32_t z, dz, dz_down;
    int32_t stride, row;
    uint32_t color;             /* twice where pixels are narrow */
};

SMEAR_STATIC_ASSERT(offsetof(struct flat_rows_lines, pixels) == 32 && offsetof(struct flat_rows_lines, row) == 32 + 24
                        && offsetof(struct flat_rows_lines, color) == 32 + 28,
                    "the assembly knows struct flat_rows_lines");
SMEAR_STATIC_ASSERT(offsetof(struct edge_walk, x) == 0 && offsetof(struct edge_walk, rest) == 4, "the assembly knows struct edge_walk");

/* A pixel whose colour has SIZE bytes. */
#define FLAT_LINES_PIXEL(STORE, SIZE)  \
    "lsrs r4, r2, #16\n\t"             \
    "ldrh r5, [r1], #2\n\t"            \
    "add r2, r2, r3\n\t"               \
    "cmp r5, r4\n\t"                   \
    "bhs 9f\n\t"                       \
    "strh r4, [r1, #-2]\n\t"           \
    STORE " r7, [r0]\n"                \
    "9: adds r0, #" SIZE "\n\t"

/* Two pixels, if both are seen; else at SLOW. Halves of r5 are 0 where the old depth is not less, and so is their product where one
 * of them is. */
#define FLAT_LINES_PAIR(STORE_TWO, SLOW) \
    "adds r4, r2, r3\n\t"                \
    "pkhtb r4, r4, r2, asr #16\n\t"      \
    "ldr r5, [r1], #4\n\t"               \
    "uqsub16 r5, r4, r5\n\t"             \
    "add r2, r2, r3, lsl #1\n\t"         \
    "smulbt r6, r5, r5\n\t"              \
    "cbz r6, " SLOW "f\n\t"              \
    "str r4, [r1, #-4]\n\t" STORE_TWO

/* Two pixels of which one at most is seen. */
#define FLAT_LINES_SLOW_NARROW   \
    "cbz r5, 9f\n\t"             \
    "ldr r5, [r1, #-4]\n\t"      \
    "usub16 r6, r5, r4\n\t"      \
    "sel r4, r5, r4\n\t"         \
    "str r4, [r1, #-4]\n\t"      \
    "ldr r5, [r0]\n\t"           \
    "sel r5, r5, r7\n\t"         \
    "str r5, [r0]\n"             \
    "9: adds r0, #4\n\t"

#define FLAT_LINES_SLOW_WIDE     \
    "cbz r5, 9f\n\t"             \
    "lsls r6, r5, #16\n\t"       \
    "itt ne\n\t"                 \
    "strne r7, [r0]\n\t"         \
    "strhne r4, [r1, #-4]\n\t"   \
    "lsrs r4, r4, #16\n\t"       \
    "lsrs r6, r5, #16\n\t"       \
    "itt ne\n\t"                 \
    "strne r7, [r0, #4]\n\t"     \
    "strhne r4, [r1, #-2]\n"     \
    "9: adds r0, #8\n\t"

/* r9 points into struct flat_rows_lines; the left edge's place and rest lie in r10 and r11, the right one's in r12 and lr. Then, in a
 * row: pixels r0, depth r1, z r2, dz r3, the colour r7, rounds of four pixels r8. LOG2 is of the bytes of a pixel. */
#define FLAT_LINES(STORE, STORE_TWO, SLOW, LOG2, SIZE)                                      \
    __asm__ volatile(".syntax unified\n\t"                                                  \
                     "push {r1, r2}\n\t"                                                    \
                     "add r9, r0, #32\n\t"                                                  \
                     "ldrd r10, r11, [r1]\n\t"                                              \
                     "ldrd r12, lr, [r2]\n"                                                 \
                     "1: ldmdb r9, {r0, r1, r2, r3, r4, r5, r6, r7}\n\t"                    \
                     "cmp r6, r10, asr #8\n\t"                                              \
                     "it lt\n\t"                                                            \
                     "asrlt r6, r10, #8\n\t"                                                \
                     "cmp r7, r12, asr #8\n\t"                                              \
                     "it gt\n\t"                                                            \
                     "asrgt r7, r12, #8\n\t"                                                \
                     EDGE_SIDES_STEP("r10", "r11", "r0", "r1", "r2")                        \
                     EDGE_SIDES_STEP("r12", "lr", "r3", "r4", "r5")                         \
                     "subs r7, r7, r6\n\t"                                                  \
                     "ble 5f\n\t"                                                           \
                     "ldm r9, {r0, r1, r2, r3, r4, r5, r8}\n\t"                             \
                     "mla r4, r4, r8, r2\n\t"                                               \
                     "mla r2, r3, r6, r4\n\t"                                               \
                     "mla r5, r5, r8, r6\n\t"                                               \
                     "add r0, r0, r5, lsl #" LOG2 "\n\t"                                    \
                     "add r1, r1, r5, lsl #1\n\t"                                           \
                     "lsrs r6, r7, #1\n\t"                                                  \
                     "ldr r7, [r9, #28]\n\t"                                                \
                     "bcc 2f\n\t"                                                           \
                     "mov r8, r6\n\t"                                                       \
                     FLAT_LINES_PIXEL(STORE, SIZE)                                          \
                     "mov r6, r8\n"                                                         \
                     "2: lsrs r6, r6, #1\n\t"                                               \
                     "mov r8, r6\n\t"                                                       \
                     "bcs 4f\n\t"                                                           \
                     "subs r8, r8, #1\n\t"                                                  \
                     "blt 5f\n"                                                             \
                     "3: " FLAT_LINES_PAIR(STORE_TWO, "6")                                  \
                     "4: " FLAT_LINES_PAIR(STORE_TWO, "7")                                  \
                     "subs r8, r8, #1\n\t"                                                  \
                     "bge 3b\n"                                                             \
                     "5: ldr r8, [r9, #24]\n\t"                                             \
                     "adds r8, r8, #1\n\t"                                                  \
                     "str r8, [r9, #24]\n\t"                                                \
                     "bne 1b\n\t"                                                           \
                     "b 8f\n"                                                               \
                     "6: " SLOW "b 4b\n"                                                    \
                     "7: " SLOW                                                             \
                     "subs r8, r8, #1\n\t"                                                  \
                     "bge 3b\n\t"                                                           \
                     "b 5b\n"                                                               \
                     "8: pop {r1, r2}\n\t"                                                  \
                     "strd r10, r11, [r1]\n\t"                                              \
                     "strd r12, lr, [r2]"                                                   \
                     : "+r"(r0), "+r"(r1), "+r"(r2)                                         \
                     :                                                                      \
                     : "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* Rows are one at least. */
static inline void flat_rows_armv7em(const struct flat_rows *r, struct edge_walk *left, struct edge_walk *right)
{
    const int32_t end = r->rows * r->stride;
    struct flat_rows_lines lines = { left->step, left->step_rest, left->dy, right->step, right->step_rest, right->dy, r->x0, r->x1,
                                     pixel_after(r->pixels, end, r->narrow), r->depth + end,
                                     r->z + r->dz_down * (uint32_t)r->rows, r->dz, r->dz_down, r->stride, -r->rows,
                                     r->narrow ? r->color * 0x10001u : r->color };
    register struct flat_rows_lines *r0 __asm__("r0") = &lines;
    register struct edge_walk *r1 __asm__("r1") = left;
    register struct edge_walk *r2 __asm__("r2") = right;
    if (r->narrow)
        FLAT_LINES("strh", "str r7, [r0], #4\n\t", FLAT_LINES_SLOW_NARROW, "1", "2");
    else
        FLAT_LINES("str", "strd r7, r7, [r0], #8\n\t", FLAT_LINES_SLOW_WIDE, "2", "4");
}

#endif

#endif

/* SPDX-License-Identifier: MIT */
/* flat_rows_arm.h - flat_rows in assembly for ARM7TDMI and what else runs ARM code without vectors: edges stay in registers, rows
 * need no numbers from the stack but constants, and hidden pixels no branch. Half of the compiler's cycles. */
#ifndef SMEAR_KERNELS_FLAT_ROWS_ARM_H
#define SMEAR_KERNELS_FLAT_ROWS_ARM_H

#include "kernels/flat_rows.h"

#if SMEAR_ASM_ARM

/* How edges change, and what a row is made of. Rows have numbers from minus their count to -1. */
struct flat_rows_arm {
    int32_t step_left, rest_left, dy_left, step_right, rest_right, dy_right;
    int32_t x0, x1;
    void *pixels;               /* pixel 0 behind the last row */
    uint16_t *depth;
    uint32_t z, dz, dz_down;
    int32_t stride;
    uint32_t color;
};

SMEAR_STATIC_ASSERT(offsetof(struct flat_rows_arm, pixels) == 32 && offsetof(struct flat_rows_arm, color) == 32 + 24,
                    "the assembly knows struct flat_rows_arm");
SMEAR_STATIC_ASSERT(offsetof(struct edge_walk, x) == 0 && offsetof(struct edge_walk, rest) == 4, "the assembly knows struct edge_walk");

/* From edge_step: an edge's place, its rest, and by how much they change. */
#define FLAT_ARM_EDGE(X, REST, STEP, STEP_REST, DY) \
    "add " X ", " X ", " STEP "\n\t"                \
    "adds " REST ", " REST ", " STEP_REST "\n\t"    \
    "subgt " REST ", " REST ", " DY "\n\t"          \
    "addgt " X ", " X ", #1\n\t"

/* The pixel AT bytes of depth and PLACE bytes of colours further on, in six instructions: the code at FLAT_ARM_PIXELS jumps over
 * some of them. */
#define FLAT_ARM_PIXEL(STORE, AT, PLACE)  \
    "ldrh r5, [r1, #" AT "]\n\t"          \
    "mov r4, r2, lsr #16\n\t"             \
    "add r2, r2, r3\n\t"                  \
    "cmp r4, r5\n\t"                      \
    "strhhi r4, [r1, #" AT "]\n\t" STORE " r6, [r0, #" PLACE "]\n\t"

/* r7 > 0 pixels, eight a round; the first round begins behind its first pixels where they are fewer. */
#define FLAT_ARM_PIXELS(LOG2, STORE, P1, P2, P3, P4, P5, P6, P7, P8)                                            \
    "rsb r4, r7, #0\n\t"                                                                                        \
    "and r4, r4, #7\n\t"                                                                                        \
    "sub r0, r0, r4, lsl #" LOG2 "\n\t"                                                                         \
    "sub r1, r1, r4, lsl #1\n\t"                                                                                \
    "add r7, r7, r4\n\t"                                                                                        \
    "add r4, r4, r4, lsl #1\n\t"                                                                                \
    "add pc, pc, r4, lsl #3\n\t"                                                                                \
    "nop\n"                                                                                                     \
    "3: " FLAT_ARM_PIXEL(STORE, "0", "0") FLAT_ARM_PIXEL(STORE, "2", P1) FLAT_ARM_PIXEL(STORE, "4", P2)         \
    FLAT_ARM_PIXEL(STORE, "6", P3) FLAT_ARM_PIXEL(STORE, "8", P4) FLAT_ARM_PIXEL(STORE, "10", P5)               \
    FLAT_ARM_PIXEL(STORE, "12", P6) FLAT_ARM_PIXEL(STORE, "14", P7)                                             \
    "add r0, r0, #" P8 "\n\t"                                                                                   \
    "add r1, r1, #16\n\t"                                                                                       \
    "subs r7, r7, #8\n\t"                                                                                       \
    "bgt 3b\n"

/* Where depth may have its break in a row it is in units from the break on: z and dz of pixels that lie on one side. At 5, pixels
 * that may not. */
#define FLAT_ARM_BREAK                   \
    "sub r4, r7, #1\n\t"                 \
    "mla r4, r3, r4, r2\n\t"             \
    "eors r4, r4, r2\n\t"                \
    "bmi 5f\n\t"                         \
    "cmp r2, #0\n\t"                     \
    "movlt r3, r3, lsl #5\n\t"           \
    "movlt r2, r2, lsl #5\n\t"           \
    "movge r3, r3, lsl #1\n\t"           \
    "movge r2, r2, lsl #1\n\t"           \
    "add r2, r2, #0x8000\n\t"            \
    "add r2, r2, #0x80000000\n\t"

#define FLAT_ARM_ACROSS(STORE, SINGLE)   \
    "5: movs r4, r2, lsl #1\n\t"         \
    "movcs r4, r2, lsl #5\n\t"           \
    "add r4, r4, #0x8000\n\t"            \
    "add r4, r4, #0x80000000\n\t"        \
    "mov r4, r4, lsr #16\n\t"            \
    "add r2, r2, r3\n\t"                 \
    "ldrh r5, [r1]\n\t"                  \
    "cmp r4, r5\n\t"                     \
    "strhhi r4, [r1]\n\t" STORE " r6, [r0]\n\t" \
    "add r0, r0, #" SINGLE "\n\t"        \
    "add r1, r1, #2\n\t"                 \
    "subs r7, r7, #1\n\t"                \
    "bne 5b\n\t"                         \
    "b 8b\n"

/* r9 points into struct flat_rows_arm; the left edge's place and rest lie in r10 and r11, the right one's in r12 and lr, the row's
 * number in r8. Then, in a row: pixels r0, depth r1, z r2, dz r3, the colour r6, how many r7. LOG2 is of the bytes of a pixel. */
#define FLAT_ROWS_ARM(BREAK, PIXELS, ACROSS, LOG2)                                               \
    __asm__ volatile(".syntax unified\n\t"                                                       \
                     "push {r1, r2}\n\t"                                                         \
                     "mov r8, r3\n\t"                                                            \
                     "add r9, r0, #32\n\t"                                                       \
                     "ldm r1, {r10, r11}\n\t"                                                    \
                     "ldm r2, {r12, lr}\n"                                                       \
                     "1: ldmdb r9, {r0, r1, r2, r3, r4, r5, r6, r7}\n\t"                         \
                     "cmp r6, r10, asr #8\n\t"                                                   \
                     "movlt r6, r10, asr #8\n\t"                                                 \
                     "cmp r7, r12, asr #8\n\t"                                                   \
                     "movgt r7, r12, asr #8\n\t"                                                 \
                     FLAT_ARM_EDGE("r10", "r11", "r0", "r1", "r2")                               \
                     FLAT_ARM_EDGE("r12", "lr", "r3", "r4", "r5")                                \
                     "subs r7, r7, r6\n\t"                                                       \
                     "ble 8f\n\t"                                                                \
                     "ldm r9, {r0, r1, r2, r3, r4, r5}\n\t"                                      \
                     "mla r2, r4, r8, r2\n\t"                                                    \
                     "mla r4, r5, r8, r6\n\t"                                                    \
                     "mla r2, r3, r6, r2\n\t"                                                    \
                     "ldr r6, [r9, #24]\n\t"                                                     \
                     "add r0, r0, r4, lsl #" LOG2 "\n\t"                                         \
                     "add r1, r1, r4, lsl #1\n\t" BREAK PIXELS                                   \
                     "8: adds r8, r8, #1\n\t"                                                    \
                     "bne 1b\n\t" ACROSS                                                         \
                     "9: pop {r1, r2}\n\t"                                                       \
                     "stm r1, {r10, r11}\n\t"                                                    \
                     "stm r2, {r12, lr}"                                                         \
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)                                    \
                     :                                                                           \
                     : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

#define FLAT_ARM_NARROW FLAT_ARM_PIXELS("1", "strhhi", "2", "4", "6", "8", "10", "12", "14", "16")
#define FLAT_ARM_WIDE FLAT_ARM_PIXELS("2", "strhi", "4", "8", "12", "16", "20", "24", "28", "32")

/* Rows are one at least. */
static inline void flat_rows_arm(const struct flat_rows *r, struct edge_walk *left, struct edge_walk *right)
{
    const int32_t end = r->rows * r->stride;
    struct flat_rows_arm lines = { left->step, left->step_rest, left->dy, right->step, right->step_rest, right->dy, r->x0, r->x1,
                                   pixel_after(r->pixels, end, r->narrow), r->depth + end, r->z + r->dz_down * (uint32_t)r->rows,
                                   r->dz, r->dz_down, r->stride, r->color };
    register struct flat_rows_arm *r0 __asm__("r0") = &lines;
    register struct edge_walk *r1 __asm__("r1") = left;
    register struct edge_walk *r2 __asm__("r2") = right;
    register int32_t r3 __asm__("r3") = -r->rows;
    if (r->narrow && r->breaks)
        FLAT_ROWS_ARM(FLAT_ARM_BREAK, FLAT_ARM_NARROW, "b 9f\n" FLAT_ARM_ACROSS("strhhi", "2"), "1");
    else if (r->narrow)
        FLAT_ROWS_ARM("", FLAT_ARM_NARROW, "", "1");
    else if (r->breaks)
        FLAT_ROWS_ARM(FLAT_ARM_BREAK, FLAT_ARM_WIDE, "b 9f\n" FLAT_ARM_ACROSS("strhi", "4"), "2");
    else
        FLAT_ROWS_ARM("", FLAT_ARM_WIDE, "", "2");
}

#endif

#endif

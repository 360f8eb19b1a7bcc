/* SPDX-License-Identifier: MIT */
/* tiny_cover.h - which of a box of up to 2 x 2 pixels a triangle covers. */
#ifndef SMEAR_KERNELS_TINY_COVER_H
#define SMEAR_KERNELS_TINY_COVER_H

#include "kernels/kernels.h"

/* In assembly all of its pixels are kept, which takes no test. */
#define TINY_COVER_ARMV6M (SMEAR_ASM_ARMV6M && !SMEAR_SMALL_CODE)
#define TINY_COVER_ARMV7EM (SMEAR_ASM_ARMV7EM && !SMEAR_SMALL_CODE)
#define TINY_COVER_KEEPS (TINY_COVER_ARMV6M || TINY_COVER_ARMV7EM)

/* A pixel that a triangle covers, and its edge functions there: twice the areas opposite to corners 1 and 2, q16. */
struct covered {
    int32_t x, y, e1, e2;
};

/* What a triangle covers in a box of up to TINY_BOX pixels a side. */
enum { TINY_BOX = 2, COVERED_KEPT = TINY_COVER_KEEPS ? TINY_BOX * TINY_BOX : 2 };
struct tiny_cover {
    int32_t area;                   /* twice the area, q16 px */
    int32_t count;                  /* centres covered */
    struct covered covered[COVERED_KEPT];       /* the first of them, row by row */
};

/* 0 for edges that go up (left ones) or right (top ones), whose centres count, else -1. */
static inline int32_t tiny_cover_bias(int32_t dx, int32_t dy) { return (dx - dy * 65536 - 1) >> 31; }

/* Counts a pixel of which no edge function is negative, and keeps it while there is room. */
SMEAR_INLINE void tiny_cover_keep(struct tiny_cover *t, int32_t x, int32_t y, int32_t e0, int32_t e1, int32_t e2)
{
    if ((e0 | e1 | e2) < 0)
        return;
    if (t->count < COVERED_KEPT)
        t->covered[t->count] = (struct covered){ x, y, e1, e2 };
    t->count++;
}

/* Corners are x and y, q8 px, clockwise, less than 16 px from the box and from each other. The box, which is not empty, is its first
 * pixel and that behind its last one. */
static inline void tiny_cover_reference(struct tiny_cover *t, const int32_t *box, const int32_t *v0, const int32_t *v1,
                                        const int32_t *v2)
{
    const int32_t x1 = v1[0] - v0[0], y1 = v1[1] - v0[1], x2 = v2[0] - v0[0], y2 = v2[1] - v0[1];
    t->area = x1 * y2 - x2 * y1;
    t->count = 0;
    for (int32_t y = box[1]; y < box[3]; y++)
        for (int32_t x = box[0]; x < box[2]; x++) {
            const int32_t cx = x * 256 + 128 - v0[0], cy = y * 256 + 128 - v0[1];
            const int32_t e1 = y2 * cx - x2 * cy, e2 = x1 * cy - y1 * cx;
            const int32_t e0 = t->area - e1 - e2 + tiny_cover_bias(x2 - x1, y2 - y1);
            tiny_cover_keep(t, x, y, e0, e1 + tiny_cover_bias(-x2, -y2), e2 + tiny_cover_bias(x1, y1));
        }
}

#if SMEAR_ASM_ARMV6M
SMEAR_STATIC_ASSERT(offsetof(struct tiny_cover, count) == 4 && offsetof(struct tiny_cover, covered) == 8
                        && sizeof(struct covered) == 16,
                    "the assembly knows struct tiny_cover");

/* Keeps pixel (r2, r3) if its edge functions, r4 to r6, are not negative. */
#define TINY_COVER_TEST(LABEL)  \
    "movs r1, r4\n\t"           \
    "orrs r1, r5\n\t"           \
    "orrs r1, r6\n\t"           \
    "bmi " LABEL "f\n\t"        \
    "stm r7!, {r2, r3, r5, r6}\n" LABEL ": "

/* Edge function E goes on by the step at AT bytes of the stack, q8 px. */
#define TINY_COVER_STEP(STEP, E, AT) \
    "ldr r1, [sp, #" AT "]\n\t"      \
    "lsls r1, r1, #8\n\t" STEP " " E ", " E ", r1\n\t"

/* Adds to E, of the edge (DX, DY), what decides centres on it. */
#define TINY_COVER_BIAS(ADD, DX, DY) \
    "lsls r5, " DY ", #16\n\t"       \
    "subs r5, r5, " DX "\n\t"        \
    "mvns r5, r5\n\t"                \
    "asrs r5, r5, #31\n\t" ADD ", r5\n\t"

/* Corners as seen from the first centre in r6 and r7, r1 and r2, r0 and r3; e0, e1 and e2 in r4, r10 and r9, the area in r11. */
#define TINY_COVER_CORNERS \
    "mov r8, r4\n\t" \
    "ldm r0!, {r4, r5}\n\t" \
    "lsls r4, r4, #8\n\t" \
    "lsls r5, r5, #8\n\t" \
    "adds r4, #128\n\t" \
    "adds r5, #128\n\t" \
    "ldm r1!, {r6, r7}\n\t" \
    "subs r6, r6, r4\n\t" \
    "subs r7, r7, r5\n\t" \
    "ldm r2, {r1, r2}\n\t" \
    "subs r1, r1, r4\n\t" \
    "subs r2, r2, r5\n\t" \
    "mov r12, r0\n\t" \
    "ldm r3, {r0, r3}\n\t" \
    "subs r0, r0, r4\n\t" \
    "subs r3, r3, r5\n\t" \
    "movs r4, r6\n\t" \
    "muls r4, r2\n\t" \
    "movs r5, r7\n\t" \
    "muls r5, r1\n\t" \
    "subs r4, r4, r5\n\t" \
    "mov r9, r4\n\t" \
    "movs r5, r0\n\t" \
    "muls r5, r7\n\t" \
    "movs r4, r3\n\t" \
    "muls r4, r6\n\t" \
    "subs r5, r5, r4\n\t" \
    "mov r10, r5\n\t" \
    "movs r4, r1\n\t" \
    "muls r4, r3\n\t" \
    "movs r5, r2\n\t" \
    "muls r5, r0\n\t" \
    "subs r4, r4, r5\n\t" \
    "movs r5, r4\n\t" \
    "add r5, r9\n\t" \
    "add r5, r10\n\t" \
    "mov r11, r5\n\t"

/* The edges opposite to corners 0, 1 and 2 in r1 and r2, r0 and r3, r6 and r7, and what they add. */
#define TINY_COVER_EDGES \
    "movs r5, r1\n\t" \
    "subs r1, r0, r1\n\t" \
    "subs r0, r6, r0\n\t" \
    "subs r6, r5, r6\n\t" \
    "movs r5, r2\n\t" \
    "subs r2, r3, r2\n\t" \
    "subs r3, r7, r3\n\t" \
    "subs r7, r5, r7\n\t" TINY_COVER_BIAS("adds r4, r4", "r1", "r2") TINY_COVER_BIAS("add r10", "r0", "r3") \
        TINY_COVER_BIAS("add r9", "r6", "r7")

/* The area, and the first row; the box as of x1 in r0, its width in r9. */
#define TINY_COVER_ROW \
    "push {r0, r1, r2, r3, r6, r7}\n\t" \
    "mov r0, r8\n\t" \
    "mov r1, r11\n\t" \
    "str r1, [r0]\n\t" \
    "movs r7, r0\n\t" \
    "adds r7, #8\n\t" \
    "mov r0, r12\n\t" \
    "subs r0, #8\n\t" \
    "ldm r0!, {r2, r3}\n\t" \
    "mov r5, r10\n\t" \
    "mov r6, r9\n\t" TINY_COVER_TEST("1") \
    "ldr r1, [r0]\n\t" \
    "subs r1, r1, r2\n\t" \
    "mov r9, r1\n\t" \
    "cmp r1, #1\n\t" \
    "beq 3f\n\t" \
    "push {r4, r5, r6}\n\t" TINY_COVER_STEP("subs", "r4", "20") TINY_COVER_STEP("subs", "r5", "24") \
    TINY_COVER_STEP("subs", "r6", "32") \
    "adds r2, #1\n\t" TINY_COVER_TEST("2") \
    "subs r2, #1\n\t" \
    "pop {r4, r5, r6}\n"

/* The second row, and how many there are. */
#define TINY_COVER_BELOW \
    "3: ldr r1, [r0, #4]\n\t" \
    "subs r1, r1, r3\n\t" \
    "cmp r1, #1\n\t" \
    "beq 5f\n\t" TINY_COVER_STEP("adds", "r4", "4") TINY_COVER_STEP("adds", "r5", "0") \
    TINY_COVER_STEP("adds", "r6", "16") \
    "adds r3, #1\n\t" TINY_COVER_TEST("4") \
    "mov r1, r9\n\t" \
    "cmp r1, #1\n\t" \
    "beq 5f\n\t" TINY_COVER_STEP("subs", "r4", "8") TINY_COVER_STEP("subs", "r5", "12") \
    TINY_COVER_STEP("subs", "r6", "20") \
    "adds r2, #1\n\t" TINY_COVER_TEST("5") \
    "add sp, #24\n\t" \
    "mov r0, r8\n\t" \
    "subs r7, r7, r0\n\t" \
    "subs r7, #8\n\t" \
    "lsrs r7, r7, #4\n\t" \
    "str r7, [r0, #4]"

/* Two thirds of the instructions that compilers take. */
SMEAR_INLINE void tiny_cover_armv6m(struct tiny_cover *t, const int32_t *box, const int32_t *v0, const int32_t *v1,
                                    const int32_t *v2)
{
    register const int32_t *r0 __asm__("r0") = box;
    register const int32_t *r1 __asm__("r1") = v0;
    register const int32_t *r2 __asm__("r2") = v1;
    register const int32_t *r3 __asm__("r3") = v2;
    register struct tiny_cover *r4 __asm__("r4") = t;
    __asm__ volatile(".syntax unified\n\t" TINY_COVER_CORNERS TINY_COVER_EDGES TINY_COVER_ROW TINY_COVER_BELOW
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3), "+r"(r4)
                     :
                     : "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "cc", "memory");
}
#endif

SMEAR_INLINE void tiny_cover(struct tiny_cover *t, const int32_t *box, const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
#if SMEAR_ASM_ARMV6M
    tiny_cover_armv6m(t, box, v0, v1, v2);
#else
    tiny_cover_reference(t, box, v0, v1, v2);
#endif
}

#if SMEAR_ASM_ARMV6M
/* The least of A, B and C into A, the most into B; KEEP and FETCH put A into another register, and that into B. */
#define TINY_SPAN_ORDER(A, B, C, KEEP, FETCH) \
    "cmp " A ", " B "\n\t"      \
    "ble 1f\n\t" KEEP           \
    "movs " A ", " B "\n\t" FETCH \
    "1: cmp " C ", " A "\n\t"   \
    "bge 2f\n\t"                \
    "movs " A ", " C "\n\t"     \
    "b 3f\n"                    \
    "2: cmp " C ", " B "\n\t"   \
    "ble 3f\n\t"                \
    "movs " B ", " C "\n"       \
    "3: "

/* Places, q8 px, become the first pixels whose centres lie behind them. */
#define TINY_SPAN_PIXELS(A, B)  \
    "adds " A ", #127\n\t"      \
    "adds " B ", #127\n\t"      \
    "asrs " A ", " A ", #8\n\t" \
    "asrs " B ", " B ", #8\n\t"
#endif

#endif

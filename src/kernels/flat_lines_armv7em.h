/* SPDX-License-Identifier: MIT */
/* flat_lines_armv7em.h - flat_lines in assembly for Cortex-M4: two pixels at once, and sides that stay in registers. Less than half of the
 * compiler's instructions of a row, and two thirds of those of a pixel. */
#ifndef SMEAR_KERNELS_FLAT_LINES_ARMV7EM_H
#define SMEAR_KERNELS_FLAT_LINES_ARMV7EM_H

#include "kernels/flat_lines.h"

#if SMEAR_ASM_ARMV7EM

SMEAR_STATIC_ASSERT(offsetof(struct flat_lines, step) == 16 && offsetof(struct flat_lines, to_pixels) == 40
                        && offsetof(struct flat_lines, dz) == 40 + 12 && offsetof(struct flat_lines, row) == 40 + 24
                        && offsetof(struct flat_lines, color) == 40 + 28,
                    "the assembly knows struct flat_lines");

/* Pixels are in r0, depths in r1, z in r2, dz in r3, the colour in r7. */

/* The last pixel. */
#define FLAT_ARMV7EM_LAST(STORE) \
    "lsrs r4, r2, #16\n\t"       \
    "ldrh r5, [r1]\n\t"          \
    "cmp r5, r4\n\t"             \
    "bhs 9f\n\t"                 \
    "strh r4, [r1]\n\t"          \
    STORE " r7, [r0]\n"          \
    "9:\n\t"

/* Two pixels, if both are seen; else at SLOW. Halves of r5 are 0 where the old depth is not less, and so is their product where one
 * of them is. */
#define FLAT_ARMV7EM_PAIR(STORE_TWO, SLOW) \
    "adds r4, r2, r3\n\t"                  \
    "pkhtb r4, r4, r2, asr #16\n\t"        \
    "ldr r5, [r1], #4\n\t"                 \
    "uqsub16 r5, r4, r5\n\t"               \
    "add r2, r2, r3, lsl #1\n\t"           \
    "smulbt r6, r5, r5\n\t"                \
    "cbz r6, " SLOW "f\n\t"                \
    "str r4, [r1, #-4]\n\t" STORE_TWO

/* Two pixels of which one at most is seen. */
#define FLAT_ARMV7EM_SLOW_NARROW \
    "cbz r5, 9f\n\t"             \
    "ldr r5, [r1, #-4]\n\t"      \
    "usub16 r6, r5, r4\n\t"      \
    "sel r4, r5, r4\n\t"         \
    "str r4, [r1, #-4]\n\t"      \
    "ldr r5, [r0]\n\t"           \
    "sel r5, r5, r7\n\t"         \
    "str r5, [r0]\n"             \
    "9: adds r0, #4\n\t"

#define FLAT_ARMV7EM_SLOW_WIDE   \
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

/* The pixels of a row, whose number, one at least, is in COUNT; then comes NEXT, which is 8. COLOR brings the colour, ELSE is anything
 * that others go to. r8 has two less than what is left of rounds of four: odd where a last one is left. */
#define FLAT_ARMV7EM_PIXELS(COUNT, COLOR, NEXT, ELSE, STORE, STORE_TWO, SLOW) \
    "sub r8, " COUNT ", #2\n\t"                                         \
    "lsls r6, " COUNT ", #31\n\t"                                       \
    COLOR                                                               \
    "bcs 4f\n\t"                                                        \
    "cmp r8, #0\n\t"                                                    \
    "blt 5f\n"                                                          \
    "3: " FLAT_ARMV7EM_PAIR(STORE_TWO, "6")                             \
    "4: " FLAT_ARMV7EM_PAIR(STORE_TWO, "7")                             \
    "subs r8, r8, #4\n\t"                                               \
    "bge 3b\n"                                                          \
    "5: lsls r6, r8, #31\n\t"                                           \
    "beq 8f\n\t"                                                        \
    FLAT_ARMV7EM_LAST(STORE)                                            \
    "8: " NEXT                                                          \
    "b 2f\n"                                                            \
    "6: " SLOW "b 4b\n"                                                 \
    "7: " SLOW                                                          \
    "subs r8, r8, #4\n\t"                                               \
    "bge 3b\n\t"                                                        \
    "b 5b\n"                                                            \
    ELSE                                                                \
    "2:\n\t"

/* The last instructions of a row: the next, or on to 2. */
#define FLAT_LINES_NEXT         \
    "ldr r8, [r9, #24]\n\t"     \
    "adds r8, r8, #1\n\t"       \
    "str r8, [r9, #24]\n\t"     \
    "bne 1b\n\t"

/* Where depth may have its break in a row it is in units from the break on. r7 pixels that lie on one side have their z and dz
 * at 20; at 21 those are asked for that may not. */
#define FLAT_LINES_BREAK              \
    "21: sub r4, r7, #1\n\t"          \
    "mla r4, r3, r4, r2\n\t"          \
    "eors r4, r4, r2\n\t"             \
    "bmi 22f\n"                       \
    "20: cmp r2, #0\n\t"              \
    "ittee lt\n\t"                    \
    "lsllt r3, r3, #5\n\t"            \
    "lsllt r2, r2, #5\n\t"            \
    "lslge r3, r3, #1\n\t"            \
    "lslge r2, r2, #1\n\t"            \
    "add r2, r2, #0x80008000\n\t"

/* Pixels behind the break come before the next row. Of them lie on the stack: their number, 0 where there are none, depth, and
 * places. */
#define FLAT_LINES_NEXT_BREAK         \
    "ldr r7, [sp]\n\t"                \
    "cmp r7, #0\n\t"                  \
    "bne 23f\n\t"                     \
    FLAT_LINES_NEXT

/* Puts them there; at 20 are those before it. */
#define FLAT_LINES_BREAK_APART(LOG2)  \
    "22: cmp r3, #0\n\t"              \
    "ble 24f\n\t"                     \
    "subs r4, r3, r2\n\t"             \
    "subs r4, r4, #1\n\t"             \
    "sdiv r4, r4, r3\n\t"             \
    "b 25f\n"                         \
    "24: negs r4, r3\n\t"             \
    "sdiv r4, r2, r4\n\t"             \
    "adds r4, r4, #1\n"               \
    "25: cmp r4, #1\n\t"              \
    "it lt\n\t"                       \
    "movlt r4, #1\n\t"                \
    "subs r6, r7, #1\n\t"             \
    "cmp r4, r6\n\t"                  \
    "it gt\n\t"                       \
    "movgt r4, r6\n\t"                \
    "subs r6, r7, r4\n\t"             \
    "mla r8, r3, r4, r2\n\t"          \
    "strd r6, r8, [sp]\n\t"           \
    "add r6, r0, r4, lsl #" LOG2 "\n\t" \
    "add r8, r1, r4, lsl #1\n\t"      \
    "strd r6, r8, [sp, #8]\n\t"       \
    "mov r7, r4\n\t"                  \
    "b 20b\n"                         \
    "23: ldr r2, [sp, #4]\n\t"        \
    "ldrd r0, r1, [sp, #8]\n\t"       \
    "movs r4, #0\n\t"                 \
    "str r4, [sp]\n\t"                \
    "ldr r3, [r9, #12]\n\t"           \
    "b 21b\n"

/* r9 points into struct flat_lines, of which rows have numbers from minus their count to -1, and what is said of a row is of that behind
 * them; the left side's place lies in r10 and r11, the right one's in r12 and lr. Then, in a row: pixels r0, depth r1, z r2, dz r3, the
 * colour r7, rounds of four pixels r8. PIXELS brings r0; BREAK, NEXT and ELSE are those above. */
#define FLAT_LINES(BREAK, NEXT, ELSE, PIXELS, STORE, STORE_TWO, SLOW) \
    __asm__ volatile(".syntax unified\n\t" \
                     "ldm r0, {r10, r11, r12, lr}\n\t" \
                     "push {r0}\n\t" \
                     "sub sp, #20\n\t" \
                     "add r9, r0, #40\n\t" \
                     "movs r0, #0\n\t" \
                     "str r0, [sp]\n" \
                     "1: ldmdb r9, {r0, r1, r2, r3, r6, r7}\n\t" \
                     "cmp r6, r11, asr #10\n\t" \
                     "it lt\n\t" \
                     "asrlt r6, r11, #10\n\t" \
                     "cmp r7, lr, asr #10\n\t" \
                     "it gt\n\t" \
                     "asrgt r7, lr, #10\n\t" \
                     "adds r10, r10, r0\n\t" \
                     "adc r11, r11, r1\n\t" \
                     "adds r12, r12, r2\n\t" \
                     "adc lr, lr, r3\n\t" \
                     "subs r7, r7, r6\n\t" \
                     "ble 8f\n\t" \
                     "ldm r9, {r0, r1, r2, r3, r4, r5, r8}\n\t" \
                     "mla r2, r4, r8, r2\n\t" \
                     "mla r2, r3, r6, r2\n\t" \
                     "mla r1, r5, r8, r1\n\t" \
                     "add r1, r1, r6, lsl #1\n\t" \
                     PIXELS BREAK FLAT_ARMV7EM_PIXELS("r7", "ldr r7, [r9, #28]\n\t", NEXT, ELSE, STORE, STORE_TWO, SLOW) \
                     "add sp, #20\n\t" \
                     "pop {r0}\n\t" \
                     "stm r0, {r10, r11, r12, lr}" \
                     : "+r"(r0) \
                     : \
                     : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

#define FLAT_LINES_NARROW(BREAK, NEXT, ELSE) \
    FLAT_LINES(BREAK, NEXT, ELSE, "add r0, r0, r1\n\t", "strh", "str r7, [r0], #4\n\t", FLAT_ARMV7EM_SLOW_NARROW)
#define FLAT_LINES_WIDE(BREAK, NEXT, ELSE) \
    FLAT_LINES(BREAK, NEXT, ELSE, "add r0, r0, r1, lsl #1\n\t", "str", "strd r7, r7, [r0], #8\n\t", FLAT_ARMV7EM_SLOW_WIDE)

/* Like flat_lines. */
static inline void flat_lines_armv7em(struct flat_lines *l, int32_t n)
{
    l->row = -n;
    l->z += l->dz_down * (uint32_t)n;
    l->depth = (uint16_t *)(void *)((uint8_t *)l->depth + l->depth_bytes * n);
    register struct flat_lines *r0 __asm__("r0") = l;
    if (l->narrow && l->breaks)
        FLAT_LINES_NARROW(FLAT_LINES_BREAK, FLAT_LINES_NEXT_BREAK, FLAT_LINES_BREAK_APART("1"));
    else if (l->narrow)
        FLAT_LINES_NARROW("", FLAT_LINES_NEXT, "");
    else if (l->breaks)
        FLAT_LINES_WIDE(FLAT_LINES_BREAK, FLAT_LINES_NEXT_BREAK, FLAT_LINES_BREAK_APART("2"));
    else
        FLAT_LINES_WIDE("", FLAT_LINES_NEXT, "");
}

#endif

#endif

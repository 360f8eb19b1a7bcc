/* SPDX-License-Identifier: MIT */
/* flat_lines_arm.h - flat_lines in assembly for ARM7TDMI and what else runs ARM code without vectors: sides stay in registers, rows
 * need no numbers from the stack but constants, and hidden pixels no branch. Half of the compiler's cycles. */
#ifndef SMEAR_KERNELS_FLAT_LINES_ARM_H
#define SMEAR_KERNELS_FLAT_LINES_ARM_H

#include "kernels/flat_lines.h"

#if SMEAR_ASM_ARM

SMEAR_STATIC_ASSERT(offsetof(struct flat_lines, step) == 16 && offsetof(struct flat_lines, to_pixels) == 40
                        && offsetof(struct flat_lines, dz) == 40 + 12 && offsetof(struct flat_lines, depth_bytes) == 40 + 20
                        && offsetof(struct flat_lines, color) == 40 + 28,
                    "the assembly knows struct flat_lines");

/* The pixel AT bytes of depth and PLACE bytes of colours further on, in six instructions: the code at FLAT_ARM_PIXELS jumps over
 * some of them. STORE: with the register of the colour. */
#define FLAT_ARM_PIXEL(STORE, AT, PLACE)  \
    "ldrh r5, [r1, #" AT "]\n\t"          \
    "mov r4, r2, lsr #16\n\t"             \
    "add r2, r2, r3\n\t"                  \
    "cmp r4, r5\n\t"                      \
    "strhhi r4, [r1, #" AT "]\n\t" STORE ", [r0, #" PLACE "]\n\t"

#define FLAT_ARM_EIGHT(STORE, P1, P2, P3, P4, P5, P6, P7)                                         \
    FLAT_ARM_PIXEL(STORE, "0", "0") FLAT_ARM_PIXEL(STORE, "2", P1) FLAT_ARM_PIXEL(STORE, "4", P2) \
    FLAT_ARM_PIXEL(STORE, "6", P3) FLAT_ARM_PIXEL(STORE, "8", P4) FLAT_ARM_PIXEL(STORE, "10", P5) \
            FLAT_ARM_PIXEL(STORE, "12", P6) FLAT_ARM_PIXEL(STORE, "14", P7)

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
    "3: " FLAT_ARM_EIGHT(STORE, P1, P2, P3, P4, P5, P6, P7)                                                     \
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

#define FLAT_ARM_ACROSS(STORE, SINGLE, DONE) \
    "5: movs r4, r2, lsl #1\n\t"         \
    "movcs r4, r2, lsl #5\n\t"           \
    "add r4, r4, #0x8000\n\t"            \
    "add r4, r4, #0x80000000\n\t"        \
    "mov r4, r4, lsr #16\n\t"            \
    "add r2, r2, r3\n\t"                 \
    "ldrh r5, [r1]\n\t"                  \
    "cmp r4, r5\n\t"                     \
    "strhhi r4, [r1]\n\t" STORE ", [r0]\n\t" \
    "add r0, r0, #" SINGLE "\n\t"        \
    "add r1, r1, #2\n\t"                 \
    "subs r7, r7, #1\n\t"                \
    "bne 5b\n\t"                         \
    "b " DONE "b\n"

/* r9 points into struct flat_lines, of which what is said of a row is of that behind the last one; rows have numbers from minus their
 * count to -1, in r8. The left side's place lies in r10 and r11, the right one's in r12 and lr. Then, in a row: pixels r0, depth r1, z r2,
 * dz r3, the colour r6, how many r7. PLACE brings r0. */
#define FLAT_ARM_ROW_START                          \
    ".syntax unified\n\t"                           \
    "push {r0}\n\t"                                 \
    "mov r8, r1\n\t"                                \
    "add r9, r0, #40\n\t"                           \
    "ldm r0, {r10, r11, r12, lr}\n"                 \
    "1: ldmdb r9, {r0, r1, r2, r3, r6, r7}\n\t"     \
    "cmp r6, r11, asr #10\n\t"                      \
    "movlt r6, r11, asr #10\n\t"                    \
    "cmp r7, lr, asr #10\n\t"                       \
    "movgt r7, lr, asr #10\n\t"                     \
    "adds r10, r10, r0\n\t"                         \
    "adc r11, r11, r1\n\t"                          \
    "adds r12, r12, r2\n\t"                         \
    "adc lr, lr, r3\n\t"                            \
    "subs r7, r7, r6\n\t"                           \
    "ble 8f\n\t"

#define FLAT_ARM_ROW_PLACE                          \
    "ldm r9, {r0, r1, r2, r3, r4, r5}\n\t"          \
    "mla r2, r4, r8, r2\n\t"                        \
    "mla r1, r5, r8, r1\n\t"                        \
    "mla r2, r3, r6, r2\n\t"                        \
    "add r1, r1, r6, lsl #1\n\t"

#define FLAT_ARM_ROW_END                            \
    "8: adds r8, r8, #1\n\t"                        \
    "bne 1b\n\t"

#define FLAT_LINES_ARM(PLACE, BREAK, PIXELS, ACROSS)                \
    __asm__ volatile(FLAT_ARM_ROW_START FLAT_ARM_ROW_PLACE          \
                     "ldr r6, [r9, #28]\n\t"                        \
                     PLACE BREAK PIXELS                             \
                     FLAT_ARM_ROW_END ACROSS                        \
                     "9: pop {r0}\n\t"                              \
                     "stm r0, {r10, r11, r12, lr}"                  \
                     : "+r"(r0), "+r"(r1)                           \
                     :                                              \
                     : "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

#define FLAT_ARM_NARROW FLAT_ARM_PIXELS("1", "strhhi r6", "2", "4", "6", "8", "10", "12", "14", "16")
#define FLAT_ARM_WIDE FLAT_ARM_PIXELS("2", "strhi r6", "4", "8", "12", "16", "20", "24", "28", "32")
#define FLAT_ARM_PLACE_NARROW "add r0, r0, r1\n\t"
#define FLAT_ARM_PLACE_WIDE "add r0, r0, r1, lsl #1\n\t"

/* Like flat_lines; `narrow` is l->narrow, or a constant. */
static inline void flat_lines_arm(struct flat_lines *l, int32_t n, bool narrow)
{
    l->z += l->dz_down * (uint32_t)n;
    l->depth = (uint16_t *)(void *)((uint8_t *)l->depth + l->depth_bytes * n);
    register struct flat_lines *r0 __asm__("r0") = l;
    register int32_t r1 __asm__("r1") = -n;
    if (narrow && l->breaks)
        FLAT_LINES_ARM(FLAT_ARM_PLACE_NARROW, FLAT_ARM_BREAK, FLAT_ARM_NARROW, "b 9f\n" FLAT_ARM_ACROSS("strhhi r6", "2", "8"));
    else if (narrow)
        FLAT_LINES_ARM(FLAT_ARM_PLACE_NARROW, "", FLAT_ARM_NARROW, "");
    else if (l->breaks)
        FLAT_LINES_ARM(FLAT_ARM_PLACE_WIDE, FLAT_ARM_BREAK, FLAT_ARM_WIDE, "b 9f\n" FLAT_ARM_ACROSS("strhi r6", "4", "8"));
    else
        FLAT_LINES_ARM(FLAT_ARM_PLACE_WIDE, "", FLAT_ARM_WIDE, "");
}

#endif

#endif

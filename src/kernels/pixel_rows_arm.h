/* SPDX-License-Identifier: MIT */
/* pixel_rows_arm.h - dithered blocks of 5, 5 and 5 bits in assembly for ARM7TDMI and what else runs ARM code without vectors:
 * loads of four pixels, which slow memory wants, and no values on the stack. */
#ifndef SMEAR_KERNELS_PIXEL_ROWS_ARM_H
#define SMEAR_KERNELS_PIXEL_ROWS_ARM_H

#include "kernels/fill.h"

#if SMEAR_ASM_ARM

/* Compares the pixels of r4 to r7 with the colour in r12. */
#define ARM_IS_FLAT(ELSE) \
        "ldmia r0!, {r4, r5, r6, r7}\n\t" \
        "cmp r4, r12\n\t" \
        "cmpeq r5, r12\n\t" \
        "cmpeq r6, r12\n\t" \
        "cmpeq r7, r12\n\t" \
        "bne " ELSE "f\n\t"

/* The pair in FIRST and SECOND, of columns with the step AT. Where it is of the last colour, which is in r11, its red, green and
 * blue are in r8, r9 and r10; else the code at OTHER makes others, in r5, r2 and r4. */
#define ARM_DITHERED_PAIR(FIRST, SECOND, AT, OTHER, DONE) \
        "cmp " FIRST ", r11\n\t" \
        "cmpeq " SECOND ", r11\n\t" \
        "bne " OTHER "f\n\t" \
        "ldr r5, [sp, #" AT "]\n\t" \
        "add r4, r10, r5\n\t" \
        "add r2, r9, r5\n\t" \
        "add r5, r8, r5\n" \
        DONE ": and r4, r4, r3\n\t" \
        "and r2, r2, r3\n\t" \
        "and r5, r5, r3\n\t" \
        "mov r4, r4, lsr #1\n\t" \
        "orr r4, r4, r2, lsr #6\n\t" \
        "orr r4, r4, r5, lsr #11\n\t" \
        "str r4, [r1], #4\n\t"

/* Not the first of its block, which so is not of one colour. */
#define ARM_DITHERED_OTHER(MOVE, AT, OTHER, DONE) \
        OTHER ":\n\t" \
        MOVE \
        "ldr r2, [sp, #" AT "]\n\t" \
        "str r0, [sp, #36]\n\t" \
        "bl 80f\n\t" \
        "b " DONE "b\n"
#define ARM_SECOND_PAIR \
        "mov r4, r6\n\t" \
        "mov r5, r7\n\t"

/* TO: a code of two halves times DITHER_31. */
#define ARM_TIMES_31(TO, FROM, OTHER) \
        "rsb " OTHER ", " FROM ", " FROM ", lsl #3\n\t" \
        "rsb " TO ", " OTHER ", " FROM ", lsl #8\n\t"
#define ARM_TWICE(TO) "orr " TO ", " TO ", " TO ", lsl #16\n\t"

/* From r4 and r5, two pixels whose step is in r2: of one colour or of two. */
#define ARM_MAKE_PAIR \
        "80: cmp r4, r5\n\t" \
        "bne 81f\n\t" \
        "mov r11, r4\n\t" \
        "and r5, r4, #0xff\n\t" \
        ARM_TIMES_31("r10", "r5", "r10") \
        ARM_TWICE("r10") \
        "mov r5, r4, lsl #16\n\t" \
        "mov r5, r5, lsr #24\n\t" \
        ARM_TIMES_31("r9", "r5", "r9") \
        ARM_TWICE("r9") \
        "mov r5, r4, lsl #8\n\t" \
        "mov r5, r5, lsr #24\n\t" \
        ARM_TIMES_31("r8", "r5", "r8") \
        ARM_TWICE("r8") \
        "add r4, r10, r2\n\t" \
        "add r5, r8, r2\n\t" \
        "add r2, r9, r2\n\t" \
        "mov pc, lr\n" \
        "81: str r2, [sp, #40]\n\t" \
        "str lr, [sp, #44]\n\t" \
        "str r0, [sp, #36]\n\t" \
        "mov r2, r4, lsl #16\n\t" \
        "mov r2, r2, lsr #16\n\t" \
        "orr r2, r2, r5, lsl #16\n\t" \
        "mov r5, r5, lsr #16\n\t" \
        "mov r4, r4, lsr #16\n\t" \
        "orr r5, r4, r5, lsl #16\n\t" \
        "bic r5, r5, #0xff000000\n\t" \
        "bic r5, r5, #0xff00\n\t" \
        "bic r4, r2, #0xff000000\n\t" \
        "bic r4, r4, #0xff00\n\t" \
        "mov r2, r2, lsr #8\n\t" \
        "bic r2, r2, #0xff00\n\t" \
        ARM_TIMES_31("r4", "r4", "lr") \
        ARM_TIMES_31("r5", "r5", "lr") \
        ARM_TIMES_31("r2", "r2", "lr") \
        "ldr lr, [sp, #40]\n\t" \
        "add r4, r4, lr\n\t" \
        "add r5, r5, lr\n\t" \
        "add r2, r2, lr\n\t" \
        "ldr pc, [sp, #44]\n"

#define ARM_DITHERED_START \
        "sub sp, sp, #48\n\t" \
        "ldmia r3, {r4, r5, r6, r7}\n\t" \
        "mov r8, #0\n\t" \
        "mov r9, #0\n\t" \
        "mov r10, #0\n\t" \
        "mov r11, #0\n\t" \
        "mov r12, #0\n\t" \
        "stmia sp, {r4, r5, r6, r7, r8, r9, r10, r11}\n\t" \
        "str r2, [sp, #32]\n\t" \
        "str r8, [sp, #36]\n\t" \
        "mov r3, #0xf800\n\t" \
        "orr r3, r3, r3, lsl #16\n"

/* At 21 the first half was of the flat colour. */
#define ARM_DITHERED_BLOCKS \
        ARM_DITHERED_START \
        "1:\n\t" \
        ARM_IS_FLAT("20") \
        ARM_IS_FLAT("21") \
        "add lr, sp, #16\n\t" \
        "ldmia lr, {r4, r5, r6, r7}\n\t" \
        "stmia r1!, {r4, r5, r6, r7}\n" \
        "2: ldr lr, [sp, #32]\n\t" \
        "cmp r0, lr\n\t" \
        "bne 1b\n\t" \
        "b 90f\n" \
        "21: ldr r2, [sp, #16]\n\t" \
        "str r2, [r1], #4\n\t" \
        "ldr r2, [sp, #20]\n\t" \
        "str r2, [r1], #4\n\t" \
        "str r0, [sp, #36]\n\t" \
        "b 22f\n" \
        "20:\n\t" \
        ARM_DITHERED_PAIR("r4", "r5", "0", "30", "40") \
        ARM_DITHERED_PAIR("r6", "r7", "4", "31", "41") \
        "ldmia r0!, {r4, r5, r6, r7}\n" \
        "22:\n\t" \
        ARM_DITHERED_PAIR("r4", "r5", "8", "32", "42") \
        ARM_DITHERED_PAIR("r6", "r7", "12", "33", "43") \
        "ldr lr, [sp, #36]\n\t" \
        "sub lr, r0, lr\n\t" \
        "cmp lr, #16\n\t" \
        "bls 2b\n\t" \
        "mov r12, r11\n\t" \
        "ldmdb r1, {r4, r5, r6, r7}\n\t" \
        "add lr, sp, #16\n\t" \
        "stmia lr, {r4, r5, r6, r7}\n\t" \
        "b 2b\n" \
        "30: ldr r2, [sp]\n\t" \
        "bl 80f\n\t" \
        "b 40b\n" \
        ARM_DITHERED_OTHER(ARM_SECOND_PAIR, "4", "31", "41") \
        ARM_DITHERED_OTHER("", "8", "32", "42") \
        ARM_DITHERED_OTHER(ARM_SECOND_PAIR, "12", "33", "43") \
        ARM_MAKE_PAIR \
        "90: add sp, sp, #48"

/* As dithered_blocks, of 555. On the stack from sp on lie the steps, four words of pixels as the last block of one colour has
 * them, which is in r12, the end, where the input was when a pair came that was not of its block's colour, and two words to keep
 * registers. Black is the first colour: its words are 0. */
static inline void dithered_blocks_arm(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step)
{
    register const uint32_t *r0 __asm__("r0") = in;
    register uint16_t *r1 __asm__("r1") = out;
    register const uint32_t *r2 __asm__("r2") = in + 8 * blocks;
    register const uint32_t *r3 __asm__("r3") = step;
    __asm__ volatile(
        ARM_DITHERED_BLOCKS
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)
        :
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}

#endif

#endif

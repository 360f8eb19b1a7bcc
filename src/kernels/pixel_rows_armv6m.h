/* SPDX-License-Identifier: MIT */
/* pixel_rows_armv6m.h - dithered blocks in assembly for Cortex-M0 and M0+, where compilers keep half of the values on the stack
 * and load constants where they are used. */
#ifndef SMEAR_KERNELS_PIXEL_ROWS_ARMV6M_H
#define SMEAR_KERNELS_PIXEL_ROWS_ARMV6M_H

#include "kernels/kernels.h"

#if SMEAR_ASM_ARMV6M

/* Two pixels, with the step of column pair AT. Those that are alike come to SAME: r8, r9 and r10 are red, green and blue of two pixels of
 * the colour in r11. Others come to OTHER, and back to JOIN. r5 and r6 are masks. */
#define ARMV6M_DITHERED_PAIR(AT, SAME, OTHER, JOIN, GREEN_STEP, SHIFT_AND_JOIN) \
        "ldm r0!, {r2, r3}\n\t" \
        "cmp r2, r3\n\t" \
        "bne " OTHER "f\n\t" \
        "cmp r2, r11\n\t" \
        "beq " SAME "f\n\t" \
        "bl 80f\n" \
        SAME ": ldr r4, [sp, #" AT "]\n\t" \
        GREEN_STEP(r3, r4) \
        "movs r2, r4\n\t" \
        "add r2, r8\n\t" \
        "add r3, r9\n\t" \
        "add r4, r10\n" \
        JOIN ": ands r2, r5\n\t" \
        "ands r3, r6\n\t" \
        "ands r4, r5\n\t" \
        SHIFT_AND_JOIN \
        "stm r1!, {r2}\n\t"

#define ARMV6M_DITHERED_OTHER(AT, OTHER, JOIN, GREEN_FACTOR, GREEN_STEP) \
        OTHER ": uxth r4, r2\n\t" \
        "lsls r7, r3, #16\n\t" \
        "orrs r4, r7\n\t" \
        "lsrs r2, r2, #16\n\t" \
        "lsrs r3, r3, #16\n\t" \
        "lsls r3, r3, #16\n\t" \
        "orrs r2, r3\n\t" \
        "ldr r7, =0x00ff00ff\n\t" \
        "ands r2, r7\n\t" \
        "lsrs r3, r4, #8\n\t" \
        "ands r3, r7\n\t" \
        "ands r4, r7\n\t" \
        "movs r7, #249\n\t" \
        "muls r2, r7\n\t" \
        "muls r4, r7\n\t" \
        "movs r7, #" GREEN_FACTOR "\n\t" \
        "muls r3, r7\n\t" \
        "ldr r7, [sp, #" AT "]\n\t" \
        "adds r2, r7\n\t" \
        "adds r4, r7\n\t" \
        GREEN_STEP(r7, r7) \
        "adds r3, r7\n\t" \
        "b " JOIN "b\n"

#define ARMV6M_UNLESS_SAME(REGISTER, ELSE) \
        "cmp r2, " REGISTER "\n\t" \
        "bne " ELSE "f\n\t"

/* Blocks from r0 up to r2, to r1, by the steps at r3. On the stack from sp on lie the steps, four words of pixels as the last
 * block of one colour has them, which is in r12, the end, and a word that is not 0 in a block of another one colour. Black is the first
 * colour: its words are 0. */
#define ARMV6M_DITHERED_BLOCKS(GREEN_MASK, GREEN_FACTOR, GREEN_STEP, SHIFT_AND_JOIN) \
    __asm__ volatile( \
        ".syntax unified\n\t" \
        "movs r4, #0\n\t" \
        "movs r5, #0\n\t" \
        "movs r6, #0\n\t" \
        "movs r7, #0\n\t" \
        "mov r8, r4\n\t" \
        "mov r9, r4\n\t" \
        "mov r10, r4\n\t" \
        "mov r11, r4\n\t" \
        "mov r12, r4\n\t" \
        "push {r2, r4}\n\t" \
        "push {r4, r5, r6, r7}\n\t" \
        "ldm r3!, {r4, r5, r6, r7}\n\t" \
        "push {r4, r5, r6, r7}\n\t" \
        "ldr r5, =0xf800f800\n\t" \
        "ldr r6, =" GREEN_MASK "\n" \
        "1: ldm r0!, {r2, r3, r4, r7}\n\t" \
        ARMV6M_UNLESS_SAME("r3", "21") \
        ARMV6M_UNLESS_SAME("r4", "21") \
        ARMV6M_UNLESS_SAME("r7", "21") \
        "ldm r0!, {r3, r4, r7}\n\t" \
        ARMV6M_UNLESS_SAME("r3", "20") \
        ARMV6M_UNLESS_SAME("r4", "20") \
        ARMV6M_UNLESS_SAME("r7", "20") \
        "ldr r3, [r0]\n\t" \
        ARMV6M_UNLESS_SAME("r3", "20") \
        "cmp r2, r12\n\t" \
        "bne 10f\n\t" \
        "adds r0, #4\n\t" \
        "add r7, sp, #16\n\t" \
        "ldm r7, {r2, r3, r4, r7}\n\t" \
        "stm r1!, {r2, r3, r4, r7}\n" \
        "2: ldr r2, [sp, #32]\n\t" \
        "cmp r0, r2\n\t" \
        "bne 1b\n\t" \
        "b 90f\n" \
        "10: mov r12, r2\n\t" \
        "str r0, [sp, #36]\n" \
        "20: subs r0, #12\n" \
        "21: subs r0, #16\n\t" \
        ARMV6M_DITHERED_PAIR("0", "30", "40", "50", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_DITHERED_PAIR("4", "31", "41", "51", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_DITHERED_PAIR("8", "32", "42", "52", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_DITHERED_PAIR("12", "33", "43", "53", GREEN_STEP, SHIFT_AND_JOIN) \
        "ldr r7, [sp, #36]\n\t" \
        "cmp r7, #0\n\t" \
        "beq 2b\n\t" \
        "subs r1, #16\n\t" \
        "ldm r1!, {r2, r3, r4, r7}\n\t" \
        "str r2, [sp, #16]\n\t" \
        "str r3, [sp, #20]\n\t" \
        "str r4, [sp, #24]\n\t" \
        "str r7, [sp, #28]\n\t" \
        "movs r2, #0\n\t" \
        "str r2, [sp, #36]\n\t" \
        "b 2b\n" \
        ARMV6M_DITHERED_OTHER("0", "40", "50", GREEN_FACTOR, GREEN_STEP) \
        ARMV6M_DITHERED_OTHER("4", "41", "51", GREEN_FACTOR, GREEN_STEP) \
        ARMV6M_DITHERED_OTHER("8", "42", "52", GREEN_FACTOR, GREEN_STEP) \
        ARMV6M_DITHERED_OTHER("12", "43", "53", GREEN_FACTOR, GREEN_STEP) \
        "80: mov r11, r2\n\t" \
        "ldr r7, =0x00f900f9\n\t" \
        "uxtb r3, r2\n\t" \
        "muls r3, r7\n\t" \
        "mov r10, r3\n\t" \
        "lsrs r3, r2, #16\n\t" \
        "uxtb r3, r3\n\t" \
        "muls r3, r7\n\t" \
        "mov r8, r3\n\t" \
        "lsrs r3, r2, #8\n\t" \
        "uxtb r3, r3\n\t" \
        "ldr r7, =" GREEN_FACTOR " * 0x10001\n\t" \
        "muls r3, r7\n\t" \
        "mov r9, r3\n\t" \
        "bx lr\n" \
        ".ltorg\n" \
        "90: add sp, #40" \
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3) \
        : \
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* A green of 63 levels takes half a step. */
#define ARMV6M_STEP_63(TO, FROM) "lsrs " #TO ", " #FROM ", #1\n\t"
#define ARMV6M_STEP_31(TO, FROM) "movs " #TO ", " #FROM "\n\t"
#define ARMV6M_JOIN_565 \
        "lsrs r3, r3, #5\n\t" \
        "lsrs r4, r4, #11\n\t" \
        "orrs r2, r3\n\t" \
        "orrs r2, r4\n\t"
#define ARMV6M_JOIN_SWAPPED \
        ARMV6M_JOIN_565 \
        "rev16 r2, r2\n\t"
#define ARMV6M_JOIN_555 \
        "lsrs r3, r3, #6\n\t" \
        "lsrs r2, r2, #11\n\t" \
        "lsrs r4, r4, #1\n\t" \
        "orrs r2, r3\n\t" \
        "orrs r2, r4\n\t"

/* As dithered_blocks: 4 instructions a pixel in blocks of the last colour, 17 in others. */
SMEAR_INLINE void dithered_blocks_armv6m(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step, bool is_555,
                                         bool swapped)
{
    register const uint32_t *r0 __asm__("r0") = in;
    register uint16_t *r1 __asm__("r1") = out;
    register const uint32_t *r2 __asm__("r2") = in + 8 * blocks;
    register const uint32_t *r3 __asm__("r3") = step;
    if (is_555)
        ARMV6M_DITHERED_BLOCKS("0xf800f800", "249", ARMV6M_STEP_31, ARMV6M_JOIN_555);
    else if (swapped)
        ARMV6M_DITHERED_BLOCKS("0xfc00fc00", "253", ARMV6M_STEP_63, ARMV6M_JOIN_SWAPPED);
    else
        ARMV6M_DITHERED_BLOCKS("0xfc00fc00", "253", ARMV6M_STEP_63, ARMV6M_JOIN_565);
}

#endif

#endif

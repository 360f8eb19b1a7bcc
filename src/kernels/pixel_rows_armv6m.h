/* SPDX-License-Identifier: MIT */
/* pixel_rows_armv6m.h - dithered blocks in assembly for Cortex-M0 and M0+, where compilers keep half of the values on the stack
 * and load constants where they are used. */
#ifndef SMEAR_KERNELS_PIXEL_ROWS_ARMV6M_H
#define SMEAR_KERNELS_PIXEL_ROWS_ARMV6M_H

#include "kernels/kernels.h"

#if SMEAR_ASM_ARMV6M

/* Red, green and blue of two pixels of the colour of r8, r9 and r10, with the step of column pair AT; and what becomes of them. r5 and r6
 * are masks. */
#define ARMV6M_OF_COLOR(AT, GREEN_STEP) \
        "ldr r2, [sp, #" AT "]\n\t" \
        GREEN_STEP(r4, r2) \
        "movs r3, r2\n\tadd r3, r8\n\tadd r4, r9\n\tadd r2, r10\n"
#define ARMV6M_JOINED(SHIFT_AND_JOIN, STORE) \
        "ands r3, r5\n\tands r4, r6\n\tands r2, r5\n\t" \
        SHIFT_AND_JOIN STORE "\n\t"

/* Two pixels. Those that are alike come to SAME: r8, r9 and r10 are red, green and blue of two pixels of the colour in r11. Others come to
 * OTHER, and back to JOIN. */
#define ARMV6M_DITHERED_PAIR(AT, SAME, OTHER, JOIN, GREEN_STEP, SHIFT_AND_JOIN) \
        "ldm r0!, {r2, r3}\n\t" \
        ARMV6M_UNLESS("r2", "r3", OTHER) \
        "cmp r2, r11\n\tbeq " SAME "f\n\tbl 80f\n" \
        SAME ": " ARMV6M_OF_COLOR(AT, GREEN_STEP) \
        JOIN ": " ARMV6M_JOINED(SHIFT_AND_JOIN, "stm r1!, {r3}")

#define ARMV6M_DITHERED_OTHER(AT, OTHER, JOIN, GREEN_FACTOR, GREEN_STEP) \
        OTHER ": lsrs r4, r2, #16\n\teors r4, r3\n\tuxth r4, r4\n\t" \
        "eors r3, r4\n\tlsls r4, r4, #16\n\teors r2, r4\n\t" \
        "ldr r7, =0x00ff00ff\n\tands r3, r7\n\t" \
        "lsrs r4, r2, #8\n\tands r4, r7\n\tands r2, r7\n\t" \
        "movs r7, #249\n\tmuls r3, r7\n\tmuls r2, r7\n\t" \
        "movs r7, #" GREEN_FACTOR "\n\tmuls r4, r7\n\t" \
        "ldr r7, [sp, #" AT "]\n\tadds r3, r7\n\tadds r2, r7\n\t" \
        GREEN_STEP(r7, r7) \
        "adds r4, r7\n\t" \
        "b " JOIN "b\n"

/* Two of that colour, which are kept. */
#define ARMV6M_RUN_PAIR(AT, KEPT, GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_OF_COLOR(AT, GREEN_STEP) ARMV6M_JOINED(SHIFT_AND_JOIN, "str r3, [sp, #" KEPT "]")

#define ARMV6M_UNLESS(FIRST, SECOND, ELSE) \
        "cmp " FIRST ", " SECOND "\n\t" \
        "bne " ELSE "f\n\t"

/* Blocks from r0 up to r2, to r1, by the steps at r3. On the stack from sp on lie the steps, four words of pixels of the colour in r12,
 * and the end. That colour is what the last block had that has one, or goes over from it to another: then the other. Black is the
 * first. A block that goes over to another, or begins one, comes to 60 with that in r7 and in r5 where it begins, in bytes. */
#define ARMV6M_DITHERED_BLOCKS(GREEN_MASK, GREEN_FACTOR, GREEN_STEP, SHIFT_AND_JOIN) \
    __asm__ volatile( \
        ".syntax unified\n\t" \
        "movs r4, #0\n\tmovs r5, #0\n\tmovs r6, #0\n\tmovs r7, #0\n\t" \
        "mov r8, r4\n\tmov r9, r4\n\tmov r10, r4\n\tmov r11, r4\n\tmov r12, r4\n\t" \
        "push {r2, r4}\n\tpush {r4, r5, r6, r7}\n\t" \
        "ldm r3!, {r4, r5, r6, r7}\n\tpush {r4, r5, r6, r7}\n\t" \
        "ldr r5, =0xf800f800\n\t" \
        "ldr r6, =" GREEN_MASK "\n" \
        "1: ldm r0!, {r2, r3, r4, r7}\n\t" \
        ARMV6M_UNLESS("r2", "r12", "10") \
        ARMV6M_UNLESS("r3", "r12", "11") \
        ARMV6M_UNLESS("r4", "r12", "12") \
        ARMV6M_UNLESS("r7", "r12", "13") \
        "ldm r0!, {r2, r3, r4, r7}\n\t" \
        ARMV6M_UNLESS("r2", "r12", "14") \
        ARMV6M_UNLESS("r3", "r12", "15") \
        ARMV6M_UNLESS("r4", "r12", "16") \
        ARMV6M_UNLESS("r7", "r12", "17") \
        "3: add r7, sp, #16\n\t" \
        "ldm r7, {r2, r3, r4, r7}\n\t" \
        "stm r1!, {r2, r3, r4, r7}\n" \
        "2: ldr r2, [sp, #32]\n\t" \
        "cmp r0, r2\n\tbne 1b\n\tb 90f\n" \
        "10: " ARMV6M_UNLESS("r2", "r3", "23") \
        "movs r5, #0\n\tb 71f\n" \
        "11: movs r5, #2\n" \
        "71: " ARMV6M_UNLESS("r3", "r4", "21") \
        "b 72f\n" \
        "12: movs r5, #4\n" \
        "72: " ARMV6M_UNLESS("r4", "r7", "21") \
        "b 73f\n" \
        "13: movs r5, #6\n" \
        "73: ldm r0!, {r2, r3, r4}\n\t" \
        ARMV6M_UNLESS("r2", "r7", "20") \
        ARMV6M_UNLESS("r3", "r7", "20") \
        ARMV6M_UNLESS("r4", "r7", "20") \
        "ldr r2, [r0]\n\t" \
        ARMV6M_UNLESS("r2", "r7", "20") \
        "adds r0, #4\n\tb 60f\n" \
        "14: movs r5, #8\n\t" \
        ARMV6M_UNLESS("r2", "r3", "22") \
        "b 75f\n" \
        "15: movs r5, #10\n" \
        "75: " ARMV6M_UNLESS("r3", "r4", "22") \
        "b 76f\n" \
        "16: movs r5, #12\n" \
        "76: " ARMV6M_UNLESS("r4", "r7", "22") \
        "b 60f\n" \
        "17: movs r5, #14\n\tb 60f\n" \
        "22: subs r0, #4\n" \
        "20: subs r0, #12\n" \
        "21: ldr r5, =0xf800f800\n" \
        "23: subs r0, #16\n\t" \
        ARMV6M_DITHERED_PAIR("0", "30", "40", "50", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_DITHERED_PAIR("4", "31", "41", "51", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_DITHERED_PAIR("8", "32", "42", "52", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_DITHERED_PAIR("12", "33", "43", "53", GREEN_STEP, SHIFT_AND_JOIN) \
        "b 2b\n" \
        ARMV6M_DITHERED_OTHER("0", "40", "50", GREEN_FACTOR, GREEN_STEP) \
        ARMV6M_DITHERED_OTHER("4", "41", "51", GREEN_FACTOR, GREEN_STEP) \
        ARMV6M_DITHERED_OTHER("8", "42", "52", GREEN_FACTOR, GREEN_STEP) \
        ARMV6M_DITHERED_OTHER("12", "43", "53", GREEN_FACTOR, GREEN_STEP) \
        "60: mov r12, r7\n\tstr r5, [sp, #36]\n\tldr r5, =0xf800f800\n\t" \
        "movs r2, r7\n\tcmp r2, r11\n\tbeq 61f\n\tbl 80f\n" \
        "61: add r7, sp, #16\n\tldm r7, {r2, r3, r4, r7}\n\tstm r1!, {r2, r3, r4, r7}\n\t" \
        ARMV6M_RUN_PAIR("0", "16", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_RUN_PAIR("4", "20", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_RUN_PAIR("8", "24", GREEN_STEP, SHIFT_AND_JOIN) \
        ARMV6M_RUN_PAIR("12", "28", GREEN_STEP, SHIFT_AND_JOIN) \
        "ldr r2, [sp, #36]\n\tmovs r3, r1\n\tsubs r3, #16\n\t" \
        "cmp r2, #0\n\tbeq 63f\n\t" \
        "add r4, sp, #16\n\tadds r3, r3, r2\n\tadds r4, r4, r2\n\t" \
        "lsrs r2, r2, #2\n\tbcc 62f\n\t" \
        "ldrh r2, [r4]\n\tstrh r2, [r3]\n\tadds r3, #2\n\tadds r4, #2\n\t" \
        "cmp r3, r1\n\tbeq 64f\n" \
        "62: ldm r4!, {r2}\n\tstm r3!, {r2}\n\tcmp r3, r1\n\tbne 62b\n" \
        "64: b 2b\n" \
        "63: movs r1, r3\n\tb 3b\n" \
        "80: mov r11, r2\n\tldr r7, =0x00f900f9\n\tuxtb r3, r2\n\t" \
        "muls r3, r7\n\tmov r10, r3\n\tlsrs r3, r2, #16\n\t" \
        "uxtb r3, r3\n\tmuls r3, r7\n\tmov r8, r3\n\t" \
        "lsrs r3, r2, #8\n\tuxtb r3, r3\n\t" \
        "ldr r7, =" GREEN_FACTOR " * 0x10001\n\t" \
        "muls r3, r7\n\tmov r9, r3\n\tbx lr\n" \
        ".ltorg\n" \
        "90: add sp, #40" \
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3) \
        : \
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* A green of 63 levels takes half a step. */
#define ARMV6M_STEP_63(TO, FROM) "lsrs " #TO ", " #FROM ", #1\n\t"
#define ARMV6M_STEP_31(TO, FROM) "movs " #TO ", " #FROM "\n\t"
#define ARMV6M_JOIN_565 \
        "lsrs r4, r4, #5\n\tlsrs r2, r2, #11\n\torrs r3, r4\n\torrs r3, r2\n\t"
#define ARMV6M_JOIN_SWAPPED \
        ARMV6M_JOIN_565 \
        "rev16 r3, r3\n\t"
#define ARMV6M_JOIN_555 \
        "lsrs r4, r4, #6\n\tlsrs r3, r3, #11\n\tlsrs r2, r2, #1\n\torrs r3, r4\n\torrs r3, r2\n\t"

/* As dithered_blocks: 3 instructions a pixel in blocks of the last colour, 16 where one goes over to another, 18 in others. */
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

/* SPDX-License-Identifier: MIT */
/* texel_curves_armv6m.h - rows of narrow texels whose coordinates are polynomials, in assembly for Cortex-M0 and M0+: a row takes two
 * fifths of the compiler's instructions, for which the registers that the pixels need are stored and loaded. */
#ifndef SMEAR_KERNELS_TEXEL_CURVES_ARMV6M_H
#define SMEAR_KERNELS_TEXEL_CURVES_ARMV6M_H

#include "kernels/texel_curve_rows.h"

#if SMEAR_ASM_ARMV6M

/* Of a polynomial at r7, of x in r10 and y in r6: the value into r4, the first change into r3. Takes r0 to r5. */
#define ARMV6M_POLYNOMIAL \
        "ldm r7!, {r0, r1, r2, r3, r4, r5}\n\t" \
        "muls r4, r6\n\t" \
        "adds r1, r1, r4\n\t" \
        "muls r5, r6\n\t" \
        "adds r2, r2, r5\n\t" \
        "muls r2, r6\n\t" \
        "adds r0, r0, r2\n\t" \
        "mov r5, r10\n\t" \
        "movs r4, r3\n\t" \
        "muls r4, r5\n\t" \
        "adds r1, r1, r4\n\t" \
        "adds r3, r3, r1\n\t" \
        "adds r3, r3, r4\n\t" \
        "muls r1, r5\n\t" \
        "adds r4, r0, r1\n\t"

/* The rows' members come to the next row and go to registers: -n into r1, where it has n > 0 pixels, y into r2, z into r3, depths into
 * r4, x0 into r5 and the left side into r6. Else goes on at 40, or 42 behind the last row. */
#define ARMV6M_NEXT_ROW \
        "40: ldr r7, [sp]\n\t" \
        "ldm r7!, {r0, r1, r2, r3, r4, r5, r6}\n\t" \
        "subs r1, r1, #1\n\t" \
        "bpl 41f\n\t" \
        "b 42f\n" \
        "41: adds r2, r2, #1\n\t" \
        "adds r3, r3, r6\n\t" \
        "ldr r6, [r7]\n\t" \
        "adds r4, r4, r6\n\t" \
        "subs r7, #28\n\t" \
        "adds r0, #12\n\t" \
        "stm r7!, {r0, r1, r2, r3, r4}\n\t" \
        "ldm r0, {r0, r6}\n\t" \
        "subs r1, r0, r6\n\t" \
        "bge 40b\n\t"

/* Rounds have eight pixels; the first begins so many before the row's that its last are the row's. Their number goes to the stack, with
 * depth and z at the row's first pixel, and space for u; where rounds end goes to lr, y to r6, x to r10. */
#define ARMV6M_ROW_PLACE \
        "movs r6, r2\n\t" \
        "lsls r2, r0, #1\n\t" \
        "adds r4, r4, r2\n\t" \
        "lsls r2, r1, #1\n\t" \
        "subs r2, r4, r2\n\t" \
        "mov lr, r2\n\t" \
        "subs r5, r0, r5\n\t" \
        "mov r10, r5\n\t" \
        "mov r5, r8\n\t" \
        "muls r5, r0\n\t" \
        "adds r5, r5, r3\n\t" \
        "movs r0, #7\n\t" \
        "ands r0, r1\n\t" \
        "subs r4, r4, r0\n\t" \
        "subs r4, r4, r0\n\t" \
        "push {r0, r4, r5, r6}\n\t"

/* On the stack lie the rows, whose members have come to the row before. */
static inline __attribute__((always_inline)) void texel_curve_rows_armv6m(struct texel_curve_rows *rows, int log2_width, int log2_height)
{
    rows->side = (const struct span_side *)((uintptr_t)rows->side - sizeof(struct span_side));
    texel_curve_rows_before(rows);
    register struct texel_curve_rows *r0 __asm__("r0") = rows;
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r0}\n\t"
        "adds r0, #80\n\t"
        "ldm r0!, {r1, r2, r3}\n\t"
        "mov r8, r1\n\t"
        "mov r11, r2\n\t"
        "mov r12, r3\n"
        ARMV6M_NEXT_ROW
            ARMV6M_ROW_PLACE
        "adds r7, #12\n\t"
        ARMV6M_POLYNOMIAL
        "str r4, [sp, #12]\n\t"
        "mov r9, r3\n\t"
        ARMV6M_POLYNOMIAL
        "mov r10, r3\n\t"
        "ldr r6, [r7, #12]\n\t"
        "ldr r5, [r7, #16]\n\t"
        "pop {r0, r1, r2, r3}\n\t"
        "movs r7, #34\n\t"
        "muls r7, r0\n\t"
        "subs r0, r1, r6\n\t"
        "add pc, r7\n\t"
        "nop\n"
        "31:\n\t"
        ARMV6M_FOUR("ldrh", "strh", "1", "0", ARMV6M_BEND)
        ARMV6M_FOUR("ldrh", "strh", "1", "4", ARMV6M_BEND)
        "adds r0, #16\n\t"
        "adds r1, #16\n\t"
        "cmp r1, lr\n\t"
        "beq 9f\n\t"
        "b 31b\n"
        "9: b 40b\n"
        "42: add sp, #4"
        : "+r"(r0)
        : [from_v] "i"(32 - log2_height), [to_v] "i"(log2_width + 1), [from_u] "i"(32 - log2_width)
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

#endif

/* SPDX-License-Identifier: MIT */
/* texel_curves_armv7em.h - rows of narrow texels whose coordinates are polynomials, in assembly for Cortex-M4: a row takes a third of
 * the compiler's instructions, which keeps all on the stack that the pixels have no register for. */
#ifndef SMEAR_KERNELS_TEXEL_CURVES_ARMV7EM_H
#define SMEAR_KERNELS_TEXEL_CURVES_ARMV7EM_H

#include "kernels/texel_curve_rows.h"
#include "kernels/texels_draw_armv7em.h"

#if SMEAR_ASM_ARMV7EM

/* Of a polynomial at, dx, dy, dxx, dxy and dyy are in registers, x in r12 and y in r3: VALUE becomes the value, STEP the first change. */
#define ARMV7EM_POLYNOMIAL(AT, DX, DY, DXX, DXY, DYY, VALUE, STEP) \
        "mla " DX ", " DXY ", r3, " DX "\n\t" \
        "mla " DY ", " DYY ", r3, " DY "\n\t" \
        "mla " AT ", " DY ", r3, " AT "\n\t" \
        "mla " DYY ", " DXX ", r12, " DX "\n\t" \
        "mla " DX ", " DXX ", r12, " DYY "\n\t" \
        "mla " VALUE ", " DYY ", r12, " AT "\n\t" \
        "add " STEP ", " DX ", " DXX "\n\t"

/* On the stack lie the rows, whose members have come to the row before. */
static inline __attribute__((always_inline)) void texel_curve_rows_armv7em(struct texel_curve_rows *rows, int log2_width, int log2_height)
{
    texel_curve_rows_before(rows);
    register struct texel_curve_rows *r0 __asm__("r0") = rows;
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r0}\n"
        "40: ldr r0, [sp]\n"
        "41: ldm r0, {r1, r2, r3, r4, r5, r6, r7, r8}\n\t"
        "subs r2, r2, #1\n\t"
        "blt 42f\n\t"
        "ldrd r9, r10, [r1], #12\n\t"
        "adds r3, r3, #1\n\t"
        "add r4, r4, r7\n\t"
        "add r5, r5, r8\n\t"
        "stm r0, {r1, r2, r3, r4, r5}\n\t"
        "subs lr, r10, r9\n\t"
        "ble 41b\n\t"
        "add r7, r5, r9, lsl #1\n\t"
        "sub r12, r9, r6\n\t"
        "ldr r1, [r0, #80]\n\t"
        "mla r9, r1, r9, r4\n\t"
        "adds r0, #32\n\t"
        "ldm r0!, {r1, r2, r6, r8, r10, r11}\n\t"
        ARMV7EM_POLYNOMIAL("r1", "r2", "r6", "r8", "r10", "r11", "r10", "r2")
        "ldm r0!, {r1, r4, r5, r6, r8, r11}\n\t"
        ARMV7EM_POLYNOMIAL("r1", "r4", "r5", "r6", "r8", "r11", "r11", "r3")
        "ldm r0, {r1, r4, r5, r8, r12}\n\t"
        "sub r7, r7, r8\n\t"
        ARMV7EM_BENT("40b")
        "42: add sp, #4"
        : "+r"(r0)
        : ARMV7EM_SIZES
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

#endif

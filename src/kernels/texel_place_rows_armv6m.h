/* SPDX-License-Identifier: MIT */
/* texel_place_rows_armv6m.h - texel_place_rows in assembly for Cortex-M0 and M0+: half of the compiler's instructions. */
#ifndef SMEAR_KERNELS_TEXEL_PLACE_ROWS_ARMV6M_H
#define SMEAR_KERNELS_TEXEL_PLACE_ROWS_ARMV6M_H

#include "kernels/texel_place_rows.h"
#include "kernels/texel_track.h"

#if TEXEL_PLACE_ROWS && SMEAR_ASM_ARMV6M

/* A plane's value at column r1 of row r2, of the three words at r0, into r4. */
#define ARMV6M_PLACE_PLANE \
        "ldm r0!, {r4, r5, r6}\n\t" \
        "muls r5, r1\n\t" \
        "muls r6, r2\n\t" \
        "adds r4, r4, r5\n\t" \
        "adds r4, r4, r6\n\t"

/* A coordinate's quotient, as far down as the word AT bytes behind r0 says. */
#define ARMV6M_PLACE_TURNS(VALUE, AT) \
        "mov r3, " VALUE "\n\t" \
        ARMV6M_QUOTIENT \
        "ldr r1, [r0, #76]\n\t" \
        "lsls r3, r1\n\t" \
        "ldr r1, [r0, #" AT "]\n\t" \
        "lsrs r3, r1\n\t"

/* The rows' members come to the next row: the left side into r1, y into r2, z into r9, depths into r5 and where they end into lr, r7
 * points to dz less 8. At 42 there is none. */
#define ARMV6M_PLACE_ROW \
        "40: ldr r7, [sp]\n\t" \
        "ldm r7!, {r0, r1, r2, r3, r4, r5, r6}\n\t" \
        "subs r1, r1, #1\n\t" \
        "bpl 41f\n\t" \
        "b 42f\n" \
        "41: adds r0, #12\n\t" \
        "adds r2, r2, #1\n\t" \
        "adds r3, r3, r4\n\t" \
        "adds r5, r5, r6\n\t" \
        "ldr r6, [r7]\n\t" \
        "subs r7, #28\n\t" \
        "stm r7!, {r0, r1, r2, r3, r4, r5}\n\t" \
        "ldr r1, [r0]\n\t" \
        "ldr r0, [r0, #4]\n\t" \
        "subs r0, r0, r1\n\t" \
        "ble 40b\n\t" \
        "cmp r0, r6\n\t" \
        "bgt 40b\n\t" \
        "ldr r4, [r7, #8]\n\t" \
        "muls r4, r1\n\t" \
        "adds r3, r3, r4\n\t" \
        "mov r9, r3\n\t" \
        "adds r5, r5, r1\n\t" \
        "adds r5, r5, r1\n\t" \
        "adds r3, r5, r0\n\t" \
        "adds r3, r3, r0\n\t" \
        "mov lr, r3\n\t"

/* A pixel of which r8 has what an index has of u, and r3 what goes above. */
#define ARMV6M_PLACE_TEXEL \
        "ldr r1, [r0, #88]\n\t" \
        "lsls r3, r1\n\t" \
        "add r3, r8\n\t" \
        "lsls r3, r3, #1\n\t" \
        "ldr r1, [r0, #92]\n\t" \
        "ldrh r3, [r1, r3]\n\t" \
        "ldr r1, [r0, #96]\n\t" \
        "strh r3, [r7, r1]\n"

/* r0 points to the rows, whose members have come to the row before, r7 to depths; z is in r9, q in r10, u in r11, v in r12; lr points to
 * the row's end. r8 has what an index has of u. */
static SMEAR_NOINLINE void texel_place_rows_armv6m(struct texel_place_rows *rows)
{
    rows->side = (const struct span_side *)((uintptr_t)rows->side - sizeof(struct span_side));
    texel_place_rows_before(rows);
    register struct texel_place_rows *r0 __asm__("r0") = rows;
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r0}\n"
        ARMV6M_PLACE_ROW
        "movs r0, r7\n\t"
        "movs r7, r5\n\t"
        "adds r0, #12\n\t"
        ARMV6M_PLACE_PLANE
        "mov r10, r4\n\t"
        ARMV6M_PLACE_PLANE
        "mov r11, r4\n\t"
        ARMV6M_PLACE_PLANE
        "mov r12, r4\n\t"
        "subs r0, #72\n"
        "43: mov r1, r9\n\t"
        "lsrs r1, r1, #16\n\t"
        "ldrh r2, [r7]\n\t"
        "cmp r2, r1\n\t"
        "blo 45f\n\t"
        "b 44f\n"
        "45: strh r1, [r7]\n\t"
        "mov r3, r10\n\t"
        ARMV6M_RECIP("72")
        ARMV6M_PLACE_TURNS("r11", "80")
        "mov r8, r3\n\t"
        ARMV6M_PLACE_TURNS("r12", "84")
                ARMV6M_PLACE_TEXEL
        "44: ldr r1, [r0, #32]\n\t"
        "add r9, r1\n\t"
        "ldr r1, [r0, #40]\n\t"
        "add r10, r1\n\t"
        "ldr r1, [r0, #52]\n\t"
        "add r11, r1\n\t"
        "ldr r1, [r0, #64]\n\t"
        "add r12, r1\n\t"
        "adds r7, #2\n\t"
        "cmp r7, lr\n\t"
        "bne 43b\n\t"
        "b 40b\n"
        "42: add sp, #4"
        : "+r"(r0)
        :
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

#endif

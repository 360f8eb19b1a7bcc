/* SPDX-License-Identifier: MIT */
/* colors_over_w.h - red, green and blue at a pixel where their planes are value / w: channel_over_w of raster/texcoord.h in assembly
 * for Cortex-M0 and M0+. */
#ifndef SMEAR_KERNELS_COLORS_OVER_W_H
#define SMEAR_KERNELS_COLORS_OVER_W_H

#include "kernels/kernels.h"

#ifdef __OPTIMIZE_SIZE__
#define COLORS_OVER_W_ARMV6M 0
#else
#define COLORS_OVER_W_ARMV6M SMEAR_ASM_ARMV6M
#endif

#if COLORS_OVER_W_ARMV6M

/* The plane at r1 at x in r8 and y in r9, half of it shifted up by r10, times the halves of the reciprocal in r6 and r7. */
#define ARMV6M_COLOR_OVER_W(LABEL)   \
    "ldm r1!, {r2, r3, r4}\n\t"      \
    "mov r5, r8\n\t"                 \
    "muls r3, r5\n\t"                \
    "mov r5, r9\n\t"                 \
    "muls r4, r5\n\t"                \
    "adds r2, r2, r3\n\t"            \
    "adds r2, r2, r4\n\t"            \
    "asrs r2, r2, #1\n\t"            \
    "mov r5, r10\n\t"                \
    "lsls r2, r5\n\t"                \
    "asrs r3, r2, #16\n\t"           \
    "uxth r2, r2\n\t"                \
    "movs r4, r2\n\t"                \
    "muls r4, r6\n\t"                \
    "lsrs r4, r4, #16\n\t"           \
    "movs r5, r3\n\t"                \
    "muls r5, r6\n\t"                \
    "adds r4, r4, r5\n\t"            \
    "muls r2, r7\n\t"                \
    "uxth r5, r4\n\t"                \
    "adds r2, r2, r5\n\t"            \
    "asrs r2, r2, #16\n\t"           \
    "muls r3, r7\n\t"                \
    "asrs r4, r4, #16\n\t"           \
    "adds r2, r2, r4\n\t"            \
    "adds r2, r2, r3\n\t"            \
    "asrs r2, r2, #3\n\t"            \
    "lsrs r3, r2, #24\n\t"           \
    "beq " LABEL "f\n\t"             \
    "asrs r2, r2, #31\n\t"           \
    "mvns r2, r2\n\t"                \
    "lsrs r2, r2, #8\n" LABEL ": "   \
    "stm r0!, {r2}\n\t"

/* Of planes whose at, dx and dy follow one another. Compilers take half as many instructions again. */
static inline void colors_over_w_armv6m(int32_t out[3], const int32_t *plane, int32_t x, int32_t y, int zeros, int32_t recip)
{
    register int32_t *to __asm__("r0") = out;
    register const int32_t *from __asm__("r1") = plane;
    register int32_t column __asm__("r2") = x;
    register int32_t row __asm__("r3") = y;
    register int up __asm__("r4") = zeros - 1;
    register int32_t over __asm__("r5") = recip;
    __asm__ volatile(".syntax unified\n\t"
                     "mov r8, r2\n\t"
                     "mov r9, r3\n\t"
                     "mov r10, r4\n\t"
                     "uxth r6, r5\n\t"
                     "asrs r7, r5, #16\n\t" ARMV6M_COLOR_OVER_W("1") ARMV6M_COLOR_OVER_W("2") ARMV6M_COLOR_OVER_W("3")
                     : "+r"(to), "+r"(from), "+r"(column), "+r"(row), "+r"(up), "+r"(over)
                     :
                     : "r6", "r7", "r8", "r9", "r10", "memory", "cc");
}

#endif

#endif

/* SPDX-License-Identifier: MIT */
/* line_means_armv6m.h - means of eight taps on ARMv6-M. */
#ifndef SMEAR_LINE_MEANS_ARMV6M_H
#define SMEAR_LINE_MEANS_ARMV6M_H

#include "kernels/packed_sums.h"

#if PACKED_ASM_ARMV6M

/* clang-format off */
/* A tap of two pixels. */
#define LINE_TAP_ARMV6M(at)                 \
    "ldr r0, [r2, #" #at "]\n\t"            \
    "add r0, r8\n\t"                        \
    "ldm r0, {r0, r1}\n\t"                  \
    "adds r4, r4, r0\n\t"                   \
    "ands r0, r3\n\t"                       \
    "adds r5, r5, r0\n\t"                   \
    "adds r6, r6, r1\n\t"                   \
    "ands r1, r3\n\t"                       \
    "adds r7, r7, r1\n\t"
/* Makes RED_BLUE the mean of its sums and of ALL, which is lost. */
#define LINE_MEAN_ARMV6M(ALL, RED_BLUE)     \
    "subs " ALL ", " ALL ", " RED_BLUE "\n\t" \
    "add " ALL ", r9\n\t"                   \
    "lsrs " ALL ", " ALL ", #11\n\t"        \
    "uxtb " ALL ", " ALL "\n\t"             \
    "lsls " ALL ", " ALL ", #8\n\t"         \
    "add " RED_BLUE ", r10\n\t"             \
    "lsrs " RED_BLUE ", " RED_BLUE ", #3\n\t" \
    "ands " RED_BLUE ", r3\n\t"             \
    "orrs " RED_BLUE ", " ALL "\n\t"

/* Writes n means, n even and not 0; offsets in bytes. 49 instructions a pixel, where compilers take 65. */
static inline void line_means_armv6m(uint32_t *out, const uint32_t *in, const int32_t offset[8], int32_t n)
{
    register const uint32_t *r0 __asm__("r0") = in;
    register const uint32_t *r1 __asm__("r1") = in + n;
    register const int32_t *r2 __asm__("r2") = offset;
    register uint32_t *r11 __asm__("r11") = out;
    __asm__ volatile(
        ".syntax unified\n\t"
        "mov r8, r0\n\t"
        "mov r12, r1\n\t"
        "movs r3, #255\n\t"
        "lsls r4, r3, #16\n\t"
        "orrs r3, r4\n\t"
        "movs r4, #4\n\t"
        "lsls r5, r4, #8\n\t"
        "mov r9, r5\n\t"                    /* half of eight: of green, 256 times; of red and blue */
        "lsls r5, r4, #16\n\t"
        "orrs r5, r4\n\t"
        "mov r10, r5\n"
        "1:\n\t"
        "movs r4, #0\n\t"
        "movs r5, #0\n\t"
        "movs r6, #0\n\t"
        "movs r7, #0\n\t"
        LINE_TAP_ARMV6M(0) LINE_TAP_ARMV6M(4) LINE_TAP_ARMV6M(8) LINE_TAP_ARMV6M(12)
        LINE_TAP_ARMV6M(16) LINE_TAP_ARMV6M(20) LINE_TAP_ARMV6M(24) LINE_TAP_ARMV6M(28)
        LINE_MEAN_ARMV6M("r4", "r5")
        LINE_MEAN_ARMV6M("r6", "r7")
        "mov r0, r11\n\t"
        "stm r0!, {r5, r7}\n\t"
        "mov r11, r0\n\t"
        "mov r0, r8\n\t"
        "adds r0, #8\n\t"
        "mov r8, r0\n\t"
        "cmp r0, r12\n\t"
        "bne 1b"
        : "+r"(r0), "+r"(r1), "+r"(r11)
        : "r"(r2)
        : "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r12", "cc", "memory");
}

/* A tap of one pixel. */
#define LINE_SINGLE_ARMV6M(at)              \
    "ldr r0, [r2, #" #at "]\n\t"            \
    "ldr r0, [r1, r0]\n\t"                 \
    "adds r4, r4, r0\n\t"                  \
    "ands r0, r3\n\t"                      \
    "adds r5, r5, r0\n\t"
/* Makes r4 what lies between A and B, by r0 and the mask in r1. */
#define LINE_BETWEEN_ARMV6M(A, B)           \
    "movs r4, " A "\n\t"                   \
    "movs r0, " A "\n\t"                   \
    "eors r4, " B "\n\t"                   \
    "orrs r0, " B "\n\t"                   \
    "lsrs r4, r4, #1\n\t"                  \
    "ands r4, r1\n\t"                      \
    "subs r4, r0, r4\n\t"

/* Writes n pixels, a multiple of four and not 0, of which every fourth is a mean: `mean` is the first, and the next one is that of the
 * taps of `in`. 21 instructions a pixel. */
static inline void line_means_sparse_armv6m(uint32_t *out, const uint32_t *in, const int32_t offset[8], int32_t n, uint32_t mean)
{
    register const uint32_t *r1 __asm__("r1") = in;
    register const int32_t *r2 __asm__("r2") = offset;
    register uint32_t r6 __asm__("r6") = mean;
    register uint32_t *r7 __asm__("r7") = out;
    register uint32_t *r12 __asm__("r12") = out + n;
    __asm__ volatile(
        ".syntax unified\n\t"
        "movs r3, #127\n\t"
        "lsls r4, r3, #16\n\t"
        "orrs r3, r4\n\t"
        "lsls r4, r3, #8\n\t"
        "orrs r4, r3\n\t"
        "mov r8, r4\n\t"                   /* 0x7f7f7f7f */
        "lsls r3, r3, #1\n\t"
        "movs r4, #1\n\t"
        "lsls r5, r4, #16\n\t"
        "orrs r5, r4\n\t"
        "orrs r3, r5\n\t"                  /* 0x00ff00ff */
        "lsls r5, r5, #2\n\t"
        "mov r10, r5\n\t"
        "lsls r4, r4, #10\n\t"
        "mov r9, r4\n"
        "1:\n\t"
        "movs r4, #0\n\t"
        "movs r5, #0\n\t"
        LINE_SINGLE_ARMV6M(0) LINE_SINGLE_ARMV6M(4) LINE_SINGLE_ARMV6M(8) LINE_SINGLE_ARMV6M(12)
        LINE_SINGLE_ARMV6M(16) LINE_SINGLE_ARMV6M(20) LINE_SINGLE_ARMV6M(24) LINE_SINGLE_ARMV6M(28)
        LINE_MEAN_ARMV6M("r4", "r5")
        "mov r11, r1\n\t"
        "mov r1, r8\n\t"
        LINE_BETWEEN_ARMV6M("r6", "r5")
        "str r6, [r7]\n\t"
        "str r4, [r7, #8]\n\t"
        "movs r0, r6\n\t"
        "eors r6, r4\n\t"
        "orrs r0, r4\n\t"
        "lsrs r6, r6, #1\n\t"
        "ands r6, r1\n\t"
        "subs r0, r0, r6\n\t"
        "str r0, [r7, #4]\n\t"
        "movs r0, r5\n\t"
        "movs r6, r5\n\t"                  /* the next one's first */
        "orrs r0, r4\n\t"
        "eors r4, r5\n\t"
        "lsrs r4, r4, #1\n\t"
        "ands r4, r1\n\t"
        "subs r0, r0, r4\n\t"
        "str r0, [r7, #12]\n\t"
        "adds r7, #16\n\t"
        "mov r1, r11\n\t"
        "adds r1, #16\n\t"
        "cmp r7, r12\n\t"
        "bne 1b"
        : "+r"(r1), "+r"(r6), "+r"(r7)
        : "r"(r2), "r"(r12)
        : "r0", "r3", "r4", "r5", "r8", "r9", "r10", "r11", "cc", "memory");
}
/* clang-format on */

#endif
#endif

/* SPDX-License-Identifier: MIT */
/* texels_draw_armv7em.h - texels_draw in assembly for Cortex-M4 and others that have its instructions for halves of words: depths are
 * tested in pairs. Compilers use none of these, and as many registers as there are for less. */
#ifndef SMEAR_KERNELS_TEXELS_DRAW_ARMV7EM_H
#define SMEAR_KERNELS_TEXELS_DRAW_ARMV7EM_H

#include "kernels/texel_run.h"

#if SMEAR_ASM_ARMV7EM

SMEAR_STATIC_ASSERT(offsetof(struct texel_run, dz) == 0 && offsetof(struct texel_run, count) == 20
                        && offsetof(struct texel_run, color) == 24 && offsetof(struct texel_run, depth) == 28
                        && offsetof(struct texel_run, z) == 32 && offsetof(struct texel_run, texels) == 44,
                    "the assembly knows struct texel_run");

/* dz is in r1, du, dv, ddu and ddv in r2 to r5, z in r9, u in r10, v in r11; r7 points to colours, depths lie r8 bytes further on, r12
 * points to texels. r0, r6 and lr are for whatever comes. */
#define ARMV7EM_STEP \
        "add r10, r10, r2\n\t" \
        "add r11, r11, r3\n\t" \
        "add r2, r2, r4\n\t" \
        "add r3, r3, r5\n\t"

#define ARMV7EM_TEXEL \
        "lsr r0, r11, %[from_v]\n\t" \
        "lsr r6, r10, %[from_u]\n\t" \
        "orr r0, r6, r0, lsl %[to_v]\n\t" \
        "ldrh r0, [r12, r0, lsl #1]\n\t"

/* A pixel, which is stepped over in memory. */
#define ARMV7EM_PIXEL \
        "ldrh r0, [r7, r8]\n\t" \
        "cmp r0, r9, lsr #16\n\t" \
        "bhs 9f\n\t" \
        "lsr r6, r9, #16\n\t" \
        "strh r6, [r7, r8]\n\t" \
        ARMV7EM_TEXEL \
        "strh r0, [r7]\n" \
        "9: add r7, r7, #2\n\t" \
        "add r9, r9, r1\n\t" \
        ARMV7EM_STEP

/* Two pixels, if both are seen; else at SLOW. The flags of usub16 are set for halves in which the old depth is not less. */
#define ARMV7EM_PAIR(SLOW) \
        "add lr, r9, r1\n\t" \
        "pkhtb lr, lr, r9, asr #16\n\t" \
        "ldr r0, [r7, r8]\n\t" \
        "usub16 r6, r0, lr\n\t" \
        "mrs r6, APSR\n\t" \
        "ands r6, r6, #0xf0000\n\t" \
        "bne " SLOW "f\n\t" \
        "add r9, r9, r1, lsl #1\n\t" \
        "str lr, [r7, r8]\n\t" \
        ARMV7EM_TEXEL \
        "strh r0, [r7], #2\n\t" \
        ARMV7EM_STEP \
        ARMV7EM_TEXEL \
        "strh r0, [r7], #2\n\t" \
        ARMV7EM_STEP

/* Two pixels of which one at most is seen. */
#define ARMV7EM_SLOW_PAIR \
        "cmp r6, #0xf0000\n\t" \
        "bne 8f\n\t" \
        "add r7, r7, #4\n\t" \
        "add r9, r9, r1, lsl #1\n\t" \
        ARMV7EM_STEP \
        ARMV7EM_STEP \
        "b 29f\n" \
        "8:\n\t" \
        ARMV7EM_PIXEL \
        ARMV7EM_PIXEL \
        "29:\n\t"

/* Narrow texels that are copied: 14 instructions a pixel where neighbours are seen, of 17. The sizes are constants. On the stack lie
 * the ends of pairs and of all, and the run. */
static inline __attribute__((always_inline)) void texels_narrow_armv7em(struct texel_run *p, int log2_width, int log2_height)
{
    register struct texel_run *r0 __asm__("r0") = p;
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r0}\n\t"
        "ldm r0!, {r1, r2, r3, r4, r5, r6}\n\t"
        "ldm r0, {r7, r8, r9, r10, r11, r12}\n\t"
        "sub r8, r8, r7\n\t"
        "add lr, r7, r6, lsl #1\n\t"
        "bic r0, r6, #1\n\t"
        "add r0, r7, r0, lsl #1\n\t"
        "push {r0, lr}\n\t"
        "cmp r0, r7\n\t"
        "beq 5f\n\t"
        "lsls r6, r6, #30\n\t"
        "bmi 3f\n"
        "2:\n\t"
        ARMV7EM_PAIR("6")
        "3:\n\t"
        ARMV7EM_PAIR("7")
        "4: ldr r0, [sp]\n\t"
        "cmp r7, r0\n\t"
        "bne 2b\n"
        "5: ldr r0, [sp, #4]\n\t"
        "cmp r7, r0\n\t"
        "beq 5f\n\t"
        ARMV7EM_PIXEL
        "b 5f\n"
        "6:\n\t"
        ARMV7EM_SLOW_PAIR
        "b 3b\n"
        "7:\n\t"
        ARMV7EM_SLOW_PAIR
        "b 4b\n"
        "5: add sp, sp, #8\n\t"
        "pop {r0}\n\t"
        "add r8, r8, r7\n\t"
        "str r7, [r0, #24]\n\t"
        "strd r8, r9, [r0, #28]"
        : "+r"(r0)
        : [from_v] "i"(32 - log2_height), [to_v] "i"(log2_width), [from_u] "i"(32 - log2_width)
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

#endif

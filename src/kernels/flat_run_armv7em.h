/* SPDX-License-Identifier: MIT */
/* flat_run_armv7em.h - pixels of one colour in a row, in assembly for Cortex-M4: two at once. Two thirds of the compiler's instructions. */
#ifndef SMEAR_KERNELS_FLAT_RUN_ARMV7EM_H
#define SMEAR_KERNELS_FLAT_RUN_ARMV7EM_H

#include "base/base.h"
#include "kernels/kernels.h"

#if SMEAR_ASM_ARMV7EM

/* Pixels are in r0, depths in r1, z in r2, dz in r3, the colour in r7. */

/* The last pixel. */
#define FLAT_ARMV7EM_LAST(STORE) \
    "lsrs r4, r2, #16\n\t"       \
    "ldrh r5, [r1]\n\t"          \
    "cmp r5, r4\n\t"             \
    "bhs 9f\n\t"                 \
    "strh r4, [r1]\n\t"          \
    STORE " r7, [r0]\n"          \
    "9:\n\t"

/* Two pixels, if both are seen; else at SLOW. Halves of r5 are 0 where the old depth is not less, and so is their product where one
 * of them is. */
#define FLAT_ARMV7EM_PAIR(STORE_TWO, SLOW) \
    "adds r4, r2, r3\n\t"                  \
    "pkhtb r4, r4, r2, asr #16\n\t"        \
    "ldr r5, [r1], #4\n\t"                 \
    "uqsub16 r5, r4, r5\n\t"               \
    "add r2, r2, r3, lsl #1\n\t"           \
    "smulbt r6, r5, r5\n\t"                \
    "cbz r6, " SLOW "f\n\t"                \
    "str r4, [r1, #-4]\n\t" STORE_TWO

/* Two pixels of which one at most is seen. */
#define FLAT_ARMV7EM_SLOW_NARROW \
    "cbz r5, 9f\n\t"             \
    "ldr r5, [r1, #-4]\n\t"      \
    "usub16 r6, r5, r4\n\t"      \
    "sel r4, r5, r4\n\t"         \
    "str r4, [r1, #-4]\n\t"      \
    "ldr r5, [r0]\n\t"           \
    "sel r5, r5, r7\n\t"         \
    "str r5, [r0]\n"             \
    "9: adds r0, #4\n\t"

#define FLAT_ARMV7EM_SLOW_WIDE   \
    "cbz r5, 9f\n\t"             \
    "lsls r6, r5, #16\n\t"       \
    "itt ne\n\t"                 \
    "strne r7, [r0]\n\t"         \
    "strhne r4, [r1, #-4]\n\t"   \
    "lsrs r4, r4, #16\n\t"       \
    "lsrs r6, r5, #16\n\t"       \
    "itt ne\n\t"                 \
    "strne r7, [r0, #4]\n\t"     \
    "strhne r4, [r1, #-2]\n"     \
    "9: adds r0, #8\n\t"

/* The pixels of a row, whose number, one at least, is in COUNT; then comes NEXT, which is 8. COLOR brings the colour, ELSE is anything
 * that others go to. r8 has two less than what is left of rounds of four: odd where a last one is left. */
#define FLAT_ARMV7EM_PIXELS(COUNT, COLOR, NEXT, ELSE, STORE, STORE_TWO, SLOW) \
    "sub r8, " COUNT ", #2\n\t"                                         \
    "lsls r6, " COUNT ", #31\n\t"                                       \
    COLOR                                                               \
    "bcs 4f\n\t"                                                        \
    "cmp r8, #0\n\t"                                                    \
    "blt 5f\n"                                                          \
    "3: " FLAT_ARMV7EM_PAIR(STORE_TWO, "6")                             \
    "4: " FLAT_ARMV7EM_PAIR(STORE_TWO, "7")                             \
    "subs r8, r8, #4\n\t"                                               \
    "bge 3b\n"                                                          \
    "5: lsls r6, r8, #31\n\t"                                           \
    "beq 8f\n\t"                                                        \
    FLAT_ARMV7EM_LAST(STORE)                                            \
    "8: " NEXT                                                          \
    "b 2f\n"                                                            \
    "6: " SLOW "b 4b\n"                                                 \
    "7: " SLOW                                                          \
    "subs r8, r8, #4\n\t"                                               \
    "bge 3b\n\t"                                                        \
    "b 5b\n"                                                            \
    ELSE                                                                \
    "2:\n\t"

#define FLAT_ARMV7EM_RUN(STORE, STORE_TWO, SLOW)                                                                      \
    __asm__ volatile(".syntax unified\n\t" FLAT_ARMV7EM_PIXELS("r4", "", "", "", STORE, STORE_TWO, SLOW)                  \
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r4)                                                         \
                     : "r"(r3), "r"(r7)                                                                               \
                     : "r5", "r6", "r8", "cc", "memory")

/* Like flat_run. */
static inline void flat_run_armv7em(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz, uint32_t color, bool narrow)
{
    register void *r0 __asm__("r0") = pixels;
    register uint16_t *r1 __asm__("r1") = depth;
    register uint32_t r2 __asm__("r2") = z, r3 __asm__("r3") = dz, r7 __asm__("r7") = narrow ? color * 0x10001u : color;
    register int32_t r4 __asm__("r4") = n;
    if (narrow)
        FLAT_ARMV7EM_RUN("strh", "str r7, [r0], #4\n\t", FLAT_ARMV7EM_SLOW_NARROW);
    else
        FLAT_ARMV7EM_RUN("str", "strd r7, r7, [r0], #8\n\t", FLAT_ARMV7EM_SLOW_WIDE);
}
#endif

#endif

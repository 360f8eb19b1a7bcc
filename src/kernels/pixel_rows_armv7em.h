/* SPDX-License-Identifier: MIT */
/* pixel_rows_armv7em.h - dithered blocks in assembly for Cortex-M4 and M7: eight pixels are loaded at once, and halves are packed by
 * instructions that compilers do not find. */
#ifndef SMEAR_KERNELS_PIXEL_ROWS_ARMV7EM_H
#define SMEAR_KERNELS_PIXEL_ROWS_ARMV7EM_H

#include "kernels/kernels.h"

#if SMEAR_ASM_ARMV7EM

/* Two pixels, which become one word in the first's register, with the step of column pair AT. r2 and r12 are factors. */
#define ARMV7EM_DITHERED_PAIR(FIRST, SECOND, AT, GREEN, PACK)  \
        "pkhbt r3, " FIRST ", " SECOND ", lsl #16\n\t"         \
        "pkhtb " SECOND ", " SECOND ", " FIRST ", asr #16\n\t" \
        "ldr " FIRST ", [sp, #" AT "]\n\t"                     \
        "uxtb16 lr, r3\n\t"                                    \
        "uxtb16 r3, r3, ror #8\n\t"                            \
        "uxtb16 " SECOND ", " SECOND "\n\t"                    \
        "mla lr, lr, r2, " FIRST "\n\t"                        \
        "mla " SECOND ", " SECOND ", r2, " FIRST "\n\t"        \
        GREEN(FIRST)                                           \
        "and " SECOND ", " SECOND ", #0xf800f800\n\t"          \
        "and lr, lr, #0xf800f800\n\t"                          \
        PACK(FIRST, SECOND)

#define ARMV7EM_GREEN_63(STEP)               \
        "lsr " STEP ", " STEP ", #1\n\t"     \
        "mla r3, r3, r12, " STEP "\n\t"      \
        "and r3, r3, #0xfc00fc00\n\t"
#define ARMV7EM_GREEN_31(STEP)               \
        "mla r3, r3, r2, " STEP "\n\t"       \
        "and r3, r3, #0xf800f800\n\t"
#define ARMV7EM_PACK_565(TO, RED)            \
        "orr r3, " RED ", r3, lsr #5\n\t"    \
        "orr " TO ", r3, lr, lsr #11\n\t"
#define ARMV7EM_PACK_SWAPPED(TO, RED)        \
        ARMV7EM_PACK_565("r3", RED)          \
        "rev16 " TO ", r3\n\t"
#define ARMV7EM_PACK_555(TO, RED)            \
        "lsr lr, lr, #1\n\t"                 \
        "orr r3, lr, r3, lsr #6\n\t"         \
        "orr " TO ", r3, " RED ", lsr #11\n\t"

/* Blocks from r0 up to r2, to r1, by the steps at r3. On the stack from sp on lie the steps, the end, the colour of the last block of
 * one colour, where its pixels lie, and black ones, which are the first. */
#define ARMV7EM_DITHERED_BLOCKS(GREEN, PACK)            \
    __asm__ volatile(                                   \
        ".syntax unified\n\t"                           \
        "movs r4, #0\n\t"                               \
        "movs r5, #0\n\t"                               \
        "movs r6, #0\n\t"                               \
        "movs r7, #0\n\t"                               \
        "push {r4, r5, r6, r7}\n\t"                     \
        "mov r4, r2\n\t"                                \
        "mov r6, sp\n\t"                                \
        "push {r4, r5, r6, r7}\n\t"                     \
        "ldm r3, {r4, r5, r6, r7}\n\t"                  \
        "push {r4, r5, r6, r7}\n\t"                     \
        "movs r2, #249\n\t"                             \
        "mov r12, #253\n"                               \
        "1: ldm r0!, {r4, r5, r6, r7, r8, r9, r10, r11}\n\t" \
        "cmp r4, r5\n\t"                                \
        "bne 2f\n\t"                                    \
        "cmp r4, r11\n\t"                               \
        "itttt eq\n\t"                                  \
        "cmpeq r4, r6\n\t"                              \
        "cmpeq r4, r7\n\t"                              \
        "cmpeq r4, r8\n\t"                              \
        "cmpeq r4, r9\n\t"                              \
        "it eq\n\t"                                     \
        "cmpeq r4, r10\n\t"                             \
        "bne 2f\n\t"                                    \
        "ldrd r3, lr, [sp, #20]\n\t"                    \
        "cmp r3, r4\n\t"                                \
        "bne 4f\n\t"                                    \
        "ldm lr, {r4, r6, r8, r10}\n\t"                 \
        "b 3f\n"                                        \
        "4: strd r4, r1, [sp, #20]\n"                   \
        "2: "                                           \
        ARMV7EM_DITHERED_PAIR("r4", "r5", "0", GREEN, PACK)   \
        ARMV7EM_DITHERED_PAIR("r6", "r7", "4", GREEN, PACK)   \
        ARMV7EM_DITHERED_PAIR("r8", "r9", "8", GREEN, PACK)   \
        ARMV7EM_DITHERED_PAIR("r10", "r11", "12", GREEN, PACK) \
        "3: stm r1!, {r4, r6, r8, r10}\n\t"             \
        "ldr r3, [sp, #16]\n\t"                         \
        "cmp r0, r3\n\t"                                \
        "bne 1b\n\t"                                    \
        "add sp, #48"                                   \
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)        \
        :                                               \
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* As dithered_blocks: 3 instructions a pixel in blocks of the last colour, 9 in others. */
SMEAR_INLINE void dithered_blocks_armv7em(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step, bool is_555,
                                          bool swapped)
{
    register const uint32_t *r0 __asm__("r0") = in;
    register uint16_t *r1 __asm__("r1") = out;
    register const uint32_t *r2 __asm__("r2") = in + 8 * blocks;
    register const uint32_t *r3 __asm__("r3") = step;
    if (is_555)
        ARMV7EM_DITHERED_BLOCKS(ARMV7EM_GREEN_31, ARMV7EM_PACK_555);
    else if (swapped)
        ARMV7EM_DITHERED_BLOCKS(ARMV7EM_GREEN_63, ARMV7EM_PACK_SWAPPED);
    else
        ARMV7EM_DITHERED_BLOCKS(ARMV7EM_GREEN_63, ARMV7EM_PACK_565);
}

#endif

#endif

/* SPDX-License-Identifier: MIT */
/* pixel_rows_armv7em.h - dithered blocks in assembly for Cortex-M4 and M7: eight pixels are loaded at once, and halves are packed by
 * instructions that compilers do not find. */
#ifndef SMEAR_KERNELS_PIXEL_ROWS_ARMV7EM_H
#define SMEAR_KERNELS_PIXEL_ROWS_ARMV7EM_H

#include "kernels/kernels.h"

#if SMEAR_ASM_ARMV7EM

/* Two pixels, of whose codes RED, GREEN and BLUE are twice two halves: levels and then, in TO, the word that they become. STEP and HALF
 * are what red and blue and what green adds. r2 and r12 are factors. */
#define ARMV7EM_DITHERED(TO, RED, FROM_RED, GREEN, FROM_GREEN, BLUE, FROM_BLUE, STEP, LOAD_HALF, HALF, BY, MASK, PACK) \
        "mla " BLUE ", " FROM_BLUE ", r2, " STEP "\n\tmla " RED ", " FROM_RED ", r2, " STEP "\n\t" LOAD_HALF \
        "mla " GREEN ", " FROM_GREEN ", " BY ", " HALF "\n\tand " GREEN ", " GREEN ", #" MASK "\n\t" \
        "and " RED ", " RED ", #0xf800f800\n\tand " BLUE ", " BLUE ", #0xf800f800\n\t" \
        PACK(TO, RED, GREEN, BLUE)

/* Any two, the first of which has the register that the word gets. */
#define ARMV7EM_DITHERED_PAIR(FIRST, SECOND, LOAD, LOAD_HALF, HALF, ...) \
        "pkhbt r3, " FIRST ", " SECOND ", lsl #16\n\tpkhtb " SECOND ", " SECOND ", " FIRST ", asr #16\n\t" \
        LOAD "uxtb16 lr, r3\n\tuxtb16 r3, r3, ror #8\n\tuxtb16 " SECOND ", " SECOND "\n\t" \
        ARMV7EM_DITHERED(FIRST, SECOND, SECOND, "r3", "r3", "lr", "lr", FIRST, LOAD_HALF, HALF, __VA_ARGS__)
#define ARMV7EM_DITHERED_LATER(FIRST, SECOND, AT, ...) \
    ARMV7EM_DITHERED_PAIR(FIRST, SECOND, "ldrd " FIRST ", r5, [sp, #" AT "]\n\t", "", "r5", __VA_ARGS__)

/* Two of the block's colour, which is in r5, r3 and lr. */
#define ARMV7EM_DITHERED_FLAT(TO, AT, ...) \
        "ldrd " TO ", r7, [sp, #" AT "]\n\t" \
        ARMV7EM_DITHERED(TO, "r11", "r5", "r7", "r3", "r9", "lr", TO, "", "r7", __VA_ARGS__)

#define ARMV7EM_PACK_565(TO, RED, GREEN, BLUE) \
        "orr " GREEN ", " RED ", " GREEN ", lsr #5\n\torr " TO ", " GREEN ", " BLUE ", lsr #11\n\t"
#define ARMV7EM_PACK_SWAPPED(TO, RED, GREEN, BLUE) ARMV7EM_PACK_565(GREEN, RED, GREEN, BLUE) "rev16 " TO ", " GREEN "\n\t"
#define ARMV7EM_PACK_555(TO, RED, GREEN, BLUE) \
        "lsr " BLUE ", " BLUE ", #1\n\torr " GREEN ", " BLUE ", " GREEN ", lsr #6\n\torr " TO ", " GREEN ", " RED ", lsr #11\n\t"
#define ARMV7EM_HALF_63(TO, FROM) "lsr " TO ", " FROM ", #1\n\t"
#define ARMV7EM_HALF_31(TO, FROM) "mov " TO ", " FROM "\n\t"

/* Blocks from r0 up to r2, to r1, by the steps at r3. On the stack from sp on lie what red and green of each two columns add, the end,
 * the colour of the last block of one colour, where its pixels lie, and black ones, which are the first. */
#define ARMV7EM_DITHERED_BLOCKS(MAKE_HALF, ...)            \
    __asm__ volatile(                                   \
        ".syntax unified\n\t"                           \
        "movs r4, #0\n\tmovs r5, #0\n\tmovs r6, #0\n\tmovs r7, #0\n\t" \
        "push {r4, r5, r6, r7}\n\t"                     \
        "mov r4, r2\n\tmov r6, sp\n\t"                  \
        "push {r4, r5, r6, r7}\n\t"                     \
        "ldm r3, {r4, r6, r8, r10}\n\t"                 \
        MAKE_HALF("r5", "r4") MAKE_HALF("r7", "r6") MAKE_HALF("r9", "r8") MAKE_HALF("r11", "r10") \
        "push {r4, r5, r6, r7, r8, r9, r10, r11}\n\t"   \
        "movs r2, #249\n\tmov r12, #253\n"              \
        "1: ldm r0!, {r4, r5, r6, r7, r8, r9, r10, r11}\n\t" \
        "cmp r4, r5\n\tbne 2f\n\t"                      \
        "cmp r4, r11\n\titttt eq\n\tcmpeq r4, r6\n\t"   \
        "cmpeq r4, r7\n\tcmpeq r4, r8\n\tcmpeq r4, r9\n\t" \
        "it eq\n\tcmpeq r4, r10\n\tbne 2f\n\t"          \
        "ldrd r3, lr, [sp, #36]\n\t"                    \
        "cmp r3, r4\n\tbne 4f\n\t"                      \
        "ldm lr, {r4, r6, r8, r10}\n\t"                 \
        "b 3f\n"                                        \
        "4: strd r4, r1, [sp, #36]\n\t"                 \
        "pkhbt r3, r4, r4, lsl #16\n\tpkhtb r5, r4, r4, asr #16\n\t" \
        "uxtb16 lr, r3\n\tuxtb16 r3, r3, ror #8\n\tuxtb16 r5, r5\n\t" \
        ARMV7EM_DITHERED_FLAT("r4", "0", __VA_ARGS__) ARMV7EM_DITHERED_FLAT("r6", "8", __VA_ARGS__) \
        ARMV7EM_DITHERED_FLAT("r8", "16", __VA_ARGS__) ARMV7EM_DITHERED_FLAT("r10", "24", __VA_ARGS__) \
        "b 3f\n"                                        \
        "2: "                                           \
        ARMV7EM_DITHERED_PAIR("r4", "r5", "ldr r4, [sp]\n\t", "ldr r4, [sp, #4]\n\t", "r4", __VA_ARGS__) \
        ARMV7EM_DITHERED_LATER("r6", "r7", "8", __VA_ARGS__) ARMV7EM_DITHERED_LATER("r8", "r9", "16", __VA_ARGS__) \
        ARMV7EM_DITHERED_LATER("r10", "r11", "24", __VA_ARGS__) \
        "3: stm r1!, {r4, r6, r8, r10}\n\t"             \
        "ldr r3, [sp, #32]\n\t"                         \
        "cmp r0, r3\n\tbne 1b\n\t"                      \
        "add sp, #64"                                   \
        : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)        \
        :                                               \
        : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

/* As dithered_blocks: 3 instructions a pixel in blocks of the last colour, 8 in those of another, 9 in others. */
SMEAR_INLINE void dithered_blocks_armv7em(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step, bool is_555,
                                          bool swapped)
{
    register const uint32_t *r0 __asm__("r0") = in;
    register uint16_t *r1 __asm__("r1") = out;
    register const uint32_t *r2 __asm__("r2") = in + 8 * blocks;
    register const uint32_t *r3 __asm__("r3") = step;
    if (is_555)
        ARMV7EM_DITHERED_BLOCKS(ARMV7EM_HALF_31, "r2", "0xf800f800", ARMV7EM_PACK_555);
    else if (swapped)
        ARMV7EM_DITHERED_BLOCKS(ARMV7EM_HALF_63, "r12", "0xfc00fc00", ARMV7EM_PACK_SWAPPED);
    else
        ARMV7EM_DITHERED_BLOCKS(ARMV7EM_HALF_63, "r12", "0xfc00fc00", ARMV7EM_PACK_565);
}

#endif

#endif

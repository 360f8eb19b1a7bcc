/* SPDX-License-Identifier: MIT */
/* texel_place_rows_armv7em.h - texel_place_rows in assembly for Cortex-M4: half of the compiler's instructions, which has most of what
 * a pixel takes on the stack. */
#ifndef SMEAR_KERNELS_TEXEL_PLACE_ROWS_ARMV7EM_H
#define SMEAR_KERNELS_TEXEL_PLACE_ROWS_ARMV7EM_H

#include "kernels/texel_place_rows.h"

#if TEXEL_PLACE_ROWS && SMEAR_ASM_ARMV7EM

/* A plane's value at column r9 of row r3, of the three words at r2, into VALUE. */
#define ARMV7EM_PLANE(VALUE) \
        "ldm r2!, {" VALUE ", r12, lr}\n\t" \
        "mla " VALUE ", r12, r9, " VALUE "\n\t" \
        "mla " VALUE ", lr, r3, " VALUE "\n\t"

/* The rows' members come to the next row, whose values go to registers; at 42 there is none. */
#define ARMV7EM_PLACE_ROW \
        "40: ldr r0, [sp, #28]\n" \
        "41: ldm r0, {r1, r2, r3, r4, r5, r6, r7, r8}\n\t" \
        "subs r2, r2, #1\n\t" \
        "blt 42f\n\t" \
        "ldrd r9, r10, [r1], #12\n\t" \
        "adds r3, r3, #1\n\t" \
        "add r4, r4, r5\n\t" \
        "add r6, r6, r7\n\t" \
        "stm r0, {r1, r2, r3, r4, r5, r6}\n\t" \
        "subs r10, r10, r9\n\t" \
        "ble 41b\n\t" \
        "cmp r10, r8\n\t" \
        "bgt 41b\n\t" \
        "add r6, r6, r9, lsl #1\n\t" \
        "add r10, r6, r10, lsl #1\n\t" \
        "ldr r1, [r0, #32]\n\t" \
        "mla r4, r1, r9, r4\n\t" \
        "add r2, r0, #72\n\t" \
        "ldm r2, {r5, r7}\n\t" \
        "ldrd r8, r11, [r0, #92]\n\t" \
        "add r2, r0, #36\n\t" \
        ARMV7EM_PLANE("r0") \
        ARMV7EM_PLANE("r1") \
        "ldm r2, {r2, r12, lr}\n\t" \
        "mla r2, r12, r9, r2\n\t" \
        "mla r3, lr, r3, r2\n"

/* The place of a pixel: u into lr, v into r2. */
#define ARMV7EM_OWN_PLACE \
        "cmp r0, #2048\n\t" \
        "ite ge\n\t" \
        "movge r9, r0\n\t" \
        "movlt r9, #2048\n\t" \
        "clz r12, r9\n\t" \
        "lsl r9, r9, r12\n\t" \
        "ubfx lr, r9, #22, #9\n\t" \
        "ldrh lr, [r5, lr, lsl #1]\n\t" \
        "lsr r9, r9, #11\n\t" \
        "mul r9, lr, r9\n\t" \
        "rsb r9, r9, #0x80000000\n\t" \
        "asr r9, r9, #4\n\t" \
        "mul r9, lr, r9\n\t" \
        "lsl lr, lr, #19\n\t" \
        "add r9, lr, r9, asr #8\n\t" \
        "sub r12, r12, #1\n\t" \
        "asr lr, r1, #1\n\t" \
        "lsl lr, lr, r12\n\t" \
        "smmul lr, lr, r9\n\t" \
        "asrs r2, r3, #1\n\t" \
        "lsl r2, r2, r12\n\t" \
        "smmul r2, r2, r9\n\t"

/* q is in r0, u in r1 and v in r3, z in r4, r5 points to seeds, r6 to depths; r7 is `up`, r8 points to texels, r10 to the row's end,
 * r11 is the way from a depth to its pixel. On the stack lie dz, how planes change, how far coordinates go down, texels, and the
 * rows, whose members have come to the row before. */
static SMEAR_NOINLINE void texel_place_rows_armv7em(struct texel_place_rows *rows)
{
    texel_place_rows_before(rows);
    register struct texel_place_rows *r0 __asm__("r0") = rows;
    __asm__ volatile(
        ".syntax unified\n\t"
        "push {r0}\n\t"
        "ldrd r5, r6, [r0, #80]\n\t"
        "ldr r7, [r0, #88]\n\t"
        "push {r5, r6, r7}\n\t"
        "ldr r1, [r0, #32]\n\t"
        "ldr r2, [r0, #40]\n\t"
        "ldr r3, [r0, #52]\n\t"
        "ldr r4, [r0, #64]\n\t"
        "push {r1, r2, r3, r4}\n"
        ARMV7EM_PLACE_ROW
        "43: ldrh r9, [r6]\n\t"
        "cmp r9, r4, lsr #16\n\t"
        "bhs 44f\n\t"
        "lsr r9, r4, #16\n\t"
        "strh r9, [r6]\n\t"
        ARMV7EM_OWN_PLACE
        "lsl lr, lr, r7\n\t"
        "lsl r2, r2, r7\n\t"
        "ldrd r9, r12, [sp, #16]\n\t"
        "lsr lr, lr, r9\n\t"
        "lsr r2, r2, r12\n\t"
        "ldr r9, [sp, #24]\n\t"
        "lsl r2, r2, r9\n\t"
        "orr r2, r2, lr\n\t"
        "ldrh r2, [r8, r2, lsl #1]\n\t"
        "strh r2, [r6, r11]\n"
        "44: ldm sp, {r2, r9, r12, lr}\n\t"
        "add r4, r4, r2\n\t"
        "add r0, r0, r9\n\t"
        "add r1, r1, r12\n\t"
        "add r3, r3, lr\n\t"
        "adds r6, r6, #2\n\t"
        "cmp r6, r10\n\t"
        "bne 43b\n\t"
        "b 40b\n"
        "42: add sp, #32"
        : "+r"(r0)
        :
        : "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

#endif

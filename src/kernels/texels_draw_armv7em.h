/* SPDX-License-Identifier: MIT */
/* texels_draw_armv7em.h - copied texels along a row, as texels_draw has them, of which blocks and rows are made in assembly for
 * Cortex-M4 and others that have its instructions for halves of words: depths are tested in pairs. Compilers use none of these, and as
 * many registers as there are for less. */
#ifndef SMEAR_KERNELS_TEXELS_DRAW_ARMV7EM_H
#define SMEAR_KERNELS_TEXELS_DRAW_ARMV7EM_H

#include "kernels/texel_run.h"

#if SMEAR_ASM_ARMV7EM

SMEAR_STATIC_ASSERT(offsetof(struct texel_run, dz) == 0 && offsetof(struct texel_run, count) == 20
                        && offsetof(struct texel_run, color) == 24 && offsetof(struct texel_run, depth) == 28
                        && offsetof(struct texel_run, z) == 32 && offsetof(struct texel_run, texels) == 44,
                    "the assembly knows struct texel_run");

/* dz is in r1, du, dv, ddu and ddv in r2 to r5, z in r9, u in r10, v in r11; r12 points to texels. r7 points to narrow colours, depths lie
 * r8 bytes further on; or, of KIND WIDE, to depths, and r8 to colours. In lr lie the bits that an index has of v, and
 * in r0 and r6 whatever comes. */
#define ARMV7EM_DEPTH_NARROW(OF) OF ", [r7, r8]\n\t"
#define ARMV7EM_DEPTH_WIDE(OF) OF ", [r7]\n\t"
#define ARMV7EM_LOAD_NARROW  "ldrh r0, [r12, r0, lsl #1]\n\t"
#define ARMV7EM_LOAD_WIDE    "ldr r0, [r12, r0, lsl #2]\n\tbic r0, r0, #0xff000000\n\t"
#define ARMV7EM_STORE_NARROW "strh r0, [r7]\n"
#define ARMV7EM_STORE_WIDE   "str r0, [r8]\n"
#define ARMV7EM_PUT_NARROW   "strh r0, [r7], #2\n\t"
#define ARMV7EM_PUT_WIDE     "str r0, [r8], #4\n\t"
/* The depths of a pair, before its colours; of a pixel whose colour is put; a pixel or two are stepped over. */
#define ARMV7EM_DEPTHS_NARROW "str r6, [r7, r8]\n\t"
#define ARMV7EM_DEPTHS_WIDE   "str r6, [r7], #4\n\t"
#define ARMV7EM_SECOND_NARROW "strh r6, [r7, r8]\n\t"
#define ARMV7EM_SECOND_WIDE   "strh r6, [r7], #2\n\t"
#define ARMV7EM_OVER_NARROW(N) "adds r7, #2 * " N "\n\t"
#define ARMV7EM_OVER_WIDE(N)   "adds r7, #2 * " N "\n\tadd r8, r8, #4 * " N "\n\t"

#define ARMV7EM_BEND \
        "add r2, r2, r4\n\t" \
        "add r3, r3, r5\n\t"

#define ARMV7EM_STEP(BEND) \
        "add r10, r10, r2\n\t" \
        "add r11, r11, r3\n\t" \
        BEND

#define ARMV7EM_TEXEL(KIND) \
        "and r0, lr, r11, lsr %[index_v]\n\t" \
        "orr r0, r0, r10, lsr %[from_u]\n\t" \
        ARMV7EM_LOAD_##KIND

#define ARMV7EM_MASK "movw lr, %[mask_v]\n\t"

/* A pixel, which is stepped over in memory; lr keeps what it has. */
#define ARMV7EM_PIXEL(KIND, BEND) \
        ARMV7EM_DEPTH_##KIND("ldrh r0") \
        "cmp r0, r9, lsr #16\n\t" \
        "bhs 9f\n\t" \
        "lsr r6, r9, #16\n\t" \
        ARMV7EM_DEPTH_##KIND("strh r6") \
        "lsr r0, r11, %[from_v]\n\t" \
        "lsr r6, r10, %[from_u]\n\t" \
        "orr r0, r6, r0, lsl %[to_v]\n\t" \
        ARMV7EM_LOAD_##KIND ARMV7EM_STORE_##KIND \
        "9: " ARMV7EM_OVER_##KIND("1") \
        "add r9, r9, r1\n\t" \
        ARMV7EM_STEP(BEND)

/* Two pixels, if both are seen; else SLOW, which goes elsewhere if r0 is 0. Halves of r0 are 0 where the old depth is not less, and
 * so is their product where one of them is. */
#define ARMV7EM_PAIR(KIND, SLOW, BEND) \
        "add r6, r9, r1\n\t" \
        "pkhtb r6, r6, r9, asr #16\n\t" \
        ARMV7EM_DEPTH_##KIND("ldr r0") \
        "uqsub16 r0, r6, r0\n\t" \
        "add r9, r9, r1, lsl #1\n\t" \
        "smulbt r0, r0, r0\n\t" \
        SLOW \
        ARMV7EM_DEPTHS_##KIND \
        ARMV7EM_TEXEL(KIND) ARMV7EM_PUT_##KIND ARMV7EM_STEP(BEND) \
        ARMV7EM_TEXEL(KIND) ARMV7EM_PUT_##KIND ARMV7EM_STEP(BEND)

/* Two pixels of which one at most is seen; their codes are in r6. */
#define ARMV7EM_SLOW_PAIR(KIND, BEND, BOTH) \
        ARMV7EM_DEPTH_##KIND("ldr r0") "uqsub16 r0, r6, r0\n\t" \
        "cbz r0, 8f\n\t" \
        "lsls r0, r0, #16\n\t" \
        "beq 7f\n\t" \
        ARMV7EM_DEPTH_##KIND("strh r6") \
        ARMV7EM_TEXEL(KIND) ARMV7EM_STORE_##KIND \
        "8: " ARMV7EM_OVER_##KIND("2") \
        BOTH \
        "b 9f\n" \
        "7: " ARMV7EM_OVER_##KIND("1") \
        ARMV7EM_STEP(BEND) \
        "lsrs r6, r6, #16\n\t" \
        ARMV7EM_SECOND_##KIND \
        ARMV7EM_TEXEL(KIND) ARMV7EM_PUT_##KIND \
        ARMV7EM_STEP(BEND) \
        "9:\n\t"

/* Coordinates go on by two pixels. */
#define ARMV7EM_BOTH \
        "add r10, r10, r2, lsl #1\n\t" \
        "add r11, r11, r3, lsl #1\n\t"

#define ARMV7EM_BOTH_BENT \
        "add r10, r10, r4\n\t" \
        "add r11, r11, r5\n\t" \
        ARMV7EM_BOTH \
        "add r2, r2, r4, lsl #1\n\t" \
        "add r3, r3, r5, lsl #1\n\t"

/* Rounds of four pixels, at 23 or 33; at 24 or 34 the last two of one. MORE goes there where more are to come. Goes on at DONE. */
#define ARMV7EM_STRAIGHT_QUADS(KIND, MORE, DONE) \
        "23:\n\t" \
        ARMV7EM_PAIR(KIND, "cbnz r0, 9f\n\tb 26f\n9:\n\t", "") \
        "24:\n\t" \
        ARMV7EM_PAIR(KIND, "cbz r0, 27f\n\t", "") \
        "28: " MORE \
        "b " DONE "\n" \
        "27:\n\t" \
        ARMV7EM_SLOW_PAIR(KIND, "", ARMV7EM_BOTH) \
        "b 28b\n" \
        "26:\n\t" \
        ARMV7EM_SLOW_PAIR(KIND, "", ARMV7EM_BOTH) \
        "b 24b\n"

#define ARMV7EM_BENT_QUADS(KIND, MORE, DONE) \
        "33:\n\t" \
        ARMV7EM_PAIR(KIND, "cbnz r0, 9f\n\tb 36f\n9:\n\t", ARMV7EM_BEND) \
        "34:\n\t" \
        ARMV7EM_PAIR(KIND, "cbz r0, 37f\n\t", ARMV7EM_BEND) \
        "38: " MORE \
        "b " DONE "\n" \
        "37:\n\t" \
        ARMV7EM_SLOW_PAIR(KIND, ARMV7EM_BEND, ARMV7EM_BOTH_BENT) \
        "b 38b\n" \
        "36:\n\t" \
        ARMV7EM_SLOW_PAIR(KIND, ARMV7EM_BEND, ARMV7EM_BOTH_BENT) \
        "b 34b\n"

/* The same of any number of pixels, lr > 0. Behind the last points r4; where changes change, the upper half of lr counts rounds. */
#define ARMV7EM_STRAIGHT(KIND, DONE) \
        "lsrs r0, lr, #1\n\t" \
        "bcc 22f\n\t" \
        ARMV7EM_PIXEL(KIND, "") \
        "22: lsrs r0, lr, #2\n\t" \
        ARMV7EM_MASK \
        "bcs 24f\n\t" \
        "beq " DONE "\n" \
        ARMV7EM_STRAIGHT_QUADS(KIND, "cmp r7, r4\n\tbne 23b\n\t", DONE)

#define ARMV7EM_BENT(KIND, DONE) \
        "lsrs r0, lr, #1\n\t" \
        "bcc 32f\n\t" \
        ARMV7EM_PIXEL(KIND, ARMV7EM_BEND) \
        "32: lsrs r0, lr, #2\n\t" \
        ARMV7EM_MASK \
        "orr lr, lr, r0, lsl #16\n\t" \
        "bcs 34f\n\t" \
        "beq " DONE "\n\t" \
        "sub lr, lr, #65536\n" \
        ARMV7EM_BENT_QUADS(KIND, "subs lr, lr, #65536\n\tbpl 33b\n\t", DONE)

/* What the instructions have of the texture's sizes. */
#define ARMV7EM_SIZES \
        [from_v] "i"(32 - log2_height), [to_v] "i"(log2_width), [from_u] "i"(32 - log2_width), \
        [index_v] "i"(32 - log2_height - log2_width), [mask_v] "i"(((1 << log2_height) - 1) << log2_width)
#endif

#endif

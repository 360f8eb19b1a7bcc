/* SPDX-License-Identifier: MIT */
/* texel_blocks_armv7em.h - blocks of copied texels along a row, in assembly for Cortex-M4: what leads from block to block takes half of
 * the compiler's instructions, and what is drawn stays in registers. */
#ifndef SMEAR_KERNELS_TEXEL_BLOCKS_ARMV7EM_H
#define SMEAR_KERNELS_TEXEL_BLOCKS_ARMV7EM_H

#include "kernels/texel_track.h"
#include "kernels/texels_draw.h"
#include "kernels/texels_draw_armv7em.h"

/* Draws `count` >= 0 whole blocks, then `rest` pixels that are no more than a block and the one behind them, if there are any. Of
 * the run, colours, depths and z are then those of the next pixel, and coordinates and their changes are anything. */
#if SMEAR_ASM_ARMV7EM

SMEAR_STATIC_ASSERT(offsetof(struct texel_track, q) == 52 && offsetof(struct texel_track, place) == 64
                        && offsetof(struct texel_track, dq) == 76 && offsetof(struct texel_track, log2) == 88
                        && offsetof(struct texel_track, seed) == 100 && offsetof(struct texel_track, parabolic) == 104
                        && offsetof(struct texel_track, n) == 112 && offsetof(struct texel_track, qx) == 116
                        && offsetof(struct texel_track, last) == 128 && offsetof(struct texel_track, counter) == 132,
                    "the assembly knows struct texel_track");

/* The place of planes r1, r2 and r3, which become the track's, whose q is at r12: 1/q into r1, coordinates into r2 and r3, the leading
 * zeros of q less one into lr. */
#define ARMV7EM_DIVIDE \
        "stm r12, {r1, r2, r3}\n\t" \
        "cmp r1, #2048\n\t" \
        "it lt\n\t" \
        "movlt r1, #2048\n\t" \
        "clz lr, r1\n\t" \
        "lsl r1, r1, lr\n\t" \
        "ldr r0, [r12, #48]\n\t" \
        "ubfx r10, r1, #22, #9\n\t" \
        "ldrh r10, [r0, r10, lsl #1]\n\t" \
        "lsrs r1, r1, #11\n\t" \
        "mul r1, r10, r1\n\t" \
        "rsb r1, r1, #0x80000000\n\t" \
        "asrs r1, r1, #4\n\t" \
        "mul r1, r10, r1\n\t" \
        "lsl r10, r10, #19\n\t" \
        "add r1, r10, r1, asr #8\n\t" \
        "sub lr, lr, #1\n\t" \
        "asrs r2, r2, #1\n\t" \
        "lsl r2, r2, lr\n\t" \
        "smmul r2, r2, r1\n\t" \
        "asrs r3, r3, #1\n\t" \
        "lsl r3, r3, lr\n\t" \
        "smmul r3, r3, r1\n\t" \
        "strd r2, r3, [r12, #12]\n\t" \
        "subs r2, r2, r4\n\t" \
        "subs r3, r3, r5\n\t"

/* Goes on by a block: the place at its end. pu and pv, the place before, come into r4 and r5, nearness into r6, changes from pixel to
 * pixel of the block into r2 and r3, 1/q into r1, `up` into r11. */
#define ARMV7EM_PLACE \
        "ldm r12, {r1, r2, r3, r4, r5, r6, r10, r11, lr}\n\t" \
        "add r1, r1, r10\n\t" \
        "add r2, r2, r11\n\t" \
        "add r3, r3, lr\n\t" \
        ARMV7EM_DIVIDE \
        "ldrd r10, r11, [r12, #36]\n\t" \
        "asr r2, r2, r10\n\t" \
        "asr r3, r3, r10\n\t"

/* How many pixels the next part has, into lr, of the rest in it: all, where they are a block, or 32 or 16. The number to be drawn goes
 * to the run's count, that of pixels behind them to the stack. */
#define ARMV7EM_PART_SIZE \
        "cmp lr, #16\n\t" \
        "bls 61f\n\t" \
        "ldr r0, [r12, #76]\n\t" \
        "cmp lr, r0\n\t" \
        "bgt 61f\n\t" \
        "cmp lr, #32\n\t" \
        "ite ge\n\t" \
        "movge lr, #32\n\t" \
        "movlt lr, #16\n" \
        "61: ldr r0, [sp, #8]\n\t" \
        "subs r0, r0, lr\n\t" \
        "str r0, [sp, #8]\n\t" \
        "ite eq\n\t" \
        "addeq r0, lr, #1\n\t" \
        "movne r0, lr\n\t" \
        "str r0, [r12, #-32]\n\t"

/* Goes on by such a part, by whose rounded inverse changes are multiplied. */
#define ARMV7EM_PART_PLACE \
        ARMV7EM_PART_SIZE \
        "str lr, [r12, #60]\n\t" \
        "ldm r12, {r1, r2, r3, r4, r5, r6}\n\t" \
        "add r0, r12, #64\n\t" \
        "ldm r0, {r0, r10, r11}\n\t" \
        "mla r1, r0, lr, r1\n\t" \
        "mla r2, r10, lr, r2\n\t" \
        "mla r3, r11, lr, r3\n\t" \
        ARMV7EM_DIVIDE \
        "ldr r11, [r12, #60]\n\t" \
        "mov r10, #65536\n\t" \
        "add r10, r10, r11, lsr #1\n\t" \
        "udiv r10, r10, r11\n\t" \
        "smull r0, r2, r10, r2\n\t" \
        "smull r11, r3, r10, r3\n\t" \
        "lsrs r0, r0, #16\n\t" \
        "orr r2, r0, r2, lsl #16\n\t" \
        "lsr r11, r11, #16\n\t" \
        "orr r3, r11, r3, lsl #16\n\t" \
        "ldr r11, [r12, #40]\n\t"

/* Of a parabola: the rate into r0, twice b into r1 and r6, first changes, and the changes of changes into r4 and r5. The start of v goes
 * to lr. LAST: the last pixel's number into r0. */
#define ARMV7EM_PARABOLA(LAST) \
        "ldr r0, [r12, #44]\n\t" \
        "smmul r0, r0, r1\n\t" \
        "rsb lr, lr, #19\n\t" \
        "asr r0, r0, lr\n\t" \
        "str r0, [r12, #20]\n\t" \
        "add r0, r0, r6\n\t" \
        "adds r0, r0, #2\n\t" \
        "asrs r0, r0, #1\n\t" \
        "lsl r10, r4, r11\n\t" \
        "lsl lr, r5, r11\n\t" \
        "asrs r1, r2, #10\n\t" \
        "muls r1, r0, r1\n\t" \
        "asrs r1, r1, #5\n\t" \
        "asrs r6, r3, #10\n\t" \
        "muls r6, r0, r6\n\t" \
        "asrs r6, r6, #5\n\t" \
        LAST \
        "mul r4, r1, r0\n\t" \
        "add r2, r2, r4, asr #1\n\t" \
        "mul r4, r6, r0\n\t" \
        "add r3, r3, r4, asr #1\n\t" \
        "lsl r1, r1, r11\n\t" \
        "negs r4, r1\n\t" \
        "lsl r6, r6, r11\n\t" \
        "bic r6, r6, #255\n\t" \
        "negs r5, r6\n\t"

/* Starts the block's run. The last eight bits of v, which no index has, count up to 0 behind the last pixel, from
 * a number that stays in r0. */
#define ARMV7EM_RUN \
        "lsl r2, r2, r11\n\t" \
        "lsl r3, r3, r11\n\t" \
        "bic r3, r3, #255\n\t" \
        "orr r3, r3, #1\n\t" \
        "ldr r0, [r12, #80]\n\t" \
        "bic r11, lr, #255\n\t" \
        "orr r11, r11, r0\n\t" \
        "ldr r1, [r12, #-52]\n\t" \
        "ldr r12, [r12, #-8]\n\t" \
        ARMV7EM_MASK

/* Starts the part's run: its number into lr. */
#define ARMV7EM_PART_RUN \
        "lsl r2, r2, r11\n\t" \
        "lsl r3, r3, r11\n\t" \
        "bic r3, r3, #255\n\t" \
        "mov r11, lr\n\t" \
        "ldr lr, [r12, #-32]\n\t" \
        "ldr r1, [r12, #-52]\n\t" \
        "ldr r12, [r12, #-8]\n\t"

/* On the stack lie the track's q, how many blocks are left, and how many pixels behind them. START and END take and leave the run's
 * colours, depths and z. */
#define ARMV7EM_BLOCKS(KIND, START, END) \
    __asm__ volatile( \
        ".syntax unified\n\t" \
        "push {r0, r1, r2}\n\t" \
        START \
        "cmp r1, #0\n\t" \
        "beq 54f\n" \
        "51: ldr r12, [sp]\n\t" \
        ARMV7EM_PLACE \
        "ldrb r0, [r12, #52]\n\t" \
        "cmp r0, #0\n\t" \
        "beq 52f\n\t" \
        ARMV7EM_PARABOLA("ldr r0, [r12, #76]\n\t") \
        ARMV7EM_RUN \
        ARMV7EM_BENT_QUADS(KIND, "lsls r0, r11, #24\n\tbne 33b\n\t", "53f") \
        "52: lsl r10, r4, r11\n\t" \
        "lsl lr, r5, r11\n\t" \
        ARMV7EM_RUN \
        "rsb r4, r0, #256\n\t" \
        "add r4, r7, r4, lsl #1\n\t" \
        ARMV7EM_STRAIGHT_QUADS(KIND, "cmp r7, r4\n\tbne 23b\n\t", "53f") \
        "53: ldr r0, [sp, #4]\n\t" \
        "subs r0, r0, #1\n\t" \
        "str r0, [sp, #4]\n\t" \
        "bne 51b\n" \
        "54: ldr lr, [sp, #8]\n\t" \
        "ldr r12, [sp]\n\t" \
        "cmp lr, #0\n\t" \
        "beq 57f\n\t" \
        ARMV7EM_PART_PLACE \
        "ldrb r0, [r12, #52]\n\t" \
        "cmp r0, #0\n\t" \
        "beq 55f\n\t" \
        ARMV7EM_PARABOLA("ldr r0, [r12, #60]\n\tsubs r0, r0, #1\n\t") \
        ARMV7EM_PART_RUN ARMV7EM_BENT(KIND, "54b") \
        "55: lsl r10, r4, r11\n\t" \
        "lsl lr, r5, r11\n\t" ARMV7EM_PART_RUN "add r4, r7, lr, lsl #1\n\t" \
        ARMV7EM_STRAIGHT(KIND, "54b") \
        "57: pop {r0, r1, r2}\n\t" END \
        : "+r"(r0), "+r"(r1), "+r"(r2) \
        : ARMV7EM_SIZES \
        : "r3", "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory")

static inline __attribute__((always_inline)) void texel_blocks_armv7em(struct texel_track *k, int32_t count, int32_t rest,
                                                                       int log2_width, int log2_height, enum texel_kind kind)
{
    register int32_t *r0 __asm__("r0") = &k->q;
    register int32_t r1 __asm__("r1") = count;
    register int32_t r2 __asm__("r2") = rest;
    if (kind == TEXELS_NARROW)
        ARMV7EM_BLOCKS(NARROW, "ldr r7, [r0, #-28]\n\tldrd r8, r9, [r0, #-24]\n\tsub r8, r8, r7\n\t",
                       "add r8, r8, r7\n\tstr r7, [r0, #-28]\n\tstrd r8, r9, [r0, #-24]");
    else
        ARMV7EM_BLOCKS(WIDE, "ldr r8, [r0, #-28]\n\tldrd r7, r9, [r0, #-24]\n\t", "str r8, [r0, #-28]\n\tstrd r7, r9, [r0, #-24]");
}
#define texel_blocks texel_blocks_armv7em
#else
/* Nowhere, and not called. */
void texel_blocks(struct texel_track *k, int32_t count, int32_t rest, int log2_width, int log2_height, enum texel_kind kind);
#endif

#endif

/* SPDX-License-Identifier: MIT */
/* tiny_triangles_armv7em.h - tiny triangles for Cortex-M4: what a triangle needs stays in registers from its list to its pixels. */
#ifndef SMEAR_KERNELS_TINY_TRIANGLES_ARMV7EM_H
#define SMEAR_KERNELS_TINY_TRIANGLES_ARMV7EM_H

#include "kernels/kernels.h"

#if SMEAR_ASM_ARMV7EM
/* Entry r1: where its vertices are into r1, r2 and r3, its colour into r7, `kind` into r11. At 9 it is of another segment. */
#define TINY_TRIANGLES_ENTRY           \
    "1: ldrd r8, r9, [r0, #132]\n\t"   \
    "ldrd r10, r11, [r0, #140]\n\t"    \
    "sub r10, r10, r1, lsl #4\n\t"     \
    "ldm r10, {r4, r5, r6, r7}\n\t"    \
    "eor r8, r8, r5\n\t"               \
    "lsrs r8, r8, #16\n\t"             \
    "bne 9f\n\t"                       \
    "strd r1, r6, [r0, #40]\n\t"       \
    "uxth r1, r4\n\t"                  \
    "lsrs r2, r4, #16\n\t"             \
    "uxth r3, r5\n\t"                  \
    "add r1, r9, r1, lsl #2\n\t"       \
    "add r2, r9, r2, lsl #2\n\t"       \
    "add r3, r9, r3, lsl #2\n\t"

/* One of the channels of three corners, to where r10 points: what that of the others is more than that of v[0], and that of v[0], with
 * what rounds codes, which is in lr. ROTATED chooses upper halves. */
#define TINY_TRIANGLES_CHANNEL(C0, C1, C2, ROTATED) \
    "uxth r5, " C0 ROTATED "\n\t"                   \
    "rsb r5, r5, #0\n\t"                            \
    "uxtah r7, r5, " C1 ROTATED "\n\t"              \
    "uxtah r9, r5, " C2 ROTATED "\n\t"              \
    "sub r11, lr, r5, lsl #14\n\t"                  \
    "stm r10!, {r7, r9, r11}\n\t"

/* Blue, red and green; or one colour. */
#define TINY_TRIANGLES_COLOR           \
    "tst r11, #2\n\t"                  \
    "beq 2f\n\t"                       \
    "ldrd r4, r5, [r1, #12]\n\t"       \
    "ldrd r6, r7, [r2, #12]\n\t"       \
    "ldrd r8, r9, [r3, #12]\n\t"       \
    "add r10, r0, #80\n\t"             \
    "mov lr, #0x200000\n\t" TINY_TRIANGLES_CHANNEL("r5", "r7", "r9", "") TINY_TRIANGLES_CHANNEL("r4", "r6", "r8", "") \
    TINY_TRIANGLES_CHANNEL("r4", "r6", "r8", ", ror #16") \
    "b 4f\n"                           \
    "2: tst r11, #1\n\t"               \
    "ittt ne\n\t"                      \
    "bfcne r7, #24, #8\n\t"            \
    "strne r7, [r0, #52]\n\t"          \
    "bne 4f\n\t"                       \
    "add r10, r0, #116\n\t"            \
    "ldm r10, {r8, r9, r10, r11}\n\t"  \
    "and r4, r7, #0xff00ff\n\t"        \
    "ubfx r5, r7, #8, #8\n\t"          \
    "mla r4, r4, r8, r9\n\t"           \
    "mla r5, r5, r10, r11\n\t"         \
    "lsrs r5, r5, #10\n\t"             \
    "ubfx r6, r4, #11, #5\n\t"         \
    "lsrs r4, r4, #27\n\t"             \
    "orr r6, r6, r5, lsl #5\n\t"       \
    "orr r6, r6, r4, lsl #11\n\t"      \
    "str r6, [r0, #52]\n"              \
    "4: "

/* The first pixel whose centre lies at or beyond (X, Y) as a pair into OUT. */
#define TINY_TRIANGLES_FIRST(OUT, X, Y) \
    "add " OUT ", " X ", #127\n\t"      \
    "add lr, " Y ", #127\n\t"           \
    "asr " OUT ", " OUT ", #8\n\t"      \
    "pkhbt " OUT ", " OUT ", lr, lsl #8\n\t"

/* Corners into r4 to r12; pairs: their box's first pixel into lr, that behind its last one into r1. At 7 it is not tiny. */
#define TINY_TRIANGLES_SPAN           \
    "ldm r1, {r4, r5, r6}\n\t"        \
    "ldm r2, {r7, r8, r9}\n\t"        \
    "ldm r3, {r10, r11, r12}\n\t" TINY_TRIANGLES_FIRST("r1", "r4", "r5") TINY_TRIANGLES_FIRST("r2", "r7", "r8") \
    TINY_TRIANGLES_FIRST("r3", "r10", "r11") \
    "ssub16 lr, r1, r2\n\t"           \
    "sel lr, r2, r1\n\t"              \
    "sel r1, r1, r2\n\t"              \
    "ssub16 r2, lr, r3\n\t"           \
    "sel lr, r3, lr\n\t"              \
    "ssub16 r2, r3, r1\n\t"           \
    "sel r1, r3, r1\n\t"              \
    "ssub16 r2, r1, lr\n\t"           \
    "add r3, r2, #0x70007\n\t"        \
    "bics r3, r3, #0xf000f\n\t"       \
    "bne 7f\n\t"                      \
    "smulbt r3, r2, r2\n\t"           \
    "cmp r3, #32\n\t"                 \
    "bgt 7f\n\t"

/* The least of two numbers from 0 on is one of them and what the other one less it has below 0. At 7 depths are not even, or on both
 * sides of their codes' break. Units that become codes are stored, and how the others differ, times two. */
#define TINY_TRIANGLES_UNITS          \
    "subs r2, r6, r9\n\t"             \
    "and r2, r2, r2, asr #31\n\t"     \
    "add r2, r2, r9\n\t"              \
    "sub r3, r2, r12\n\t"             \
    "and r3, r3, r3, asr #31\n\t"     \
    "add r2, r3, r12\n\t"             \
    "ldr r3, [r0, #144]\n\t"          \
    "lsrs r3, r3, #3\n\t"             \
    "bcc 2f\n\t"                      \
    "add r3, r2, r2, asr #5\n\t"      \
    "cmp r6, r3\n\t"                  \
    "itt le\n\t"                      \
    "cmple r9, r3\n\t"                \
    "cmple r12, r3\n\t"               \
    "bgt 7f\n"                        \
    "2: subs r2, #2\n\t"              \
    "cmp r2, #0x4000000\n\t"          \
    "blt 25f\n\t"                     \
    "add r2, r6, #0x3c000000\n\t"     \
    "add r2, r2, #0x4000\n\t"         \
    "movs r3, #15\n"                  \
    "26: strd r2, r3, [r0, #72]\n\t"  \
    "lsls r2, r6, #1\n\t"             \
    "rsb r9, r2, r9, lsl #1\n\t"      \
    "rsb r12, r2, r12, lsl #1\n\t"    \
    "strd r9, r12, [r0, #64]\n\t"

/* Codes of units before the break. */
#define TINY_TRIANGLES_FAR            \
    "25: orr r2, r6, r9\n\t"          \
    "orr r2, r2, r12\n\t"             \
    "lsrs r2, r2, #26\n\t"            \
    "bne 7f\n\t"                      \
    "add r2, r6, #0x400\n\t"          \
    "movs r3, #11\n\t"                \
    "b 26b\n"

/* The box within the plane: columns into r9, rows into r12. At 8 it is empty. */
#define TINY_TRIANGLES_CUT            \
    "ldr r2, [r0, #148]\n\t"          \
    "ssub16 r3, lr, r2\n\t"           \
    "sel lr, lr, r2\n\t"              \
    "ldr r3, [r0, #152]\n\t"          \
    "ssub16 r2, r3, r1\n\t"           \
    "sel r1, r1, r3\n\t"              \
    "ssub16 r1, r1, lr\n\t"           \
    "sub r2, r1, #0x10001\n\t"        \
    "tst r2, #0x80008000\n\t"         \
    "bne 8f\n\t"                      \
    "uxth r9, r1\n\t"                 \
    "lsr r12, r1, #16\n\t"

/* Edge functions at the first pixel into r1, r2 and r4 (the third one), twice the area into r6; x1, y1, -x2 and y2 in r7, r8, r10 and
 * r11. Products cross in pairs of halves. */
#define TINY_TRIANGLES_EDGES          \
    "subs r7, r7, r4\n\t"             \
    "sub r8, r8, r5\n\t"              \
    "sub r10, r4, r10\n\t"            \
    "sub r11, r11, r5\n\t"            \
    "pkhbt r2, r7, r8, lsl #16\n\t"   \
    "pkhbt r3, r10, r11, lsl #16\n\t" \
    "pkhbt r4, r4, r5, lsl #16\n\t"   \
    "lsl r5, lr, #8\n\t"              \
    "bic r5, r5, #0xff0000\n\t"       \
    "orr r5, r5, #0x800080\n\t"       \
    "ssub16 r5, r5, r4\n\t"           \
    "smuadx r6, r2, r3\n\t"           \
    "smuadx r1, r5, r3\n\t"           \
    "smusdx r2, r2, r5\n\t"           \
    "subs r4, r6, r1\n\t"             \
    "subs r4, r4, r2\n\t"

/* What decides centres on edges. */
#define TINY_TRIANGLES_BIASES         \
    "add r3, r7, r10\n\t"             \
    "sub r5, r8, r11\n\t"             \
    "mvns r3, r3\n\t"                 \
    "add r3, r3, r5, lsl #16\n\t"     \
    "add r4, r4, r3, asr #31\n\t"     \
    "add r3, r10, r11, lsl #16\n\t"   \
    "subs r3, #1\n\t"                 \
    "add r1, r1, r3, asr #31\n\t"     \
    "mvn r3, r8, lsl #16\n\t"         \
    "adds r3, r3, r7\n\t"             \
    "add r2, r2, r3, asr #31\n\t"

/* The first pixel's depth into r3, the row's end into lr; what leads from row to row is stored. */
#define TINY_TRIANGLES_ROWS           \
    "ldrd r5, r3, [r0, #156]\n\t"     \
    "smlatb r3, lr, r5, r3\n\t"       \
    "uxth lr, lr\n\t"                 \
    "add r3, r3, lr, lsl #1\n\t"      \
    "lsl r9, r9, #1\n\t"              \
    "add lr, r3, r9\n\t"              \
    "mla r12, r12, r5, lr\n\t"        \
    "lsls r7, r7, #8\n\t"             \
    "lsl r10, r10, #8\n\t"            \
    "stm r0, {r1, r2, r4, r5, r7, r9, r10, r12}\n\t"

/* tiny_scale_make, and steps along rows into r5 and r6. */
#define TINY_TRIANGLES_SCALE          \
    "clz r12, r6\n\t"                 \
    "lsl r6, r6, r12\n\t"             \
    "ldr r7, [r0, #164]\n\t"          \
    "ubfx r9, r6, #22, #9\n\t"        \
    "ldrh r9, [r7, r9, lsl #1]\n\t"   \
    "lsrs r6, r6, #11\n\t"            \
    "mov r7, #0x80000000\n\t"         \
    "mls r6, r6, r9, r7\n\t"          \
    "asrs r6, r6, #4\n\t"             \
    "mul r6, r6, r9\n\t"              \
    "lsl r9, r9, #19\n\t"             \
    "add r9, r9, r6, asr #8\n\t"      \
    "lsr r9, r9, #14\n\t"             \
    "sub r9, r9, #1\n\t"              \
    "strd r12, r9, [r0, #56]\n\t"     \
    "lsl r5, r11, #8\n\t"             \
    "rsb r6, r8, #0\n\t"              \
    "lsls r6, r6, #8\n\t"             \
    "strd r5, r6, [r0, #32]\n\t"

/* On to one of four loops. */
#define TINY_TRIANGLES_CHOOSE         \
    "ldr r7, [r0, #144]\n\t"          \
    "and r7, r7, #3\n\t"              \
    "tbh [pc, r7, lsl #1]\n"          \
    "20: .hword (21f - 20b) / 2, (22f - 20b) / 2, (23f - 20b) / 2, (24f - 20b) / 2\n"

/* `mi` where the pixel in r3 is not covered. */
#define TINY_TRIANGLES_TEST \
    "orr r7, r1, r2\n\t"    \
    "orrs r7, r7, r4\n\t"

/* One pixel further right; `ne` unless the row is at its end. */
#define TINY_TRIANGLES_STEP \
    "adds r1, r1, r5\n\t"   \
    "adds r2, r2, r6\n\t"   \
    "subs r4, r4, r5\n\t"   \
    "subs r4, r4, r6\n\t"   \
    "adds r3, #2\n\t"       \
    "cmp r3, lr\n\t"

/* Weights of corners, times 2^15, into r10 and r11, the code into r12. */
#define TINY_TRIANGLES_CODE           \
    "ldrd r7, r8, [r0, #56]\n\t"      \
    "lsl r10, r1, r7\n\t"             \
    "lsl r11, r2, r7\n\t"             \
    "lsr r10, r10, #16\n\t"           \
    "lsr r11, r11, #16\n\t"           \
    "mul r10, r10, r8\n\t"            \
    "mul r11, r11, r8\n\t"            \
    "bfc r10, #0, #15\n\t"            \
    "bfc r11, #0, #15\n\t"            \
    "ldrd r7, r8, [r0, #64]\n\t"      \
    "ldrd r12, r9, [r0, #72]\n\t"     \
    "smmla r12, r7, r10, r12\n\t"     \
    "smmla r12, r8, r11, r12\n\t"     \
    "lsr r12, r12, r9\n\t"

/* Blue, red and green into r7, r8 and r9. */
#define TINY_TRIANGLES_SHADE          \
    "lsr r10, r10, #17\n\t"           \
    "lsr r11, r11, #17\n\t"           \
    "add r12, r0, #80\n\t"            \
    "ldm r12!, {r5, r6, r7}\n\t"      \
    "mla r7, r5, r10, r7\n\t"         \
    "mla r7, r6, r11, r7\n\t"         \
    "ldm r12!, {r5, r6, r8}\n\t"      \
    "mla r8, r5, r10, r8\n\t"         \
    "mla r8, r6, r11, r8\n\t"         \
    "ldm r12!, {r5, r6, r9}\n\t"      \
    "mla r9, r5, r10, r9\n\t"         \
    "mla r9, r6, r11, r9\n\t"         \
    "lsrs r7, r7, #22\n\t"            \
    "lsr r8, r8, #22\n\t"             \
    "lsr r9, r9, #22\n\t"             \
    "orr r7, r7, r8, lsl #16\n\t"

/* As rgb565_nearest has it. */
#define TINY_TRIANGLES_SHADE_NARROW   \
    TINY_TRIANGLES_SHADE              \
    "ldm r12, {r5, r6, r10, r11}\n\t" \
    "mla r7, r7, r5, r6\n\t"          \
    "mla r9, r9, r10, r11\n\t"        \
    "lsr r9, r9, #10\n\t"             \
    "ubfx r8, r7, #11, #5\n\t"        \
    "lsrs r7, r7, #27\n\t"            \
    "orr r8, r8, r9, lsl #5\n\t"      \
    "orr r7, r8, r7, lsl #11\n\t"     \
    "ldrd r5, r6, [r0, #32]\n\t"      \
    "ldr r8, [r0, #48]\n\t"
#define TINY_TRIANGLES_SHADE_WIDE     \
    TINY_TRIANGLES_SHADE              \
    "orr r7, r7, r9, lsl #8\n\t"      \
    "ldrd r5, r6, [r0, #32]\n\t"      \
    "ldr r8, [r0, #48]\n\t"
#define TINY_TRIANGLES_FLAT \
    "ldrd r8, r7, [r0, #48]\n\t"
#define TINY_TRIANGLES_NARROW \
    "strh r7, [r3, r8]\n"
#define TINY_TRIANGLES_WIDE      \
    "add r8, r8, r3, lsl #1\n\t" \
    "str r7, [r8]\n"

/* A triangle's pixels, then on to 8. Pixels of a row that are covered lie side by side. */
#define TINY_TRIANGLES_PIXELS(PUT)    \
    "2: " TINY_TRIANGLES_TEST         \
    "bpl 3f\n\t" TINY_TRIANGLES_STEP  \
    "bne 2b\n\t"                      \
    "b 5f\n"                          \
    "3: " TINY_TRIANGLES_CODE         \
    "ldrh r7, [r3]\n\t"               \
    "cmp r7, r12\n\t"                 \
    "bhs 4f\n\t"                      \
    "strh r12, [r3]\n\t" PUT          \
    "4: " TINY_TRIANGLES_STEP         \
    "beq 5f\n\t" TINY_TRIANGLES_TEST  \
    "bpl 3b\n"                        \
    "5: ldm r0, {r1, r2, r4, r7, r8, r9, r10, r11}\n\t" \
    "add lr, lr, r7\n\t"              \
    "cmp lr, r11\n\t"                 \
    "beq 8f\n\t"                      \
    "add r1, r1, r10\n\t"             \
    "add r2, r2, r8\n\t"              \
    "sub r4, r4, r10\n\t"             \
    "sub r4, r4, r8\n\t"              \
    "stm r0, {r1, r2, r4}\n\t"        \
    "sub r3, lr, r9\n\t"              \
    "b 2b\n"

/* The next triangle. */
#define TINY_TRIANGLES_NEXT \
    "8: ldr r1, [r0, #44]\n\t" \
    "cmn r1, #1\n\t"           \
    "bne 1b\n\t"               \
    "b 9f\n"
#endif

#endif

/* SPDX-License-Identifier: MIT */
/* tiny_corners.h - makes the box of a tiny triangle ready (tiny_box.h): edge functions, weights, depths and colours of its corners. */
#ifndef SMEAR_KERNELS_TINY_CORNERS_H
#define SMEAR_KERNELS_TINY_CORNERS_H

#include "kernels/tiny_box.h"
#include "kernels/tiny_cover.h"

/* The pixels whose centres may be covered, from the first to that behind the last one, and the range of depth units. */
struct tiny_span {
    int32_t left, top, right, bottom, low, high;
};

/* Records begin with x and y, q8 px, less than 2^15 px from 0, and depth units from 0 on. */
static inline void tiny_span_reference(struct tiny_span *s, const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
    s->left = (min_i32(v0[0], min_i32(v1[0], v2[0])) + 127) >> 8;
    s->right = (max_i32(v0[0], max_i32(v1[0], v2[0])) + 127) >> 8;
    s->top = (min_i32(v0[1], min_i32(v1[1], v2[1])) + 127) >> 8;
    s->bottom = (max_i32(v0[1], max_i32(v1[1], v2[1])) + 127) >> 8;
    s->low = min_i32(v0[2], min_i32(v1[2], v2[2]));
    s->high = max_i32(v0[2], max_i32(v1[2], v2[2]));
}

#if TINY_ASM_ARMV6M
/* The least of A, B and C into A, the most into B; KEEP and FETCH put A into another register, and that into B. */
#define TINY_SPAN_ORDER(A, B, C, KEEP, FETCH) \
    "cmp " A ", " B "\n\t"      \
    "ble 1f\n\t" KEEP           \
    "movs " A ", " B "\n\t" FETCH \
    "1: cmp " C ", " A "\n\t"   \
    "bge 2f\n\t"                \
    "movs " A ", " C "\n\t"     \
    "b 3f\n"                    \
    "2: cmp " C ", " B "\n\t"   \
    "ble 3f\n\t"                \
    "movs " B ", " C "\n"       \
    "3: "

/* Places, q8 px, become the first pixels whose centres lie behind them. */
#define TINY_SPAN_PIXELS(A, B)  \
    "adds " A ", #127\n\t"      \
    "adds " B ", #127\n\t"      \
    "asrs " A ", " A ", #8\n\t" \
    "asrs " B ", " B ", #8\n\t"

/* Two thirds of the instructions that compilers take. */
SMEAR_INLINE void tiny_span_armv6m(struct tiny_span *s, const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
    register uint32_t r0 __asm__("r0") = (uint32_t)(uintptr_t)v0;
    register uint32_t r1 __asm__("r1") = (uint32_t)(uintptr_t)v1;
    register uint32_t r2 __asm__("r2") = (uint32_t)(uintptr_t)v2;
    register int32_t r3 __asm__("r3"), r4 __asm__("r4"), r5 __asm__("r5"), r6 __asm__("r6");
    __asm__ volatile(".syntax unified\n\t"
                     "ldr r3, [r0]\n\t"
                     "ldr r4, [r1]\n\t"
                     "ldr r5, [r2]\n\t" TINY_SPAN_ORDER("r3", "r4", "r5", "movs r6, r3\n\t", "movs r4, r6\n")
                         TINY_SPAN_PIXELS("r3", "r4")
                     "ldr r5, [r0, #4]\n\t"
                     "ldr r6, [r1, #4]\n\t"
                     "ldr r7, [r2, #4]\n\t" TINY_SPAN_ORDER("r5", "r6", "r7", "mov r8, r5\n\t", "mov r6, r8\n")
                         TINY_SPAN_PIXELS("r5", "r6")
                     "ldr r0, [r0, #8]\n\t"
                     "ldr r1, [r1, #8]\n\t"
                     "ldr r2, [r2, #8]\n\t" TINY_SPAN_ORDER("r0", "r1", "r2", "movs r7, r0\n\t", "movs r1, r7\n")
                     : "+r"(r0), "+r"(r1), "+r"(r2), "=r"(r3), "=r"(r4), "=r"(r5), "=r"(r6)
                     :
                     : "r7", "r8", "cc", "memory");
    *s = (struct tiny_span){ r3, r5, r4, r6, (int32_t)r0, (int32_t)r1 };
}
#endif

#if SMEAR_ASM_ARMV7EM
/* The first pixels of three corners as pairs of halves, of which the least and most are chosen by the flags of ssub16. */
#define TINY_SPAN_FIRST(OUT, X, Y) \
    "add " OUT ", " X ", #127\n\t" \
    "add r3, " Y ", #127\n\t"      \
    "asr " OUT ", " OUT ", #8\n\t" \
    "pkhbt " OUT ", " OUT ", r3, lsl #8\n\t"
#define TINY_SPAN_PIXELS \
    TINY_SPAN_FIRST("r0", "r4", "r5") TINY_SPAN_FIRST("r1", "r7", "r8") TINY_SPAN_FIRST("r2", "r10", "r11") \
    "ssub16 r3, r0, r1\n\t" \
    "sel r4, r1, r0\n\t"    \
    "sel r5, r0, r1\n\t"    \
    "ssub16 r3, r4, r2\n\t" \
    "sel r0, r2, r4\n\t"    \
    "ssub16 r3, r2, r5\n\t" \
    "sel r1, r2, r5\n\t"

/* The least of two numbers from 0 on is one of them and what the other one less it has below 0. */
#define TINY_SPAN_UNITS \
    "subs r3, r6, r9\n\t"           \
    "and r3, r3, r3, asr #31\n\t"   \
    "adds r4, r3, r9\n\t"           \
    "subs r5, r6, r3\n\t"           \
    "sub r3, r4, r12\n\t"           \
    "and r3, r3, r3, asr #31\n\t"   \
    "add r2, r3, r12\n\t"           \
    "sub r3, r12, r5\n\t"           \
    "and r3, r3, r3, asr #31\n\t"   \
    "sub r3, r12, r3"

/* Half of the instructions that compilers take. */
SMEAR_INLINE void tiny_span_armv7em(struct tiny_span *s, const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
    register uint32_t r0 __asm__("r0") = (uint32_t)(uintptr_t)v0;
    register uint32_t r1 __asm__("r1") = (uint32_t)(uintptr_t)v1;
    register int32_t r2 __asm__("r2") = (int32_t)(uintptr_t)v2;
    register int32_t r3 __asm__("r3");
    __asm__ volatile(".syntax unified\n\t"
                     "ldm r0, {r4, r5, r6}\n\t"
                     "ldm r1, {r7, r8, r9}\n\t"
                     "ldm r2, {r10, r11, r12}\n\t" TINY_SPAN_PIXELS TINY_SPAN_UNITS
                     : "+r"(r0), "+r"(r1), "+r"(r2), "=r"(r3)
                     :
                     : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "cc", "memory");
    *s = (struct tiny_span){ (int16_t)r0, (int16_t)(r0 >> 16), (int16_t)r1, (int16_t)(r1 >> 16), r2, r3 };
}
#endif

SMEAR_INLINE void tiny_span(struct tiny_span *s, const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
#if TINY_ASM_ARMV6M
    tiny_span_armv6m(s, v0, v1, v2);
#elif SMEAR_ASM_ARMV7EM
    tiny_span_armv7em(s, v0, v1, v2);
#else
    tiny_span_reference(s, v0, v1, v2);
#endif
}

/* 0 for edges that go up (left ones) or right (top ones), whose centres count, else -1. */
static inline int32_t tiny_corner_bias(int32_t dx, int32_t dy) { return (dx - dy * 65536 - 1) >> 31; }

/* Records begin with x and y, q8 px, and depth units; clockwise, less than 16 px apart. (x, y) is the box's first pixel, at most as far
 * from them. */
static inline void tiny_corners_reference(struct tiny_box *b, const int32_t *v0, const int32_t *v1, const int32_t *v2, int32_t x,
                                          int32_t y)
{
    const int32_t x1 = v1[0] - v0[0], y1 = v1[1] - v0[1], x2 = v2[0] - v0[0], y2 = v2[1] - v0[1], area = x1 * y2 - x2 * y1;
    const int32_t cx = x * 256 + 128 - v0[0], cy = y * 256 + 128 - v0[1];
    const int32_t bias1 = tiny_corner_bias(-x2, -y2), bias2 = tiny_corner_bias(x1, y1);
    const struct tiny_scale scale = tiny_scale_make(area);
    b->up = scale.up;
    b->recip = scale.recip;
    b->e1 = y2 * cx - x2 * cy + bias1;
    b->e2 = x1 * cy - y1 * cx + bias2;
    b->sum = area + tiny_corner_bias(x2 - x1, y2 - y1) + bias1 + bias2;
    b->right1 = y2 * 256;
    b->right2 = -y1 * 256;
    b->down1 = -x2 * 256;
    b->down2 = x1 * 256;
    tiny_units(b, v1[2] - v0[2], v2[2] - v0[2]);
}

static inline void tiny_channel_make(struct tiny_channel *c, uint32_t c0, uint32_t c1, uint32_t c2, uint32_t round)
{
    c->to1 = (int32_t)(c1 & 0xffffu) - (int32_t)(c0 & 0xffffu);
    c->to2 = (int32_t)(c2 & 0xffffu) - (int32_t)(c0 & 0xffffu);
    c->base = ((c0 & 0xffffu) << 14) + round;
}

/* Two words of each corner: red and green, blue. What rounds is 2^21 for codes, 0 for linear light. */
static inline void tiny_colors_reference(struct tiny_box *b, const uint32_t *c0, const uint32_t *c1, const uint32_t *c2, uint32_t round)
{
    for (int i = 0; i < 3; i++) {
        const int word = i & 1, shift = i << 3 & 16;        /* red, blue, green */
        tiny_channel_make(&b->channel[i], c0[word] >> shift, c1[word] >> shift, c2[word] >> shift, round);
    }
}

#if TINY_ASM_ARMV6M
/* One of the channels, AT bytes into the words, whose corners r1, r2 and r3 point to. */
#define TINY_CORNERS_CHANNEL(AT) \
    "ldrh r6, [r1, #" AT "]\n\t" \
    "ldrh r4, [r2, #" AT "]\n\t" \
    "ldrh r5, [r3, #" AT "]\n\t" \
    "subs r4, r4, r6\n\t"        \
    "subs r5, r5, r6\n\t"        \
    "lsls r6, r6, #14\n\t"       \
    "adds r6, r6, r7\n\t"        \
    "stm r0!, {r4, r5, r6}\n\t"

static inline void tiny_colors_armv6m(struct tiny_box *b, const uint32_t *c0, const uint32_t *c1, const uint32_t *c2, uint32_t round)
{
    register struct tiny_channel *r0 __asm__("r0") = b->channel;
    register const uint32_t *r1 __asm__("r1") = c0;
    register const uint32_t *r2 __asm__("r2") = c1;
    register const uint32_t *r3 __asm__("r3") = c2;
    register uint32_t r7 __asm__("r7") = round;
    __asm__ volatile(".syntax unified\n\t" TINY_CORNERS_CHANNEL("0") TINY_CORNERS_CHANNEL("4") TINY_CORNERS_CHANNEL("2")
                     : "+r"(r0)
                     : "r"(r1), "r"(r2), "r"(r3), "r"(r7)
                     : "r4", "r5", "r6", "cc", "memory");
}

/* Makes the number in r1 larger by 2^BITS where it has that many leading zeros, which r2 counts; FEWER is 32 - BITS. */
#define TINY_CORNERS_ZEROS(BITS, FEWER, LABEL) \
    "lsrs r3, r1, #" FEWER "\n\t"              \
    "bne " LABEL "f\n\t"                       \
    "adds r2, #" BITS "\n\t"                   \
    "lsls r1, r1, #" BITS "\n" LABEL ": "

/* Vectors into r8 to r11, v[0] into r12 and lr. */
#define TINY_CORNERS_VECTORS \
    "ldm r1!, {r4, r5}\n\t" \
    "ldm r2!, {r6, r7}\n\t" \
    "subs r6, r6, r4\n\t" \
    "subs r7, r7, r5\n\t" \
    "mov r8, r6\n\t" \
    "mov r9, r7\n\t" \
    "ldm r3!, {r6, r7}\n\t" \
    "subs r6, r6, r4\n\t" \
    "subs r7, r7, r5\n\t" \
    "mov r10, r6\n\t" \
    "mov r11, r7\n\t" \
    "mov r12, r4\n\t" \
    "mov lr, r5\n\t"

/* What units change by. */
#define TINY_CORNERS_UNITS \
    "ldr r4, [r1]\n\t" \
    "ldr r5, [r2]\n\t" \
    "ldr r6, [r3]\n\t" \
    "subs r5, r5, r4\n\t" \
    "subs r6, r6, r4\n\t" \
    "uxth r4, r5\n\t" \
    "asrs r5, r5, #16\n\t" \
    "asrs r7, r6, #16\n\t" \
    "uxth r6, r6\n\t" \
    "adds r0, #48\n\t" \
    "stm r0!, {r4, r5, r6, r7}\n\t" \
    "subs r0, #64\n\t"

/* Edge functions at the first pixel into r3 and r2; y2, x2, x1 and y1 into r4 to r7. */
#define TINY_CORNERS_PLACES \
    "ldr r1, [r0]\n\t" \
    "lsls r1, r1, #8\n\t" \
    "adds r1, #128\n\t" \
    "mov r3, r12\n\t" \
    "subs r1, r1, r3\n\t" \
    "ldr r2, [r0, #4]\n\t" \
    "lsls r2, r2, #8\n\t" \
    "adds r2, #128\n\t" \
    "mov r3, lr\n\t" \
    "subs r2, r2, r3\n\t" \
    "mov r4, r11\n\t" \
    "movs r3, r4\n\t" \
    "muls r3, r1\n\t" \
    "mov r5, r10\n\t" \
    "movs r6, r5\n\t" \
    "muls r6, r2\n\t" \
    "subs r3, r3, r6\n\t" \
    "mov r6, r8\n\t" \
    "muls r2, r6\n\t" \
    "mov r7, r9\n\t" \
    "muls r1, r7\n\t" \
    "subs r2, r2, r1\n\t"

/* With their biases, whose sum goes into r12. */
#define TINY_CORNERS_BIASES \
    "lsls r1, r4, #16\n\t" \
    "subs r1, r1, r5\n\t" \
    "subs r1, #1\n\t" \
    "asrs r1, r1, #31\n\t" \
    "adds r3, r3, r1\n\t" \
    "mov r12, r1\n\t" \
    "lsls r1, r7, #16\n\t" \
    "subs r1, r6, r1\n\t" \
    "subs r1, #1\n\t" \
    "asrs r1, r1, #31\n\t" \
    "adds r2, r2, r1\n\t" \
    "add r12, r1\n\t" \
    "str r3, [r0]\n\t" \
    "str r2, [r0, #4]\n\t"

/* Their steps. */
#define TINY_CORNERS_STEPS \
    "lsls r1, r5, #8\n\t" \
    "negs r1, r1\n\t" \
    "str r1, [r0, #8]\n\t" \
    "lsls r1, r6, #8\n\t" \
    "str r1, [r0, #12]\n\t" \
    "lsls r1, r4, #8\n\t" \
    "str r1, [r0, #108]\n\t" \
    "lsls r1, r7, #8\n\t" \
    "negs r1, r1\n\t" \
    "str r1, [r0, #112]\n\t"

/* The area into r1, and the sum of all three functions. */
#define TINY_CORNERS_AREA \
    "movs r1, r6\n\t" \
    "muls r1, r4\n\t" \
    "movs r2, r5\n\t" \
    "muls r2, r7\n\t" \
    "subs r1, r1, r2\n\t" \
    "subs r5, r5, r6\n\t" \
    "subs r4, r4, r7\n\t" \
    "lsls r4, r4, #16\n\t" \
    "subs r5, r5, r4\n\t" \
    "subs r5, #1\n\t" \
    "asrs r5, r5, #31\n\t" \
    "add r5, r12\n\t" \
    "adds r5, r5, r1\n\t" \
    "str r5, [r0, #116]\n\t"

/* tiny_scale_make. */
#define TINY_CORNERS_RECIP \
    "movs r2, #0\n\t" TINY_CORNERS_ZEROS("16", "16", "1") TINY_CORNERS_ZEROS("8", "24", "2") \
    TINY_CORNERS_ZEROS("4", "28", "3") TINY_CORNERS_ZEROS("2", "30", "4") TINY_CORNERS_ZEROS("1", "31", "5") \
    "str r2, [r0, #32]\n\t" \
    "lsls r2, r1, #1\n\t" \
    "lsrs r2, r2, #23\n\t" \
    "lsls r2, r2, #1\n\t" \
    "ldr r3, [r0, #64]\n\t" \
    "ldrh r2, [r3, r2]\n\t" \
    "lsrs r1, r1, #11\n\t" \
    "muls r1, r2\n\t" \
    "movs r3, #128\n\t" \
    "lsls r3, r3, #24\n\t" \
    "subs r3, r3, r1\n\t" \
    "asrs r3, r3, #4\n\t" \
    "muls r3, r2\n\t" \
    "asrs r3, r3, #8\n\t" \
    "lsls r2, r2, #19\n\t" \
    "adds r3, r3, r2\n\t" \
    "lsrs r3, r3, #14\n\t" \
    "subs r3, #1\n\t" \
    "str r3, [r0, #36]"

/* Less than two thirds of the instructions that compilers take. */
static inline void tiny_corners_armv6m(struct tiny_box *b, const int32_t *v0, const int32_t *v1, const int32_t *v2, int32_t x,
                                       int32_t y)
{
    register struct tiny_box *r0 __asm__("r0") = b;
    register const int32_t *r1 __asm__("r1") = v0;
    register const int32_t *r2 __asm__("r2") = v1;
    register const int32_t *r3 __asm__("r3") = v2;
    b->e1 = x;
    b->e2 = y;
    b->to_pixel = (uint32_t)(uintptr_t)smear_recip_seed;
    __asm__ volatile(".syntax unified\n\t" TINY_CORNERS_VECTORS TINY_CORNERS_UNITS TINY_CORNERS_PLACES TINY_CORNERS_BIASES
                         TINY_CORNERS_STEPS TINY_CORNERS_AREA TINY_CORNERS_RECIP
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)
                     :
                     : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

#if SMEAR_ASM_ARMV7EM
/* Vectors: x1, y1, -x2 and y2 into r7, r8, r10 and r11, and what units change by. */
#define TINY_CORNERS_VECTORS \
    "ldm r1, {r4, r5, r6}\n\t" \
    "ldm r2, {r7, r8, r9}\n\t" \
    "ldm r3, {r10, r11, r12}\n\t" \
    "sub r9, r9, r6\n\t" \
    "sub r12, r12, r6\n\t" \
    "lsl r9, r9, #1\n\t" \
    "lsl r12, r12, #1\n\t" \
    "strd r9, r12, [r0, #48]\n\t" \
    "ldrd r1, r2, [r0]\n\t" \
    "subs r7, r7, r4\n\t" \
    "sub r8, r8, r5\n\t" \
    "sub r10, r4, r10\n\t" \
    "sub r11, r11, r5\n\t" \
    "rsb r1, r4, r1, lsl #8\n\t" \
    "adds r1, r1, #128\n\t" \
    "rsb r2, r5, r2, lsl #8\n\t" \
    "adds r2, r2, #128\n\t"

/* Edge functions at the first pixel into r3 and r2, the area into r1, the sum of all into r4. */
#define TINY_CORNERS_PLACES \
    "mul r3, r11, r1\n\t" \
    "mla r3, r10, r2, r3\n\t" \
    "mul r2, r7, r2\n\t" \
    "mls r2, r8, r1, r2\n\t" \
    "mul r1, r7, r11\n\t" \
    "mla r1, r10, r8, r1\n\t" \
    "add r4, r10, r11, lsl #16\n\t" \
    "subs r4, r4, #1\n\t" \
    "asrs r4, r4, #31\n\t" \
    "adds r3, r3, r4\n\t" \
    "mvn r5, r8, lsl #16\n\t" \
    "adds r5, r5, r7\n\t" \
    "asrs r5, r5, #31\n\t" \
    "adds r2, r2, r5\n\t" \
    "adds r4, r4, r5\n\t" \
    "adds r4, r4, r1\n\t" \
    "sub r5, r8, r11\n\t" \
    "add r6, r7, r10\n\t" \
    "mvns r6, r6\n\t" \
    "add r6, r6, r5, lsl #16\n\t" \
    "add r4, r4, r6, asr #31\n\t"

/* They are stored, with their steps. */
#define TINY_CORNERS_STEPS \
    "strd r3, r2, [r0]\n\t" \
    "lsl r10, r10, #8\n\t" \
    "lsl r7, r7, #8\n\t" \
    "strd r10, r7, [r0, #8]\n\t" \
    "lsl r11, r11, #8\n\t" \
    "rsb r8, r8, #0\n\t" \
    "lsl r8, r8, #8\n\t" \
    "strd r11, r8, [r0, #100]\n\t" \
    "str r4, [r0, #108]\n\t"

/* tiny_scale_make. */
#define TINY_CORNERS_RECIP \
    "clz r4, r1\n\t" \
    "lsls r1, r4\n\t" \
    "ldr r3, [r0, #56]\n\t" \
    "ubfx r2, r1, #22, #9\n\t" \
    "ldrh r5, [r3, r2, lsl #1]\n\t" \
    "lsrs r1, r1, #11\n\t" \
    "mov r3, #0x80000000\n\t" \
    "mls r1, r1, r5, r3\n\t" \
    "asrs r1, r1, #4\n\t" \
    "mul r1, r1, r5\n\t" \
    "lsls r5, r5, #19\n\t" \
    "add r5, r5, r1, asr #8\n\t" \
    "lsrs r5, r5, #14\n\t" \
    "subs r5, r5, #1\n\t" \
    "strd r4, r5, [r0, #32]"

/* Two thirds of the instructions that compilers take. */
static inline void tiny_corners_armv7em(struct tiny_box *b, const int32_t *v0, const int32_t *v1, const int32_t *v2, int32_t x,
                                        int32_t y)
{
    register struct tiny_box *r0 __asm__("r0") = b;
    register const int32_t *r1 __asm__("r1") = v0;
    register const int32_t *r2 __asm__("r2") = v1;
    register const int32_t *r3 __asm__("r3") = v2;
    b->e1 = x;
    b->e2 = y;
    b->to_pixel = (uint32_t)(uintptr_t)smear_recip_seed;
    __asm__ volatile(".syntax unified\n\t" TINY_CORNERS_VECTORS TINY_CORNERS_PLACES TINY_CORNERS_STEPS TINY_CORNERS_RECIP
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3)
                     :
                     : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r11", "r12", "cc", "memory");
}
#endif

static inline void tiny_corners(struct tiny_box *b, const int32_t *v0, const int32_t *v1, const int32_t *v2, int32_t x, int32_t y)
{
#if TINY_ASM_ARMV6M
    tiny_corners_armv6m(b, v0, v1, v2, x, y);
#elif SMEAR_ASM_ARMV7EM
    tiny_corners_armv7em(b, v0, v1, v2, x, y);
#else
    tiny_corners_reference(b, v0, v1, v2, x, y);
#endif
}

static inline void tiny_colors(struct tiny_box *b, const uint32_t *c0, const uint32_t *c1, const uint32_t *c2, uint32_t round)
{
#if TINY_ASM_ARMV6M
    tiny_colors_armv6m(b, c0, c1, c2, round);
#else
    tiny_colors_reference(b, c0, c1, c2, round);
#endif
}

#endif

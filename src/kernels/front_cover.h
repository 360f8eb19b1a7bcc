/* SPDX-License-Identifier: MIT */
/* front_cover.h - the box of a triangle that faces the viewer and lies within the frame, and which of its pixels are covered where
 * there are few. */
#ifndef SMEAR_KERNELS_FRONT_COVER_H
#define SMEAR_KERNELS_FRONT_COVER_H

#include "kernels/places.h"
#include "kernels/tiny_cover.h"

/* Boxes are looked at so where that pays. */
#define FRONT_COVERS TINY_COVER_ARMV7EM

#if FRONT_COVERS
struct front_cover {
    struct tiny_cover tiny;         /* known where boxes are tiny */
    uint32_t low, high;             /* the box: its first pixel and that behind its last one; y in the upper half */
};

/* More than a tiny box has. */
enum { FRONT_LARGE = TINY_BOX * TINY_BOX + 1 };

static inline void front_span(int32_t *first, int32_t *end, int32_t a, int32_t b, int32_t c)
{
    *first = (min_i32(a, min_i32(b, c)) + 127) >> 8;
    *end = (max_i32(a, max_i32(b, c)) + 127) >> 8;
}

/* Corners are x and y, q8 px, clockwise, from 0 to 2^15 - 1 px. Returns how many pixels are covered; FRONT_LARGE where the box has
 * more than TINY_BOX a side. */
static inline int32_t front_cover_reference(struct front_cover *f, const int32_t *v0, const int32_t *v1, const int32_t *v2)
{
    int32_t box[4];
    front_span(&box[0], &box[2], v0[0], v1[0], v2[0]);
    front_span(&box[1], &box[3], v0[1], v1[1], v2[1]);
    f->low = (uint32_t)box[0] | (uint32_t)box[1] << 16;
    f->high = (uint32_t)box[2] | (uint32_t)box[3] << 16;
    if (box[0] == box[2] || box[1] == box[3])
        return 0;
    if (box[2] - box[0] > TINY_BOX || box[3] - box[1] > TINY_BOX)
        return FRONT_LARGE;
    tiny_cover_reference(&f->tiny, box, v0, v1, v2);
    return f->tiny.count;
}

SMEAR_STATIC_ASSERT(offsetof(struct front_cover, low) == 72 && offsetof(struct tiny_cover, count) == 4
                        && offsetof(struct tiny_cover, covered) == 8 && sizeof(struct covered) == 16,
                    "the assembly knows struct front_cover");

#if TINY_COVER_ARMV7EM
/* The first pixel whose centre lies at or beyond (X, Y) as a pair into OUT. */
#define FRONT_COVER_FIRST(OUT, TEMP, X, Y) \
    "add " OUT ", " X ", #127\n\t"         \
    "add " TEMP ", " Y ", #127\n\t"        \
    "asr " OUT ", " OUT ", #8\n\t"         \
    "pkhbt " OUT ", " OUT ", " TEMP ", lsl #8\n\t"

/* The box of corners in r4 to r9 into r11 and r12, and stored; one less than its size into r10. At 8 it is empty, at 9 large. */
#define FRONT_COVER_BOX            \
    FRONT_COVER_FIRST("r1", "r2", "r4", "r5") FRONT_COVER_FIRST("r2", "r3", "r6", "r7") \
    FRONT_COVER_FIRST("r3", "r10", "r8", "r9") \
    "ssub16 r10, r1, r2\n\t"       \
    "sel r11, r2, r1\n\t"          \
    "sel r12, r1, r2\n\t"          \
    "ssub16 r10, r11, r3\n\t"      \
    "sel r11, r3, r11\n\t"         \
    "ssub16 r10, r3, r12\n\t"      \
    "sel r12, r3, r12\n\t"         \
    "strd r11, r12, [r0, #72]\n\t" \
    "sub r10, r12, r11\n\t"        \
    "sub r10, r10, #0x10001\n\t"   \
    "tst r10, #0x80008000\n\t"     \
    "bne 8f\n\t"                   \
    "bics r1, r10, #0x10001\n\t"   \
    "bne 9f\n\t"

/* Edge functions at the first pixel, r2 and r3, into r12, r4 and r5; the edges x1 and y1 in r6 and r7, -x2 and y2 in r8 and r9, x1 - x2
 * in r1, y1 - y2 in lr. Products cross in pairs of halves. */
#define FRONT_COVER_EDGES \
    "sub r6, r6, r4\n\t" \
    "sub r7, r7, r5\n\t" \
    "sub r8, r4, r8\n\t" \
    "sub r9, r9, r5\n\t" \
    "pkhbt r1, r6, r7, lsl #16\n\t" \
    "pkhbt r2, r8, r9, lsl #16\n\t" \
    "pkhbt r3, r4, r5, lsl #16\n\t" \
    "lsl r12, r11, #8\n\t" \
    "bic r12, r12, #0x00ff0000\n\t" \
    "orr r12, r12, #0x00800080\n\t" \
    "ssub16 r3, r12, r3\n\t" \
    "smuadx r12, r1, r2\n\t" \
    "str r12, [r0], #8\n\t" \
    "smuadx r4, r3, r2\n\t" \
    "smusdx r5, r1, r3\n\t" \
    "sub r12, r12, r4\n\t" \
    "sub r12, r12, r5\n\t" \
    "add r1, r6, r8\n\t" \
    "sub lr, r7, r9\n\t"

/* What decides centres on edges: less than 0 as the shifted numbers are. */
#define FRONT_COVER_BIASES \
    "mvn r2, r1\n\t" \
    "add r2, r2, lr, lsl #16\n\t" \
    "add r12, r12, r2, asr #31\n\t" \
    "add r2, r8, r9, lsl #16\n\t" \
    "subs r2, r2, #1\n\t" \
    "add r4, r4, r2, asr #31\n\t" \
    "mvn r2, r7, lsl #16\n\t" \
    "add r2, r2, r6\n\t" \
    "add r5, r5, r2, asr #31\n\t" \
    "uxth r2, r11\n\t" \
    "lsrs r3, r11, #16\n\t"

/* Keeps the pixel if no edge function is negative. */
#define FRONT_COVER_TEST(LABEL) \
    "orr r11, r4, r5\n\t"       \
    "orrs r11, r11, r12\n\t"    \
    "bmi " LABEL "f\n\t"        \
    "stm r0!, {r2, r3, r4, r5}\n" LABEL ": "

#define FRONT_COVER_RIGHT           \
    "add r12, r12, lr, lsl #8\n\t"  \
    "add r4, r4, r9, lsl #8\n\t"    \
    "sub r5, r5, r7, lsl #8\n\t"    \
    "adds r2, r2, #1\n\t"

#define FRONT_COVER_PIXELS FRONT_COVER_TEST("1") \
    "tst r10, #1\n\t" \
    "beq 3f\n\t" \
    "push {r4, r5, r12}\n\t" FRONT_COVER_RIGHT FRONT_COVER_TEST("2") \
    "subs r2, r2, #1\n\t" \
    "pop {r4, r5, r12}\n" \
    "3: tst r10, #0x10000\n\t" \
    "beq 7f\n\t" \
    "sub r12, r12, r1, lsl #8\n\t" \
    "add r4, r4, r8, lsl #8\n\t" \
    "add r5, r5, r6, lsl #8\n\t" \
    "adds r3, r3, #1\n\t" FRONT_COVER_TEST("4") \
    "tst r10, #1\n\t" \
    "beq 7f\n\t" FRONT_COVER_RIGHT FRONT_COVER_TEST("5")

/* What r0 points to becomes known of corners in r4 to r9; how many pixels are covered into r0. All registers are used. Half of the
 * instructions that compilers take. */
#define FRONT_COVER_ARMV7EM \
    FRONT_COVER_BOX FRONT_COVER_EDGES \
    "push {r0}\n\t" FRONT_COVER_BIASES FRONT_COVER_PIXELS \
    "7: pop {r1}\n\t" \
    "subs r0, r0, r1\n\t" \
    "lsrs r0, r0, #4\n\t" \
    "str r0, [r1, #-4]\n\t" \
    "b 6f\n" \
    "8: movs r0, #0\n\t" \
    "b 6f\n" \
    "9: movs r0, #5\n" \
    "6: "
#endif
#endif

#endif

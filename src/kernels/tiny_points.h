/* SPDX-License-Identifier: MIT */
/* tiny_points.h - pixels that a tiny triangle covers become points of lists (points_list.h). */
#ifndef SMEAR_KERNELS_TINY_POINTS_H
#define SMEAR_KERNELS_TINY_POINTS_H

#include "kernels/points_list.h"
#include "kernels/tiny_cover.h"
#include "kernels/tiny_weights.h"

/* Where entries lie, and the rings they are linked into: pixel row y is in ring y row_recip >> 22. */
struct points_rings {
    void *top;                      /* entry 0; entry i lies i entries before it */
    uint32_t *last;                 /* the last entry of each ring, or UINT32_MAX; the next after it is the ring's first */
    uint32_t row_recip;
    uint32_t *count;                /* entries in use */
    const uint16_t *seed;           /* for assembly: smear_recip_seed */
};

static inline struct point_entry *points_entry(const struct points_rings *r, uint32_t i)
{
    return (struct point_entry *)r->top - i;
}

/* Takes the next entry for a triangle or a point whose first pixel is in row y; `next` becomes known. */
static inline void points_link(const struct points_rings *r, int32_t y, struct point_entry entry)
{
    const uint32_t i = (*r->count)++;
    uint32_t *const ring = &r->last[(uint32_t)y * r->row_recip >> 22];
    entry.next = i;
    if (*ring != UINT32_MAX) {
        struct point_entry *const before = points_entry(r, *ring);
        entry.next = before->next;
        before->next = i;
    }
    *points_entry(r, i) = entry;
    *ring = i;
}

/* Adds the pixels that `t` kept, of which there is one at least, as points of one colour. Depths of its corners are units of at most
 * 2^27. Edge functions become weights of corners 1 and 2, as tiny_weight has them. */
static inline void tiny_points_reference(const struct points_rings *r, struct tiny_cover *t, const int32_t *depth0,
                                         const int32_t *depth1, const int32_t *depth2, uint32_t color)
{
    const struct tiny_scale scale = tiny_scale_make(t->area);
    for (int32_t k = 0; k < t->count; k++) {
        struct covered *const c = &t->covered[k];
        const uint32_t w1 = tiny_weight(scale, c->e1), w2 = tiny_weight(scale, c->e2);
        points_link(r, c->y, (struct point_entry){ (uint16_t)c->x, (uint16_t)c->y,
                                                   (uint16_t)tiny_depth(*depth0, *depth1, *depth2, w1, w2), POINT_ENTRY, 0, color });
        c->e1 = (int32_t)w1;
        c->e2 = (int32_t)w2;
    }
}

#if TINY_COVER_ARMV6M
SMEAR_STATIC_ASSERT(offsetof(struct points_rings, last) == 4 && offsetof(struct points_rings, row_recip) == 8
                        && offsetof(struct points_rings, count) == 12 && offsetof(struct points_rings, seed) == 16,
                    "the assembly knows struct points_rings");

/* Makes the number in r1 larger by 2^BITS where it has that many leading zeros, which r2 counts; FEWER is 32 - BITS. */
#define TINY_POINTS_ZEROS(BITS, FEWER, LABEL) \
    "lsrs r3, r1, #" FEWER "\n\t"             \
    "bne " LABEL "f\n\t"                      \
    "adds r2, #" BITS "\n\t"                  \
    "lsls r1, r1, #" BITS "\n" LABEL ": "

/* tiny_scale_make of the area in r1: r2 and r3. */
#define TINY_POINTS_SCALE \
    "movs r2, #0\n\t" TINY_POINTS_ZEROS("16", "16", "1") TINY_POINTS_ZEROS("8", "24", "2") TINY_POINTS_ZEROS("4", "28", "3") \
    TINY_POINTS_ZEROS("2", "30", "4") TINY_POINTS_ZEROS("1", "31", "5") \
    "mov r3, r8\n\t"        \
    "ldr r3, [r3, #16]\n\t" \
    "lsls r5, r1, #1\n\t"   \
    "lsrs r5, r5, #23\n\t"  \
    "lsls r5, r5, #1\n\t"   \
    "ldrh r5, [r3, r5]\n\t" \
    "lsrs r1, r1, #11\n\t"  \
    "muls r1, r5\n\t"       \
    "movs r3, #128\n\t"     \
    "lsls r3, r3, #24\n\t"  \
    "subs r3, r3, r1\n\t"   \
    "asrs r3, r3, #4\n\t"   \
    "muls r3, r5\n\t"       \
    "asrs r3, r3, #8\n\t"   \
    "lsls r5, r5, #19\n\t"  \
    "adds r3, r3, r5\n\t"   \
    "lsrs r3, r3, #14\n\t"  \
    "subs r3, #1\n\t"

/* The edge function in E becomes a weight. */
#define TINY_POINTS_WEIGHT(E)      \
    "lsls " E ", r2\n\t"           \
    "lsrs " E ", " E ", #16\n\t"   \
    "muls " E ", r3\n\t"           \
    "lsrs " E ", " E ", #15\n\t"

/* The weight in W times what lies at LOW and HIGH of the stack. */
#define TINY_POINTS_TIMES(W, LOW, HIGH) \
    "ldr r7, [sp, #" LOW "]\n\t"        \
    "muls r7, " W "\n\t"                \
    "lsrs r7, r7, #16\n\t"              \
    "ldr r1, [sp, #" HIGH "]\n\t"       \
    "muls " W ", r1\n\t"                \
    "adds " W ", " W ", r7\n\t"

/* What all pixels share, by depth units of corners in r2, r3 and r4. */
#define TINY_POINTS_START \
    "mov r8, r0\n\t" \
    "mov r9, r5\n\t" \
    "mov r10, r2\n\t" \
    "subs r3, r3, r2\n\t" \
    "subs r5, r4, r2\n\t" \
    "uxth r2, r3\n\t" \
    "asrs r3, r3, #16\n\t" \
    "uxth r4, r5\n\t" \
    "asrs r5, r5, #16\n\t" \
    "push {r2, r3, r4, r5}\n\t" \
    "ldr r6, 8f\n\t" \
    "mov lr, r6\n\t" \
    "movs r4, r1\n\t" \
    "ldm r4!, {r1, r6}\n\t" \
    "lsls r6, r6, #4\n\t" \
    "adds r6, r6, r4\n\t" \
    "mov r11, r6\n\t" TINY_POINTS_SCALE

/* The next pixel: its place into r0, its depth and kind into r5, its ring into r12. KEEP is what keeps weights. */
#define TINY_POINTS_PIXEL(KEEP) \
    "1: ldm r4!, {r0, r1, r5, r6}\n\t" \
    "mov r7, r8\n\t" \
    "ldr r7, [r7, #8]\n\t" \
    "muls r7, r1\n\t" \
    "lsrs r7, r7, #22\n\t" \
    "lsls r7, r7, #2\n\t" \
    "mov r12, r7\n\t" \
    "lsls r1, r1, #16\n\t" \
    "orrs r0, r1\n\t" TINY_POINTS_WEIGHT("r5") TINY_POINTS_WEIGHT("r6") KEEP TINY_POINTS_TIMES("r5", "0", "4") \
    "add r5, r10\n\t" TINY_POINTS_TIMES("r6", "8", "12") \
    "adds r5, r5, r6\n\t" \
    "lsrs r1, r5, #26\n\t" \
    "beq 2f\n\t" \
    "add r5, lr\n\t" \
    "asrs r5, r5, #15\n" \
    "3: "
#define TINY_POINTS_KEEP \
    "subs r4, #8\n\t" \
    "stm r4!, {r5, r6}\n\t"

/* Links an entry of the words r0, r5 and r9 into the ring in r12, of the rings in r8; r1, r2, r3, r6 and r7 are lost. */
#define TINY_POINTS_LINK \
    "mov r1, r8\n\t" \
    "ldm r1, {r1, r2, r3, r6}\n\t" \
    "ldr r7, [r6]\n\t" \
    "adds r3, r7, #1\n\t" \
    "str r3, [r6]\n\t" \
    "add r2, r12\n\t" \
    "ldr r3, [r2]\n\t" \
    "str r7, [r2]\n\t" \
    "movs r6, r7\n\t" \
    "adds r2, r3, #1\n\t" \
    "beq 4f\n\t" \
    "lsls r3, r3, #4\n\t" \
    "subs r3, r1, r3\n\t" \
    "ldr r6, [r3, #8]\n\t" \
    "str r7, [r3, #8]\n" \
    "4: lsls r7, r7, #4\n\t" \
    "subs r1, r1, r7\n\t" \
    "mov r7, r9\n\t" \
    "stm r1!, {r0, r5, r6, r7}\n\t"

/* Far depths, and what makes codes of near ones: with what rounds those, and bit 31, of which the shift makes the kind. */
#define TINY_POINTS_FAR \
    "2: movs r1, #31\n\t" \
    "lsls r1, r1, #27\n\t" \
    "adds r5, r5, r1\n\t" \
    "movs r1, #1\n\t" \
    "lsls r1, r1, #10\n\t" \
    "adds r5, r5, r1\n\t" \
    "asrs r5, r5, #11\n\t" \
    "b 3b\n\t" \
    ".balign 4\n" \
    "8: .word 0xbc004000\n"

/* The rings in r0, pixels in r1, depth units in r2, r3 and r4, the colour in r5. Then the rings in r8, the colour in r9, depth units of
 * corner 0 in r10, the end of pixels in r11; r2 and r3 scale weights, r4 is the next pixel, how the others' depth differs lies on the
 * stack. Less than half of the instructions that compilers take. */
#define TINY_POINTS_ARMV6M(KEEP) TINY_POINTS_START TINY_POINTS_PIXEL(KEEP) \
    "push {r2, r3}\n\t" TINY_POINTS_LINK \
    "pop {r2, r3}\n\t" \
    "cmp r4, r11\n\t" \
    "bne 1b\n\t" \
    "add sp, #16\n\t" \
    "b 5f\n" TINY_POINTS_FAR \
    "5: "

SMEAR_INLINE void tiny_points_armv6m(const struct points_rings *r, struct tiny_cover *t, const int32_t *depth0,
                                     const int32_t *depth1, const int32_t *depth2, uint32_t color)
{
    register const struct points_rings *r0 __asm__("r0") = r;
    register struct tiny_cover *r1 __asm__("r1") = t;
    register int32_t r2 __asm__("r2") = *depth0;
    register int32_t r3 __asm__("r3") = *depth1;
    register int32_t r4 __asm__("r4") = *depth2;
    register uint32_t r5 __asm__("r5") = color;
    __asm__ volatile(".syntax unified\n\t" TINY_POINTS_ARMV6M(TINY_POINTS_KEEP)
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3), "+r"(r4), "+r"(r5)
                     :
                     : "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

#if TINY_COVER_ARMV7EM
SMEAR_STATIC_ASSERT(offsetof(struct points_rings, last) == 4 && offsetof(struct points_rings, row_recip) == 8
                        && offsetof(struct points_rings, count) == 12 && offsetof(struct points_rings, seed) == 16,
                    "the assembly knows struct points_rings");

/* What all pixels share, by depth units of corners in r2, r3 and r4: how the others differ from corner 0 in r3 and r4, the end of pixels
 * in r7, what scales weights in r8 and r9 (tiny_scale_make). */
#define TINY_POINTS_START \
    "subs r3, r3, r2\n\t" \
    "subs r4, r4, r2\n\t" \
    "ldm r1!, {r6, r7}\n\t" \
    "add r7, r1, r7, lsl #4\n\t" \
    "clz r8, r6\n\t" \
    "lsl r6, r6, r8\n\t" \
    "ldr r9, [r0, #16]\n\t" \
    "ubfx r10, r6, #22, #9\n\t" \
    "ldrh r9, [r9, r10, lsl #1]\n\t" \
    "lsrs r6, r6, #11\n\t" \
    "mov r10, #0x80000000\n\t" \
    "mls r6, r6, r9, r10\n\t" \
    "asrs r6, r6, #4\n\t" \
    "mul r6, r6, r9\n\t" \
    "lsl r9, r9, #19\n\t" \
    "add r9, r9, r6, asr #8\n\t" \
    "lsr r9, r9, #14\n\t" \
    "sub r9, r9, #1\n\t"

/* The edge function in E becomes a weight. */
#define TINY_POINTS_WEIGHT(E)       \
    "lsl " E ", " E ", r8\n\t"      \
    "lsr " E ", " E ", #16\n\t"     \
    "mul " E ", " E ", r9\n\t"      \
    "lsr " E ", " E ", #15\n\t"

/* The difference D of units at the weight in W is added to r6. */
#define TINY_POINTS_TIMES(D, W)          \
    "smull r12, lr, " D ", " W "\n\t"    \
    "add r6, r6, r12, lsr #16\n\t"       \
    "add r6, r6, lr, lsl #16\n\t"

/* The next pixel: its place into r10, its depth and kind into r6, its ring into r12. */
#define TINY_POINTS_PIXEL               \
    "1: ldrd r10, r11, [r1, #8]\n\t" TINY_POINTS_WEIGHT("r10") TINY_POINTS_WEIGHT("r11") \
    "strd r10, r11, [r1, #8]\n\t"       \
    "mov r6, r2\n\t" TINY_POINTS_TIMES("r3", "r10") TINY_POINTS_TIMES("r4", "r11") \
    "ldrd r10, r11, [r1], #16\n\t"      \
    "lsrs r12, r6, #26\n\t"             \
    "bne 2f\n\t"                        \
    "add r6, r6, #0x400\n\t"            \
    "lsrs r6, r6, #11\n\t"              \
    "b 3f\n"                            \
    "2: add r6, r6, #0x3c000000\n\t"    \
    "add r6, r6, #0x4000\n\t"           \
    "lsrs r6, r6, #15\n"                \
    "3: movt r6, #0xffff\n\t"           \
    "pkhbt r10, r10, r11, lsl #16\n\t"  \
    "ldrd r12, lr, [r0, #4]\n\t"        \
    "mul r11, r11, lr\n\t"              \
    "lsr r11, r11, #22\n\t"             \
    "add r12, r12, r11, lsl #2\n\t"

/* Links its entry, whose number is in r11. */
#define TINY_POINTS_LINK              \
    "ldr lr, [r0, #12]\n\t"           \
    "ldr r11, [lr]\n\t"               \
    "add r11, r11, #1\n\t"            \
    "str r11, [lr]\n\t"               \
    "sub r11, r11, #1\n\t"            \
    "ldr lr, [r12]\n\t"               \
    "str r11, [r12]\n\t"              \
    "ldr r12, [r0]\n\t"               \
    "cmn lr, #1\n\t"                  \
    "beq 4f\n\t"                      \
    "sub lr, r12, lr, lsl #4\n\t"     \
    "sub r12, r12, r11, lsl #4\n\t"   \
    "strd r10, r6, [r12]\n\t"         \
    "ldr r10, [lr, #8]\n\t"           \
    "str r11, [lr, #8]\n\t"           \
    "strd r10, r5, [r12, #8]\n\t"     \
    "cmp r1, r7\n\t"                  \
    "bne 1b\n\t"                      \
    "b 5f\n"                          \
    "4: sub r12, r12, r11, lsl #4\n\t" \
    "strd r10, r6, [r12]\n\t"         \
    "strd r11, r5, [r12, #8]\n\t"     \
    "cmp r1, r7\n\t"                  \
    "bne 1b\n"                        \
    "5:"

/* The rings in r0, the next pixel in r1, the colour in r5. Three fifths of the instructions that compilers take. */
#define TINY_POINTS_ARMV7EM TINY_POINTS_START TINY_POINTS_PIXEL TINY_POINTS_LINK

SMEAR_INLINE void tiny_points_armv7em(const struct points_rings *r, struct tiny_cover *t, const int32_t *depth0,
                                      const int32_t *depth1, const int32_t *depth2, uint32_t color)
{
    register const struct points_rings *r0 __asm__("r0") = r;
    register struct tiny_cover *r1 __asm__("r1") = t;
    register const int32_t *r2 __asm__("r2") = depth0;
    register const int32_t *r3 __asm__("r3") = depth1;
    register const int32_t *r4 __asm__("r4") = depth2;
    register uint32_t r5 __asm__("r5") = color;
    __asm__ volatile(".syntax unified\n\t"
                     "ldr r2, [r2]\n\t"
                     "ldr r3, [r3]\n\t"
                     "ldr r4, [r4]\n\t" TINY_POINTS_ARMV7EM
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3), "+r"(r4), "+r"(r5)
                     :
                     : "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

SMEAR_INLINE void tiny_make_points(const struct points_rings *r, struct tiny_cover *t, const int32_t *depth0, const int32_t *depth1,
                                   const int32_t *depth2, uint32_t color)
{
#if TINY_COVER_ARMV6M
    tiny_points_armv6m(r, t, depth0, depth1, depth2, color);
#elif TINY_COVER_ARMV7EM
    tiny_points_armv7em(r, t, depth0, depth1, depth2, color);
#else
    tiny_points_reference(r, t, depth0, depth1, depth2, color);
#endif
}

#endif

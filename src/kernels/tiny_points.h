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
#if TINY_COVER_ARMV7EM
    tiny_points_armv7em(r, t, depth0, depth1, depth2, color);
#else
    tiny_points_reference(r, t, depth0, depth1, depth2, color);
#endif
}

#endif

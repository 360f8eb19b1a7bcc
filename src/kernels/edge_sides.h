/* SPDX-License-Identifier: MIT */
/* edge_sides.h - where rows begin or end: the pixels of an edge in some rows. */
#ifndef SMEAR_KERNELS_EDGE_SIDES_H
#define SMEAR_KERNELS_EDGE_SIDES_H

#include "kernels/edge_walk.h"
#include "kernels/kernels.h"

/* Left sides of n > 0 rows, 0 at least. The edge goes on by so many rows. */
SMEAR_INLINE void edge_left_reference(struct span_side *side, struct edge_walk *edge, int32_t n)
{
    struct edge_walk e = *edge;
    struct span_side *const end = side + n;
    do {
        side->left = max_i32(edge_pixel(&e), 0);
        edge_step(&e);
    } while (++side != end);
    *edge = e;
}

/* Right sides, `width` at most, and where they are. */
SMEAR_INLINE void edge_right_reference(struct span_side *side, struct edge_walk *edge, int32_t n, int32_t width)
{
    struct edge_walk e = *edge;
    struct span_side *const end = side + n;
    do {
        int32_t x = edge_pixel(&e);
        side->right = min_i32(x, width);
        side->edge = x;
        edge_step(&e);
    } while (++side != end);
    *edge = e;
}

#if SMEAR_ASM_ARMV6M
SMEAR_STATIC_ASSERT(sizeof(struct span_side) == 12 && offsetof(struct span_side, edge) == 8 && sizeof(struct edge_walk) == 20
                        && offsetof(struct edge_walk, step_rest) == 12,
                    "the assembly knows edges and sides");

/* The edge at r0 into r1 to r5, rows at r6; STORE takes its pixel in r7. The last row's end in r8, the width in r9. Half of the
 * instructions that compilers take. */
#define EDGE_SIDES_ARMV6M(STORE) \
    __asm__ volatile(".syntax unified\n\t" \
                     "mov r8, r7\n\t" \
                     "mov r9, r1\n\t" \
                     "ldm r0!, {r1, r2, r3, r4, r5}\n\t" \
                     "subs r0, #20\n" \
                     "1: asrs r7, r1, #8\n\t" STORE "adds r6, #12\n\t" \
                     "adds r1, r1, r3\n\t" \
                     "adds r2, r2, r4\n\t" \
                     "ble 3f\n\t" \
                     "subs r2, r2, r5\n\t" \
                     "adds r1, #1\n" \
                     "3: cmp r6, r8\n\t" \
                     "bne 1b\n\t" \
                     "stm r0!, {r1, r2}" \
                     : "+r"(r0), "+r"(r1), "+r"(r6), "+r"(r7) \
                     : \
                     : "r2", "r3", "r4", "r5", "r8", "r9", "cc", "memory")

static inline void edge_left_armv6m(struct span_side *side, struct edge_walk *edge, int32_t n)
{
    register struct edge_walk *r0 __asm__("r0") = edge;
    register int32_t r1 __asm__("r1") = 0;
    register struct span_side *r6 __asm__("r6") = side;
    register struct span_side *r7 __asm__("r7") = side + n;
    EDGE_SIDES_ARMV6M("bpl 2f\n\t"
                      "movs r7, #0\n"
                      "2: str r7, [r6]\n\t");
}

static inline void edge_right_armv6m(struct span_side *side, struct edge_walk *edge, int32_t n, int32_t width)
{
    register struct edge_walk *r0 __asm__("r0") = edge;
    register int32_t r1 __asm__("r1") = width;
    register struct span_side *r6 __asm__("r6") = side;
    register struct span_side *r7 __asm__("r7") = side + n;
    EDGE_SIDES_ARMV6M("str r7, [r6, #8]\n\t"
                      "cmp r7, r9\n\t"
                      "ble 2f\n\t"
                      "mov r7, r9\n"
                      "2: str r7, [r6, #4]\n\t");
}
#endif

static inline void edge_left(struct span_side *side, struct edge_walk *edge, int32_t n)
{
#if SMEAR_ASM_ARMV6M
    edge_left_armv6m(side, edge, n);
#else
    edge_left_reference(side, edge, n);
#endif
}

static inline void edge_right(struct span_side *side, struct edge_walk *edge, int32_t n, int32_t width)
{
#if SMEAR_ASM_ARMV6M
    edge_right_armv6m(side, edge, n, width);
#else
    edge_right_reference(side, edge, n, width);
#endif
}

/* Both sides of n > 0 rows. */
static inline void edge_sides(struct span_side *side, struct edge_walk *left, struct edge_walk *right, int32_t n, int32_t width)
{
    edge_left(side, left, n);
    edge_right(side, right, n, width);
}

#endif

/* SPDX-License-Identifier: MIT */
/* points_list.h - finished pixels of a list, into a plane. */
#ifndef SMEAR_KERNELS_POINTS_LIST_H
#define SMEAR_KERNELS_POINTS_LIST_H

#include "base/pixel.h"
#include "kernels/kernels.h"

/* Draws points from entry `head` on, where they are nearer. Returns the first entry that is no point, or UINT32_MAX. Pixels are
 * RGB565 where they are narrow. */
SMEAR_INLINE uint32_t points_list_reference(const struct points_plane *p, uint32_t head, bool narrow)
{
    const struct points_plane k = *p;
    while (head != UINT32_MAX) {
        struct point_entry e;
        __builtin_memcpy(&e, (const uint8_t *)k.top - (size_t)head * sizeof e, sizeof e);
        if (e.kind != POINT_ENTRY)
            break;
        head = e.next;
        const uint32_t x = e.x - k.x0, y = e.y - k.y0;
        if (x >= k.width || y >= k.height)
            continue;
        const int32_t at = (int32_t)y * k.stride + (int32_t)x;
        if (e.depth <= k.depth[at])
            continue;
        k.depth[at] = e.depth;
        if (narrow)
            ((uint16_t *)k.pixels)[at] = (uint16_t)rgb565_nearest(e.color);
        else
            ((uint32_t *)k.pixels)[at] = e.color & 0xffffffu;
    }
    return head;
}

#if SMEAR_ASM_ARMV7EM
SMEAR_STATIC_ASSERT(sizeof(struct point_entry) == 16 && offsetof(struct point_entry, depth) == 4
                        && offsetof(struct point_entry, next) == 8,
                    "the assembly knows struct point_entry");

/* A colour in r6, which is stored r5 pixels further on. */
#define POINTS_PUT_NARROW         \
    "and r2, r6, #0xff00ff\n\t"   \
    "mla r2, r2, r7, r8\n\t"      \
    "ubfx r6, r6, #8, #8\n\t"     \
    "rsb r3, r6, r6, lsl #8\n\t"  \
    "sub r6, r3, r6, lsl #1\n\t"  \
    "addw r6, r6, #505\n\t"       \
    "lsrs r6, r6, #10\n\t"        \
    "ubfx r3, r2, #11, #5\n\t"    \
    "lsrs r2, r2, #27\n\t"        \
    "orr r3, r3, r6, lsl #5\n\t"  \
    "orr r3, r3, r2, lsl #11\n\t" \
    "strh r3, [r0, r5, lsl #1]\n"
#define POINTS_PUT_WIDE    \
    "bfc r6, #24, #8\n\t"  \
    "str r6, [r0, r5, lsl #2]\n"

/* The next entry in r1, the first entry's address in lr; pixels in r0, depths in r12. Pairs of halves: x0 and y0 in r9, one less than
 * the width and the height in r10. The stride is in r11; r7 and r8 are of rgb565_nearest. */
#define POINTS_LIST(PUT)                               \
    __asm__ volatile(".syntax unified\n"               \
                     "1: sub r4, lr, r1, lsl #4\n\t"   \
                     "ldrd r2, r3, [r4]\n\t"           \
                     "cmn r3, #0x10000\n\t"            \
                     "bcc 9f\n\t"                      \
                     "ldrd r1, r6, [r4, #8]\n\t"       \
                     "usub16 r4, r2, r9\n\t"           \
                     "uqsub16 r2, r4, r10\n\t"         \
                     "cbnz r2, 8f\n\t"                 \
                     "uxth r5, r4\n\t"                 \
                     "smlatb r5, r4, r11, r5\n\t"      \
                     "uxth r3, r3\n\t"                 \
                     "ldrh r2, [r12, r5, lsl #1]\n\t"  \
                     "cmp r2, r3\n\t"                  \
                     "bhs 8f\n\t"                      \
                     "strh r3, [r12, r5, lsl #1]\n\t" PUT "8: cmn r1, #1\n\t" \
                     "bne 1b\n"                        \
                     "9:"                              \
                     : "+r"(r1)                        \
                     : "r"(r0), "r"(r7), "r"(r8), "r"(r9), "r"(r10), "r"(r11), "r"(r12), "r"(lr) \
                     : "r2", "r3", "r4", "r5", "r6", "cc", "memory")

/* Less than two thirds of the instructions that compilers take. */
static inline uint32_t points_list_armv7em(const struct points_plane *p, uint32_t head, bool narrow)
{
    register void *r0 __asm__("r0") = p->pixels;
    register uint32_t r1 __asm__("r1") = head;
    register uint32_t r7 __asm__("r7") = 249u;
    register uint32_t r8 __asm__("r8") = 0x03f603f6u;
    register uint32_t r9 __asm__("r9") = p->x0 | p->y0 << 16;
    register uint32_t r10 __asm__("r10") = (p->width - 1) | (p->height - 1) << 16;
    register int32_t r11 __asm__("r11") = p->stride;
    register uint16_t *r12 __asm__("r12") = p->depth;
    register const void *lr __asm__("lr") = p->top;
    if (head == UINT32_MAX)
        return head;
    if (narrow)
        POINTS_LIST(POINTS_PUT_NARROW);
    else
        POINTS_LIST(POINTS_PUT_WIDE);
    return r1;
}
#endif

static inline uint32_t points_list(const struct points_plane *p, uint32_t head, bool narrow)
{
#if SMEAR_ASM_ARMV7EM
    return points_list_armv7em(p, head, narrow);
#else
    return narrow ? points_list_reference(p, head, true) : points_list_reference(p, head, false);
#endif
}

#endif

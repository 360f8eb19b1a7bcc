/* SPDX-License-Identifier: MIT */
/* gradient.h - how what changes along two edges of a triangle changes per pixel. */
#ifndef SMEAR_KERNELS_GRADIENT_H
#define SMEAR_KERNELS_GRADIENT_H

#include "base/fixmath.h"
#include "kernels/kernels.h"

/* n 256 / area with n = a1 y2 - a2 y1 (or a2 x1 - a1 x2): change per pixel of an attribute that changes by a1 and a2 along the two
 * edges; to nearest, clamped. recip: 2^61 / area, whose highest bit was shifted up by so many zeros. */
SMEAR_INLINE int32_t gradient_of(int64_t n, uint32_t recip, int area_zeros)
{
    if (n == 0)
        return 0;
    uint64_t size = n < 0 ? 0u - (uint64_t)n : (uint64_t)n;
    int zeros; /* n = top 2^(33 - zeros) */
#if UINTPTR_MAX > 0xffffffffu || SMEAR_ONE_COPY
    zeros = count_leading_zeros_64(size);
    uint32_t high = (uint32_t)(size << zeros >> 32);
#else
    uint32_t high = (uint32_t)(size >> 32), low = (uint32_t)size;
    if (high != 0) {
        zeros = count_leading_zeros(high);
        high = high << zeros | low >> 1 >> (31 - zeros);
    } else {
        zeros = count_leading_zeros(low);
        high = low << zeros;
        zeros += 32;
    }
#endif
    int32_t top = (int32_t)(high >> 1);
    int32_t g = mulh_i32(top, (int32_t)recip);
    g = scale_sat(g, clamp_i32(area_zeros - zeros - 20, -31, 31));
    return n < 0 ? -g : g;
}

/* (frac q8) x slope / 256, exact floor without a wide product. */
static inline int32_t slope_part(int32_t slope, int32_t frac)
{
    return mul_wrap(slope >> 8, frac) + ((slope & 255) * frac >> 8);
}

/* gradient_of d1 y2 - d2 y1 in the lower word and of d2 x1 - d1 x2 in the upper one, of the edges x1, y1, x2 and y2. */
static inline uint64_t gradients_reference(const int32_t *edge, int32_t d1, int32_t d2, uint32_t recip, int area_zeros)
{
    const int32_t dx = gradient_of(cross_wide(d1, d2, edge[1], edge[3]), recip, area_zeros);
    const int32_t dy = gradient_of(cross_wide(d2, d1, edge[2], edge[0]), recip, area_zeros);
    return (uint64_t)(uint32_t)dy << 32 | (uint32_t)dx;
}

#ifdef __OPTIMIZE_SIZE__
#define GRADIENT_ARMV6M 0
#else
#define GRADIENT_ARMV6M SMEAR_ASM_ARMV6M
#endif

#if GRADIENT_ARMV6M
#define gradients gradients_armv6m

/* The product of r0 and r1: its high word into r1, its low word into r4. */
#define ARMV6M_PRODUCT         \
    "movs r4, r0\n\t"          \
    "muls r4, r1\n\t"          \
    "uxth r5, r1\n\t"          \
    "asrs r1, r1, #16\n\t"     \
    "uxth r2, r0\n\t"          \
    "asrs r0, r0, #16\n\t"     \
    "movs r3, r2\n\t"          \
    "muls r3, r5\n\t"          \
    "lsrs r3, r3, #16\n\t"     \
    "muls r5, r0\n\t"          \
    "adds r5, r5, r3\n\t"      \
    "muls r2, r1\n\t"          \
    "muls r1, r0\n\t"          \
    "uxth r3, r5\n\t"          \
    "adds r2, r2, r3\n\t"      \
    "asrs r5, r5, #16\n\t"     \
    "adds r1, r1, r5\n\t"      \
    "asrs r2, r2, #16\n\t"     \
    "adds r1, r1, r2\n\t"

/* r0 r1 - r2 r3 of factors r1 and r3 of 16 bits: its high word into r1, its low word into r4. */
#define ARMV6M_CROSS_SHORT     \
    "uxth r4, r0\n\t"          \
    "asrs r0, r0, #16\n\t"     \
    "muls r4, r1\n\t"          \
    "muls r0, r1\n\t"          \
    "uxth r5, r2\n\t"          \
    "asrs r2, r2, #16\n\t"     \
    "muls r5, r3\n\t"          \
    "muls r2, r3\n\t"          \
    "subs r0, r0, r2\n\t"      \
    "asrs r1, r4, #31\n\t"     \
    "asrs r3, r5, #31\n\t"     \
    "subs r4, r4, r5\n\t"      \
    "sbcs r1, r3\n\t"          \
    "lsls r2, r0, #16\n\t"     \
    "asrs r0, r0, #16\n\t"     \
    "adds r4, r4, r2\n\t"      \
    "adcs r1, r0\n\t"

#define ARMV6M_CROSS_LONG      \
    "push {r2, r3}\n\t" ARMV6M_PRODUCT \
    "pop {r2, r3}\n\t"         \
    "push {r1, r4}\n\t"        \
    "movs r0, r2\n\t"          \
    "movs r1, r3\n\t" ARMV6M_PRODUCT \
    "pop {r2, r3}\n\t"         \
    "subs r4, r3, r4\n\t"      \
    "sbcs r2, r1\n\t"          \
    "movs r1, r2\n\t"

/* Shifts r1 up by BITS where its upper ones are zero, and counts that in r2. */
#define ARMV6M_SHIFT_UP(REST, BITS, LABEL) \
    "lsrs r3, r1, #" REST "\n\t"           \
    "bne " LABEL "f\n\t"                   \
    "lsls r1, r1, #" BITS "\n\t"           \
    "adds r2, #" BITS "\n" LABEL ": "

/* The number in r1 and r4, which is not 0, in the upper 32 bits, rounded down, into r1; how far it was shifted into r2. */
#define ARMV6M_NORMAL          \
    "movs r2, #0\n\t"          \
    ARMV6M_SHIFT_UP("16", "16", "11") ARMV6M_SHIFT_UP("24", "8", "12")           \
    ARMV6M_SHIFT_UP("28", "4", "13") ARMV6M_SHIFT_UP("30", "2", "14")            \
    "movs r3, r1\n\t"          \
    "bmi 15f\n\t"              \
    "lsls r1, r1, #1\n\t"      \
    "adds r2, #1\n"            \
    "15: movs r3, #32\n\t"     \
    "subs r3, r3, r2\n\t"      \
    "lsrs r4, r3\n\t"          \
    "orrs r1, r4\n\t"

/* The high word of r1 / 2 times r8, neither of which has a sign, into r0. */
#define ARMV6M_TIMES_OVER_AREA \
    "lsrs r0, r1, #17\n\t"     \
    "lsls r1, r1, #15\n\t"     \
    "lsrs r1, r1, #16\n\t"     \
    "mov r3, r8\n\t"           \
    "uxth r4, r3\n\t"          \
    "lsrs r3, r3, #16\n\t"     \
    "movs r5, r1\n\t"          \
    "muls r5, r4\n\t"          \
    "lsrs r5, r5, #16\n\t"     \
    "muls r4, r0\n\t"          \
    "adds r4, r4, r5\n\t"      \
    "muls r1, r3\n\t"          \
    "uxth r5, r4\n\t"          \
    "adds r1, r1, r5\n\t"      \
    "lsrs r1, r1, #16\n\t"     \
    "muls r0, r3\n\t"          \
    "lsrs r4, r4, #16\n\t"     \
    "adds r0, r0, r4\n\t"      \
    "adds r0, r0, r1\n\t"

/* gradient_of r10 times the word 12 bytes behind r6 less r11 times the word 4 bytes behind r6 into r0; of the area's reciprocal in
 * r8, and 19 less its zeros in r9. scale_sat in both directions is behind 6 and 7: numbers stay below 2^29 before it. */
#define ARMV6M_GRADIENT        \
    "mov r0, r10\n\t"          \
    "mov r2, r11\n\t"          \
    "ldr r1, [r6, #12]\n\t"    \
    "ldr r3, [r6, #4]\n\t"     \
    "sxth r4, r1\n\t"          \
    "cmp r4, r1\n\t"           \
    "bne 5f\n\t"               \
    "sxth r4, r3\n\t"          \
    "cmp r4, r3\n\t"           \
    "bne 5f\n\t" ARMV6M_CROSS_SHORT \
    "2: asrs r5, r1, #31\n\t"  \
    "mov r12, r5\n\t"          \
    "eors r4, r5\n\t"          \
    "eors r1, r5\n\t"          \
    "subs r4, r4, r5\n\t"      \
    "sbcs r1, r5\n\t"          \
    "mov r5, r9\n\t"           \
    "bne 3f\n\t"               \
    "movs r0, r4\n\t"          \
    "beq 4f\n\t"               \
    "movs r1, r0\n\t"          \
    "movs r4, #0\n\t"          \
    "adds r5, #32\n"           \
    "3: " ARMV6M_NORMAL        \
    "adds r2, r2, r5\n\t" ARMV6M_TIMES_OVER_AREA \
    "cmp r2, #0\n\t"           \
    "blt 6f\n\t"               \
    "lsrs r0, r2\n\t"          \
    "adds r0, #1\n\t"          \
    "lsrs r0, r0, #1\n"        \
    "7: mov r5, r12\n\t"       \
    "eors r0, r5\n\t"          \
    "subs r0, r0, r5\n"        \
    "4: bx lr\n"               \
    "5: " ARMV6M_CROSS_LONG    \
    "b 2b\n"                   \
    "6: mvns r2, r2\n\t"       \
    "movs r4, #0\n\t"          \
    "mvns r4, r4\n\t"          \
    "lsrs r4, r4, #1\n\t"      \
    "movs r3, r4\n\t"          \
    "lsrs r3, r2\n\t"          \
    "cmp r0, r3\n\t"           \
    "bhi 8f\n\t"               \
    "lsls r0, r2\n\t"          \
    "b 7b\n"                   \
    "8: movs r0, r4\n\t"       \
    "b 7b\n"

/* The second is that of d1 x2 - d2 x1, with the other sign. Compilers take half as many instructions again, and twice the room. */
static SMEAR_NOINLINE uint64_t gradients_armv6m(const int32_t *edge, int32_t d1, int32_t d2, uint32_t recip, int area_zeros)
{
    register uint32_t low __asm__("r0") = (uint32_t)(uintptr_t)edge;
    register uint32_t high __asm__("r1") = (uint32_t)d1;
    register int32_t second __asm__("r2") = d2;
    register uint32_t over __asm__("r3") = recip;
    register int less __asm__("r4") = 19 - area_zeros;
    __asm__ volatile(".syntax unified\n\t"
                     "movs r6, r0\n\t"
                     "mov r10, r1\n\t"
                     "mov r11, r2\n\t"
                     "mov r8, r3\n\t"
                     "mov r9, r4\n\t"
                     "bl 1f\n\t"
                     "push {r0}\n\t"
                     "subs r6, #4\n\t"
                     "bl 1f\n\t"
                     "negs r1, r0\n\t"
                     "pop {r0}\n\t"
                     "b 9f\n"
                     "1: " ARMV6M_GRADIENT
                     "9:"
                     : "+r"(low), "+r"(high), "+r"(second), "+r"(over), "+r"(less)
                     :
                     : "r5", "r6", "r8", "r9", "r10", "r11", "r12", "lr", "memory", "cc");
    return (uint64_t)high << 32 | low;
}

#else
#define gradients gradients_reference
#endif

#endif

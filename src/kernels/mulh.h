/* SPDX-License-Identifier: MIT */
/* mulh.h - high words of products from products of 16 bits, for cores that have no wider ones. It lies below base. */
#ifndef SMEAR_KERNELS_MULH_H
#define SMEAR_KERNELS_MULH_H

#include "kernels/bind.h"

/* Returns the high word of the signed product: a = ah 2^16 + al, likewise b. |ah bl| <= 2^15 (2^16 - 1): what is added to it has 16 bits
 * and fits. */
static inline int32_t mulh_i32_reference(int32_t a, int32_t b)
{
    const int32_t ah = a >> 16, bh = b >> 16;
    const uint32_t al = (uint32_t)a & 0xffffu, bl = (uint32_t)b & 0xffffu;
    const int32_t middle = ah * (int32_t)bl + (int32_t)(al * bl >> 16);
    const int32_t other = (int32_t)al * bh + (int32_t)((uint32_t)middle & 0xffffu);
    return ah * bh + (middle >> 16) + (other >> 16);
}

/* Returns the high word of the unsigned product. */
static inline uint32_t mulh_u32_reference(uint32_t a, uint32_t b)
{
    const uint32_t ah = a >> 16, bh = b >> 16, al = a & 0xffffu, bl = b & 0xffffu;
    const uint32_t middle = ah * bl + (al * bl >> 16), other = al * bh + (middle & 0xffffu);
    return ah * bh + (middle >> 16) + (other >> 16);
}

/* The high word of a product on ARMv6-M, where ASR and LSR take upper halves of signed and unsigned words: 17 instructions, of
 * which compilers make 20 to 26. Takes a and b apart, and three registers more. */
#if SMEAR_ON_ARMV6M && SMEAR_GNU
#define MULH_ARMV6M(SHIFT, A, B, LOW_A, LOW_B, MIDDLE) \
    __asm__(".syntax unified\n\t" \
            "uxth %[al], %[a]\n\t" \
            SHIFT " %[a], %[a], #16\n\t" \
            "uxth %[bl], %[b]\n\t" \
            SHIFT " %[b], %[b], #16\n\t" \
            "movs %[m], %[al]\n\t" \
            "muls %[m], %[bl]\n\t" \
            "lsrs %[m], %[m], #16\n\t" \
            "muls %[bl], %[a]\n\t" \
            "adds %[m], %[m], %[bl]\n\t" \
            "muls %[al], %[b]\n\t" \
            "uxth %[bl], %[m]\n\t" \
            "adds %[al], %[al], %[bl]\n\t" \
            SHIFT " %[al], %[al], #16\n\t" \
            "muls %[a], %[b]\n\t" \
            SHIFT " %[m], %[m], #16\n\t" \
            "adds %[a], %[a], %[m]\n\t" \
            "adds %[a], %[a], %[al]" \
            : [a] "+l"(A), [b] "+l"(B), [al] "=&l"(LOW_A), [bl] "=&l"(LOW_B), [m] "=&l"(MIDDLE) : : "cc")

SMEAR_INLINE_ALWAYS int32_t mulh_i32_armv6m(int32_t a, int32_t b)
{
    uint32_t low_a, low_b, middle;
    MULH_ARMV6M("asrs", a, b, low_a, low_b, middle);
    return a;
}

SMEAR_INLINE_ALWAYS uint32_t mulh_u32_armv6m(uint32_t a, uint32_t b)
{
    uint32_t low_a, low_b, middle;
    MULH_ARMV6M("lsrs", a, b, low_a, low_b, middle);
    return a;
}
#endif

#endif

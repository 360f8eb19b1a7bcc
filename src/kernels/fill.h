/* SPDX-License-Identifier: MIT */
/* fill.h - rows of one value. */
#ifndef SMEAR_KERNELS_FILL_H
#define SMEAR_KERNELS_FILL_H

#include "base/pixel.h"
#include "kernels/kernels.h"

/* Sets n >= 0 times eight words; returns where the next lies. */
#if SMEAR_GNU && !defined(__clang__) && defined(__arm__) && defined(__OPTIMIZE__)
/* So many stores a round, of four registers each. */
#define FILL_ROUNDS(STORES, rounds)                                  \
    if ((rounds) > 0)                                                \
        __asm__ volatile(".syntax unified\n"                         \
                         "1:\n\t.rept " #STORES "\n\t"               \
                         "stmia %[p]!, {r3, r4, r5, r6}\n\t.endr\n\t" \
                         "subs %[n], %[n], #1\n\t"                   \
                         "bne 1b"                                    \
                         : [p] "+l"(p), [n] "+l"(rounds)             \
                         : "r"(a), "r"(b), "r"(c), "r"(d)            \
                     : "cc", "memory")

/* Four registers a store: half the cycles of single words, and a fifth of the instructions. */
static inline pixel_word *fill_eights(pixel_word *p, uint32_t value, int32_t n)
{
    register uint32_t a __asm__("r3") = value;
    register uint32_t b __asm__("r4") = value;
    register uint32_t c __asm__("r5") = value;
    register uint32_t d __asm__("r6") = value;
#ifndef __OPTIMIZE_SIZE__
    int32_t rounds = n >> 2;
    n &= 3;
    FILL_ROUNDS(8, rounds);
#endif
    FILL_ROUNDS(2, n);
    return p;
}
#else
static inline pixel_word *fill_eights(pixel_word *p, uint32_t value, int32_t n)
{
    for (; n > 0; n--, p += 8) {
        p[0] = value;
        p[1] = value;
        p[2] = value;
        p[3] = value;
        p[4] = value;
        p[5] = value;
        p[6] = value;
        p[7] = value;
    }
    return p;
}
#endif

/* Sets n >= 0 words. */
static inline void pixels_fill_reference(uint32_t *p, uint32_t value, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        p[i] = value;
}

/* Eight words a round: stores of many registers where a core has them. */
static inline void pixels_fill(uint32_t *p, uint32_t value, int32_t n)
{
    fill_eights(p, value, n >> 3);
    for (int32_t i = n & ~7; i < n; i++)
        p[i] = value;
}

/* Sets n >= 0 pixels of 16 bits to value < 2^16. */
static inline void pixels_fill_narrow_reference(uint16_t *p, uint32_t value, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        p[i] = (uint16_t)value;
}

/* In words, from the first aligned one on. */
static inline void pixels_fill_narrow(uint16_t *p, uint32_t value, int32_t n)
{
    if (n > 0 && ((uintptr_t)p & 2u) != 0) {
        *p++ = (uint16_t)value;
        n--;
    }
    pixel_word *pairs = (pixel_word *)(void *)p;
    value |= value << 16;
    pairs = fill_eights(pairs, value, n >> 4);
    for (n &= 15; n >= 2; n -= 2)
        *pairs++ = value;
    if (n > 0)
        *(uint16_t *)(void *)pairs = (uint16_t)value;
}

/* Sets them to 0: smaller, or faster than what a libc has. */
static inline void pixels_clear_narrow(uint16_t *p, int32_t n)
{
#ifdef __OPTIMIZE_SIZE__
    __builtin_memset(p, 0, (size_t)n * sizeof *p);
#else
    pixels_fill_narrow(p, 0, n);
#endif
}

/* Sets both bytes of each to the lowest one of `byte`. */
static inline void pixels_fill_bytes(uint16_t *p, int byte, int32_t n) { __builtin_memset(p, byte, (size_t)n * sizeof *p); }

#endif

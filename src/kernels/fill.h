/* SPDX-License-Identifier: MIT */
/* fill.h - rows of one value. */
#ifndef SMEAR_KERNELS_FILL_H
#define SMEAR_KERNELS_FILL_H

#include "base/pixel.h"
#include "kernels/kernels.h"

/* Sets n >= 0 times eight words of each of some rows, of which there is one at least, `gap` words apart: any number
 * where there is but one. */
#if SMEAR_GNU && !defined(__clang__) && defined(__arm__) && defined(__OPTIMIZE__)
#ifdef __thumb__
#define FILL_HIGH "h"
#else
#define FILL_HIGH "r"
#endif

/* Four registers a store: half the cycles of single words, and a fifth of the instructions. From row to row 10, where compilers take 24. */
static inline void fill_eights(pixel_word *p, uint32_t value, int32_t n, int32_t gap, int32_t rows)
{
    register uint32_t a __asm__("r3") = value, b __asm__("r4") = value, c __asm__("r5") = value, d __asm__("r6") = value;
    int32_t left;
#ifdef __OPTIMIZE_SIZE__                /* of whose rows there is one, but of a sky: GCC keeps nothing in r8 and above then */
    for (left = n; n > 0 && rows > 0; rows--, p += gap, left = n)
        __asm__ volatile(".syntax unified\n1:\n\t.rept 2\n\tstmia %[p]!, {r3, r4, r5, r6}\n\t.endr\n\tsubs %[left], %[left], #1\n\tbne 1b"
                         : [p] "+l"(p), [left] "+l"(left) : "r"(a), "r"(b), "r"(c), "r"(d) : "cc", "memory");
#else
    __asm__ volatile(".syntax unified\n"
                     "1:\n\tmov %[left], %[many]\n\tcmp %[left], #0\n\tbeq 3f\n"
                     "2:\n\t.rept 8\n\tstmia %[p]!, {r3, r4, r5, r6}\n\t.endr\n\tsubs %[left], %[left], #1\n\tbne 2b\n"
                     "3:\n\tmov %[left], %[few]\n\tcmp %[left], #0\n\tbeq 5f\n"
                     "4:\n\t.rept 2\n\tstmia %[p]!, {r3, r4, r5, r6}\n\t.endr\n\tsubs %[left], %[left], #1\n\tbne 4b\n"
                     "5:\n\tadd %[p], %[p], %[gap]\n\tsubs %[rows], %[rows], #1\n\tbne 1b"
                     : [p] "+l"(p), [rows] "+l"(rows), [left] "=&l"(left)
                     : [many] FILL_HIGH(n >> 2), [few] FILL_HIGH(n & 3), [gap] FILL_HIGH(4 * gap), "r"(a), "r"(b), "r"(c), "r"(d)
                     : "cc", "memory");
#endif
}
#else
static inline void fill_eights(pixel_word *p, uint32_t value, int32_t n, int32_t gap, int32_t rows)
{
    for (; rows > 0; rows--, p += gap)
        for (int32_t i = 0; i < n; i++, p += 8)        /* written out, as compilers then store vectors */
            p[0] = p[1] = p[2] = p[3] = p[4] = p[5] = p[6] = p[7] = value;
}
#endif

/* Sets n >= 0 words, eight a round: stores of many registers where a core has them. */
static inline void pixels_fill(uint32_t *p, uint32_t value, int32_t n)
{
    fill_eights(p, value, n >> 3, n, 1);
    for (int32_t i = n & ~7; i < n; i++)
        p[i] = value;
}

/* Sets n >= 0 words of each of some rows, of which there is one at least, `stride` words apart. */
static inline void pixels_fill_rows(uint32_t *p, uint32_t value, int32_t n, int32_t stride, int32_t rows)
{
    if (n == stride) {
        n *= rows;
        rows = 1;
    }
    fill_eights(p, value, n >> 3, stride - (n & ~7), rows);
    for (; (n & 7) != 0 && rows > 0; rows--, p += stride)
        for (int32_t i = n & ~7; i < n; i++)
            p[i] = value;
}

/* Sets n >= 0 pixels of 16 bits to value < 2^16: in words, from the first aligned one on. */
static inline void pixels_fill_narrow(uint16_t *p, uint32_t value, int32_t n)
{
    if (n > 0 && ((uintptr_t)p & 2u) != 0) {
        *p++ = (uint16_t)value;
        n--;
    }
    pixel_word *pairs = (pixel_word *)(void *)p;
    value |= value << 16;
    fill_eights(pairs, value, n >> 4, n, 1);
    pairs += n >> 4 << 3;
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

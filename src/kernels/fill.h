/* SPDX-License-Identifier: MIT */
/* fill.h - rows of one value. */
#ifndef SMEAR_KERNELS_FILL_H
#define SMEAR_KERNELS_FILL_H

#include "base/pixel.h"
#include "kernels/kernels.h"

static inline void fill_eight(pixel_word *p, uint32_t value)
{
    p[0] = value;
    p[1] = value;
    p[2] = value;
    p[3] = value;
    p[4] = value;
    p[5] = value;
    p[6] = value;
    p[7] = value;
}

/* Sets n >= 0 words. */
static inline void pixels_fill_reference(uint32_t *p, uint32_t value, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        p[i] = value;
}

/* Eight words a round: stores of many registers where a core has them. */
static inline void pixels_fill_unrolled(uint32_t *p, uint32_t value, int32_t n)
{
    int32_t i = 0;
    for (; i + 8 <= n; i += 8)
        fill_eight(p + i, value);
    for (; i < n; i++)
        p[i] = value;
}

static inline void pixels_fill(uint32_t *p, uint32_t value, int32_t n) { pixels_fill_unrolled(p, value, n); }

/* Sets n >= 0 pixels of 16 bits to value < 2^16. */
static inline void pixels_fill_narrow_reference(uint16_t *p, uint32_t value, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        p[i] = (uint16_t)value;
}

/* In words, from the first aligned one on. */
static inline void pixels_fill_narrow_unrolled(uint16_t *p, uint32_t value, int32_t n)
{
    if (n > 0 && ((uintptr_t)p & 2u) != 0) {
        *p++ = (uint16_t)value;
        n--;
    }
    pixel_word *pairs = (pixel_word *)(void *)p;
    value |= value << 16;
    for (; n >= 16; n -= 16, pairs += 8)
        fill_eight(pairs, value);
    for (; n >= 2; n -= 2)
        *pairs++ = value;
    if (n > 0)
        *(uint16_t *)(void *)pairs = (uint16_t)value;
}

static inline void pixels_fill_narrow(uint16_t *p, uint32_t value, int32_t n)
{
    pixels_fill_narrow_unrolled(p, value, n);
}

#endif

/* SPDX-License-Identifier: MIT */
/* doubled.c - see doubled.h. Rows and the pixels of a row are gone through from the last to the first, so that what is
 * written lies behind all that is still to be read. */
#include "display/doubled.h"

#include "display/pixel_format.h"

#if SMEAR_WITH_DISPLAY

/* Return the bits of a byte or of a nibble, each twice. */
static inline uint32_t nibbles_twice(uint32_t byte)
{
    return (byte >> 4) * 0x1100u | (byte & 15u) * 0x11u;
}

static inline uint32_t bits_twice(uint32_t nibble)
{
    const uint32_t apart = (nibble | nibble << 2) & 0x33u, spread = (apart | apart << 1) & 0x55u;
    return spread * 3u;
}

/* Makes a row of `bytes` bytes of one whose pixels come half as often. Where bytes have several pixels, its last one may
 * have no second half. */
static void widen(uint8_t *out, uint32_t bytes, const uint8_t *in, smear_format format)
{
    if (format == SMEAR_XRGB8888) {
        const uint32_t *from = (const uint32_t *)(const void *)in;
        uint32_t *to = (uint32_t *)(void *)out;
        for (uint32_t i = bytes / 8; i-- > 0;)
            to[2 * i + 1] = to[2 * i] = from[i];
    } else if (format == SMEAR_RGB565 || format == SMEAR_RGB565_SWAPPED || format == SMEAR_RGB555) {
        const uint16_t *from = (const uint16_t *)(const void *)in;
        uint16_t *to = (uint16_t *)(void *)out;
        for (uint32_t i = bytes / 4; i-- > 0;)
            to[2 * i + 1] = to[2 * i] = from[i];
    } else {
        for (uint32_t i = (bytes + 1) / 2; i-- > 0;) {
            const uint32_t byte = in[i];
            const uint32_t pair = format == SMEAR_L4   ? nibbles_twice(byte)
                                : format == SMEAR_L1 ? bits_twice(byte >> 4) << 8 | bits_twice(byte & 15u)
                                                     : byte * 0x101u;
            if (2 * i + 1 < bytes)
                out[2 * i + 1] = (uint8_t)pair;
            out[2 * i] = (uint8_t)(pair >> 8);
        }
    }
}

/* Makes two pages of one: the first shows its upper four rows. */
static void heighten_page(uint8_t *upper, const uint8_t *in, uint32_t bytes, uint8_t *lower)
{
    for (uint32_t i = bytes; i-- > 0;) {
        const uint32_t byte = in[i];
        lower[i] = (uint8_t)bits_twice(byte >> 4);
        upper[i] = (uint8_t)bits_twice(byte & 15u);
    }
}

void smear_double_band(uint8_t *pixels, int32_t width, int32_t rows, smear_format format, int doubled)
{
    const uint32_t x = (uint32_t)doubled & SMEAR_DOUBLED_X, y = (uint32_t)doubled >> 1;
    const uint32_t stride = smear_format_stride(width, format), wide = smear_format_stride(width << x, format);
    const bool pages = format == SMEAR_L1_PAGES;
    for (uint32_t line = pages ? ((uint32_t)rows + 7) / 8 : (uint32_t)rows; line-- > 0;) {
        const uint8_t *in = pixels + line * stride;
        uint8_t *out = pixels + (line * wide << y);
        if (x != 0)
            widen(out, wide, in, format);
        else if (!pages && line != 0)
            __builtin_memcpy(out, in, stride);
        if (y != 0 && pages)
            heighten_page(out, x != 0 ? out : in, wide, out + wide);
        else if (y != 0)
            __builtin_memcpy(out + wide, out, wide);
    }
}

#endif

/* SPDX-License-Identifier: MIT */
/* screen.c - what is done to finished bands for displays of few greys and of doubled pixels: see display/band.h. */
#include "screen/screen.h"

#include "base/tables.h"
#include "display/band.h"

#if SMEAR_WITH_DISPLAY

/* ------------------------------------------------------------------ SMEAR_DITHER_DIFFUSE */

/* A code as a 1-bit display has it, of which the neighbours' codes are known. */
static inline int32_t with_contrast(int32_t code, int32_t left, int32_t above)
{
    const int32_t sharp = code + ((2 * code - left - above) >> 1);
    return (sharp * 341 >> 8) - 43;
}

/* Returns the nearest of 16 greys. */
static inline int32_t nearest_grey(int32_t code)
{
    return clamp_i32((code * 15 * 257 + 32768) >> 16, 0, 15);
}

/* Sets pixel (x, y) of a band; pixels come row by row, from left to right. */
static inline void put(uint8_t *band, int32_t width, int32_t x, int32_t y, smear_format format, int32_t level)
{
    if (format == SMEAR_L4) {
        uint8_t *byte = band + y * ((width + 1) / 2) + x / 2;
        *byte = (uint8_t)(x & 1 ? *byte | level : level << 4);
    } else if (format == SMEAR_L1) {
        uint8_t *byte = band + y * ((width + 7) / 8) + x / 8;
        *byte = (uint8_t)((x & 7 ? *byte : 0) | level << (7 - (x & 7)));
    } else {
        uint8_t *byte = band + (y >> 3) * width + x;
        *byte = (uint8_t)((y & 7 ? *byte : 0) | level << (y & 7));
    }
}

void smear_diffuse_band(uint8_t *band, int32_t width, int32_t y, int32_t rows, smear_format format, void *state)
{
    int16_t *left_over = (int16_t *)state;      /* of pixel x: at x + 1 */
    uint8_t *above = (uint8_t *)(left_over + width + 2);
    const int32_t y0 = y;
    if (y == 0) {
        __builtin_memset(left_over, 0, ((uint32_t)width + 2u) * sizeof *left_over);
        __builtin_memcpy(above, band, (uint32_t)width);
    }
    for (; y < y0 + rows; y++) {
        const uint8_t *in = band + (y - y0) * width, *place = smear_dither_ordered + ((y & 7) << 3);
        int32_t right = 0, below = 0, behind = 0, left = in[0];
        for (int32_t x = 0; x < width; x++) {
            const int32_t code = in[x], given = right + left_over[x + 1];
            int32_t wanted, level, rest;
            if (format == SMEAR_L4) {
                wanted = code + given;
                level = nearest_grey(wanted);
                rest = wanted - level * 17;
            } else {
                wanted = with_contrast(code, left, above[x]) + given;
                level = wanted >= 96 + (place[x & 7] >> 2);
                rest = clamp_i32(wanted - level * 255, -128, 127);
            }
            const int32_t three = rest * 3 >> 4, five = rest * 5 >> 4, one = rest >> 4;
            left_over[x] = (int16_t)(behind + three);
            behind = below + five;
            below = one;
            right = rest - three - five - one;
            left = above[x] = (uint8_t)code;
            put(band, width, x, y - y0, format, level);
        }
        left_over[width] = (int16_t)behind;
    }
}

/* ------------------------------------------------------------------ doubled displays */

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

/* Doubles finished pixels of a band in place. The buffer has room for what comes of them. */
static void double_band(uint8_t *pixels, int32_t width, int32_t rows, smear_format format, int doubled)
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

void smear_screen_finish(const struct smear_rows *rows, uint8_t *pixels, int32_t width, int32_t y, int32_t height)
{
    const smear_desc *d = rows->desc;
    const smear_format format = (smear_format)d->format;
    const uint32_t start = stage_start(rows);
    if (format_diffuses(d))                 /* bands are whole rows then */
        smear_diffuse_band(pixels, width, y, height, format, rows->bands.buffer[0] + rows->bands.bytes);
    if (is_doubled(d))
        double_band(pixels, width, height, format, d->display.doubled);
    stage_end(rows, &rows->stats->time.convert, start);
}

#endif

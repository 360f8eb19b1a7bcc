/* SPDX-License-Identifier: MIT */
/* convert.c - rounding and dither to the display's formats.
 *
 * Undithered levels are the nearest: 5 bits (249 c + 1014) >> 11, 6 bits (253 c + 505) >> 10, both exact for every
 * code. Dithered levels are floor(c levels / 255 + threshold): white stays white and black black. */
#include "convert.h"

#include "pixel.h"

uint32_t smear_convert_stride(int32_t width, smear_format format)
{
    uint32_t w = (uint32_t)width;
    switch (format) {
    case SMEAR_XRGB8888: return w * 4;
    case SMEAR_RGB565:
    case SMEAR_RGB565_SWAPPED:
    case SMEAR_RGB555: return w * 2;
    case SMEAR_L4: return (w + 1) / 2;
    case SMEAR_L1: return (w + 7) / 8;
    default: return w;
    }
}

uint32_t smear_convert_size(int32_t width, int32_t rows, smear_format format)
{
    uint32_t lines = (uint32_t)rows;
    if (format == SMEAR_L1_PAGES)
        lines = (lines + 7) / 8;
    return smear_convert_stride(width, format) * lines;
}

/* 0 .. 255 in steps of 1/256 of a level. */
static inline uint32_t threshold_at(int32_t x, int32_t y, smear_dither dither)
{
    return dither == SMEAR_DITHER_ORDERED ? smear_dither_ordered[(y & 7) << 3 | (x & 7)]
                                          : smear_dither_blue[(y & 31) << 5 | (x & 31)];
}

/* floor(c levels / 255 + t / 256): c 257 / 65536 is c / 255 for all that matters here, and exactly 1 at 255. */
static inline uint32_t level_dithered(uint32_t code, uint32_t levels, uint32_t t)
{
    return (code * 257u * levels + (code >> 7) * levels + (t << 8)) >> 16;
}

static inline uint32_t level_nearest(uint32_t code, uint32_t levels)
{
    return (code * levels * 2u + 255u) / 510u;
}

/* Luma of codes, BT.601 weights as display code expects them: (77 r + 150 g + 29 b) / 256. */
static inline uint32_t luma(uint32_t p)
{
    return (77u * pixel_red(p) + 150u * pixel_green(p) + 29u * pixel_blue(p) + 128u) >> 8;
}

static void rgb_levels(uint32_t p, int32_t x, int32_t y, smear_dither dither, uint32_t out[3],
                       const uint32_t levels[3])
{
    const uint32_t code[3] = { pixel_red(p), pixel_green(p), pixel_blue(p) };
    uint32_t t = dither != SMEAR_DITHER_NONE ? threshold_at(x, y, dither) : 0;
    for (int i = 0; i < 3; i++)
        out[i] = dither == SMEAR_DITHER_NONE ? level_nearest(code[i], levels[i])
                                             : level_dithered(code[i], levels[i], t);
}

static inline uint32_t rgb565_bytes(uint32_t p, bool swapped)
{
    uint32_t packed = rgb565_nearest(p);
    return swapped ? packed >> 8 | (packed << 8 & 0xff00u) : packed;
}

void smear_convert_swap(uint16_t *pixels, int32_t n)
{
    for (; n > 0; n--, pixels++)
        *pixels = (uint16_t)(*pixels >> 8 | *pixels << 8);
}

/* Two pixels of 16 bits as they lie in memory. */
static inline uint32_t pair_of(uint32_t first, uint32_t second)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return first << 16 | second;
#else
    return first | second << 16;
#endif
}

static inline void store_pair(uint16_t *out, uint32_t pair)
{
    __builtin_memcpy(__builtin_assume_aligned(out, 4), &pair, 4);
}

/* Flat areas are long: pairs of pixels that stay as they were cost a comparison. Rows are aligned to a pixel. */
SMEAR_INLINE void row_rgb565(uint16_t *out, const uint32_t *in, int32_t n, bool swapped)
{
    if (((uintptr_t)out & 2u) != 0 && n > 0) {
        *out++ = (uint16_t)rgb565_bytes(*in++, swapped);
        n--;
    }
    if (n <= 0)
        return;
    uint32_t last = ~*in, packed = 0, pair = 0;
    const uint32_t *end = in + n, *end_of_pairs = end - 1, *end_of_sixes = end - 5;
    for (; in < end_of_pairs; in += 2, out += 2) {
        uint32_t a = in[0], b = in[1], first = packed;
        if (a != last) {
            first = rgb565_bytes(a, swapped);
            packed = b == a ? first : rgb565_bytes(b, swapped);
        } else if (b != last) {
            packed = rgb565_bytes(b, swapped);
        } else {
            store_pair(out, pair);
            for (; in < end_of_sixes && in[2] == last && in[3] == last && in[4] == last && in[5] == last;
                 in += 4, out += 4) {
                store_pair(out + 2, pair);
                store_pair(out + 4, pair);
            }
            continue;
        }
        last = b;
        pair = pair_of(packed, packed);
        store_pair(out, pair_of(first, packed));
    }
    if (in < end)
        *out = (uint16_t)rgb565_bytes(*in, swapped);
}

static void row_16bit_dithered(uint8_t *out, const uint32_t *in, int32_t n, int32_t x, int32_t y,
                               smear_format format, smear_dither dither)
{
    static const uint32_t levels565[3] = { 31, 63, 31 }, levels555[3] = { 31, 31, 31 };
    for (int32_t i = 0; i < n; i++, out += 2) {
        uint32_t c[3], packed;
        if (format == SMEAR_RGB555) {
            rgb_levels(in[i], x + i, y, dither, c, levels555);
            packed = c[2] << 10 | c[1] << 5 | c[0];
        } else {
            rgb_levels(in[i], x + i, y, dither, c, levels565);
            packed = c[0] << 11 | c[1] << 5 | c[2];
        }
        int low = format == SMEAR_RGB565_SWAPPED ? 1 : 0;
        out[low] = (uint8_t)packed;
        out[1 - low] = (uint8_t)(packed >> 8);
    }
}

static uint32_t grey_level(uint32_t p, int32_t x, int32_t y, uint32_t levels, smear_dither dither)
{
    return dither == SMEAR_DITHER_NONE ? level_nearest(luma(p), levels)
                                       : level_dithered(luma(p), levels, threshold_at(x, y, dither));
}

void smear_convert_row(uint8_t *band, uint32_t stride, const uint32_t *in, int32_t n, int32_t x, int32_t y,
                       int32_t y0, smear_format format, smear_dither dither)
{
    static const uint32_t levels332[3] = { 7, 7, 3 };
    uint8_t *row = band + (uint32_t)(y - y0) * stride;
    switch (format) {
    case SMEAR_XRGB8888: {
        uint32_t *out = (uint32_t *)(void *)row + x;
        for (int32_t i = 0; i < n; i++)
            out[i] = in[i] & 0xffffffu;
        break;
    }
    case SMEAR_RGB565:
    case SMEAR_RGB565_SWAPPED:
        if (dither == SMEAR_DITHER_NONE) {
            uint16_t *out = (uint16_t *)(void *)row + x;
            if (smear_convert_is_swapped(format))
                row_rgb565(out, in, n, true);
            else
                row_rgb565(out, in, n, false);
            break;
        }
        row_16bit_dithered(row + 2 * x, in, n, x, y, format, dither);
        break;
    case SMEAR_RGB555:
        row_16bit_dithered(row + 2 * x, in, n, x, y, format, dither);
        break;
    case SMEAR_RGB332:
        for (int32_t i = 0; i < n; i++) {
            uint32_t c[3];
            rgb_levels(in[i], x + i, y, dither, c, levels332);
            row[x + i] = (uint8_t)(c[0] << 5 | c[1] << 2 | c[2]);
        }
        break;
    case SMEAR_L8:
        for (int32_t i = 0; i < n; i++)
            row[x + i] = (uint8_t)luma(in[i]);
        break;
    case SMEAR_L4:
        for (int32_t i = 0; i < n; i++) {
            uint32_t level = grey_level(in[i], x + i, y, 15, dither);
            uint8_t *pair = row + (x + i) / 2;
            *pair = (x + i) & 1 ? (uint8_t)(*pair | level) : (uint8_t)(level << 4);
        }
        break;
    case SMEAR_L1:
        for (int32_t i = 0; i < n; i++) {
            uint8_t *byte = row + (x + i) / 8;
            if (((x + i) & 7) == 0)
                *byte = 0;
            if (grey_level(in[i], x + i, y, 1, dither) != 0)
                *byte = (uint8_t)(*byte | 0x80 >> ((x + i) & 7));
        }
        break;
    case SMEAR_L1_PAGES:
        row = band + (uint32_t)((y - y0) / 8) * stride;
        for (int32_t i = 0; i < n; i++)
            if (grey_level(in[i], x + i, y, 1, dither) != 0)
                row[x + i] = (uint8_t)(row[x + i] | 1 << ((y - y0) & 7));
        break;
    }
}

uint32_t smear_crc32(uint32_t crc, const uint8_t *bytes, uint32_t size)
{
    /* Four bits at a time: a table of 16 words, and no 64-bit or table start-up anywhere. */
    static const uint32_t nibble[16] = {
        0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu, 0x76dc4190u, 0x6b6b51f4u, 0x4db26158u,
        0x5005713cu, 0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu, 0x9b64c2b0u, 0x86d3d2d4u,
        0xa00ae278u, 0xbdbdf21cu
    };
    crc = ~crc;
    for (; size > 0; size--) {
        crc ^= *bytes++;
        crc = crc >> 4 ^ nibble[crc & 15u];
        crc = crc >> 4 ^ nibble[crc & 15u];
    }
    return ~crc;
}

/* SPDX-License-Identifier: MIT */
/* pixel_format.c - rounding and dither to the display's formats; loops that pay off in more than one form are in
 * kernels/pixel_rows.h. */
#include "display/pixel_format.h"

#include "base/tables.h"
#include "kernels/pixel_rows.h"

enum { HAS_BLUE = SMEAR_WITH_DITHER && SMEAR_WITH_DISPLAY };

bool smear_format_has(int format, int dither)
{
    static const bool has[] = {
        SMEAR_WITH_RGB, SMEAR_WITH_RGB565, SMEAR_WITH_RGB565, SMEAR_WITH_RGB, SMEAR_WITH_RGB,
        SMEAR_WITH_GREY, SMEAR_WITH_GREY, SMEAR_WITH_GREY, SMEAR_WITH_GREY
    };
    if (format > SMEAR_L1_PAGES || dither > (SMEAR_WITH_DISPLAY ? SMEAR_DITHER_DIFFUSE : SMEAR_DITHER_BLUE) || !has[format])
        return false;
    if (SMEAR_WITH_DISPLAY && dither == SMEAR_DITHER_DIFFUSE)
        return format >= SMEAR_L4;
    return format == SMEAR_XRGB8888 || format == SMEAR_L8 || dither == SMEAR_DITHER_NONE
        || (SMEAR_WITH_DITHER && (dither == SMEAR_DITHER_ORDERED || SMEAR_WITH_DISPLAY));
}

uint32_t smear_format_stride(int32_t width, smear_format format)
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

uint32_t smear_format_size(int32_t width, int32_t rows, smear_format format)
{
    uint32_t lines = (uint32_t)rows;
    if (format == SMEAR_L1_PAGES)
        lines = (lines + 7) / 8;
    return smear_format_stride(width, format) * lines;
}

void smear_format_swap(uint16_t *pixels, int32_t n)
{
    for (; n > 0; n--, pixels++)
        *pixels = (uint16_t)(*pixels >> 8 | *pixels << 8);
}

/* A row of thresholds, in 1/256 of a level: column x has value[x & mask]; null where levels are the nearest. */
struct thresholds {
    const uint8_t *value;
    int32_t mask;
};

static inline struct thresholds thresholds_of(int32_t y, smear_dither dither)
{
    if (!SMEAR_WITH_DITHER || dither == SMEAR_DITHER_NONE)
        return (struct thresholds){ NULL, 7 };
    if (HAS_BLUE && dither == SMEAR_DITHER_BLUE)
        return (struct thresholds){ smear_dither_blue + ((y & 31) << 5), 31 };
    return (struct thresholds){ smear_dither_ordered + ((y & 7) << 3), 7 };
}

static inline uint32_t level_at(uint32_t code, uint32_t levels, int32_t x, const struct thresholds *t)
{
    return SMEAR_WITH_DITHER && t->value != NULL ? level_dithered(code, levels, t->value[x & t->mask]) : level_nearest(code, levels);
}

static inline enum row_16bit layout_of(smear_format format)
{
    return SMEAR_WITH_RGB && format == SMEAR_RGB555 ? ROW_555 : format == SMEAR_RGB565_SWAPPED ? ROW_565_SWAPPED : ROW_565;
}

static inline bool format_is_16bit(smear_format format)
{
    return (SMEAR_WITH_RGB565 && (format == SMEAR_RGB565 || format == SMEAR_RGB565_SWAPPED))
        || (SMEAR_WITH_RGB && format == SMEAR_RGB555);
}

static void row_rgb16(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, enum row_16bit layout, const struct thresholds *t)
{
    if (SMEAR_WITH_DITHER && t->value != NULL)
        row_dithered(out, in, n, x, t->value, t->mask, layout);
    else
        row_nearest(out, in, n, layout);
}

static void row_rgb332(uint8_t *out, const uint32_t *in, int32_t n, int32_t x, const struct thresholds *t)
{
    for (; n > 0; n--, in++, x++)
        *out++ = (uint8_t)(level_at(pixel_red(*in), 7, x, t) << 5 | level_at(pixel_green(*in), 7, x, t) << 2
                           | level_at(pixel_blue(*in), 3, x, t));
}

static void row_l8(uint8_t *out, const uint32_t *in, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        out[i] = (uint8_t)pixel_luma(in[i]);
}

/* Sets bits where pixels are white: eight columns share a byte, which is cleared before, or each has its own, whose bit is `page`. */
static void row_bits(uint8_t *row, const uint32_t *in, int32_t n, int32_t x, int page, const struct thresholds *t)
{
    for (const int32_t end = x + n; x < end; x++, in++) {
        uint8_t *byte = row + (page < 0 ? x >> 3 : x);
        if (page < 0 && (x & 7) == 0)
            *byte = 0;
        *byte = (uint8_t)(*byte | level_at(pixel_luma(*in), 1, x, t) << (page < 0 ? 7 - (x & 7) : page));
    }
}

void smear_format_row(uint8_t *band, uint32_t stride, const uint32_t *in, int32_t n, int32_t x, int32_t y,
                      int32_t y0, smear_format format, smear_dither dither)
{
    const struct thresholds t = thresholds_of(y, dither);
    uint8_t *row = band + (uint32_t)(y - y0) * stride;
    if (SMEAR_WITH_RGB && format == SMEAR_XRGB8888)
        row_xrgb8888((uint32_t *)(void *)row + x, in, n);
    else if (format_is_16bit(format))
        row_rgb16((uint16_t *)(void *)row + x, in, n, x, layout_of(format), &t);
    else if (SMEAR_WITH_RGB && format == SMEAR_RGB332)
        row_rgb332(row + x, in, n, x, &t);
    else if (SMEAR_WITH_GREY && format == SMEAR_L8)
        row_l8(row + x, in, n);
    else if (SMEAR_WITH_GREY && format == SMEAR_L4)
        row_l4_from_eights(row, in, n, x, t.value, t.mask);
    else if (SMEAR_WITH_GREY && format == SMEAR_L1)
        row_bits(row, in, n, x, -1, &t);
    else if (SMEAR_WITH_GREY && format == SMEAR_L1_PAGES)
        row_bits(band + (uint32_t)((y - y0) / 8) * stride, in, n, x, (y - y0) & 7, &t);
}

bool smear_format_rows(uint8_t *band, uint32_t stride, const uint32_t *in, int32_t in_stride, int32_t rows, int32_t n, int32_t x,
                       int32_t y, smear_format format, smear_dither dither)
{
    uint16_t *const out = (uint16_t *)(void *)band + x;
    if (!SMEAR_ROWS_AT_ONCE || !format_is_16bit(format) || !SMEAR_WITH_DITHER || dither != SMEAR_DITHER_ORDERED || ((n | x) & 7) != 0
        || (((uintptr_t)out | stride) & 3u) != 0)
        return false;
    const struct dithered_rows r = { .out = out, .in = in, .out_stride = (ptrdiff_t)(stride / 2), .in_stride = in_stride,
                                     .rows = rows, .n = n, .x = x, .y = y };
    smear_rows_dithered_blocks(&r, layout_of(format));
    return true;
}

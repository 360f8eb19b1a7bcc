/* SPDX-License-Identifier: MIT */
/* pixel_format.h - turns working pixels into the display's formats. */
#ifndef SMEAR_PIXEL_FORMAT_H
#define SMEAR_PIXEL_FORMAT_H

#include "smear.h"

#include "base/base.h"
#include "kernels/vector.h"

/* Whether the format was compiled in, with that dither. */
bool smear_format_has(int format, int dither);

/* Returns the bytes of a row of pixels, or of a page of eight rows for SMEAR_L1_PAGES. */
uint32_t smear_format_stride(int32_t width, smear_format format);

/* Returns the bytes of `rows` pixel rows. */
uint32_t smear_format_size(int32_t width, int32_t rows, smear_format format);

/* Writes n pixels that start at (x, y) of the frame into `band`, whose first row is y0. Formats of less than a byte per
 * pixel need x (SMEAR_L1_PAGES: y0) on a multiple of 8. Rows of a page are added to it, so its band starts at zero. */
void smear_format_row(uint8_t *band, uint32_t stride, const uint32_t *in, int32_t n, int32_t x, int32_t y,
                      int32_t y0, smear_format format, smear_dither dither);

/* Writes `rows` rows of n pixels, `in_stride` pixels apart, into `band`, whose first row is y. False where that is no faster than
 * row by row: then nothing is written. */
bool smear_format_rows(uint8_t *band, uint32_t stride, const uint32_t *in, int32_t in_stride, int32_t rows, int32_t n, int32_t x,
                       int32_t y, smear_format format, smear_dither dither);

/* Whether the bytes of a pixel are not in this machine's order; smear_format_swap exchanges them. */
static inline bool smear_format_is_swapped(smear_format format)
{
    const bool big = SMEAR_BIG_ENDIAN;
    return (format == SMEAR_RGB565_SWAPPED) != big;
}

void smear_format_swap(uint16_t *pixels, int32_t n);

/* SMEAR_DITHER_DIFFUSE: what rounding a pixel to few greys leaves over goes to its neighbours. */

/* Whether bands are drawn in 8-bit grey and made the display's pixels when they are whole. */
static inline bool format_diffuses(const smear_desc *d)
{
    return SMEAR_WITH_GREY && SMEAR_WITH_DISPLAY && d->display.dither == SMEAR_DITHER_DIFFUSE;
}

/* Returns the bytes of what a row leaves to the next one. */
static inline uint32_t smear_diffuse_bytes(int32_t width)
{
    return 3u * (uint32_t)width + 4u;
}

#endif

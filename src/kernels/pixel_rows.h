/* SPDX-License-Identifier: MIT */
/* pixel_rows.h - rows of pixels (0x??RRGGBB, whose top byte does not matter) in the display's formats.
 *
 * Undithered levels are the nearest. Dithered ones are floor(c levels / 255 + threshold): white stays white and black
 * black. Variants live on what rows of pictures have: neighbours of one colour. */
#ifndef SMEAR_KERNELS_PIXEL_ROWS_H
#define SMEAR_KERNELS_PIXEL_ROWS_H

#include "base/pixel.h"
#include "kernels/vector.h"
#include "kernels/fill.h"

/* ------------------------------------------------------------------ levels */

/* Returns level c levels / 255 in q16: c 257 / 65536 is c / 255 for all that matters here, and exactly 1 at 255. */
static inline uint32_t level_q16(uint32_t code, uint32_t levels)
{
    return code * (257u * levels) + (code >> 7) * levels;
}

/* Returns the dithered level of a code; `threshold` is in 1/256 of a level. */
static inline uint32_t level_dithered(uint32_t code, uint32_t levels, uint32_t threshold)
{
    return (level_q16(code, levels) + (threshold << 8)) >> 16;
}

static inline uint32_t level_nearest(uint32_t code, uint32_t levels)
{
    return (code * levels * 2u + 255u) / 510u;
}

/* Returns the luma of codes, with the weights of BT.601 that display code expects: (77 r + 150 g + 29 b) / 256. */
static inline uint32_t pixel_luma(uint32_t p)
{
    return (77u * pixel_red(p) + 150u * pixel_green(p) + 29u * pixel_blue(p) + 128u) >> 8;
}

/* ------------------------------------------------------------------ XRGB8888 */

/* Stores n >= 0 pixels with a top byte of 0; `out` may be `in`. */
static inline void row_xrgb8888_reference(uint32_t *out, const uint32_t *in, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        out[i] = in[i] & 0xffffffu;
}

#if SMEAR_VECTORS
/* Takes four pixels a round. */
static inline void row_xrgb8888_vector(uint32_t *out, const uint32_t *in, int32_t n)
{
    int32_t i = 0;
    for (; i + 4 <= n; i += 4)
        v4u_store(out + i, v4u_load(in + i) & 0xffffffu);
    for (; i < n; i++)
        out[i] = in[i] & 0xffffffu;
}
#endif

static inline void row_xrgb8888(uint32_t *out, const uint32_t *in, int32_t n)
{
#if SMEAR_VECTORS
    row_xrgb8888_vector(out, in, n);
#else
    row_xrgb8888_reference(out, in, n);
#endif
}

/* ------------------------------------------------------------------ 16 bits, nearest levels */

/* Exchanges the bytes of 16 bits where the display wants them in the other order than this machine has: the high one
 * first where `swapped`, else the low one. */
static inline uint32_t bytes_ordered(uint32_t packed, bool swapped)
{
    return swapped != SMEAR_BIG_ENDIAN ? packed >> 8 | (packed << 8 & 0xff00u) : packed;
}

/* Layouts: blue over green over red, 5 bits each; red over green over blue, 5, 6 and 5; the latter with its high byte
 * first. */
enum row_16bit { ROW_555, ROW_565, ROW_565_SWAPPED };

SMEAR_INLINE uint32_t nearest_16bit(uint32_t p, enum row_16bit format)
{
    if (SMEAR_WITH_RGB && format == ROW_555)
        return bytes_ordered(rgb555_nearest(p), false);
    return bytes_ordered(rgb565_nearest(p), format == ROW_565_SWAPPED);
}

/* Stores n >= 0 pixels. Memory does not overlap. */
static inline void row_nearest_reference(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
    while (n-- > 0)
        *out++ = (uint16_t)nearest_16bit(*in++, format);
}

#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
/* Stores eight pixels a round. */
void smear_row_nearest_vector(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format);
#endif

static inline void row_nearest(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
    smear_row_nearest_vector(out, in, n, format);
#else
    row_nearest_reference(out, in, n, format);
#endif
}

/* ------------------------------------------------------------------ 16 bits, dithered */

/* Stores n >= 0 dithered pixels from column x on; column c has the threshold[c & mask], in 1/256 of a level. Memory
 * does not overlap. Runs of one colour share its levels: only thresholds differ. */
static inline void row_dithered_reference(uint16_t *out, const uint32_t *in, int32_t n, int32_t x,
                                          const uint8_t *threshold, int32_t mask, enum row_16bit format)
{
    const bool is_555 = SMEAR_WITH_RGB && format == ROW_555, swapped = format == ROW_565_SWAPPED;
    uint32_t last = n > 0 ? ~*in : 0, high = 0, green = 0, low = 0;
    for (; n > 0; n--, in++) {
        if (*in != last) {
            last = *in;
            high = level_q16(is_555 ? pixel_blue(last) : pixel_red(last), 31);
            green = level_q16(pixel_green(last), is_555 ? 31 : 63);
            low = level_q16(is_555 ? pixel_red(last) : pixel_blue(last), 31);
        }
        uint32_t t = (uint32_t)threshold[x++ & mask] << 8;
        uint32_t packed = ((high + t) >> 16) << (is_555 ? 10 : 11) | ((green + t) >> 11 & 0x7e0u)
                        | (low + t) >> 16;
        *out++ = (uint16_t)bytes_ordered(packed, swapped);
    }
}

/* Rows y, y + 1 ... of n >= 0 columns from x on; row y has the thresholds (y & mask) (mask + 1) and following. */
struct dithered_rows {
    uint16_t *out;
    const uint32_t *in;
    ptrdiff_t out_stride, in_stride;        /* pixels */
    int32_t rows, n, x, y;
    const uint8_t *threshold;
    int32_t mask;
};

#ifndef __OPTIMIZE_SIZE__
/* Stores dithered pixels by eight thresholds of the form 4 k + 2 (mask is 7). A block of eight columns of one colour
 * looks like the last of its colour in this row; other pixels take one sum for two channels. */
void smear_row_dithered_blocks(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                               enum row_16bit format);

#endif
/* The same of rows that have the thresholds of smear_dither_ordered, whatever r says of thresholds. They are whole blocks: x and n are
 * multiples of eight, and each begins at a multiple of four bytes. */
void smear_rows_dithered_blocks(const struct dithered_rows *r, enum row_16bit format);
#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
/* Stores eight pixels a round, by thresholds of the form 4 k + 2 (mask is 7), or by any (31). */
void smear_row_dithered_vector(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                               int32_t mask, enum row_16bit format);
#endif

static inline void row_dithered(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                                int32_t mask, enum row_16bit format)
{
#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
    smear_row_dithered_vector(out, in, n, x, threshold, mask, format);
#else
#ifndef __OPTIMIZE_SIZE__
    if (mask == 7) {
        smear_row_dithered_blocks(out, in, n, x, threshold, format);
        return;
    }
#endif
    row_dithered_reference(out, in, n, x, threshold, mask, format);
#endif
}

/* ------------------------------------------------------------------ L4 */

static inline uint32_t l4_grey(uint32_t p, bool dithered)
{
    return dithered ? level_q16(pixel_luma(p), 15) : level_nearest(pixel_luma(p), 15) << 16;
}

/* Stores the levels of n >= 0 greys from column x on, two in a byte, the left one above; column c has the
 * threshold[c & mask], or none where threshold is null: then levels are the nearest. `row` begins with column 0. A byte
 * with two columns is written where the row has the right one, a last left one with 0 below it. */
static inline void row_l4_reference(uint8_t *row, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                                    int32_t mask)
{
    uint32_t last = n > 0 ? ~*in : 0, grey = 0, left = 0;
    uint8_t *pair = row + x / 2;
    for (int32_t i = 0; i < n; i++) {
        if (in[i] != last) {
            last = in[i];
            grey = l4_grey(last, threshold != NULL);
        }
        uint32_t level = (grey + (threshold != NULL ? (uint32_t)threshold[(x + i) & mask] << 8 : 0u)) >> 16;
        if (((x + i) & 1) != 0) {
            *pair++ = (uint8_t)(left | level);
        } else {
            left = level << 4;
            *pair = (uint8_t)left;
        }
    }
}

#ifndef __OPTIMIZE_SIZE__
/* Takes eight thresholds (mask is 7), or none; x is a multiple of eight. A block of eight columns of one colour looks
 * like the last of its colour. */
void smear_row_l4_blocks(uint8_t *row, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold);
#endif

/* The same from a multiple of eight columns on. */
static inline void row_l4_from_eights(uint8_t *row, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold, int32_t mask)
{
#ifndef __OPTIMIZE_SIZE__
    if (mask == 7 && (x & 7) == 0) {    /* tiles of four columns begin between blocks */
        smear_row_l4_blocks(row, in, n, x, threshold);
        return;
    }
#endif
    row_l4_reference(row, in, n, x, threshold, mask);
}

#endif

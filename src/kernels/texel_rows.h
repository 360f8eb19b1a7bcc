/* SPDX-License-Identifier: MIT */
/* texel_rows.h - texels in rows of a triangle, eight or sixteen pixels at once: for processors that have AVX2. */
#ifndef SMEAR_KERNELS_TEXEL_ROWS_H
#define SMEAR_KERNELS_TEXEL_ROWS_H

#include "kernels/avx2.h"
#include "kernels/span_side.h"
#include "kernels/texel_lit.h"
#include "kernels/texel_places.h"
#include "kernels/texel_run.h"
#include "kernels/texel_spans.h"

#if SMEAR_AVX2

/* The least columns that may be written. */
enum { TEXEL_ROWS_LEAST = 16 };

/* Pictures of any size, that repeat, stay at their borders or turn back there. Planes are texels q16, or if they are divided
 * ratios q27; polynomials ratios q29: texels of a ratio q29 are its product with the scale / 2^32, shifted up, or down if that
 * is negative. Numbers of u, then of v. */
struct texel_wraps {
    int32_t size[2], scale[2];
    int wrap[2], shift[2];              /* smear_wrap */
};

/* Where texels are taken from, and pixels lie: pixel 0 of row 0, which may lie outside the memory; in all rows columns
 * [x0, x1), which are TEXEL_ROWS_LEAST at least, may be written as they are. */
struct texel_rows {
    const void *texels;                 /* if copied, RGB565 if narrow, else 32 bits; a multiple of four */
    const struct texel_lights *lights;  /* null: they are copied */
    int log2_width, log2_height;        /* 1 .. 12 */
    const struct texel_wraps *wraps;    /* or null: sizes are those powers of two, and repeat. With them texels are lit, and four at
                                         * least */
    void *color;
    uint16_t *depth;
    ptrdiff_t stride;                   /* pixels */
    int32_t x0, x1;
    bool narrow;
};

/* Draws pixels whose depth codes are greater than those in memory, which they replace, by the texels at coordinates that
 * are exact at the ends of blocks, or at every pixel of rows that have SHORT_SPAN pixels at most or blocks of one. By AVX2
 * a third of the instructions of texels_draw and its callers, and less than half the time. */
void smear_texel_rows_places_reference(const struct texel_rows *t, const struct texel_spans *s, const struct texel_planes *p);
void smear_texel_rows_places_avx2(const struct texel_rows *t, const struct texel_spans *s, const struct texel_planes *p);

/* A polynomial of x and y, modulo 2^32. */
struct texel_curve {
    uint32_t at, dx, dy, dxx, dxy, dyy;
};

/* Coordinates are polynomials of x - x0 and row - y0, those of v given in steps above what u would carry. */
struct texel_curves {
    int32_t x0, y0;
    struct texel_curve u, v;
    int32_t block;                      /* with wraps: 4, 8 or 16 pixels, at whose first coordinates are exact */
};

void smear_texel_rows_curves_reference(const struct texel_rows *t, const struct texel_spans *s, const struct texel_curves *p);
void smear_texel_rows_curves_avx2(const struct texel_rows *t, const struct texel_spans *s, const struct texel_curves *p);

/* The most rows of a triangle, a multiple of sixteen. */
enum { TEXEL_SIDES = 64 };

/* Rows of a triangle one below the other, from row 0 on, that lie in columns [x0, x1) where there are any; columns are below 2^15.
 * Sides of a multiple of sixteen rows are read. Depth codes 16.16 at column 0 are z + row dz_down. */
struct texel_sides {
    const struct span_side *side;
    int32_t count;
    uint32_t z, dz, dz_down;
};

/* The same of whole rows: columns of eight pixels are stepped down, which takes half the instructions where rows are short. */
void smear_texel_columns_reference(const struct texel_rows *t, const struct texel_sides *s, const struct texel_curves *p);
void smear_texel_columns_avx2(const struct texel_rows *t, const struct texel_sides *s, const struct texel_curves *p);

#endif

#endif

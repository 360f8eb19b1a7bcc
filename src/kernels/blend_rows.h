/* SPDX-License-Identifier: MIT */
/* blend_rows.h - rows of a triangle of one colour that is blended, eight pixels at once: for processors that have AVX2. */
#ifndef SMEAR_KERNELS_BLEND_ROWS_H
#define SMEAR_KERNELS_BLEND_ROWS_H

#include "base/pixel.h"
#include "kernels/texel_rows.h"

#if SMEAR_AVX2

/* Where pixels lie: pixel 0 of row 0 in each plane, which may lie outside the memory; in all rows columns [x0, x1), which are
 * BLEND_ROWS_LEAST at least, may be written as they are. */
enum { BLEND_ROWS_LEAST = 8 };
struct blend_rows {
    uint32_t *color;
    const uint16_t *depth;
    ptrdiff_t color_stride, depth_stride;       /* pixels */
    int32_t turn;                               /* rows from this on have colours so many pixels farther back: */
    ptrdiff_t back;
    int32_t x0, x1;
    uint32_t over;                              /* 0xAARRGGBB */
    bool linear;
};

/* Where the colours of column 0 of a row lie. */
static inline uint32_t *blend_rows_color(const struct blend_rows *t, int32_t row)
{
    return t->color + (row * t->color_stride - (row >= t->turn ? t->back : 0));
}

/* Blends the colour by its alpha over pixels whose depth codes are less, by pixel_blend. */
static inline void blend_rows_reference(const struct blend_rows *t, const struct texel_spans *s)
{
    for (int32_t i = 0; i < s->count; i++) {
        uint32_t *const color = blend_rows_color(t, s->row[i]);
        const uint16_t *const depth = t->depth + s->row[i] * t->depth_stride;
        for (int32_t x = s->a[i]; x < s->b[i]; x++)
            if ((s->z[i] + s->dz[i] * (uint32_t)x) >> 16 > depth[x])
                color[x] = pixel_blend(color[x], t->over, pixel_alpha(t->over), t->linear);
    }
}

/* A fifth of the instructions of span.c. */
void smear_blend_rows_avx2(const struct blend_rows *t, const struct texel_spans *s);

#endif

#endif

/* SPDX-License-Identifier: MIT */
/* shade_rows.h - rows of a triangle whose colours change from pixel to pixel, eight pixels at once: for processors that have
 * AVX2. */
#ifndef SMEAR_KERNELS_SHADE_ROWS_H
#define SMEAR_KERNELS_SHADE_ROWS_H

#include "kernels/light_planes.h"
#include "kernels/shade_run.h"
#include "kernels/texel_rows.h"

#if SMEAR_AVX2

/* Where pixels lie: pixel 0 of row 0, which may lie outside the memory; in all rows columns [x0, x1), which are
 * SHADE_ROWS_LEAST at least, may be written as they are. */
enum { SHADE_ROWS_LEAST = 16 };
struct shade_rows {
    void *color;
    uint16_t *depth;
    ptrdiff_t stride;               /* pixels */
    int32_t x0, x1;
    struct light_planes light;      /* at column 0 of row 0 */
    bool linear, narrow;
};

/* Draws pixels whose depth codes are greater than those in memory, which they replace. A third of the instructions of
 * shade_run and its callers. */
static inline void shade_rows_reference(const struct shade_rows *t, const struct texel_spans *s)
{
    for (int32_t i = 0; i < s->count; i++)
        for (int32_t x = s->a[i]; x < s->b[i]; x++) {
            const ptrdiff_t at = s->row[i] * t->stride + x;
            struct shade k = { { 0, 0, 0 }, { 0, 0, 0 } };
            light_planes_at(k.c, &t->light, s->left[i], s->right[i], t->light.block, x, s->row[i]);
            shade_run_reference(t->narrow ? (void *)((uint16_t *)t->color + at) : (uint32_t *)t->color + at, t->depth + at, 1,
                                s->z[i] + s->dz[i] * (uint32_t)x, 0, &k, t->linear, t->narrow);
        }
}

void smear_shade_rows_avx2(const struct shade_rows *t, const struct texel_spans *s);

#endif

#endif

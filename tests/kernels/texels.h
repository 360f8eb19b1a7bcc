/* SPDX-License-Identifier: MIT */
/* texels.h - what kernels of copied texels are to draw, pixel by pixel. */
#ifndef TEXELS_TEST_H
#define TEXELS_TEST_H

#include "kernels/texel_blocks_armv7em.h"
#include "kernels/texel_curve_rows.h"
#include "kernels/texels_draw.h"

SMEAR_INLINE void texels_draw_reference(struct texel_run *run, int32_t n, int log2_width, int log2_height,
                                        enum texel_kind kind)
{
    struct texel_run r = *run;
    for (; n > 0; n--) {
        texel_pixel(r.color, r.depth, r.z, r.texels, r.light, texel_run_uv(&r), log2_width, log2_height, kind);
        texel_run_advance(&r, 1, texels_are_narrow(kind));
        texel_run_step(&r);
        r.z += r.dz;
    }
    run->color = r.color;
    run->depth = r.depth;
    run->z = r.z;
}

static inline uint32_t curve_at(const struct curve *p, uint32_t x, uint32_t y, uint32_t *step)
{
    const uint32_t dxx = (uint32_t)p->dxx, dx = (uint32_t)p->dxy * y + (uint32_t)p->dx + dxx * x;
    *step = dx + dxx * (x + 1u);
    return (uint32_t)p->at + ((uint32_t)p->dyy * y + (uint32_t)p->dy) * y + dx * x;
}

static inline void texel_curve_rows_reference(struct texel_curve_rows *r, int log2_width, int log2_height, enum texel_kind kind)
{
    for (int32_t row = 0; row < r->count; row++) {
        const int32_t left = r->side[row].left, n = r->side[row].right - left, bytes = row * r->stride + 2 * left;
        struct texel_run run = { .dz = r->dz, .texels = r->texels };
        struct texcoord c = { .curvature_u = 0u - r->ddu, .curvature_v = 0u - r->ddv };
        c.u = curve_at(&r->u, (uint32_t)(left - r->x0), (uint32_t)(r->y + row), &c.du);
        c.v = curve_at(&r->v, (uint32_t)(left - r->x0), (uint32_t)(r->y + row), &c.dv);
        texcoord_run(&run, c);
        texel_run_start(&run, log2_width, log2_height);
        run.z = r->z + r->dz_down * (uint32_t)row + r->dz * (uint32_t)left;
        run.depth = (uint16_t *)((uintptr_t)r->depth + (uintptr_t)bytes);
        run.color = (void *)((uintptr_t)run.depth * (texels_are_narrow(kind) ? 1u : 2u) + (uintptr_t)r->to_pixels);
        if (n > 0)
            texels_draw_reference(&run, n, log2_width, log2_height, kind);
    }
}

static inline void texel_blocks_reference(struct texel_track *k, int32_t count, int32_t rest, int log2_width, int log2_height,
                                          enum texel_kind kind)
{
    for (; count > 0; count--) {
        texel_track_next_reference(k);
        texels_draw_reference(&k->run, 1 << k->log2, log2_width, log2_height, kind);
    }
    while (rest > 0) {
        const int32_t n = block_next(1 << k->log2, rest);
        texel_track_part_reference(k, n);
        rest -= n;
        texels_draw_reference(&k->run, n + (rest == 0), log2_width, log2_height, kind);
    }
}

#endif

/* SPDX-License-Identifier: MIT */
/* texture_curves.h - rows of copied texels whose coordinates are polynomials, by a kernel. */
#ifndef SMEAR_TEXTURE_CURVES_H
#define SMEAR_TEXTURE_CURVES_H

#include "kernels/texel_curves_armv6m.h"
#include "kernels/texel_curves_armv7em.h"
#include "raster/texture_rows.h"

#if TEXEL_CURVES_ASM
static inline struct texel_polynomial polynomial_of(const struct curve *c)
{
    return (struct texel_polynomial){ (uint32_t)c->at, (uint32_t)c->dx, (uint32_t)c->dy, (uint32_t)c->dxx, (uint32_t)c->dxy,
                                      (uint32_t)c->dyy };
}

/* Whole rows of copied texels. */
SMEAR_INLINE void draw_whole_curves(const struct setup *s, const struct span_rows *r, int log2_width, int log2_height)
{
    const struct smear_raster_target *target = s->target;
    const struct texture_setup *t = &s->texture;
    struct texel_curve_rows rows = {
        .side = r->side, .count = r->count, .y = r->y - t->y0, .z = code_from_units(plane_at(&s->depth, 0, r->y), s->slope),
        .depth = target->depth + r->at, .x0 = t->x0, .dz_down = (uint32_t)step_from_units(s->depth.dy, s->slope),
        .stride = 2 * target->window_rows.stride, .u = polynomial_of(&t->curve[0]), .v = polynomial_of(&t->curve[1]),
        .dz = (uint32_t)step_from_units(s->depth.dx, s->slope),
        .to_depth = (int32_t)((uintptr_t)target->depth - (uintptr_t)target->direct), .texels = s->draw->sampler.texels
    };
    rows.ddu = 2 * rows.u.dxx;
    rows.ddv = 2 * rows.v.dxx;
#if SMEAR_ASM_ARMV6M
    texel_curve_rows_armv6m(&rows, log2_width, log2_height);
#else
    texel_curve_rows_armv7em(&rows, log2_width, log2_height);
#endif
}
#endif

#endif

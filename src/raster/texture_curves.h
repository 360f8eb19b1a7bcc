/* SPDX-License-Identifier: MIT */
/* texture_curves.h - rows of texels whose coordinates are polynomials. */
#ifndef SMEAR_TEXTURE_CURVES_H
#define SMEAR_TEXTURE_CURVES_H

#include "kernels/texel_curves_armv6m.h"
#include "kernels/texel_curves_armv7em.h"
#include "kernels/texel_run.h"
#include "raster/texture_rows.h"

#if SMEAR_SPAN_ROWS
/* Both coordinates' polynomials, and a row's run from pixel (x, y) of them on. */
#if TEXELS_PACKED
struct curves {
    uint64_t at, dx, dy, dxx, dxy, dyy;
};

SMEAR_INLINE void curves_start(struct curves *k, const struct curve *u, const struct curve *v, struct texel_run *r)
{
    k->at = packed_step((uint32_t)u->at, (uint32_t)v->at);
    k->dx = packed_step((uint32_t)u->dx, (uint32_t)v->dx);
    k->dy = packed_step((uint32_t)u->dy, (uint32_t)v->dy);
    k->dxx = packed_step((uint32_t)u->dxx, (uint32_t)v->dxx);
    k->dxy = packed_step((uint32_t)u->dxy, (uint32_t)v->dxy);
    k->dyy = packed_step((uint32_t)u->dyy, (uint32_t)v->dyy);
    r->dduv = 2 * k->dxx;
}

SMEAR_INLINE void curves_run(const struct curves *k, int32_t column, int32_t row, struct texel_run *r)
{
    const uint64_t x = (uint64_t)(int64_t)column, y = (uint64_t)(int64_t)row;
    const uint64_t dx = k->dx + k->dxy * y + k->dxx * x;
    r->uv = k->at + (k->dy + k->dyy * y) * y + dx * x;
    r->duv = dx + k->dxx * (x + 1);
}
#else
/* As they are needed: small cores have few registers. */
struct curve_words {
    uint32_t dxy, dx, dyy, dy, at, dxx;
};

struct curves {
    struct curve_words u, v;
};

SMEAR_INLINE void curves_start(struct curves *k, const struct curve *u, const struct curve *v, struct texel_run *r)
{
    k->u = (struct curve_words){ (uint32_t)u->dxy, (uint32_t)u->dx, (uint32_t)u->dyy, (uint32_t)u->dy, (uint32_t)u->at,
                                 (uint32_t)u->dxx };
    k->v = (struct curve_words){ (uint32_t)v->dxy, (uint32_t)v->dx, (uint32_t)v->dyy, (uint32_t)v->dy, (uint32_t)v->at,
                                 (uint32_t)v->dxx };
    r->ddu = 2 * k->u.dxx;
    r->ddv = 2 * k->v.dxx;
}

SMEAR_INLINE uint32_t curve_value(const struct curve_words *k, uint32_t x, uint32_t y, uint32_t *step)
{
    const uint32_t dx = k->dxy * y + k->dx, at = (k->dyy * y + k->dy) * y + k->at, along = k->dxx * x;
    *step = dx + along + along + k->dxx;
    return (dx + along) * x + at;
}

static SMEAR_NOINLINE void curves_run(const struct curves *k, int32_t x, int32_t y, struct texel_run *r)
{
    r->u = curve_value(&k->u, (uint32_t)x, (uint32_t)y, &r->du);
    r->v = curve_value(&k->v, (uint32_t)x, (uint32_t)y, &r->dv);
}
#endif

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
    texel_curve_rows_draw(&rows, log2_width, log2_height);
}
#endif

#endif

/* SPDX-License-Identifier: MIT */
/* texel_run.h - a row of textured pixels and where it has come to. */
#ifndef SMEAR_KERNELS_TEXEL_RUN_H
#define SMEAR_KERNELS_TEXEL_RUN_H

#include "kernels/fill.h"
#include "kernels/texel_light.h"

/* How texels become pixels. */
enum texel_kind {
    TEXELS_WIDE,            /* 0xAARRGGBB, copied */
    TEXELS_NARROW,          /* RGB565, copied */
    TEXELS_LIT,             /* of any format and light, to 32 bits */
    TEXELS_LIT_NARROW       /* to RGB565 */
};

SMEAR_INLINE bool texels_are_lit(enum texel_kind kind) { return kind >= TEXELS_LIT; }

SMEAR_INLINE bool texels_are_narrow(enum texel_kind kind)
{
    return kind == TEXELS_NARROW || kind == TEXELS_LIT_NARROW;
}

/* The texel at coordinates. */
SMEAR_INLINE uint32_t packed_index(uint64_t uv, int log2_width, int log2_height)
{
    return (uint32_t)(uv >> 32) >> (32 - log2_height) << log2_width | (uint32_t)uv >> (32 - log2_width);
}

/* Where words have 64 bits, one addition steps both coordinates: what u carries into v is the last bit of v, which the
 * bits of an index stay clear of (raster/texture.h). Elsewhere each is stepped alone. */
#if UINTPTR_MAX > 0xffffffffu
#define TEXELS_PACKED 1
struct texel_run {
    uint64_t uv, duv, dduv;
    void *color;
    uint16_t *depth;
    uint32_t z, dz;             /* depth codes, 16.16 */
    const void *texels;
    struct texel_light *light;  /* null where texels are copied */
    uint64_t bits, fold;        /* of an index; what brings those of u next to those of v */
};

/* Prepares for texels_draw; the texture's sizes are powers of two. */
SMEAR_INLINE void texel_run_start(struct texel_run *r, int log2_width, int log2_height)
{
    r->bits = (uint64_t)(0u - (1u << (32 - log2_height))) << 32 | (0u - (1u << (32 - log2_width)));
    r->fold = 1u + ((uint64_t)1 << (32 - log2_height));
    SMEAR_KEEP_VALUE(r->fold);          /* one product, not a shift and a sum */
}

SMEAR_INLINE uint64_t texel_run_uv(const struct texel_run *r) { return r->uv; }

SMEAR_INLINE void texel_run_step(struct texel_run *r)
{
    r->uv += r->duv;
    r->duv += r->dduv;
}

/* Steps n times. */
SMEAR_INLINE void texel_run_skip(struct texel_run *r, uint32_t n)
{
    r->uv += r->duv * n + r->dduv * (n * (n - 1u) / 2u);
    r->duv += r->dduv * n;
}

/* Both coordinates' polynomials, and a row's run from pixel (x, y) of them on. */
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
#define TEXELS_PACKED 0
struct texel_run {              /* the order in which the assembly loads registers */
    uint32_t dz, du, dv, ddu, ddv;
    int32_t count;              /* set by texels_draw */
    void *color;
    uint16_t *depth;
    uint32_t z, u, v;
    const void *texels;
    struct texel_light *light;
};

SMEAR_INLINE void texel_run_start(struct texel_run *r, int log2_width, int log2_height)
{
    (void)r, (void)log2_width, (void)log2_height;
}

SMEAR_INLINE uint64_t texel_run_uv(const struct texel_run *r) { return packed_uv(r->u, r->v); }

SMEAR_INLINE void texel_run_step(struct texel_run *r)
{
    r->u += r->du;
    r->v += r->dv;
    r->du += r->ddu;
    r->dv += r->ddv;
}

/* Steps n times. */
SMEAR_INLINE void texel_run_skip(struct texel_run *r, uint32_t n)
{
    const uint32_t pairs = n * (n - 1u) / 2u;
    r->u += r->du * n + r->ddu * pairs;
    r->v += r->dv * n + r->ddv * pairs;
    r->du += r->ddu * n;
    r->dv += r->ddv * n;
}

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

SMEAR_CALLED void curves_run(const struct curves *k, int32_t x, int32_t y, struct texel_run *r)
{
    r->u = curve_value(&k->u, (uint32_t)x, (uint32_t)y, &r->du);
    r->v = curve_value(&k->v, (uint32_t)x, (uint32_t)y, &r->dv);
}
#endif

/* Goes on by n pixels in memory; coordinates and depth stay. */
SMEAR_INLINE void texel_run_advance(struct texel_run *r, int32_t n, bool narrow)
{
    r->depth += n;
    r->color = pixel_after(r->color, n, narrow);
}

/* Pixel i becomes a texel. */
SMEAR_INLINE void texel_put(void *color, int32_t i, const void *texels, struct texel_light *light, uint32_t index,
                            enum texel_kind kind)
{
    if (kind == TEXELS_NARROW)
        ((uint16_t *)color)[i] = ((const uint16_t *)texels)[index];
    else if (kind == TEXELS_WIDE)
        ((uint32_t *)color)[i] = ((const uint32_t *)texels)[index];
    else if (kind == TEXELS_LIT_NARROW)
        ((uint16_t *)color)[i] = (uint16_t)texel_light_pixel(light, index, true);
    else
        ((uint32_t *)color)[i] = texel_light_pixel(light, index, false);
}

/* One pixel, where it is nearer. */
SMEAR_INLINE void texel_pixel(void *color, uint16_t *depth, uint32_t z, const void *texels, struct texel_light *light,
                              uint64_t uv, int log2_width, int log2_height, enum texel_kind kind)
{
    uint16_t code = (uint16_t)(z >> 16);
    if (code > *depth) {
        *depth = code;
        texel_put(color, 0, texels, light, packed_index(uv, log2_width, log2_height), kind);
    }
}

#endif

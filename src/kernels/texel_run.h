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

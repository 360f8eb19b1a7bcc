/* SPDX-License-Identifier: MIT */
/* texture.h - texels for a run of pixels. */
#ifndef SMEAR_TEXTURE_H
#define SMEAR_TEXTURE_H

#include "smear.h"

#include "fixed.h"

/* A texture as the raster reads it. */
struct smear_sampler {
    const void *texels;
    const uint32_t *palette;
    int32_t width, height;
    uint8_t format, wrap_u, wrap_v;
    bool bilinear, linear;
    uint8_t uv_shift;           /* mesh units: 2^uv_shift are the texture */
    bool turns;                 /* nearest texels of both sizes powers of two, repeated: a coordinate's upper bits say */
    uint8_t log2_width, log2_height;    /* with turns */
    int32_t scale_u, scale_v;   /* ratio (q29, of 2^15 mesh units) to texels (i32q16): mulh, then shift */
    int8_t shift_u, shift_v;
};

void smear_sampler_make(struct smear_sampler *s, const smear_texture *texture, int uv_shift,
                        bool bilinear, bool linear);

/* u / 2^15 in q29 (mesh units over 2^15) to texels. Wraps: textures repeat. */
static inline int32_t sampler_texel_u(const struct smear_sampler *s, int32_t ratio)
{
    int32_t t = mulh_i32(ratio, s->scale_u);
    return s->shift_u >= 0 ? shl_wrap(t, s->shift_u) : t >> -s->shift_u;
}

static inline int32_t sampler_texel_v(const struct smear_sampler *s, int32_t ratio)
{
    int32_t t = mulh_i32(ratio, s->scale_v);
    return s->shift_v >= 0 ? shl_wrap(t, s->shift_v) : t >> -s->shift_v;
}

/* Coordinates of a block of pixels, in turns or in texels q16: pieces of 2 pixels whose steps change by the bend. */
struct smear_texture_run {
    uint32_t u, v, du, dv;
    uint32_t bend_u, bend_v;
};

/* With turns: the texel at (u, v). */
static inline uint32_t sampler_index(const struct smear_sampler *s, uint32_t u, uint32_t v)
{
    /* Shifts by 32 would not do: sizes of one. */
    return (v >> 1 >> (31 - s->log2_height)) << s->log2_width | u >> 1 >> (31 - s->log2_width);
}

/* Texels of pixels [first, first + n) of a block, as 0xAARRGGBB. Any format, size, wrap. */
void smear_sample(uint32_t *out, const struct smear_sampler *s, const struct smear_texture_run *run, int first,
                  int n);

#endif

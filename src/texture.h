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
    bool masked;                /* both sizes powers of two */
    uint8_t log2_width;         /* when masked */
    uint32_t mask_u, mask_v;    /* when masked; mask_v is shifted up by log2_width */
    int32_t scale_u, scale_v;   /* ratio (q29, of 2^15 mesh units) to texels (i32q16): mulh, then shift */
    int8_t shift_u, shift_v;
    int8_t up_u, up_v;          /* when masked: texels = ratio q27 x 2^up */
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

/* Texels of n pixels from (u, v) in i32q16 texels, stepping by (du, dv), as 0xAARRGGBB. Any format, size, wrap. */
void smear_sample(uint32_t *out, const struct smear_sampler *s, int32_t u, int32_t v, int32_t du,
                  int32_t dv, int n);

#endif

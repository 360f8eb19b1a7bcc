/* SPDX-License-Identifier: MIT */
/* texture.h - texels for a run of pixels. */
#ifndef SMEAR_TEXTURE_H
#define SMEAR_TEXTURE_H

#include "smear.h"

#include "base/fixed.h"
#include "base/pixel.h"
#include "kernels/kernels.h"

/* A texture as the raster reads it. */
struct smear_sampler {
    const void *texels;
    const uint32_t *palette;
    int32_t width, height;
    uint8_t format, wrap_u, wrap_v;
    bool bilinear;
    smear_transfer transfer;
    uint8_t uv_shift;           /* mesh units: 2^uv_shift are the texture */
    bool turns;                 /* nearest texels of both sizes powers of two, repeated:
                                 * a coordinate's upper bits say */
    uint8_t log2_width, log2_height;    /* with turns */
    uint8_t levels;             /* with turns: smaller pictures behind the texels */
    int32_t scale[2];           /* u, v: ratio (q29, of 2^15 mesh units) to
                                 * texels (i32q16): mulh, then shift */
    int8_t shift[2];
    uint8_t uv_up;              /* records have 2^uv_up times the mesh's coordinates */
};

void smear_sampler_make(struct smear_sampler *s, const smear_texture *texture, int uv_shift,
                        bool bilinear, smear_transfer transfer);

/* The smaller picture `level`, 1 .. levels, instead. */
void smear_sampler_shrink(struct smear_sampler *s, int level);

/* u (axis 0) or v / 2^15 in q29 (mesh units over 2^15) to texels. Wraps: textures repeat. */
int32_t smear_sampler_texel(const struct smear_sampler *s, int axis, int32_t ratio);

/* Coordinates of a block of pixels: v above u, each in turns or in texels q16. One addition steps both (two
 * where words have 32 bits); what u carries into v is the last bit. Steps change by the curvature from pixel to pixel. */
struct smear_texture_run {
    uint64_t at, step, curvature;
};

/* With turns: the texel at (u, v). */
static inline uint32_t sampler_index(const struct smear_sampler *s, uint32_t u, uint32_t v)
{
    /* Shifts by 32 would not do: sizes of one. */
    return (v >> 1 >> (31 - s->log2_height)) << s->log2_width | u >> 1 >> (31 - s->log2_width);
}

/* The texel at u and v, q16 texels, as 0xAARRGGBB. Any format, size, wrap. */
uint32_t smear_sample_at(const struct smear_sampler *s, int32_t u, int32_t v);

/* Texels of pixels [first, first + n) of a block, as 0xAARRGGBB. Any format, size, wrap. */
void smear_sample(uint32_t *out, const struct smear_sampler *s, const struct smear_texture_run *run, int first, int n);

#endif

/* SPDX-License-Identifier: MIT */
/* texture.c - texel (floor(u W), floor(v H)), row 0 at the top; wrap modes; nearest and bilinear. */
#include "raster/texture.h"

#include "base/fixmath.h"
#include "base/pixel.h"
#include "kernels/texel_light.h"

static int log2_exact(uint32_t x)
{
    return (x & (x - 1)) == 0 ? 31 - count_leading_zeros(x) : -1;
}

/* Ratio q29 counts 2^15 mesh units: texels i32q16 = ratio size 2^(15 - uv_shift) 2^16 / 2^29. */
static int32_t scale_for(int32_t size, int uv_shift, int8_t *shift)
{
    int zeros = count_leading_zeros((uint32_t)size) - 2;        /* size 2^zeros lies in [2^29, 2^30) */
    *shift = (int8_t)(32 + 2 - uv_shift - zeros);
    return size << zeros;
}

void smear_sampler_make(struct smear_sampler *s, const smear_texture *texture, int uv_shift,
                        bool bilinear, smear_transfer transfer)
{
    bilinear = SMEAR_WITH_TEXTURE && bilinear;
    s->texels = texture->texels;
    s->palette = texture->palette;
    s->width = texture->width;
    s->height = texture->height;
    s->format = texture->format;
    s->wrap_u = texture->wrap_u;
    s->wrap_v = texture->wrap_v;
    s->bilinear = bilinear;
    s->transfer = transfer;
    s->uv_shift = (uint8_t)uv_shift;
    int log2_width = log2_exact(texture->width), log2_height = log2_exact(texture->height);
    s->turns = log2_width >= 0 && log2_height >= 0 && s->wrap_u == SMEAR_REPEAT && s->wrap_v == SMEAR_REPEAT
            && !bilinear;
    if (s->turns) {
        s->log2_width = (uint8_t)log2_width;
        s->log2_height = (uint8_t)log2_height;
    }
    s->levels = SMEAR_WITH_BOUNDS && s->turns ? texture->levels : 0;
    s->scale[0] = scale_for(texture->width, uv_shift, &s->shift[0]);
    s->scale[1] = scale_for(texture->height, uv_shift, &s->shift[1]);
}

void smear_sampler_shrink(struct smear_sampler *s, int level)
{
    const uint32_t size = s->format == SMEAR_TEXEL_8888 ? 4 : s->format == SMEAR_TEXEL_565 ? 2 : 1;
    const uint8_t *texels = (const uint8_t *)s->texels;
    for (; level > 0; level--) {
        texels += (uint32_t)s->width * (uint32_t)s->height * size;
        if (s->log2_width > 0) {
            s->width >>= 1;
            s->log2_width--;
            s->shift[0]--;
        }
        if (s->log2_height > 0) {
            s->height >>= 1;
            s->log2_height--;
            s->shift[1]--;
        }
    }
    s->texels = texels;
    s->levels = 0;
}

int32_t smear_sampler_texel(const struct smear_sampler *s, int axis, int32_t ratio)
{
    const int32_t scale = s->scale[axis], shift = s->shift[axis];
    int32_t t = scale == 1 << 29 ? ratio >> 3 : mulh_i32(ratio, scale);     /* powers of two */
    return shift >= 0 ? shl_wrap(t, shift) : t >> -shift;
}

static uint32_t fetch(const struct smear_sampler *s, uint32_t at)
{
    return texel_fetch(s->texels, s->palette, at, s->format);
}

/* Any integer texel coordinate into 0 .. size - 1. Divides only beyond the first period. */
static int32_t wrap(int32_t i, int32_t size, int mode)
{
    if (mode == SMEAR_CLAMP)
        return clamp_i32(i, 0, size - 1);
    int32_t period = mode == SMEAR_MIRROR ? 2 * size : size;
    if (SMEAR_SMALL_CODE || (uint32_t)i >= (uint32_t)period) {
        i %= period;
        i += i < 0 ? period : 0;
    }
    return i < size ? i : period - 1 - i;
}

static uint32_t texel(const struct smear_sampler *s, int32_t iu, int32_t iv)
{
    return fetch(s, (uint32_t)(wrap(iv, s->height, s->wrap_v) * s->width
                               + wrap(iu, s->width, s->wrap_u)));
}

/* Blends by weight 0 .. 256 towards b; alpha is always linear. */
static uint32_t mix_texels(uint32_t a, uint32_t b, uint32_t weight, smear_transfer transfer)
{
    uint32_t result = 0;
    for (int shift = 0; shift < 32; shift += 8)
        result |= code_mix(a >> shift & 255u, b >> shift & 255u, weight, shift < 24 ? transfer : TRANSFER_CODES) << shift;
    return result;
}

static uint32_t sample_bilinear(const struct smear_sampler *s, int32_t u, int32_t v)
{
    u = sub_wrap(u, 0x8000);
    v = sub_wrap(v, 0x8000);
    int32_t iu = u >> 16, iv = v >> 16;
    uint32_t fu = (uint32_t)u >> 8 & 255u, fv = (uint32_t)v >> 8 & 255u;
    uint32_t top = mix_texels(texel(s, iu, iv), texel(s, iu + 1, iv), fu, s->transfer);
    uint32_t bottom = mix_texels(texel(s, iu, iv + 1), texel(s, iu + 1, iv + 1), fu, s->transfer);
    return mix_texels(top, bottom, fv, s->transfer);
}

uint32_t smear_sample_at(const struct smear_sampler *s, int32_t u, int32_t v)
{
    if (SMEAR_WITH_TEXTURE && s->bilinear)
        return sample_bilinear(s, u, v);
    return texel(s, u >> 16, v >> 16);
}

/* The next texel of a run. */
static inline uint32_t sample_next(const struct smear_sampler *s, uint64_t at)
{
    if (s->turns)
        return texel_fetch(s->texels, s->palette, sampler_index(s, (uint32_t)at, (uint32_t)(at >> 32)), s->format);
    return smear_sample_at(s, (int32_t)at, (int32_t)(at >> 32));
}

/* Along a chord or a parabola. No coordinate is asked for after a loop, which would
 * be a product of 64 bits: small cores call for that. */
void smear_sample(uint32_t *out, const struct smear_sampler *s, const struct smear_texture_run *run, int first, int n)
{
    uint64_t at = run->at, step = run->step;
    const uint64_t curvature = run->curvature;
    if (first != 0) {
        at += step * (uint32_t)first + curvature * (uint32_t)(first * (first - 1) / 2);
        step += curvature * (uint32_t)first;
    }
    for (; n > 0; n--, at += step, step += curvature)
        *out++ = sample_next(s, at);
}

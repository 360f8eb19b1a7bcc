/* SPDX-License-Identifier: MIT */
/* texel_light.c - what a texel becomes in its triangle's light. */
#include "kernels/texel_light.h"

/* Remembers the pixel of a texel. */
static inline uint32_t remember(struct texel_light *l, uint32_t t, uint32_t pixel)
{
    l->texel = t;
    l->pixel = l->narrow ? rgb565_nearest(pixel) : pixel;
    return l->pixel;
}

static inline uint32_t in_linear_light(const struct texel_light *l, uint32_t t)
{
    return pixel_make(0, smear_srgb_encode[smear_srgb_decode[pixel_red(t)] * l->red >> 20],
                      smear_srgb_encode[smear_srgb_decode[pixel_green(t)] * l->green >> 20],
                      smear_srgb_encode[smear_srgb_decode[pixel_blue(t)] * l->blue >> 20]);
}

static inline uint32_t in_codes(const struct texel_light *l, uint32_t t)
{
    /* code_times, of red and blue in one word */
    const uint32_t pair = 0xff00ffu;
    uint32_t rb = (pixel_red(t) * l->red << 16) + pixel_blue(t) * l->blue + 0x800080u;
    rb = (rb + (rb >> 8 & pair)) >> 8 & pair;
    return rb | code_times(pixel_green(t), l->green) << 8;
}

static SMEAR_RARE uint32_t find_linear(struct texel_light *l, uint32_t t)
{
    uint32_t pixel = in_linear_light(l, t);
    if (SMEAR_WITH_FOG && l->fog_part != 0)
        pixel = pixel_mix_part(pixel, l->fog, l->fog_part, true);
    return remember(l, t, pixel);
}

/* Codes in fog, as by pixel_mix. */
static SMEAR_RARE uint32_t find_composed(struct texel_light *l, uint32_t t)
{
    if (SMEAR_WITH_LINEAR && l->linear)
        return find_linear(l, t);
    const uint32_t pixel = in_codes(l, t);
    return remember(l, t, (((pixel & 0xff00ffu) * l->clear + l->fog_pair) >> 8 & 0xff00ffu)
                        | ((pixel_green(pixel) * l->clear + l->fog_green) & 0xff00u));
}

uint32_t smear_texel_light_find(struct texel_light *l, uint32_t index)
{
    const uint32_t t = texel_fetch(l->texels, l->palette, index, l->format) & 0xffffffu;
    l->index = index;
    l->near = 0;
    if (!SMEAR_ON_64 && l->numbers != NULL)
        l->number = l->numbers[index];
    if (t == l->texel)
        return l->pixel;
    if ((SMEAR_WITH_LINEAR || SMEAR_WITH_FOG) && l->composed)
        return find_composed(l, t);
    return remember(l, t, in_codes(l, t));
}

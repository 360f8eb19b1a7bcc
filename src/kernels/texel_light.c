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

static SMEAR_RARE uint32_t find_linear(struct texel_light *l, uint32_t t)
{
    return remember(l, t, pixel_make(0, smear_srgb_encode[smear_srgb_decode[pixel_red(t)] * l->red >> 20],
                                     smear_srgb_encode[smear_srgb_decode[pixel_green(t)] * l->green >> 20],
                                     smear_srgb_encode[smear_srgb_decode[pixel_blue(t)] * l->blue >> 20]));
}

uint32_t smear_texel_light_find(struct texel_light *l, uint32_t index)
{
    const uint32_t pair = 0xff00ffu, t = texel_fetch(l->texels, l->palette, index, l->format) & 0xffffffu;
    l->index = index;
    if (t == l->texel)
        return l->pixel;
    if (SMEAR_WITH_LINEAR && l->linear)
        return find_linear(l, t);
    /* code_times, of red and blue in one word */
    uint32_t rb = (pixel_red(t) * l->red << 16) + pixel_blue(t) * l->blue + 0x800080u;
    rb = (rb + (rb >> 8 & pair)) >> 8 & pair;
    return remember(l, t, rb | code_times(pixel_green(t), l->green) << 8);
}

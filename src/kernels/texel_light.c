/* SPDX-License-Identifier: MIT */
/* texel_light.c - what a texel becomes in its triangle's light. */
#include "kernels/texel_light.h"

uint32_t smear_texel_light_find(struct texel_light *l, uint32_t index)
{
    const uint32_t pair = 0xff00ffu, t = texel_fetch(l->texels, l->palette, index, l->format) & 0xffffffu;
    l->index = index;
    if (t == l->texel)
        return l->pixel;
    /* code_times, of red and blue in one word */
    uint32_t rb = (pixel_red(t) * l->red << 16) + pixel_blue(t) * l->blue + 0x800080u;
    rb = (rb + (rb >> 8 & pair)) >> 8 & pair;
    const uint32_t p = rb | code_times(pixel_green(t), l->green) << 8;
    l->texel = t;
    l->pixel = l->narrow ? rgb565_nearest(p) : p;
    return l->pixel;
}

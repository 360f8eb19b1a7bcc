/* SPDX-License-Identifier: MIT */
/* texel_light.h - a texel in the light of its triangle, as a pixel. */
#ifndef SMEAR_KERNELS_TEXEL_LIGHT_H
#define SMEAR_KERNELS_TEXEL_LIGHT_H

#include "smear.h"

#include "base/pixel.h"
#include "kernels/kernels.h"

/* Texel number `at` in memory, of a smear_texel_format, as 0xAARRGGBB. */
SMEAR_INLINE uint32_t texel_fetch(const void *texels, const uint32_t *palette, uint32_t at, int format)
{
    if (format == SMEAR_TEXEL_8888)
        return ((const uint32_t *)texels)[at];
    if (format == SMEAR_TEXEL_PALETTE8)
        return palette[((const uint8_t *)texels)[at]];
    uint32_t c = ((const uint16_t *)texels)[at];
    uint32_t r = c >> 11, g = c >> 5 & 63u, b = c & 31u;
    return pixel_make(255, (r * 527u + 23u) >> 6, (g * 259u + 33u) >> 6, (b * 527u + 23u) >> 6);
}

/* Light that is the same throughout a triangle, its texture, and the last texel with the pixel that it became: where
 * textures are magnified, most pixels look like those before them. */
struct texel_light {
    uint32_t pixel;                     /* the order in which the assembly loads registers */
    uint32_t near, at_u, at_v;          /* the pixel is that of all coordinates that are less than `near` beyond these */
    uint32_t cell;                      /* a texel's width or height, whichever is less: what `near` becomes */
    uint32_t from_v, mask_v, from_u;    /* index = v >> from_v & mask_v | u >> from_u */
    uint32_t index;
    uint32_t texel;
    uint32_t red, green, blue;          /* of the light: codes, or linear light, 65536 is one */
    const void *texels;
    const uint32_t *palette;
    int format;
    bool narrow;                        /* pixels are RGB565 */
    bool linear;
    bool composed;                      /* linear, or in fog: not what most texels become */
    uint32_t fog;                       /* 0x00RRGGBB, of which pixels have so much of 65536 */
    int32_t fog_part;
    uint32_t clear, fog_pair, fog_green;    /* of 256; what fog adds to red and blue, and to green, 8 bits more */
    const uint8_t *numbers;             /* texels that are numbers of colours, else null */
    uint32_t number;                    /* of the last texel's colour: beside it there often is another */
};

/* White light. The texture's sizes are 2^log2_width and 2^log2_height, both at least 2. */
static inline void texel_light_start(struct texel_light *l, const void *texels, const uint32_t *palette, int format,
                                     int log2_width, int log2_height, bool narrow, bool linear)
{
    l->index = ~0u;
    l->texel = 0;
    l->pixel = 0;           /* that of black */
    l->near = l->at_u = l->at_v = 0;
    l->cell = 1u << (32 - (log2_width > log2_height ? log2_width : log2_height));
    l->red = l->green = l->blue = linear ? 65536 : 255;
    l->texels = texels;
    l->palette = palette;
    l->format = format;
    l->numbers = !SMEAR_ON_64 && format == SMEAR_TEXEL_PALETTE8 ? (const uint8_t *)texels : NULL;
    l->number = ~0u;
    l->narrow = narrow;
    l->linear = l->composed = SMEAR_WITH_LINEAR && linear;
    l->fog_part = 0;
    l->from_v = 32u - (uint32_t)log2_height - (uint32_t)log2_width;
    l->mask_v = ((1u << log2_height) - 1u) << log2_width;
    l->from_u = 32u - (uint32_t)log2_width;
}

/* Returns a channel (pixel.h) as red, green and blue are. */
static inline uint32_t texel_light_of(const struct texel_light *l, uint32_t channel)
{
    const uint32_t light = channel >> 8 & 0xffffu;
    return SMEAR_WITH_LINEAR && l->linear ? light + (light >> 15) : light >> 8;
}

/* Goes on with another part of fog: remembers no pixel. Codes show a 256th of fog, light less (pixel_mix_part). */
static inline void texel_light_fog(struct texel_light *l, int32_t part)
{
    const int32_t seen = SMEAR_WITH_LINEAR && l->linear ? part : (part + 128) & ~255;
    if (l->fog_part == seen)
        return;
    const uint32_t a = (uint32_t)seen >> 8;
    l->fog_part = seen;
    l->clear = 256u - a;
    l->fog_pair = (l->fog & 0xff00ffu) * a + 0x800080u;
    l->fog_green = pixel_green(l->fog) * a + 0x80u;
    l->composed = l->linear || seen != 0;
    l->index = l->texel = l->number = ~0u;
    l->near = 0;
}

/* Returns the pixel of another texel than the last one. Rarely called, where textures are magnified. */
uint32_t smear_texel_light_find(struct texel_light *l, uint32_t index);

/* The pixel of a texel. Where words have 64 bits, calls are cheaper than to look for its colour first. */
SMEAR_INLINE uint32_t texel_light_pixel(struct texel_light *l, uint32_t index)
{
    if (index == l->index)
        return l->pixel;
    if (SMEAR_ON_64 || l->numbers == NULL || l->numbers[index] != l->number)
        return smear_texel_light_find(l, index);
    l->index = index;
    return l->pixel;
}

#endif

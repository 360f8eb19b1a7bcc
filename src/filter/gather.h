/* SPDX-License-Identifier: MIT */
/* gather.h - what filters that gather pixels share: vectors, weighed sums, sums of even weight. */
#ifndef SMEAR_GATHER_H
#define SMEAR_GATHER_H

#include "base/fixmath.h"
#include "base/pixel.h"
#include "filter/filter.h"

/* ------------------------------------------------------------------ vectors */

struct vector {
    int32_t x, y;               /* q8 px */
};

/* Returns the length of a pixel's velocity, q8 px. */
static inline int32_t speed_of(struct smear_pixel_velocity v)
{
    return (int32_t)sqrt_q3((uint32_t)(v.x * v.x + v.y * v.y)) << 2;
}

/* ------------------------------------------------------------------ weighed sums */

/* Sums of channels times weights, which the caller keeps within 32 bits. */
struct weighed_sum {
    uint32_t r, g, b, weight;
};

/* Adds a pixel as codes, or as linear light of 16 - light_down bits. */
SMEAR_INLINE void weighed_add(struct weighed_sum *s, uint32_t pixel, uint32_t weight, bool linear, int light_down)
{
    if (linear) {
        s->r += ((uint32_t)smear_srgb_decode[pixel_red(pixel)] >> light_down) * weight;
        s->g += ((uint32_t)smear_srgb_decode[pixel_green(pixel)] >> light_down) * weight;
        s->b += ((uint32_t)smear_srgb_decode[pixel_blue(pixel)] >> light_down) * weight;
    } else {
        s->r += pixel_red(pixel) * weight;
        s->g += pixel_green(pixel) * weight;
        s->b += pixel_blue(pixel) * weight;
    }
    s->weight += weight;
}

/* ------------------------------------------------------------------ even sums */

/* Sums of pixels of equal weight. Of codes, red_blue has red and blue side by side and `all` the three channels, so
 * that their difference is green, times 256. */
struct even_sum {
    uint32_t r, g, b;           /* linear light */
    uint32_t all, red_blue;     /* codes */
};

SMEAR_INLINE void even_add(struct even_sum *s, uint32_t pixel, const struct smear_blur_settings *settings)
{
    if (settings->linear) {
        s->r += smear_srgb_decode[pixel_red(pixel)];
        s->g += smear_srgb_decode[pixel_green(pixel)];
        s->b += smear_srgb_decode[pixel_blue(pixel)];
    } else {
        s->all += pixel;
        s->red_blue += pixel & 0xff00ffu;
    }
}

/* Returns the mean of n pixels, n at most 256; `over` is 2^24 / n, rounded up: sums stay below 2^24 n, and equal pixels
 * keep their value. */
SMEAR_INLINE uint32_t even_mean(const struct even_sum *s, uint32_t over, const struct smear_blur_settings *settings)
{
    if (settings->linear)
        return pixel_make(0, smear_srgb_encode[mulh_u32(s->r << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32(s->g << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32(s->b << 8, over) >> 4]);
    over >>= 8;
    const uint32_t green = (s->all - s->red_blue) >> 8 & 0xffffu;
    return pixel_make(0, ((s->red_blue >> 16) * over + 0x8000u) >> 16, (green * over + 0x8000u) >> 16,
                      ((s->red_blue & 0xffffu) * over + 0x8000u) >> 16);
}

#endif

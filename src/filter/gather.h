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
SMEAR_INLINE void weighed_add(struct weighed_sum *s, uint32_t pixel, uint32_t weight, smear_transfer transfer, int light_down)
{
    const int down = transfer_is_linear(transfer) ? light_down : 0;
    s->r += (value_of_code(pixel_red(pixel), transfer) >> down) * weight;
    s->g += (value_of_code(pixel_green(pixel), transfer) >> down) * weight;
    s->b += (value_of_code(pixel_blue(pixel), transfer) >> down) * weight;
    s->weight += weight;
}

/* Returns the mean. Weights are q12: the taps of a pixel weigh less than 8 in all (spaced 2 px, each at most 1.2 /
 * its distance), so sums of 16-bit values fit 32 bits. */
static inline uint32_t weighed_mean(const struct weighed_sum *s, smear_transfer transfer)
{
    int zeros = count_leading_zeros(s->weight);
    uint32_t r = recip_norm(s->weight << zeros);            /* 2^(61 - zeros) / weight */
    if (transfer_is_linear(transfer)) {
        /* Sums use 16 bits more than the weight: their quotients come out in q13. */
        int up = zeros - 16;
        uint32_t red = mulh_u32(s->r << up, r) >> 17, green = mulh_u32(s->g << up, r) >> 17;
        uint32_t blue = mulh_u32(s->b << up, r) >> 17;
        return pixel_make(0, smear_srgb_encode[min_u32(red, 4095u)],
                          smear_srgb_encode[min_u32(green, 4095u)],
                          smear_srgb_encode[min_u32(blue, 4095u)]);
    }
    /* 8 bits more: brought to 20 bits, times 12 bits, in q23. */
    const int down = max_i32(20 - zeros, 0), up = max_i32(zeros - 20, 0);
    const uint32_t r12 = r >> 18, half = 1u << 22;
    return pixel_make(0, ((s->r << up >> down) * r12 + half) >> 23, ((s->g << up >> down) * r12 + half) >> 23,
                      ((s->b << up >> down) * r12 + half) >> 23);
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
    if (transfer_is_linear(settings->transfer)) {
        s->r += smear_srgb_decode[pixel_red(pixel)];
        s->g += smear_srgb_decode[pixel_green(pixel)];
        s->b += smear_srgb_decode[pixel_blue(pixel)];
    } else {
        s->all += pixel;
        s->red_blue += pixel & 0xff00ffu;
    }
}

/* Returns the mean of n pixels, n at most 256; `over` is 2^24 / n, rounded up: sums stay below 2^24 n, and equal pixels
 * keep their value. `fine`: the means of codes that differ are nearest, too. */
SMEAR_INLINE uint32_t even_mean(const struct even_sum *s, uint32_t over, bool fine,
                                const struct smear_blur_settings *settings)
{
    if (transfer_is_linear(settings->transfer))
        return pixel_of_values(mulh_u32(s->r << 8, over), mulh_u32(s->g << 8, over), mulh_u32(s->b << 8, over), TRANSFER_LINEAR);
    const uint32_t red = s->red_blue >> 16, green = (s->all - s->red_blue) >> 8 & 0xffffu, blue = s->red_blue & 0xffffu;
    if (fine)
        return pixel_make(0, (mulh_u32(red << 16, over) + 128u) >> 8, (mulh_u32(green << 16, over) + 128u) >> 8,
                          (mulh_u32(blue << 16, over) + 128u) >> 8);
    over >>= 8;
    return pixel_make(0, (red * over + 0x8000u) >> 16, (green * over + 0x8000u) >> 16, (blue * over + 0x8000u) >> 16);
}

#endif

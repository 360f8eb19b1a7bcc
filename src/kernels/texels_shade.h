/* SPDX-License-Identifier: MIT */
/* texels_shade.h - depth-tested texels along a row, in a light that changes from pixel to pixel. */
#ifndef SMEAR_KERNELS_TEXELS_SHADE_H
#define SMEAR_KERNELS_TEXELS_SHADE_H

#include "kernels/texel_run.h"
#include "kernels/texels_lanes.h"

/* Light of the next pixel, red, green and blue in q16 codes (or linear light >> 8), and its steps. Where it has no colour,
 * blue stands for all. */
struct shaded_light {
    uint32_t c[3], d[3];
};

/* Texels of a draw, and what they become. */
struct shaded_texels {
    const void *texels;
    const uint32_t *palette;
    int format, log2_width, log2_height;
    bool narrow;
};

SMEAR_INLINE uint32_t shaded_pixel(uint32_t t, uint32_t r, uint32_t g, uint32_t b, bool white, bool linear)
{
    if (linear) {
        const uint32_t blue = b >> 8 & 0xffffu;
        return pixel_make(0, code_times_linear(pixel_red(t), white ? blue : r >> 8 & 0xffffu),
                          code_times_linear(pixel_green(t), white ? blue : g >> 8 & 0xffffu),
                          code_times_linear(pixel_blue(t), blue));
    }
    const uint32_t blue = b >> 16 & 255u, pair = 0xff00ffu;
    if (white) {
        uint32_t rb = (t & pair) * blue + 0x800080u;
        rb = (rb + (rb >> 8 & pair)) >> 8 & pair;
        return rb | code_times(pixel_green(t), blue) << 8;
    }
    return pixel_make(0, code_times(pixel_red(t), r >> 16 & 255u), code_times(pixel_green(t), g >> 16 & 255u),
                      code_times(pixel_blue(t), blue));
}

/* Draws n > 0 pixels of a run, where they are nearer, in a light that changes from pixel to pixel: white where blue stands for all. */
SMEAR_INLINE void texels_shade_reference(const struct shaded_texels *k, struct texel_run *run, const struct shaded_light *l,
                                         int32_t n, bool white, bool linear)
{
    struct texel_run r = *run;
    uint32_t red = l->c[0], green = l->c[1], blue = l->c[2];
    const uint32_t red_step = l->d[0], green_step = l->d[1], blue_step = l->d[2];
    const int log2_width = k->log2_width, log2_height = k->log2_height, format = k->format;
    const bool narrow = k->narrow;
    for (; n > 0; n--) {
        const uint32_t code = r.z >> 16;
        if (code > *r.depth) {
            SMEAR_KEEP_BRANCH();
            const uint32_t t = texel_fetch(k->texels, k->palette, packed_index(texel_run_uv(&r), log2_width, log2_height),
                                           format);
            const uint32_t p = shaded_pixel(t, red, green, blue, white, linear);
            *r.depth = (uint16_t)code;
            if (narrow)
                *(uint16_t *)r.color = (uint16_t)rgb565_nearest(p);
            else
                *(uint32_t *)r.color = p;
        }
        texel_run_advance(&r, 1, narrow);
        texel_run_step(&r);
        r.z += r.dz;
        blue += blue_step;
        if (!white) {
            red += red_step;
            green += green_step;
        }
    }
}

#if TEXELS_LANES
/* Light of one channel in eight pixels, by what it changes over eight. */
struct shaded_lanes {
    smear_v4u low, high, step;
};

static inline void shaded_lanes_start(struct shaded_lanes *k, uint32_t c, uint32_t d)
{
    k->low = (smear_v4u){ c, c + d, c + 2 * d, c + 3 * d };
    k->high = k->low + v4u_all(4 * d);
    k->step = v4u_all(8 * d);
}

static inline smear_v8u shaded_lanes_next(struct shaded_lanes *k)
{
    const smear_v8u codes = (smear_v8u)v8i_upper(k->low, k->high) & 255u;
    k->low += k->step;
    k->high += k->step;
    return codes;
}

/* code_times of eight. */
static inline smear_v8u v8u_code_times(smear_v8u a, smear_v8u b)
{
    const smear_v8u t = a * b + 128u;
    return (t + (t >> 8)) >> 8;
}

/* RGB565 texels in light, as RGB565 again: what texel_fetch, shaded_pixel and rgb565_nearest do. */
static inline smear_v8u shaded_lanes_light(smear_v8u texel, smear_v8u red, smear_v8u green, smear_v8u blue)
{
    const smear_v8u r = v8u_code_times(((texel >> 11) * 527u + 23u) >> 6, red);
    const smear_v8u g = v8u_code_times(((texel >> 5 & 63u) * 259u + 33u) >> 6, green);
    const smear_v8u b = v8u_code_times(((texel & 31u) * 527u + 23u) >> 6, blue);
    return (r * 249u + 1014u) >> 11 << 11 | (g * 253u + 505u) >> 10 << 5 | (b * 249u + 1014u) >> 11;
}

/* Eight pixels at once of RGB565 texels that fit, for narrow ones. */
SMEAR_INLINE void texels_shade_lanes(const struct shaded_texels *k, struct texel_run *run, const struct shaded_light *l, int32_t n,
                                     bool white)
{
    struct texels_pair pair;
    struct shaded_lanes red, green, blue;
    uint16_t *depth = run->depth, *color = (uint16_t *)run->color;
    uint32_t z = run->z;
    texels_pair_start(&pair, run->uv, run->duv, run->dduv);
    shaded_lanes_start(&blue, l->c[2], l->d[2]);
    if (!white) {
        shaded_lanes_start(&red, l->c[0], l->d[0]);
        shaded_lanes_start(&green, l->c[1], l->d[1]);
    }
    for (; n > 0; n -= 8, depth += 8, color += 8) {
        uint16_t pixel[8];
        const smear_v4i low = texels_indices(&pair, k->log2_width, k->log2_height),
                        high = texels_indices(&pair, k->log2_width, k->log2_height);
        const smear_v8u texel = texels_gather(k->texels, (smear_v8u)low, (smear_v8u)high), b = shaded_lanes_next(&blue);
        const smear_v8u r = white ? b : shaded_lanes_next(&red), g = white ? b : shaded_lanes_next(&green);
        v8i_store(pixel, (smear_v8i)shaded_lanes_light(texel, r, g, b));
        const int32_t drawn = n < 8 ? n : 8;
        for (int32_t i = 0; i < drawn; i++, z += run->dz)
            if (z >> 16 > depth[i]) {
                depth[i] = (uint16_t)(z >> 16);
                color[i] = pixel[i];
            }
    }
}
#endif

SMEAR_INLINE void texels_shade(const struct shaded_texels *k, struct texel_run *run, const struct shaded_light *l, int32_t n,
                               bool white, bool linear)
{
#if TEXELS_LANES
    if (!linear && k->narrow && k->format == SMEAR_TEXEL_565 && n > 2 && texels_fit_lanes(k->log2_width, k->log2_height)) {
        texels_shade_lanes(k, run, l, n, white);
        return;
    }
#endif
    texels_shade_reference(k, run, l, n, white, linear);
}

#endif

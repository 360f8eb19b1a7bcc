/* SPDX-License-Identifier: MIT */
/* linear_runs.h - texels in interpolated light and blended pixels, of linear light. */
#ifndef SMEAR_KERNELS_LINEAR_RUNS_H
#define SMEAR_KERNELS_LINEAR_RUNS_H

#include "base/pixel.h"
#include "kernels/avx2.h"
#include "kernels/kernels.h"

/* Light that is interpolated: red, green and blue, 16 bits above 8, alpha q16 codes, and their steps. */
struct light_ramp {
    uint32_t c[4], d[4];
};

/* Multiplies n >= 0 texels (0xAARRGGBB) by light: texel i by k->c + i k->d. */
static inline void light_texels_reference(uint32_t *texel, int32_t n, const struct light_ramp *k)
{
    uint32_t r = k->c[0], g = k->c[1], b = k->c[2], a = k->c[3];
    for (; n > 0; n--, texel++) {
        const uint32_t t = *texel;
        *texel = pixel_make(code_times(pixel_alpha(t), a >> 16 & 255u), code_times_linear(pixel_red(t), r >> 8 & 0xffffu),
                            code_times_linear(pixel_green(t), g >> 8 & 0xffffu),
                            code_times_linear(pixel_blue(t), b >> 8 & 0xffffu));
        r += k->d[0];
        g += k->d[1];
        b += k->d[2];
        a += k->d[3];
    }
}

/* Blends n >= 0 pixels by their alpha over those of `color`, by pixel_blend, where they are nearer: pixel i has the depth code
 * (z + i dz) >> 16, modulo 2^16. Memory does not overlap. */
static inline void blend_linear_reference(uint32_t *color, const uint16_t *depth, const uint32_t *in, int32_t n, uint32_t z,
                                          uint32_t dz)
{
    for (; n > 0; n--, in++, color++, depth++, z += dz)
        if (z >> 16 > *depth)
            *color = pixel_blend(*color, *in, pixel_alpha(*in), true);
}

#if SMEAR_AVX2
void smear_light_texels_avx2(uint32_t *texel, int32_t n, const struct light_ramp *k);
void smear_blend_linear_avx2(uint32_t *color, const uint16_t *depth, const uint32_t *in, int32_t n, uint32_t z, uint32_t dz);
#endif

static inline void light_texels(uint32_t *texel, int32_t n, const struct light_ramp *k)
{
#if SMEAR_AVX2
    if (n >= 8 && smear_has_avx2()) {
        smear_light_texels_avx2(texel, n, k);
        return;
    }
#endif
    light_texels_reference(texel, n, k);
}

static inline void blend_linear(uint32_t *color, const uint16_t *depth, const uint32_t *in, int32_t n, uint32_t z, uint32_t dz)
{
#if SMEAR_AVX2
    if (n >= 8 && smear_has_avx2()) {
        smear_blend_linear_avx2(color, depth, in, n, z, dz);
        return;
    }
#endif
    blend_linear_reference(color, depth, in, n, z, dz);
}

#endif

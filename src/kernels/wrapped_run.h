/* SPDX-License-Identifier: MIT */
/* wrapped_run.h - texels of pictures of any size, that repeat, stay at their borders or turn back there; and pixels that are
 * written where they are nearer: by AVX2. */
#ifndef SMEAR_KERNELS_WRAPPED_RUN_H
#define SMEAR_KERNELS_WRAPPED_RUN_H

#include "smear.h"

#include "kernels/avx2.h"
#include "kernels/kernels.h"

/* Texels 0xAARRGGBB of a picture: 1 to 2048 of them across and down. Its two wraps are a smear_wrap. */
struct wrapped_texels {
    const uint32_t *texels;
    int32_t width, height;
    int wrap_u, wrap_v;
};

/* Coordinates: v q16 texels above u, and how both change from pixel to pixel, and that. What u carries goes into v. */
struct wrapped_walk {
    uint64_t at, step, curvature;
};

/* Any coordinate into 0 .. size - 1. */
static inline int32_t wrapped_index(int32_t i, int32_t size, int mode)
{
    if (mode == SMEAR_CLAMP)
        return i < 0 ? 0 : i < size ? i : size - 1;
    const int32_t period = mode == SMEAR_MIRROR ? 2 * size : size;
    i %= period;
    i += i < 0 ? period : 0;
    return i < size ? i : period - 1 - i;
}

/* Reads n >= 0 texels, one for each pixel of the walk. */
static inline void wrapped_run_reference(uint32_t *out, const struct wrapped_texels *t, struct wrapped_walk w, int32_t n)
{
    for (; n > 0; n--, w.at += w.step, w.step += w.curvature)
        *out++ = t->texels[wrapped_index((int32_t)(w.at >> 32) >> 16, t->height, t->wrap_v) * t->width
                           + wrapped_index((int32_t)w.at >> 16, t->width, t->wrap_u)];
}

/* Writes n >= 0 pixels 0xAARRGGBB as 0x00RRGGBB where they are nearer: pixel i has the depth code (z + i dz) >> 16, modulo
 * 2^16. Memory does not overlap. */
static inline void nearer_run_reference(uint32_t *color, uint16_t *depth, const uint32_t *in, int32_t n, uint32_t z, uint32_t dz)
{
    for (; n > 0; n--, in++, color++, depth++, z += dz) {
        const uint32_t code = z >> 16;
        if (code > *depth) {
            *depth = (uint16_t)code;
            *color = *in & 0xffffffu;
        }
    }
}

#if SMEAR_AVX2
/* A sixth of the reference's instructions. */
void smear_wrapped_run_avx2(uint32_t *out, const struct wrapped_texels *t, const struct wrapped_walk *w, int32_t n);

/* n >= 8. A fourth of the reference's instructions. */
void smear_nearer_run_avx2(uint32_t *color, uint16_t *depth, const uint32_t *in, int32_t n, uint32_t z, uint32_t dz);
#endif

#endif

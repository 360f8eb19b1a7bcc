/* SPDX-License-Identifier: MIT */
/* texels_draw.h - depth-tested texels along a row. */
#ifndef SMEAR_KERNELS_TEXELS_DRAW_H
#define SMEAR_KERNELS_TEXELS_DRAW_H

#include "kernels/texels_draw_armv6m.h"
#include "kernels/texels_lanes.h"

/* Draws n >= 1 pixels of a run. Pixel i has the depth code z >> 16; where it is greater than that in memory,
 * which it then replaces, the pixel becomes the texel at the run's coordinates. Then z changes by dz, u and v by du
 * and dv, these by ddu and ddv, all modulo 2^32. Afterwards color, depth and z are those of the next pixel; coordinates
 * and their changes are as before. Sizes are 2 at least; texels, light, colours and depths don't overlap. */
#if TEXELS_PACKED
SMEAR_INLINE void texels_step(struct texel_run *r, int32_t i, int log2_width, int log2_height, enum texel_kind kind)
{
    uint16_t code = (uint16_t)(r->z >> 16);
    if (code > r->depth[i]) {
        SMEAR_KEEP_BRANCH();            /* in advance it would take more registers than there are */
        r->depth[i] = code;
        texel_put(r->color, i, r->texels, r->light,
                  (uint32_t)((r->uv & r->bits) * r->fold >> (64 - log2_width - log2_height)), kind);
    }
    r->z += r->dz;
    SMEAR_KEEP_VALUE(r->z);             /* one sum, not one for every other pixel */
    texel_run_step(r);
}

/* Indices are a product. Rows are short where lanes are: one branch tells where they end. */
SMEAR_INLINE void texels_draw_unrolled(struct texel_run *run, int32_t n, int log2_width, int log2_height,
                                       enum texel_kind kind)
{
    struct texel_run r = *run;          /* in registers */
    for (int32_t i = 0; i < n; i++)
        texels_step(&r, i, log2_width, log2_height, kind);
    texel_run_advance(run, n, texels_are_narrow(kind));
    run->z = r.z;
}

#else
/* The twelve values of the loop are as many as ARM has registers for; compilers would rather keep copies of some. Not of Cortex-M4, whose
 * assembly is tried in programs for Linux, too, that have fewer. */
#if SMEAR_GNU && defined(__arm__) && defined(__OPTIMIZE__) && (defined(__thumb2__) || !defined(__thumb__)) && !SMEAR_ASM_ARMV7EM
#define TEXELS_KEEP_ALL \
    __asm__("" : "+r"(u), "+r"(v), "+r"(du), "+r"(dv), "+r"(z), "+r"(depth), "+r"(color) \
            : "r"(ddu), "r"(ddv), "r"(dz), "r"(texels), "r"(end))
#else
#define TEXELS_KEEP_ALL (void)0
#endif

#define TEXELS_STEP(I) \
    do { \
        TEXELS_KEEP_ALL; \
        if (z >> 16 > depth[I]) { \
            SMEAR_KEEP_BRANCH(); \
            depth[I] = (uint16_t)(z >> 16); \
            texel_put(color, I, texels, light, \
                      v >> (32 - log2_height) << log2_width | u >> (32 - log2_width), kind); \
        } \
        z += dz; \
        u += du; \
        v += dv; \
        du += ddu; \
        dv += ddv; \
    } while (0)

/* Two pixels a round. */
SMEAR_INLINE void texels_draw_unrolled(struct texel_run *run, int32_t n, int log2_width, int log2_height,
                                       enum texel_kind kind)
{
    uint32_t u = run->u, v = run->v, du = run->du, dv = run->dv, z = run->z;
    const uint32_t ddu = run->ddu, ddv = run->ddv, dz = run->dz;
    const void *const texels = run->texels;
    struct texel_light *const light = run->light;
    void *color = run->color;
    uint16_t *depth = run->depth, *const end = depth + (n & ~1);
    for (; depth != end; depth += 2, color = pixel_after(color, 2, texels_are_narrow(kind))) {
        TEXELS_STEP(0);
        TEXELS_STEP(1);
    }
    if (n & 1) {
        texel_pixel(color, depth, z, texels, light, packed_uv(u, v), log2_width, log2_height, kind);
        color = pixel_after(color, 1, texels_are_narrow(kind));
        depth++;
        z += dz;
    }
    run->color = color;
    run->depth = depth;
    run->z = z;
}
#endif

#if SMEAR_ASM_ARMV6M
SMEAR_INLINE void texels_draw_armv6m(struct texel_run *run, int32_t n, int log2_width, int log2_height,
                                     enum texel_kind kind)
{
    run->count = n;
    if (texels_are_lit(kind))
        texels_light_armv6m(run, kind);
    else if (!__builtin_constant_p(log2_width))
        texels_copy_any_armv6m(run, log2_width, log2_height, kind);
    else
        texels_copy_armv6m(run, log2_width, log2_height, kind);
}
#endif

SMEAR_INLINE void texels_draw(struct texel_run *run, int32_t n, int log2_width, int log2_height,
                              enum texel_kind kind)
{
#if SMEAR_ASM_ARMV6M
    texels_draw_armv6m(run, n, log2_width, log2_height, kind);
#elif TEXELS_LANES
    if (n >= 8 && !texels_are_lit(kind) && texels_fit_lanes(log2_width, log2_height))
        texels_draw_lanes(run, n, log2_width, log2_height, kind);
    else
        texels_draw_unrolled(run, n, log2_width, log2_height, kind);
#else
    texels_draw_unrolled(run, n, log2_width, log2_height, kind);
#endif
}

#endif

/* SPDX-License-Identifier: MIT */
/* shade_run.h - depth-tested pixels of a row whose colours are interpolated. */
#ifndef SMEAR_KERNELS_SHADE_RUN_H
#define SMEAR_KERNELS_SHADE_RUN_H

#include "base/pixel.h"
#include "kernels/kernels.h"

/* Red, green and blue, q16 (codes, or linear light >> 8), and their steps. */
struct shade {
    uint32_t c[3], d[3];
};

SMEAR_INLINE uint32_t shade_pixel(uint32_t r, uint32_t g, uint32_t b, bool linear, bool narrow)
{
    const uint32_t p = linear ? pixel_make(0, smear_srgb_encode[r >> 12 & 4095u], smear_srgb_encode[g >> 12 & 4095u],
                                           smear_srgb_encode[b >> 12 & 4095u])
                              : (r & 0xff0000u) | (g >> 8 & 0xff00u) | (b >> 16 & 255u);
    return narrow ? rgb565_nearest(p) : p;
}

/* A byte becomes 0, which has no register that loops lack. */
#if SMEAR_ASM_ARMV6M
#define SHADE_ZERO(BYTE) __asm__ volatile("movs %0, #0" : "=l"(BYTE) : : "cc")
#else
#define SHADE_ZERO(BYTE) ((BYTE) = 0)
#endif

/* Draws n > 0 pixels, RGB565 where they are narrow. Pixel i has the depth code (z + i dz) >> 16, modulo 2^16, and the colour
 * k->c + i k->d; where the code is greater than depth[i] both are written. Pixels and depth don't overlap. */
SMEAR_INLINE void shade_run(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz, const struct shade *k,
                            bool linear, bool narrow)
{
    uint32_t r = k->c[0], g = k->c[1], b = k->c[2];
    const uint32_t dr = k->d[0], dg = k->d[1], db = k->d[2];
    uint32_t *wide = (uint32_t *)pixels;
    uint16_t *thin = (uint16_t *)pixels;
    const uint16_t *const end = depth + n;
    do {
        const uint32_t code = z >> 16;
        if (code > *depth) {
            SMEAR_KEEP_BRANCH();
            *depth = (uint16_t)code;
            if (narrow)
                *thin = (uint16_t)shade_pixel(r, g, b, linear, true);
            else if (SMEAR_ON_ARMV6M && !SMEAR_BIG_ENDIAN && !linear) {
                uint8_t *const byte = (uint8_t *)wide;
                byte[0] = (uint8_t)(b >> 16);
                byte[1] = (uint8_t)(g >> 16);
                byte[2] = (uint8_t)(r >> 16);
                SHADE_ZERO(byte[3]);
            } else
                *wide = shade_pixel(r, g, b, linear, false);
        }
        z += dz;
        r += dr;
        g += dg;
        b += db;
        wide++;
        thin++;
    } while (++depth != end);
}

#endif

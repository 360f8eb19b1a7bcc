/* SPDX-License-Identifier: MIT */
/* flat_run.h - depth-tested pixels of one colour in a row. */
#ifndef SMEAR_KERNELS_FLAT_RUN_H
#define SMEAR_KERNELS_FLAT_RUN_H

#include "base/base.h"
#include "base/pixel.h"
#include "kernels/kernels.h"
#include "kernels/vector.h"

/* Pixel i: where its depth code is greater, that is nearer. */
SMEAR_INLINE void flat_pixel(void *pixels, uint16_t *depth, int32_t i, uint32_t z, uint32_t color, bool narrow)
{
    uint16_t code = (uint16_t)(z >> 16);
    if (code > depth[i]) {
        /* Cores that predicate pay for both stores even where the pixel is hidden. */
        SMEAR_KEEP_BRANCH();
        if (narrow)
            ((uint16_t *)pixels)[i] = (uint16_t)color;
        else
            ((uint32_t *)pixels)[i] = color;
        depth[i] = code;
    }
}

/* Draws n > 0 pixels of the colour `color`, RGB565 where they are narrow. Pixel i has the depth code (z + i dz) >> 16,
 * modulo 2^16; where it is greater than depth[i] both are written. Pixels and depth are aligned to their
 * size and don't overlap. */
SMEAR_INLINE void flat_run_reference(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                                     uint32_t color, bool narrow)
{
    int32_t i = 0;
    do {
        flat_pixel(pixels, depth, i, z, color, narrow);
        z += dz;
    } while (++i < n);
}

SMEAR_INLINE void flat_four(void *pixels, uint16_t *depth, uint32_t z, uint32_t dz, uint32_t color, bool narrow)
{
    flat_pixel(pixels, depth, 0, z, color, narrow);
    flat_pixel(pixels, depth, 1, z += dz, color, narrow);
    flat_pixel(pixels, depth, 2, z += dz, color, narrow);
    flat_pixel(pixels, depth, 3, z + dz, color, narrow);
}

/* A run, and where it has come to. */
struct flat_walk {
    void *pixels;
    uint16_t *depth;
    uint32_t z;
};

/* Draws up to seven pixels, so that a multiple of eight is left. */
SMEAR_INLINE void flat_odd(struct flat_walk *w, int32_t n, uint32_t dz, uint32_t color, bool narrow)
{
    if (n & 1) {
        flat_pixel(w->pixels, w->depth, 0, w->z, color, narrow);
        w->pixels = pixel_after(w->pixels, 1, narrow);
        w->depth++;
        w->z += dz;
    }
    if (n & 2) {
        flat_pixel(w->pixels, w->depth, 0, w->z, color, narrow);
        flat_pixel(w->pixels, w->depth, 1, w->z + dz, color, narrow);
        w->pixels = pixel_after(w->pixels, 2, narrow);
        w->depth += 2;
        w->z += 2 * dz;
    }
    if (n & 4) {
        flat_four(w->pixels, w->depth, w->z, dz, color, narrow);
        w->pixels = pixel_after(w->pixels, 4, narrow);
        w->depth += 4;
        w->z += 4 * dz;
    }
}

/* Eight pixels a round, whose addresses are constants away from each other. */
SMEAR_INLINE void flat_run_unrolled(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                                    uint32_t color, bool narrow)
{
    struct flat_walk w = { pixels, depth, z };
    flat_odd(&w, n, dz, color, narrow);
    for (n >>= 3; n > 0; n--) {
        flat_four(w.pixels, w.depth, w.z, dz, color, narrow);
        flat_four(pixel_after(w.pixels, 4, narrow), w.depth + 4, w.z + 4 * dz, dz, color, narrow);
        w.pixels = pixel_after(w.pixels, 8, narrow);
        w.depth += 8;
        w.z += 8 * dz;
    }
}

#if SMEAR_VECTORS
/* Eight pixels; z: depths of the first four, and of the others. */
SMEAR_INLINE void flat_eight(void *pixels, uint16_t *depth, smear_v4u z, smear_v4u next, uint32_t color, bool narrow)
{
    const smear_v8u old = (smear_v8u)v8i_load(depth), nearer = v8u_less((smear_v8u)v8i_upper(z, next), old);
    const smear_v8i hidden = (smear_v8i)(nearer == 0);
    v8i_store(depth, (smear_v8i)(old + nearer));
    if (narrow) {
        uint16_t *const out = (uint16_t *)pixels;
        v8i_store(out, v8i_choose(hidden, v8i_load(out), v8i_all((int16_t)color)));
        return;
    }
    uint32_t *out = (uint32_t *)pixels;
    const smear_v4u all = v4u_all(color);
    v4u_store(out, v4u_choose(v4i_twice_low(hidden), v4u_load(out), all));
    v4u_store(out + 4, v4u_choose(v4i_twice_high(hidden), v4u_load(out + 4), all));
}

/* Eight pixels at once. What is left are the last eight: those drawn before are no nearer than themselves. */
SMEAR_INLINE void flat_run_vector(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz,
                                  uint32_t color, bool narrow)
{
    struct flat_walk w = { pixels, depth, z };
    if (n < 8) {
        flat_odd(&w, n, dz, color, narrow);
        return;
    }
    const smear_v4u step = v4u_all(4 * dz);
    smear_v4u z4 = { z, z + dz, z + 2 * dz, z + 3 * dz };
    for (int32_t eights = n >> 3; eights > 0; eights--) {
        const smear_v4u next = z4 + step;
        flat_eight(w.pixels, w.depth, z4, next, color, narrow);
        z4 = next + step;
        w.pixels = pixel_after(w.pixels, 8, narrow);
        w.depth += 8;
    }
    if ((n & 7) != 0) {
        const int32_t back = (n & 7) - 8;
        z4 += v4u_all((uint32_t)back * dz);
        flat_eight(pixel_after(w.pixels, back, narrow), w.depth + back, z4, z4 + step, color, narrow);
    }
}
#endif

SMEAR_INLINE void flat_run(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz, uint32_t color,
                           bool narrow)
{
#if SMEAR_VECTORS
    flat_run_vector(pixels, depth, n, z, dz, color, narrow);
#else
    flat_run_unrolled(pixels, depth, n, z, dz, color, narrow);
#endif
}

#endif

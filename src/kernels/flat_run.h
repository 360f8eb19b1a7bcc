/* SPDX-License-Identifier: MIT */
/* flat_run.h - depth-tested pixels of one colour in a row. */
#ifndef SMEAR_KERNELS_FLAT_RUN_H
#define SMEAR_KERNELS_FLAT_RUN_H

#include "base/base.h"
#include "base/pixel.h"
#include "kernels/kernels.h"
#include "kernels/vector.h"

#if SMEAR_ASM_ARMV7EM

/* Pixels are in r0, depths in r1, z in r2, dz in r3, the colour in r7. */

/* The last pixel. */
#define FLAT_ARMV7EM_LAST(STORE) \
    "lsrs r4, r2, #16\n\t"       \
    "ldrh r5, [r1]\n\t"          \
    "cmp r5, r4\n\t"             \
    "bhs 9f\n\t"                 \
    "strh r4, [r1]\n\t"          \
    STORE " r7, [r0]\n"          \
    "9:\n\t"

/* Two pixels, if both are seen; else at SLOW. Halves of r5 are 0 where the old depth is not less, and so is their product where one
 * of them is. */
#define FLAT_ARMV7EM_PAIR(STORE_TWO, SLOW) \
    "adds r4, r2, r3\n\t"                  \
    "pkhtb r4, r4, r2, asr #16\n\t"        \
    "ldr r5, [r1], #4\n\t"                 \
    "uqsub16 r5, r4, r5\n\t"               \
    "add r2, r2, r3, lsl #1\n\t"           \
    "smulbt r6, r5, r5\n\t"                \
    "cbz r6, " SLOW "f\n\t"                \
    "str r4, [r1, #-4]\n\t" STORE_TWO

/* Two pixels of which one at most is seen. */
#define FLAT_ARMV7EM_SLOW_NARROW \
    "cbz r5, 9f\n\t"             \
    "ldr r5, [r1, #-4]\n\t"      \
    "usub16 r6, r5, r4\n\t"      \
    "sel r4, r5, r4\n\t"         \
    "str r4, [r1, #-4]\n\t"      \
    "ldr r5, [r0]\n\t"           \
    "sel r5, r5, r7\n\t"         \
    "str r5, [r0]\n"             \
    "9: adds r0, #4\n\t"

#define FLAT_ARMV7EM_SLOW_WIDE   \
    "cbz r5, 9f\n\t"             \
    "lsls r6, r5, #16\n\t"       \
    "itt ne\n\t"                 \
    "strne r7, [r0]\n\t"         \
    "strhne r4, [r1, #-4]\n\t"   \
    "lsrs r4, r4, #16\n\t"       \
    "lsrs r6, r5, #16\n\t"       \
    "itt ne\n\t"                 \
    "strne r7, [r0, #4]\n\t"     \
    "strhne r4, [r1, #-2]\n"     \
    "9: adds r0, #8\n\t"

/* The pixels of a row, whose number, one at least, is in COUNT; then comes NEXT, which is 8. COLOR brings the colour, ELSE is anything
 * that others go to. r8 has two less than what is left of rounds of four: odd where a last one is left. */
#define FLAT_ARMV7EM_PIXELS(COUNT, COLOR, NEXT, ELSE, STORE, STORE_TWO, SLOW) \
    "sub r8, " COUNT ", #2\n\t"                                         \
    "lsls r6, " COUNT ", #31\n\t"                                       \
    COLOR                                                               \
    "bcs 4f\n\t"                                                        \
    "cmp r8, #0\n\t"                                                    \
    "blt 5f\n"                                                          \
    "3: " FLAT_ARMV7EM_PAIR(STORE_TWO, "6")                             \
    "4: " FLAT_ARMV7EM_PAIR(STORE_TWO, "7")                             \
    "subs r8, r8, #4\n\t"                                               \
    "bge 3b\n"                                                          \
    "5: lsls r6, r8, #31\n\t"                                           \
    "beq 8f\n\t"                                                        \
    FLAT_ARMV7EM_LAST(STORE)                                            \
    "8: " NEXT                                                          \
    "b 2f\n"                                                            \
    "6: " SLOW "b 4b\n"                                                 \
    "7: " SLOW                                                          \
    "subs r8, r8, #4\n\t"                                               \
    "bge 3b\n\t"                                                        \
    "b 5b\n"                                                            \
    ELSE                                                                \
    "2:\n\t"

#define FLAT_ARMV7EM_RUN(STORE, STORE_TWO, SLOW)                                                                      \
    __asm__ volatile(".syntax unified\n\t" FLAT_ARMV7EM_PIXELS("r4", "", "", "", STORE, STORE_TWO, SLOW)                  \
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r4)                                                         \
                     : "r"(r3), "r"(r7)                                                                               \
                     : "r5", "r6", "r8", "cc", "memory")

/* Like flat_run. */
static inline void flat_run_armv7em(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz, uint32_t color, bool narrow)
{
    register void *r0 __asm__("r0") = pixels;
    register uint16_t *r1 __asm__("r1") = depth;
    register uint32_t r2 __asm__("r2") = z, r3 __asm__("r3") = dz, r7 __asm__("r7") = narrow ? color * 0x10001u : color;
    register int32_t r4 __asm__("r4") = n;
    if (narrow)
        FLAT_ARMV7EM_RUN("strh", "str r7, [r0], #4\n\t", FLAT_ARMV7EM_SLOW_NARROW);
    else
        FLAT_ARMV7EM_RUN("str", "strd r7, r7, [r0], #8\n\t", FLAT_ARMV7EM_SLOW_WIDE);
}
#endif

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
#if SMEAR_ASM_ARMV7EM
    flat_run_armv7em(pixels, depth, n, z, dz, color, narrow);
#elif SMEAR_VECTORS
    flat_run_vector(pixels, depth, n, z, dz, color, narrow);
#else
    flat_run_unrolled(pixels, depth, n, z, dz, color, narrow);
#endif
}

#endif

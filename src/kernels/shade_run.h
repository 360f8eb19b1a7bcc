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

/* Draws n > 0 pixels, RGB565 where they are narrow. Pixel i has the depth code (z + i dz) >> 16, modulo 2^16, and the colour
 * k->c + i k->d; where the code is greater than depth[i] both are written. Pixels and depth don't overlap. */
SMEAR_INLINE void shade_run_reference(void *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz, const struct shade *k,
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
            else
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

#if SMEAR_ASM_ARMV6M
/* The pixel AT bytes of depth and PLACE bytes of colours further on. LABEL is behind it. */
#define SHADE_RUN_PIXEL(AT, PLACE, LABEL) \
    "lsrs r6, r2, #16\n\t" \
    "ldrh r7, [r1, #" AT "]\n\t" \
    "add r2, r8\n\t" \
    "cmp r7, r6\n\t" \
    "bhs " LABEL "f\n\t" \
    "strh r6, [r1, #" AT "]\n\t" \
    "lsrs r6, r3, #16\n\t" \
    "uxtb r6, r6\n\t" \
    "lsls r6, r6, #16\n\t" \
    "lsrs r7, r4, #16\n\t" \
    "uxtb r7, r7\n\t" \
    "lsls r7, r7, #8\n\t" \
    "orrs r6, r7\n\t" \
    "lsrs r7, r5, #16\n\t" \
    "uxtb r7, r7\n\t" \
    "orrs r6, r7\n\t" \
    "str r6, [r0, #" PLACE "]\n" LABEL ": add r3, r9\n\t" \
    "add r4, r10\n\t" \
    "add r5, r11\n\t"

/* Codes of wide pixels, two a round: r0 points to pixels, r1 to depths; z in r2, colours in r3, r4 and r5, their steps in r8 to r11, the
 * last pair's end in r12. A quarter fewer instructions than compilers take. */
static inline void shade_run_armv6m(uint32_t *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz, const struct shade *k)
{
    register uint32_t *r0 __asm__("r0") = pixels;
    register uint16_t *r1 __asm__("r1") = depth;
    register uint32_t r2 __asm__("r2") = z;
    register const uint32_t *r3 __asm__("r3") = k->c;
    register uint32_t r4 __asm__("r4") = dz;
    register int32_t r5 __asm__("r5") = n;
    __asm__ volatile(".syntax unified\n\t"
                     "mov r8, r4\n\t"
                     "lsrs r6, r5, #1\n\t"
                     "lsls r6, r6, #2\n\t"
                     "adds r6, r6, r1\n\t"
                     "mov r12, r6\n\t"
                     "movs r7, r3\n\t"
                     "adds r7, #12\n\t"
                     "ldm r7, {r4, r6, r7}\n\t"
                     "mov r9, r4\n\t"
                     "mov r10, r6\n\t"
                     "mov r11, r7\n\t"
                     "movs r7, #1\n\t"
                     "ands r7, r5\n\t"
                     "mov lr, r7\n\t"
                     "ldm r3, {r3, r4, r5}\n\t"
                     "b 3f\n"
                     "1: " SHADE_RUN_PIXEL("0", "0", "2") SHADE_RUN_PIXEL("2", "4", "2")
                     "adds r0, #8\n\t"
                     "adds r1, #4\n"
                     "3: cmp r1, r12\n\t"
                     "bne 1b\n\t"
                     "mov r7, lr\n\t"
                     "cmp r7, #0\n\t"
                     "beq 4f\n\t" SHADE_RUN_PIXEL("0", "0", "2")
                     "4:"
                     : "+r"(r0), "+r"(r1), "+r"(r2), "+r"(r3), "+r"(r4), "+r"(r5)
                     :
                     : "r6", "r7", "r8", "r9", "r10", "r11", "r12", "lr", "cc", "memory");
}
#endif

/* The same of codes and wide pixels. */
static inline void shade_run_codes(uint32_t *pixels, uint16_t *depth, int32_t n, uint32_t z, uint32_t dz, const struct shade *k)
{
#if SMEAR_ASM_ARMV6M
    shade_run_armv6m(pixels, depth, n, z, dz, k);
#else
    shade_run_reference(pixels, depth, n, z, dz, k, false, false);
#endif
}

#endif

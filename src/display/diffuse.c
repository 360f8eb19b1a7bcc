/* SPDX-License-Identifier: MIT */
/* diffuse.c - see diffuse.h. The weights are those of Floyd and Steinberg, "An Adaptive Algorithm for Spatial Greyscale",
 * 1976: 7 to the right, 3, 5, 1 below, of 16.
 *
 * 1-bit displays, which have no greys to lose, get more contrast: code c becomes (c - 32) 4/3. And edges are kept: half
 * of what a pixel differs from those on its left and above is added, so that outlines stay whole where both of their sides
 * round alike. Where something moves, what is left over changes for all pixels that come after it, and what stands still
 * there would flicker. So the threshold of a bit is not 128 but between 96 and 160, by the place's own in the pattern of
 * ordered dither: dots keep their places, and a still pixel changes about half as often. */
#include "display/diffuse.h"

#include "base/tables.h"

#if SMEAR_WITH_GREY && SMEAR_WITH_DISPLAY

/* A code as a 1-bit display has it, of which the neighbours' codes are known. */
static inline int32_t with_contrast(int32_t code, int32_t left, int32_t above)
{
    const int32_t sharp = code + ((2 * code - left - above) >> 1);
    return (sharp * 341 >> 8) - 43;
}

/* Returns the nearest of 16 greys. */
static inline int32_t nearest_grey(int32_t code)
{
    return clamp_i32((code * 15 * 257 + 32768) >> 16, 0, 15);
}

/* Sets pixel (x, y) of a band; pixels come row by row, from left to right. */
static inline void put(uint8_t *band, int32_t width, int32_t x, int32_t y, smear_format format, int32_t level)
{
    if (format == SMEAR_L4) {
        uint8_t *byte = band + y * ((width + 1) / 2) + x / 2;
        *byte = (uint8_t)(x & 1 ? *byte | level : level << 4);
    } else if (format == SMEAR_L1) {
        uint8_t *byte = band + y * ((width + 7) / 8) + x / 8;
        *byte = (uint8_t)((x & 7 ? *byte : 0) | level << (7 - (x & 7)));
    } else {
        uint8_t *byte = band + (y >> 3) * width + x;
        *byte = (uint8_t)((y & 7 ? *byte : 0) | level << (y & 7));
    }
}

void smear_diffuse_band(uint8_t *band, int32_t width, int32_t y, int32_t rows, smear_format format, void *state)
{
    int16_t *left_over = (int16_t *)state;      /* of pixel x: at x + 1 */
    uint8_t *above = (uint8_t *)(left_over + width + 2);
    const int32_t y0 = y;
    if (y == 0) {
        __builtin_memset(left_over, 0, ((uint32_t)width + 2u) * sizeof *left_over);
        __builtin_memcpy(above, band, (uint32_t)width);
    }
    for (; y < y0 + rows; y++) {
        const uint8_t *in = band + (y - y0) * width, *place = smear_dither_ordered + ((y & 7) << 3);
        int32_t right = 0, below = 0, behind = 0, left = in[0];
        for (int32_t x = 0; x < width; x++) {
            const int32_t code = in[x], given = right + left_over[x + 1];
            int32_t wanted, level, rest;
            if (format == SMEAR_L4) {
                wanted = code + given;
                level = nearest_grey(wanted);
                rest = wanted - level * 17;
            } else {
                wanted = with_contrast(code, left, above[x]) + given;
                level = wanted >= 96 + (place[x & 7] >> 2);
                rest = clamp_i32(wanted - level * 255, -128, 127);
            }
            const int32_t three = rest * 3 >> 4, five = rest * 5 >> 4, one = rest >> 4;
            left_over[x] = (int16_t)(behind + three);
            behind = below + five;
            below = one;
            right = rest - three - five - one;
            left = above[x] = (uint8_t)code;
            put(band, width, x, y - y0, format, level);
        }
        left_over[width] = (int16_t)behind;
    }
}

#endif

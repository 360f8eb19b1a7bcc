/* SPDX-License-Identifier: MIT */
/* color.h - between display codes and linear light, by the exact sRGB curve (IEC 61966-2-1). */
#ifndef SMEAR_TOOLS_SCENES_COLOR_H
#define SMEAR_TOOLS_SCENES_COLOR_H

#include <math.h>
#include <stdint.h>

/* Both map 0..1 to 0..1. */
static inline double color_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

static inline double color_encode(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

/* Display codes 0..255 as an opaque linear colour. */
static inline void color_from_codes(double r, double g, double b, float out[4])
{
    out[0] = (float)color_decode(r / 255.0);
    out[1] = (float)color_decode(g / 255.0);
    out[2] = (float)color_decode(b / 255.0);
    out[3] = 1.0f;
}

/* 0xRRGGBB, as on the web, as an opaque linear colour. */
static inline void color_from_hex(uint32_t rgb, float out[4])
{
    color_from_codes((double)(rgb >> 16 & 255), (double)(rgb >> 8 & 255), (double)(rgb & 255), out);
}

#endif

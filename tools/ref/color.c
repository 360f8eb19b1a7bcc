/* SPDX-License-Identifier: MIT */
/* ref_color.c - the sRGB transfer function, for the reference renderer and the reference filter. */
#include "tools/ref/ref.h"

#include <math.h>

static double clamp_unit(double value)
{
    return value > 0.0 ? (value < 1.0 ? value : 1.0) : 0.0;
}

double ref_srgb_encode(double linear)
{
    double l = clamp_unit(linear);
    return l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1.0 / 2.4) - 0.055;
}

double ref_srgb_decode(double encoded)
{
    double e = clamp_unit(encoded);
    return e <= 0.04045 ? e / 12.92 : pow((e + 0.055) / 1.055, 2.4);
}

uint8_t ref_code(double code)
{
    return (uint8_t)floor(255.0 * clamp_unit(code / 255.0) + 0.5 + 1e-6);
}

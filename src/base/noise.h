/* SPDX-License-Identifier: MIT */
/* noise.h - interleaved gradient noise [Jimenez14]: frac(52.9829189 frac(0.06711056 x + 0.00583715 y)). */
#ifndef SMEAR_NOISE_H
#define SMEAR_NOISE_H

#include "base/base.h"

/* The inner factors in q32; adding them steps from pixel to pixel. */
#define NOISE_X 288237660u
#define NOISE_Y 25070368u

/* Returns the noise, q16. The outer factor is 53 - 0.0170811, 35822 in q21. */
static inline uint32_t noise_of(uint32_t inner)
{
    return (inner * 53u - ((inner >> 16) * 35822u >> 5)) >> 16;
}

#endif

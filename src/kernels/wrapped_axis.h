/* SPDX-License-Identifier: MIT */
/* wrapped_axis.h - texels of a picture's axis at eight coordinates, which repeat, stay at the borders or turn back there. */
#ifndef SMEAR_KERNELS_WRAPPED_AXIS_H
#define SMEAR_KERNELS_WRAPPED_AXIS_H

#include "smear.h"

#include "kernels/lanes8.h"

#if SMEAR_AVX2

/* An axis of a picture. Coordinates count from a multiple of the period below all there are, and are less than 2^17 then: the
 * upper half of their product with 2^32 / period is how often that fits, exactly. */
struct wrapped_axis {
    lanes8 bias, over, period;
    lanes8i size;
    int mode;
};

SMEAR_AVX2_INLINE struct wrapped_axis wrapped_axis_make(int32_t size, int mode)
{
    const uint32_t period = (uint32_t)(mode == SMEAR_MIRROR ? 2 * size : size);
    return (struct wrapped_axis){ lanes8_all((32767u / period + 1u) * period), lanes8_all(UINT32_MAX / period + 1u), lanes8_all(period),
                                  lanes8i_all(size), period > 1 ? mode : SMEAR_CLAMP };
}

/* Coordinates q16. */
SMEAR_AVX2_INLINE lanes8i wrapped_axis_index(const struct wrapped_axis *a, lanes8 at)
{
    const lanes8i i = (lanes8i)at >> 16;
    if (a->mode == SMEAR_CLAMP)
        return lanes8i_max(lanes8i_min(i, a->size - 1), lanes8i_all(0));
    const lanes8 n = (lanes8)i + a->bias;
    const lanes8i inside = (lanes8i)(n - lanes8_mulh(n, a->over) * a->period);
    return a->mode == SMEAR_MIRROR ? lanes8i_min(inside, (lanes8i)a->period - 1 - inside) : inside;
}
#endif

#endif

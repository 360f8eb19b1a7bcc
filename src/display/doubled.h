/* SPDX-License-Identifier: MIT */
/* doubled.h - desc.display.doubled: displays twice as wide or high as what is drawn. */
#ifndef SMEAR_DOUBLED_H
#define SMEAR_DOUBLED_H

#include "smear.h"

#include "base/base.h"

static inline bool is_doubled(const smear_desc *d)
{
    return SMEAR_WITH_DISPLAY && d->display.doubled != SMEAR_DOUBLED_NONE;
}

/* Return how many columns or rows of the display so many of the picture are. */
static inline int32_t doubled_x(const smear_desc *d, int32_t columns)
{
    return SMEAR_WITH_DISPLAY ? columns << (d->display.doubled & SMEAR_DOUBLED_X) : columns;
}

static inline int32_t doubled_y(const smear_desc *d, int32_t rows)
{
    return SMEAR_WITH_DISPLAY ? rows << (d->display.doubled >> 1) : rows;
}

/* Doubles finished pixels of a band in place. The buffer has room for what comes of them. */
void smear_double_band(uint8_t *pixels, int32_t width, int32_t rows, smear_format format, int doubled);

#endif

/* SPDX-License-Identifier: MIT */
/* diffuse.h - SMEAR_DITHER_DIFFUSE: what rounding a pixel to few greys leaves over goes to its neighbours. */
#ifndef SMEAR_DIFFUSE_H
#define SMEAR_DIFFUSE_H

#include "smear.h"

#include "base/base.h"

/* Whether bands are drawn in 8-bit grey and made the display's pixels when they are whole. */
static inline bool format_diffuses(const smear_desc *d)
{
    return SMEAR_WITH_GREY && SMEAR_WITH_DISPLAY && d->display.dither == SMEAR_DITHER_DIFFUSE;
}

/* Returns the bytes of what a row leaves to the next one. */
static inline uint32_t smear_diffuse_bytes(int32_t width)
{
    return 3u * (uint32_t)width + 4u;
}

/* Makes pixels of `format` (SMEAR_L4, SMEAR_L1, SMEAR_L1_PAGES) of a band of whole rows in SMEAR_L8, in place: what is
 * written lies before all that is still to be read. The rows of a frame come from top to bottom, y is the first of them.
 * `state` is of smear_diffuse_bytes, 2-byte aligned; row 0 finds nothing in it. */
void smear_diffuse_band(uint8_t *band, int32_t width, int32_t y, int32_t rows, smear_format format, void *state);

#endif

/* SPDX-License-Identifier: MIT */
/* screen.h - what rounding a pixel to few greys leaves over goes to its neighbours. */
#ifndef SMEAR_SCREEN_H
#define SMEAR_SCREEN_H

#include "smear.h"

/* Makes pixels of `format` (SMEAR_L4, SMEAR_L1, SMEAR_L1_PAGES) of a band of whole rows in SMEAR_L8, in place: what is
 * written lies before all that is still to be read. The rows of a frame come from top to bottom, y is the first of them.
 * `state` is of smear_diffuse_bytes, 2-byte aligned; row 0 finds nothing in it. */
void smear_diffuse_band(uint8_t *band, int32_t width, int32_t y, int32_t rows, smear_format format, void *state);

#endif

/* SPDX-License-Identifier: MIT */
/* temporal_rows.h - tile rows by methods that look at several instants. */
#ifndef SMEAR_TEMPORAL_ROWS_H
#define SMEAR_TEMPORAL_ROWS_H

#include "display/band.h"

/* Draws, finishes and hands out the tile rows [first, end), a part of the frame that has
 * been assembled. Returns as smear_band_flush. */
int smear_temporal_rows(struct smear_context *c, int first, int end);

#endif

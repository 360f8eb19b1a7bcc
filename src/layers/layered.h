/* SPDX-License-Identifier: MIT */
/* layered.h - tile rows with blurred layers over the static scene. */
#ifndef SMEAR_LAYERED_H
#define SMEAR_LAYERED_H

#include "display/row.h"
#include "layers/groups.h"

/* Draws and finishes the tile rows [first, end), a part of the frame that has been assembled; `samples` of filters.
 * Returns as smear_band_flush. */
int smear_layered_rows(struct smear_layers *l, struct smear_rows *rows, int32_t samples, int first, int end);

#endif

/* SPDX-License-Identifier: MIT */
/* smooth.h - smooth edges of what stands still, for methods that look at several instants. */
#ifndef SMEAR_SMOOTH_H
#define SMEAR_SMOOTH_H

#include "methods/temporal.h"

/* Smooths edges in a tile row that is drawn, before anything moves in it. Rows come from top to bottom. Takes the work memory
 * of the method and the scratch of the rows. */
void smear_smooth_static(struct smear_rows *rows, int row, const struct smear_temporal *temporal);

#endif

/* SPDX-License-Identifier: MIT */
/* timed.h - tile rows by methods that look at several instants. */
#ifndef SMEAR_TIMED_H
#define SMEAR_TIMED_H

#include "band.h"

/* Draws the tile rows [first, end), a part of the frame that has been assembled from row `top` on; finishes and hands out
 * what can be: with smooth tiles the last row waits for the next part, unless it is the frame's. Returns as
 * smear_band_flush. */
int smear_timed_rows(struct smear_context *c, int top, int first, int end);

#endif

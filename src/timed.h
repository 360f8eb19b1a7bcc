/* SPDX-License-Identifier: MIT */
/* timed.h - tile rows by methods that look at several instants. */
#ifndef SMEAR_TIMED_H
#define SMEAR_TIMED_H

#include "band.h"

/* Draws, finishes and hands out the tile rows [first, end), a part of the frame that has
 * been assembled. Returns as smear_band_flush. */
int smear_timed_rows(struct smear_context *c, int first, int end);

#endif

/* SPDX-License-Identifier: MIT */
/* timed.h - tile rows finished by methods that look at several instants. */
#ifndef SMEAR_TIMED_H
#define SMEAR_TIMED_H

#include "band.h"

/* Before the rows of a frame. */
void smear_timed_begin(struct smear_context *c);

/* The row's still scene has been drawn into the window: what moves in it is listed, and what can be finished is. Without
 * a window that is the whole row, which is handed out; with one, movers are then drawn into it, and the row above is handed
 * out. `last`: the row below belongs to another part of the frame, or there is none. Returns as smear_band_flush. */
int smear_timed_row(struct smear_context *c, int row, bool last);

#endif

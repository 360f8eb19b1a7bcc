/* SPDX-License-Identifier: MIT */
/* frame.h - a frame: the order of its stages. */
#ifndef SMEAR_FRAME_H
#define SMEAR_FRAME_H

#include "base/base.h"
#include "context.h"

/* Draws what was submitted and hands it to flush. Returns SMEAR_OK, or what flush returned if negative. */
int smear_frame_render(struct smear_context *c);

/* Keeps a frame whose pointers have been followed. */
void smear_frame_keep(struct smear_context *c, const smear_frame *f);

/* Get the stages ready for a frame, and sum up its statistics: what comes before all rows, and after them. `by_depth`: velocities may
 * come from depth. */
void smear_frame_prepare(struct smear_context *c, bool by_depth);
void smear_frame_sum_up(struct smear_context *c);

/* Measures or cuts all that a context needs beside itself; `c` receives the addresses, which mean nothing while
 * measuring. The desc is valid, its defaults filled in. */
void smear_layout(struct smear_context *c, struct smear_arena *a, const smear_desc *d);

#endif

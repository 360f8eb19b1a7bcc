/* SPDX-License-Identifier: MIT */
/* layout.h - cuts a context's memory. */
#ifndef SMEAR_LAYOUT_H
#define SMEAR_LAYOUT_H

#include "base/arena.h"
#include "context.h"

/* Measures or cuts all that a context needs beside itself; `c` receives the addresses, which mean nothing while
 * measuring. The desc is valid, its defaults filled in. */
void smear_layout(struct smear_context *c, struct smear_arena *a, const smear_desc *d);

#endif

/* SPDX-License-Identifier: MIT */
/* probe.h - what tests and tools may look at in a context, after flush was called or a frame was drawn. Firmware does not
 * link it. */
#ifndef SMEAR_PROBE_H
#define SMEAR_PROBE_H

#include "filter/filtered.h"
#include "methods/temporal.h"

struct smear_probe {
    const struct smear_rows *rows;          /* window, lists, store of triangles */
    const struct smear_filtered *filtered;  /* the window that is filtered */
    const struct smear_temporal *temporal;  /* moving triangles of the last row */
    uint8_t method;                         /* smear_method of the frame, defaults filled in */
    int32_t samples;
    int32_t half_exposure;                  /* q24 frames */
    bool direct;                            /* drawn as the display's pixels */
};

struct smear_probe smear_probe(const smear_context *c);

#endif

/* SPDX-License-Identifier: MIT */
/* frame.h - a frame: the order of its stages. */
#ifndef SMEAR_FRAME_H
#define SMEAR_FRAME_H

#include "context.h"

/* Draws what was submitted and hands it to flush. Returns SMEAR_OK, or what flush returned if negative. */
int smear_frame_render(struct smear_context *c);

/* The filter alone: begins, then takes a row of another renderer's pixels at a time. */
void smear_frame_filter_begin(struct smear_context *c);
int smear_frame_filter_row(struct smear_context *c, const uint32_t *color, const uint32_t *depth,
                           const int16_t *velocity);

#endif

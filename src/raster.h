/* SPDX-License-Identifier: MIT */
/* raster.h - a list of triangles into rows of colour, depth and velocity. */
#ifndef SMEAR_RASTER_H
#define SMEAR_RASTER_H

#include "target.h"

/* Draws the list that starts with triangle `head`, in order. */
void smear_raster_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                       uint32_t head);

#endif

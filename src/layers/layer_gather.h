/* SPDX-License-Identifier: MIT */
/* layer_gather.h - a blurred layer by the velocities of its pixels, over the background: the reconstruction filter
 * where what lies behind is known. */
#ifndef SMEAR_LAYER_GATHER_H
#define SMEAR_LAYER_GATHER_H

#include "layers/layer.h"

/* The longest velocity of a column as wide as a tile, or of it and its neighbours, 1/8 px. */
struct smear_layer_cell {
    int16_t x, y;
    uint8_t any;                /* something is drawn there */
};

enum { SMEAR_GATHER_TAPS = 64 };

/* Finds the layer's cells. */
void smear_gather_cells(const struct smear_layer_area *a);

/* Merges the area; returns the taps taken. */
uint32_t smear_gather_merge(const struct smear_layer_area *a);

/* Merges the mean of `samples` places along one displacement (q8 px): the two-camera approach as it is. Returns the
 * taps taken. */
uint32_t smear_two_camera_merge(const struct smear_layer_area *a, int32_t vx, int32_t vy);

#endif

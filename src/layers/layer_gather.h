/* SPDX-License-Identifier: MIT */
/* layer_gather.h - a blurred layer by the velocities of its pixels, over the still scene: the
 * reconstruction filter where what lies behind is known. */
#ifndef SMEAR_LAYER_GATHER_H
#define SMEAR_LAYER_GATHER_H

#include "layers/layer.h"

/* Longest velocity of a column of cells as wide as a tile and of its
 * neighbours, 1/8 px; any: something is drawn. */
struct smear_layer_cell {
    int16_t x, y;
    uint8_t any;
};

enum { SMEAR_GATHER_TAPS = 64 };

/* Where a layer is merged. */
struct smear_gather_area {
    const struct smear_layer_rows *layer;
    int32_t x0, x1, rows;       /* columns that are drawn, and rows */
    int32_t top;                /* which of them is the first to be finished */
    uint32_t *still;            /* first pixel of the frame's row to be finished */
    const uint16_t *still_depth;
    int32_t still_stride;
    /* Where groups pass through each other, as in streak.h. */
    uint32_t *passed;
    uint16_t *passed_depth;
    int32_t mixed0, mixed1;
    bool marks;
    int32_t left, right, height;            /* columns and rows of the frame to be finished */
    int32_t tile_shift, samples;
    bool linear, over;          /* over: whatever the depths are */
};

/* Finds the layer's cells. */
void smear_gather_cells(const struct smear_gather_area *a);

/* Merges. Returns the taps taken. */
uint32_t smear_gather_merge(const struct smear_gather_area *a);

/* The mean of `samples` places along one displacement (q8 px): the two-camera approach as it is. Likewise. */
uint32_t smear_two_camera_merge(const struct smear_gather_area *a, int32_t vx, int32_t vy);

#endif

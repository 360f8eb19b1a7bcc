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

/* What is merged of a layer, and where. */
struct smear_gather_area {
    const struct smear_layer_rows *layer;
    int32_t x0, x1, rows;       /* columns that are drawn, and rows */
    int32_t top;                /* the first row to be finished */
    uint32_t *background;       /* first pixel of the frame's row to be finished */
    const uint16_t *background_depth;
    int32_t background_stride;
    /* As `over`, `over_depth` and those after them in streak.h. */
    uint32_t *passed;
    uint16_t *passed_depth;
    int32_t mixed0, mixed1;
    bool marks;
    int32_t left, right, height;            /* columns and rows of the frame to be finished */
    int32_t tile_shift, samples;
    bool linear;
    bool over;                  /* the layer lies in front of the background, whatever the depths are */
};

/* Finds the layer's cells. */
void smear_gather_cells(const struct smear_gather_area *a);

/* Merges the area; returns the taps taken. */
uint32_t smear_gather_merge(const struct smear_gather_area *a);

/* Merges the mean of `samples` places along one displacement (q8 px): the two-camera approach as it is. Returns the
 * taps taken. */
uint32_t smear_two_camera_merge(const struct smear_gather_area *a, int32_t vx, int32_t vy);

#endif

/* SPDX-License-Identifier: MIT */
/* edges.h - smooth edges of what stands still: where colours differ from pixel to pixel, all is drawn at three more places
 * within the pixel, and each pixel becomes the mean of all four. They lie on lines of their own along x and along y, and their
 * mean is the centre. */
#ifndef SMEAR_SMOOTH_EDGES_H
#define SMEAR_SMOOTH_EDGES_H

#include "raster/target.h"

/* Colours are looked at in units of so many columns and rows of pixels. */
enum { EDGE_UNIT_LOG2 = 3, EDGE_BAND_LOG2 = 3, EDGE_UNITS_MAX = 2048 >> EDGE_UNIT_LOG2, EDGE_PLACES = 3 };

/* Which units of a tile row have edges: a bit for each band of rows, for each unit of columns. */
struct smear_edge_units {
    uint8_t bands[SMEAR_EDGES ? EDGE_UNITS_MAX : 1];
};

/* Finds units with edges in the target's columns, which begin with a tile. `below` are the pixels of the row below it, from
 * column x0 on, or null at the frame's border; what they tell of it is left for the next tile row in t->moving. `width`: of
 * the frame. */
void smear_edges_find(struct smear_edge_units *e, const struct smear_raster_target *t, const uint32_t *below, int32_t width);

/* Whether there are edges in columns [x0, x1) of pixels. */
bool smear_edges_any(const struct smear_edge_units *e, int32_t x0, int32_t x1);

/* Some columns of a tile row that are drawn at the other places. */
struct smear_edge_planes {
    uint32_t *color[EDGE_PLACES];
    uint16_t *depth;
};

/* Returns the target of place k, cut to the columns [x0, x1) of `t`, in planes of so many columns. */
struct smear_raster_target smear_edges_target(const struct smear_raster_target *t, const struct smear_edge_planes *planes, int k);

/* Makes units with edges empty. */
void smear_edges_clear(const struct smear_edge_units *e, const struct smear_raster_target *t, uint32_t color);

/* Draws what of the list may be seen in units with edges at place k. */
void smear_edges_draw(const struct smear_edge_units *e, const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                      uint32_t head, int k);

/* Takes the mean of all places. */
void smear_edges_mean(const struct smear_edge_units *e, const struct smear_raster_target *t, const struct smear_edge_planes *planes,
                      smear_transfer transfer);

#endif

/* SPDX-License-Identifier: MIT */
/* row_lists.h - what moves in a tile row: its moving triangles, and what they mean for its tiles. */
#ifndef SMEAR_ROW_LISTS_H
#define SMEAR_ROW_LISTS_H

#include "raster/window.h"
#include "temporal/tile_method.h"

struct smear_row_moving {
    struct smear_moving_triangle *moving;
    uint32_t count;
    struct smear_tile_travel *travel;           /* per tile */
};

/* Lists the moving triangles from `head` on, for the tile row whose first pixel row is `top`. */
void smear_list_moving(struct smear_row_moving *r, const struct smear_bins *bins, const struct smear_window *w,
                       uint32_t head, int32_t top);

/* Marks the tiles of blended draws, from `head` on. */
void smear_list_blended(struct smear_row_moving *r, const struct smear_bins *bins, const struct smear_window *w,
                        uint32_t head, int32_t top);

/* Adds the areas of a ring of moving triangles, before it is opened: `last` is its last. */
void smear_add_areas(struct smear_travel_areas *areas, const struct smear_bins *bins, uint32_t last);

#endif

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
    struct smear_row_blocks blocks;
    bool measures;                              /* how far triangles go is asked, besides where */
};

/* Begins a tile row: nothing moves in its tiles so far. */
void smear_list_begin(struct smear_row_moving *r, const struct smear_window *w);

/* Adds what the moving triangles from `head` on mean for the tiles of columns [first, end) and for their blocks, in the tile
 * row whose first pixel row is `top`. Columns are independent of each other. */
void smear_list_columns(struct smear_row_moving *r, const struct smear_bins *bins, const struct smear_window *w,
                        uint32_t head, int32_t top, int32_t first, int32_t end);

/* Lists the moving triangles from `head` on. */
void smear_list_moving(struct smear_row_moving *r, const struct smear_bins *bins, const struct smear_window *w,
                       uint32_t head);

/* Marks the tiles of blended draws, from `head` on. */
void smear_list_blended(struct smear_row_moving *r, const struct smear_bins *bins, const struct smear_window *w,
                        uint32_t head, int32_t top);

/* Adds the areas of moving triangles from `head` to `last`, or to the list's end. */
void smear_add_areas(struct smear_travel_areas *areas, const struct smear_bins *bins, uint32_t head, uint32_t last);

#endif

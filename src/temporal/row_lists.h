/* SPDX-License-Identifier: MIT */
/* row_lists.h - what moves in a tile row: its moving triangles, and what they mean for its tiles. */
#ifndef SMEAR_ROW_LISTS_H
#define SMEAR_ROW_LISTS_H

#include "raster/window.h"
#include "temporal/tile_method.h"
#include "geometry/space.h"

struct smear_row_moving {
    struct smear_moving_triangle *moving;
    uint32_t count, room;
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
void smear_list_moving(struct smear_row_moving *r, const struct smear_bins *bins, const struct smear_window *w, uint32_t head);

/* Puts the moving triangles of a tile row that are listed in order from the front, so far as that makes no difference to any pixel at any
 * instant. As they are, where few pixels would be hidden. */
void smear_list_order(struct smear_row_moving *r, const struct smear_bins *bins, const struct smear_window *w, int32_t top);

/* Marks the tiles of blended draws, from `head` on. */
void smear_list_blended(struct smear_row_moving *r, const struct smear_bins *bins, const struct smear_window *w,
                        uint32_t head, int32_t top);

/* Adds the areas of moving triangles from `head` to `last`, or to the list's end. */
void smear_add_areas(struct smear_travel_areas *areas, const struct smear_bins *bins, uint32_t head, uint32_t last);

/* ------------------------------------------------------------------ row_space.c */

/* How triangles with paths in space (geometry/space.h) move from place to place of the middle of the exposure. */

/* Values that change evenly from pixel to pixel: `at` the pixel that is looked at, and by how much per step to the right and
 * down. */
struct smear_even {
    int64_t at, right, down;
};

/* A plane in the middle of the exposure and where its pixels come from and go: a homography to open and one to close. Values of
 * each group have one factor of their own, which their quotients lose. */
struct smear_plane_motion {
    struct smear_even side[3];          /* how far inside of each side: none is below 0 on the triangle */
    struct smear_even pose[2][3];       /* X, Y, W at open and at close */
    int32_t depth[3];                   /* of the vertices of an orthographic camera, q11 >> 14 */
    int32_t nearness, nearness_shift;   /* else: from the sum of the sides to that of a pixel */
    bool is_even;                       /* orthographic */
    int32_t width, height, coarse;
};

/* Where a pixel of the plane goes: its displacement from open to close, and how far the path's middle lies off the chord,
 * twice, all 1/16 px; and its depth, as blocks have it. */
struct smear_place_motion {
    int32_t x, y, bend;
    uint16_t depth;
};

enum { PLACE_UNKNOWN = INT16_MAX };     /* bend of what comes from behind the eye or goes there, without a displacement */

/* Finds the motion of a triangle's plane from the middle of pixel (x, y) on, in steps of `step` pixels. False where it is not
 * seen in the middle of the exposure. */
bool smear_plane_motion_make(struct smear_plane_motion *m, struct smear_space *space, const int32_t *const record[3],
                             int32_t x, int32_t y, int32_t step);

/* Goes on by a step to the right, or down. */
void smear_plane_motion_go(struct smear_plane_motion *m, bool down);

/* Finds the motion at a pixel, which lies at (x, y). False where the triangle does not cover it in the middle of the exposure. */
bool smear_plane_motion_at(struct smear_place_motion *out, const struct smear_plane_motion *m, int32_t x, int32_t y);

#endif

/* SPDX-License-Identifier: MIT */
/* moving.h - the moving triangles of a tile row, and a run of tiles in which some are seen. */
#ifndef SMEAR_MOVING_H
#define SMEAR_MOVING_H

#include "geometry/path.h"
#include "raster/target.h"

/* A moving triangle of the tile row, in submission order. */
struct smear_moving_triangle {
    uint32_t triangle;
    uint8_t first, last;        /* tile columns it may touch during the exposure */
    uint16_t nearest;           /* depth code it does not exceed: larger is nearer */
};

/* A run of tiles beside each other, or one tile, to be finished by a method that looks at several instants. */
struct smear_tile_run {
    const struct smear_raster_frame *frame;
    const struct smear_shutter_times *shutter;
    struct smear_raster_target background;      /* what does not move, drawn; only read. Its y0, y1 are the tiles', its
                                                 * x0, x1, too, or a little beyond */
    int32_t x0, x1;                             /* columns of pixels of the tiles */
    const struct smear_moving_triangle *moving; /* of the row: those whose columns meet these are seen here */
    uint32_t moving_count;
    int32_t column, last_column;                /* tiles */
    uint32_t blend;                             /* blended triangles of the row, static and moving ones, or
                                                 * SMEAR_NO_TRIANGLE */
    uint32_t *out;                              /* finished working pixels, rows `pitch` apart */
    int32_t pitch;
    int32_t tile;                               /* edge, pixels */
    /* Where the row's triangles do not find room at once (display/row.h), else null: `moving` and `blend` are only some of
     * them, the first ones or, with `next`, those after; false when there are none left. `kinds`: FILL_MOVING ... Of what
     * moves, those that are seen in columns [fill_x0, fill_x1) */
    bool (*fill)(struct smear_tile_run *t, int kinds, bool next);
    const void *fill_of;
    int32_t fill_x0, fill_x1;
    void *work;                                 /* memory of the worker's own */
};

static inline bool moving_is_in(const struct smear_moving_triangle *m, const struct smear_tile_run *t)
{
    return m->first <= t->last_column && m->last >= t->column;
}

#endif

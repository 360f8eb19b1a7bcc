/* SPDX-License-Identifier: MIT */
/* subframes.h - tiles in which something moves: their triangles drawn again at several instants, or by the time they cover. */
#ifndef SMEAR_SUBFRAMES_H
#define SMEAR_SUBFRAMES_H

#include "geometry/path.h"
#include "kernels/light_sums.h"
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
    bool is_bare;                               /* it is known that nothing stands still there: depths are 0 */
    int32_t x0, x1;                             /* columns of pixels of the tiles */
    const struct smear_moving_triangle *moving; /* of the row: those whose columns meet these are seen here */
    uint32_t moving_count;
    int32_t column, last_column;                /* tiles */
    uint32_t blend;                             /* blended triangles of the row, static and moving ones, or
                                                 * SMEAR_NO_TRIANGLE */
    uint32_t *out;                              /* finished working pixels, rows `pitch` apart */
    int32_t pitch;
    int32_t tile;                               /* edge, pixels */
    bool mixes;                                 /* few instants, as pictures of lines.h are mixed */
    /* Where the row's triangles do not find room at once (display/row.h), else null: `moving` and `blend` are only some of
     * them, the first ones or, with `next`, those after; false when there are none left. `kinds`: FILL_MOVING ... Of what
     * moves, those that are seen in columns [fill_x0, fill_x1) */
    bool (*fill)(struct smear_tile_run *t, int kinds, bool next);
    const void *fill_of;
    int32_t fill_x0, fill_x1;
    void *work;                                 /* memory of the worker's own */
};

/* Begins to go through triangles of the tiles, or goes on: where they find room at once they are there, once. */
static inline bool tile_run_fill(struct smear_tile_run *t, int kinds, bool next)
{
    return t->fill == NULL ? !next : t->fill(t, kinds, next);
}

static inline bool moving_is_in(const struct smear_moving_triangle *m, const struct smear_tile_run *t)
{
    return m->first <= t->last_column && m->last >= t->column;
}

/* Instants of which codes add up in 16 bits: without SMEAR_WITH_LINEAR there are no more. */
enum {
    SMEAR_PACKED_INSTANTS = PACKED_INSTANTS_MAX,
    SMEAR_SUBFRAMES_MOST = SMEAR_WITH_LINEAR ? (int)LIGHT_INSTANTS_MAX : (int)PACKED_INSTANTS_MAX
};

/* How all moving triangles of a tile go on from one instant to the next, nearly, in 1/16 px. */
struct smear_step {
    int16_t x, y;
};

/* Returns the bytes of work memory per worker for tiles that are `width` pixels wide together, and `height` high. */
size_t smear_subframes_work(int32_t width, int32_t height);

struct smear_tile_plan;

/* Writes the mean of `instants` (1 .. 1024) sharp instants, which stand in the middles of sub-intervals of equal weight.
 * Static opaque surfaces come from the background; moving triangles and all blended draws are drawn at every instant.
 * With a plan (tile_method.h), not null, it is asked how many there are when the middle one is drawn, and gaps between
 * instants are closed, unless something is blended there. Where the row's triangles do not find room at once, t->moving and
 * t->blend are others afterwards. Returns the samples taken. */
uint32_t smear_subframes_tiles(struct smear_tile_run *t, int32_t instants, const struct smear_tile_plan *plan);

/* Copies the background's colours, or puts PACKED_NOTHING in their place. */
void smear_tile_run_take_background(const struct smear_tile_run *t, uint32_t *color, bool nothing);

/* Finds depths in the middle of the exposure of what is opaque, of columns [x0, x1) of the tiles, when their pixels are done.
 * Returns them, in the work memory, in rows like those of `out`. */
uint16_t *smear_subframes_depth(const struct smear_tile_run *t, int32_t x0, int32_t x1);

/* ------------------------------------------------------------------ time masks */

/* Returns the bytes of work memory per worker, whatever the tile. */
size_t smear_timemask_work(void);

/* Draws a tile of opaque moving triangles that have paths on the screen, in 8, 16 or 32 time samples: what else there is, is for
 * subframes. Returns the fragments taken. */
uint32_t smear_timemask_tile(const struct smear_tile_run *t, int32_t samples);

#endif

/* SPDX-License-Identifier: MIT */
/* row.h - what the tile rows of a frame share: the window they are drawn in, their lists of triangles, jobs, bands.
 *
 * Methods get this and what they keep for themselves, never the context. */
#ifndef SMEAR_ROW_H
#define SMEAR_ROW_H

#include "smear_scene.h"

#include "base/jobs.h"
#include "geometry/shot.h"
#include "raster/raster.h"
#include "raster/window.h"

/* Finished pixels on their way to the display. */
struct smear_bands {
    uint8_t *buffer[2];
    uint32_t bytes;             /* of a buffer; what a row of SMEAR_DITHER_DIFFUSE leaves to the next lies behind
                                 * those of the first */
    uint32_t handed;            /* bands handed to flush so far */
    unsigned sent;              /* of them reported by smear_band_done */
};

/* What is asked of a sky, which lies in scene/: programs bring it by naming it. */
struct smear_sky_kind {
    /* Takes in where the camera looks at an instant; null: over the exposure. `width`: of the frame. */
    void (*aim)(smear_sky *sky, const struct smear_shot *shot, const struct smear_instant *instant, int32_t width, smear_transfer transfer);
    /* Fills the target's pixels, not its depths, and `too`: as wide rows of its tile row, one behind the other; or null. What a pixel gets
     * does not depend on the target's sides. */
    void (*fill)(const smear_sky *sky, const struct smear_raster_target *t, uint32_t *too);
};

/* Which draws a fill of the store takes. */
enum {
    FILL_STATIC = 1, FILL_MOVING = 2,           /* opaque and cut out */
    FILL_BLENDED = 4,
    FILL_GROUP = 8                              /* those of a group of a layer, and no others */
};

/* The group of a draw that is in none: it is drawn with the background. */
#define SMEAR_NO_GROUP 0xffffu

/* How a tile row is drawn whose triangles do not find room at once: the store is filled with some, then with the next ones
 * in their order, as often as it takes, and all over again for each picture that is drawn of them. */
struct smear_refill {
    void (*fill)(struct smear_refill *self);    /* draws.c */
    void *context;
    const void *instant;
    int row;
    uint8_t kinds;              /* FILL_STATIC | ... */
    uint8_t counted;            /* those that statistics have */
    uint16_t group;
    int32_t path_x0, path_x1;   /* as in struct smear_assembler */
    /* What the fill had no room for comes next; more than that: */
    bool more;
    bool failed;                /* a tile cannot be drawn of several fills */
    uint32_t draw, triangle;
    uint16_t parts;
};

struct smear_rows {
    const smear_desc *desc;     /* defaults filled in */
    smear_stats *stats;
    struct smear_window window;
    struct smear_bins bins;
    struct smear_raster_frame raster;
    struct smear_raster_cache cache;    /* of the first raster job */
    struct smear_jobs jobs;
    struct smear_bands bands;
    /* lists of the row that is drawn and of the row that is finished; SMEAR_NO_TRIANGLE before the first */
    uint32_t opaque, blend, moving;
    struct smear_refill *refill;        /* null: the lists hold all triangles of the row */
    bool blends;                /* some draw is blended */
    bool keeps_motion;          /* triangles that move write velocities into the window */
    uint16_t points;            /* the first listed point of the overlay's, or SMEAR_NO_POINT: overlay.h */
    uint32_t clear;             /* 0x00RRGGBB */
    smear_sky *sky;             /* in its place; or null */
    const smear_overlay *overlay;       /* what lies over the finished frame; or null */
    uint32_t *scratch;          /* finished pixels of a tile or strip per worker, or what cores draw sharp rows of their own in */
    uint8_t *scratch_end;       /* of that and all that temporal methods work in behind it, which other methods may use; or null */
    int32_t *inspect;           /* wide velocities, a plane like the window's; or null */
    uint32_t samples[SMEAR_WORKERS_MAX];        /* taken by each worker */
};

static inline bool rows_have_sky(const struct smear_rows *rows) { return SMEAR_WITH_SKY && rows->sky != NULL; }

static inline bool rows_have_overlay(const struct smear_rows *rows)
{
    return SMEAR_WITH_OVERLAY && rows->overlay != NULL;
}

/* ------------------------------------------------------------------ time */

static inline uint32_t stage_start(const struct smear_rows *rows)
{
    return rows->desc->debug.clock != NULL ? rows->desc->debug.clock(rows->desc->user) : 0;
}

static inline void stage_end(const struct smear_rows *rows, uint32_t *stage, uint32_t start)
{
    *stage += stage_start(rows) - start;
}

/* ------------------------------------------------------------------ places */

/* Return the first pixel row of a tile row, and the end of its rows. */
static inline int32_t row_top(const struct smear_rows *rows, int row)
{
    return row * rows->bins.row_px;
}

static inline int32_t row_bottom(const struct smear_rows *rows, int row)
{
    return min_i32(row_top(rows, row) + rows->bins.row_px, rows->window.height);
}

/* Return the first pixel column of a tile, and the end of its columns. */
static inline int32_t tile_left(const struct smear_rows *rows, int column)
{
    return column << rows->window.tile_shift;
}

static inline int32_t tile_right(const struct smear_rows *rows, int column)
{
    return min_i32(tile_left(rows, column) + rows->window.tile, rows->window.width);
}

/* Points `t` at the window's rows [y0, y1): colour and depth. */
void smear_window_target(const struct smear_rows *rows, int32_t y0, int32_t y1, struct smear_raster_target *t);

/* Points `t` at the window's rows of a tile row. */
void smear_row_target(const struct smear_rows *rows, int row, struct smear_raster_target *t);

/* Finds the columns of a job: the frame's width in as many equal cuts as there are workers. */
void smear_job_columns(const struct smear_rows *rows, int job, int32_t *x0, int32_t *x1);

/* Cuts the target of a tile row, or of some columns of it, down to what a raster job draws. Of two jobs, one draws the upper
 * half of the rows and one the lower: spans stay whole, what lies in few columns is shared, too, and the halves of a row are
 * more alike than its sides. Targets with velocities have columns of tiles of their own. False where nothing is left. */
bool smear_job_area(const struct smear_rows *rows, int job, struct smear_raster_target *t);

/* ------------------------------------------------------------------ jobs of a row */

/* What the jobs of a tile row share. A band may be a part of the row: pixel rows [y0, y1) and columns [x0, x1);
 * where an end is 0, all. */
struct row_job {
    struct smear_rows *rows;
    int row;
    uint8_t *band;              /* finished pixels: each tile's place is that of the same tile of a whole row
                                 * whose tiles lie one after the other */
    int32_t y0, y1;
    int32_t x0, x1;             /* of a temporal method */
    uint8_t steps;              /* ROW_CLEAR | ...: those that a job does, see smear_row_run */
    bool stays_clear;           /* what has no depth has the frame's colour, so that clearing what else is converted clears the next row */
    bool is_clear;              /* so the row before was */
    uint32_t *sky_too;          /* rows that get the sky of those that are cleared, too, and are cleared next; or null */
};

enum { ROW_CLEAR = 1, ROW_DRAW = 2, ROW_FINISH = 4, ROW_ALL = 7 };

static inline int32_t job_left(const struct row_job *r) { return SMEAR_WITH_SUBFRAMES && r->x1 != 0 ? r->x0 : 0; }

static inline int32_t job_right(const struct row_job *r)
{
    return SMEAR_WITH_SUBFRAMES && r->x1 != 0 ? r->x1 : r->rows->window.width;
}

static inline int32_t job_top(const struct row_job *r) { return r->y1 != 0 ? r->y0 : row_top(r->rows, r->row); }

static inline int32_t job_bottom(const struct row_job *r)
{
    return r->y1 != 0 ? r->y1 : row_bottom(r->rows, r->row);
}

/* ------------------------------------------------------------------ steps of a row */

/* Counts a tile: the kind of motion in it (smear_tile_class), and the method it got where that is not TILE_STATIC. */
void smear_row_count(const struct smear_rows *rows, int kind, smear_method method);

/* Fills the target's columns with what is behind all and depth 0, and with `velocity` bytes where it has velocities. `sky_too`: as in
 * row_job. */
void smear_row_clear(const struct smear_rows *rows, const struct smear_raster_target *t, int velocity, uint32_t *sky_too);

/* Makes a cache of setups of what the pool has left between vertices and triangles, or of other memory where that is more. */
void smear_row_make_cache(struct smear_rows *rows, void *other, size_t other_bytes);

/* Moves a list of triangles on to the row. */
static inline uint32_t row_advance(const struct smear_rows *rows, const uint32_t *last, uint32_t head, int row)
{
    return smear_bins_advance(&rows->bins, last, head, row);
}

/* Moves the list of blended triangles on to a row that is not refilled. */
static inline void row_advance_blended(struct smear_rows *rows, int row)
{
    if (SMEAR_WITH_ALPHA && rows->blends && rows->refill == NULL)
        rows->blend = row_advance(rows, rows->bins.blend_last, rows->blend, row);
}

/* Fills the store with triangles of a row, where it is refilled, and begins their lists: from the first one on; with the next
 * ones, if there are any left.
 *
 *     for (bool any = smear_row_fill(rows, row, kinds); any; any = smear_row_fill_next(rows)) */
bool smear_row_fill(struct smear_rows *rows, int row, int kinds);
bool smear_row_fill_next(struct smear_rows *rows);

/* Begins with the first one on, too, without what moves beside columns [x0, x1). */
bool smear_row_fill_columns(struct smear_rows *rows, int row, int kinds, int32_t x0, int32_t x1);

/* Runs a job for each cut of columns on the row's triangles of `kinds`: once, with all steps; where the row is refilled,
 * to clear, then for each fill to draw, then to finish. */
void smear_row_run(struct smear_rows *rows, smear_job_fn *job, struct row_job *argument, int kinds);

/* Draws the job's share of the row's opaque triangles over cleared rows of the target, whose x0 and x1 it sets. False
 * where the share is empty. */
bool smear_row_draw_opaque(const struct row_job *r, int job, struct smear_raster_target *t, int velocity);

/* Draws blended triangles of the row straight over its rows in the window: where no filter will read them. */
void smear_row_blend(struct smear_rows *rows, int row);

/* Draws the job's columns, of a list that has been moved on. */
void smear_row_blend_columns(struct row_job *job);

#endif

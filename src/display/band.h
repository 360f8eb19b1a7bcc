/* SPDX-License-Identifier: MIT */
/* band.h - tile rows on their way to the display: where they lie in
 * the frame, their buffers, conversion, flush. */
#ifndef SMEAR_BAND_H
#define SMEAR_BAND_H

#include "context.h"

/* ------------------------------------------------------------------ time */

static inline uint32_t stage_start(const struct smear_context *c)
{
    return c->desc.clock != NULL ? c->desc.clock(c->desc.user) : 0;
}

static inline void stage_end(const struct smear_context *c, uint32_t *stage, uint32_t start)
{
    *stage += stage_start(c) - start;
}

/* ------------------------------------------------------------------ rows */

/* Pixel rows of a tile row. */
static inline int32_t row_top(const struct smear_context *c, int row)
{
    return row * c->bins.row_px;
}

static inline int32_t row_bottom(const struct smear_context *c, int row)
{
    return min_i32(row_top(c, row) + c->bins.row_px, c->window.height);
}

/* Pixel columns of a tile. */
static inline int32_t tile_left(const struct smear_context *c, int column)
{
    return column << c->window.tile_shift;
}

static inline int32_t tile_right(const struct smear_context *c, int column)
{
    return min_i32(tile_left(c, column) + c->window.tile, c->window.width);
}

/* The window's rows of a tile row, to draw into. */
void smear_row_target(const struct smear_context *c, int row, struct smear_raster_target *t);

/* Columns of a raster job: the frame's width in as many equal cuts as there are workers. */
void smear_job_columns(const struct smear_context *c, int job, int32_t *x0, int32_t *x1);

/* What the jobs of a tile row share. A band may be a part of the row: pixel rows [y0, y1) and columns [x0, x1);
 * where the end is 0, all. */
struct row_job {
    struct smear_context *c;
    int row;
    uint8_t *band;              /* finished pixels: each tile's place is that of the same tile of a whole row
                                 * whose tiles lie one after the other */
    int32_t y0, y1;
    int32_t x0, x1;             /* of a timed method */
};

static inline int32_t job_left(const struct row_job *r) { return SMEAR_WITH_SUBFRAMES && r->x1 != 0 ? r->x0 : 0; }

static inline int32_t job_right(const struct row_job *r)
{
    return SMEAR_WITH_SUBFRAMES && r->x1 != 0 ? r->x1 : r->c->window.width;
}

static inline int32_t job_top(const struct row_job *r) { return r->y1 != 0 ? r->y0 : row_top(r->c, r->row); }

static inline int32_t job_bottom(const struct row_job *r)
{
    return r->y1 != 0 ? r->y1 : row_bottom(r->c, r->row);
}

/* ------------------------------------------------------------------ bands */

/* A buffer for the next rows; waits until what it held has been sent. */
uint8_t *smear_band_begin(struct smear_context *c);

/* Hands a tile row, or the job's part of it, to the display.
 * Returns SMEAR_OK, or what flush says if negative. */
int smear_band_flush(struct smear_context *c, int row, uint8_t *band);
int smear_band_flush_part(const struct row_job *r);

/* Converts columns [x0, x1) of the job's rows, which lie in a target or in the window. */
void smear_band_convert_rows(const struct row_job *r, const struct smear_raster_target *t, int32_t x0,
                             int32_t x1);
void smear_band_convert_window(const struct row_job *r, int32_t x0, int32_t x1);

/* Converts a tile of finished pixels, rows a tile apart. */
void smear_band_convert_tile(const struct row_job *r, int column, const uint32_t *tile);

/* Blended draws of the row (c->blend) over the job's rows of a tile, finished pixels. */
void smear_band_blend_tile(const struct row_job *r, int column, uint32_t *tile);

#endif

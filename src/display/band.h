/* SPDX-License-Identifier: MIT */
/* band.h - tile rows on their way to the display: their buffers, conversion, flush. */
#ifndef SMEAR_BAND_H
#define SMEAR_BAND_H

#include "smear.h"

#include "base/base.h"
#include "display/pixel_format.h"
#include "display/row.h"

static inline bool is_doubled(const smear_desc *d)
{
    return SMEAR_WITH_DISPLAY && d->display.doubled != SMEAR_DOUBLED_NONE;
}

/* Return how many columns or rows of the display so many of the picture are. */
static inline int32_t doubled_x(const smear_desc *d, int32_t columns)
{
    return SMEAR_WITH_DISPLAY ? columns << (d->display.doubled & SMEAR_DOUBLED_X) : columns;
}

static inline int32_t doubled_y(const smear_desc *d, int32_t rows)
{
    return SMEAR_WITH_DISPLAY ? rows << (d->display.doubled >> 1) : rows;
}

/* Returns what tiles are converted to. */
static inline smear_format drawn_format(const smear_desc *d)
{
    return format_diffuses(d) ? SMEAR_L8 : (smear_format)d->format;
}

/* Return the bytes of a band's buffer, a multiple of 8 where something lies behind it, and of what does: what is kept from
 * band to band. */
static inline uint32_t band_bytes(const smear_desc *d)
{
    const uint32_t drawn = smear_format_size(d->width, d->band_rows, drawn_format(d));
    if (!SMEAR_WITH_DISPLAY)
        return drawn;
    const uint32_t sent = smear_format_size(doubled_x(d, d->width), doubled_y(d, d->band_rows), (smear_format)d->format);
    return ((sent > drawn ? sent : drawn) + 7u) & ~7u;
}

static inline uint32_t band_state_bytes(const smear_desc *d)
{
    return format_diffuses(d) ? smear_diffuse_bytes(d->width) : 0;
}

/* Is asked of screen/: makes of rows from y on, as tiles were converted, what the display takes, in place. */
void smear_screen_finish(const struct smear_rows *rows, uint8_t *pixels, int32_t width, int32_t y, int32_t height);

/* Returns a buffer for the next rows; waits until what it held has been sent. */
uint8_t *smear_band_begin(struct smear_rows *rows);

/* Starts the job's next band, after job->y1; false when the tile row has none. Bands may have fewer rows than a tile. */
bool smear_band_next(struct row_job *job);

/* Hands the job's tile row, or its part of it, to the display. Returns SMEAR_OK, or what flush says if negative. */
int smear_band_flush(const struct row_job *r);

/* Converts columns [x0, x1) of the job's rows, which lie in a target. */
void smear_band_convert_rows(const struct row_job *r, const struct smear_raster_target *t, int32_t x0, int32_t x1);

/* Converts a tile of finished pixels, rows a tile apart. */
void smear_band_convert_tile(const struct row_job *r, int column, uint32_t *tile);

/* Draws blended triangles of the row (rows->blend) over the job's rows of a tile, finished pixels. */
void smear_band_blend_tile(const struct row_job *r, int column, uint32_t *tile);

/* Converts and hands out what lies finished in the window, band after band: the job's columns of a tile row. */
int smear_band_finish(struct row_job *job);

#endif

/* SPDX-License-Identifier: MIT */
/* sharp.c - see sharp.h. */
#include "methods/sharp.h"

#include "base/base.h"
#include "display/band.h"
#include "display/pixel_format.h"
#include "display/points.h"
#include "kernels/fill.h"

/* ------------------------------------------------------------------ into the window */

void smear_sharp_draw_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(r->rows, r->row, &t);
    smear_row_draw_opaque(r, job, &t, 0);
}

void smear_sharp_inspect_row(const struct smear_rows *rows, int row)
{
    const struct smear_window *w = &rows->window;
    for (int32_t y = row_top(rows, row); y < row_bottom(rows, row); y++) {
        const int32_t at = window_ring_row(w, y) * w->width;
        if (!rows->keeps_motion)
            __builtin_memset(rows->inspect + 2 * at, 0, (size_t)w->width * 8);
        rows->desc->debug.inspect(rows->desc->user, y, w->color + at, w->depth + at, rows->inspect + 2 * at);
    }
}

void smear_sharp_advance_lists(struct smear_rows *rows, int row)
{
    if (rows->refill == NULL)
        rows->opaque = row_advance(rows, rows->bins.opaque_last, rows->opaque, row);
    for (int32_t i = 0; i < rows->window.columns; i++)
        rows->window.moving[i] = 0;
}

void smear_sharp_draw_row(struct row_job *job)
{
    struct smear_rows *const rows = job->rows;
    const uint32_t start = stage_start(rows);
    smear_sharp_advance_lists(rows, job->row);
    smear_row_run(rows, smear_sharp_draw_job, job, FILL_STATIC | FILL_MOVING);
    if (SMEAR_WITH_DEBUG && rows->inspect != NULL)
        smear_sharp_inspect_row(rows, job->row);
    stage_end(rows, &rows->stats->time.raster, start);
}

/* ------------------------------------------------------------------ straight into the band */

bool smear_sharp_may_be_direct(const smear_desc *d, bool has_window)
{
    return SMEAR_DIRECT && !has_window && !d->reuse.cache_static && d->display.dither == SMEAR_DITHER_NONE
        && (d->format == SMEAR_RGB565 || d->format == SMEAR_RGB565_SWAPPED);
}

/* The display's own pixels are drawn, so nothing is converted. A row's place in the band is its place in the window,
 * which has no more rows. */
static void direct_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    const struct smear_rows *rows = r->rows;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(rows, r->row, &t);
    if (!smear_job_area(rows, job, &t))
        return;
    t.direct = (uint16_t *)(void *)r->band;
    t.cache = smear_raster_cache_of(&rows->cache, job);
    const uint32_t clear = rgb565_nearest(rows->clear);
    const int32_t from = target_row(&t.window_rows, &t, t.y0) + t.x0, n = t.x1 - t.x0;
    int32_t at = from;
    for (int32_t y = t.y0; y < t.y1; y++, at += rows->window.width) {
        pixels_fill_narrow(t.direct + at, clear, n);
        pixels_fill_narrow(t.depth + at, 0, n);
    }
    if (rows_have_sky(rows))
        rows->sky->kind->fill(rows->sky, &t, NULL);
    smear_raster_list(&rows->raster, &t, rows->opaque);
    at = from;
    if (smear_format_is_swapped((smear_format)rows->desc->format))
        for (int32_t y = t.y0; y < t.y1; y++, at += rows->window.width)
            smear_format_swap(t.direct + at, n);
}

static int draw_direct_row(struct smear_rows *rows, int row)
{
    const uint32_t start = stage_start(rows);
    rows->opaque = row_advance(rows, rows->bins.opaque_last, rows->opaque, row);
    struct row_job job = { .rows = rows, .row = row, .band = smear_band_begin(rows) };
    smear_jobs_run(&rows->jobs, direct_job, &job, rows->jobs.workers);
    stage_end(rows, &rows->stats->time.raster, start);
    return smear_band_flush(&job);
}

/* What lies over pixels is drawn before they become the display's. */
static bool is_covered(const struct smear_rows *rows, int row)
{
    const struct overlay_box box = { 0, row_top(rows, row), rows->window.width, row_bottom(rows, row) };
    return rows_are_covered(rows, &box) || (rows_have_overlay(rows) && smear_points_touch(rows, box.y0, box.y1));
}

/* Whether nothing but opaque triangles changes the rows of a frame, which lie in the same memory, and pixels are of 16 bits in eights. */
static bool stays_clear(const struct smear_rows *rows)
{
    const smear_desc *d = rows->desc;
    return (d->width & 7) == 0 && smear_format_stride(1, drawn_format(d)) == 2 && d->display.dither <= SMEAR_DITHER_ORDERED
        && rows->window.ring == rows->bins.row_px && rows->inspect == NULL && !rows->blends && !rows_have_sky(rows)
        && !rows_have_overlay(rows);
}

/* Draws a row by way of the window. */
static inline int draw_window_row(struct smear_rows *rows, int row, bool stays_clear, bool is_clear)
{
    struct row_job job = { .rows = rows, .row = row, .stays_clear = stays_clear, .is_clear = is_clear };
    smear_sharp_draw_row(&job);
    smear_row_blend(rows, row);
    return smear_band_finish(&job);
}

int smear_sharp_rows(struct smear_rows *rows, struct smear_damage *damage, bool direct, int first, int end)
{
    int result = SMEAR_OK;
    if (damage_compares(damage))
        return smear_damage_rows(rows, damage, first, end);
    if (SMEAR_POOL_PARTS && rows->jobs.workers > 1 && !direct && smear_workers_rows(rows, first, end, &result))
        return result;
    const bool stay_clear = SMEAR_STAYS_CLEAR && !direct && stays_clear(rows);
    for (int row = first; row < end && result == SMEAR_OK; row++) {
        const bool straight = SMEAR_DIRECT && direct && rows->refill == NULL && !is_covered(rows, row);
        result = straight ? draw_direct_row(rows, row) : draw_window_row(rows, row, stay_clear, stay_clear && row > first);
    }
    return result;
}

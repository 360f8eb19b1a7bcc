/* SPDX-License-Identifier: MIT */
/* row.c - see row.h. */
#include "display/row.h"

#include "kernels/fill.h"

void smear_row_make_cache(struct smear_rows *rows, void *other, size_t other_bytes)
{
    size_t bytes;
    uint8_t *const own = bins_rest(&rows->bins, &bytes);
    const bool takes_other = bytes < other_bytes;
    rows->cache = smear_raster_cache_make(takes_other ? other : own, takes_other ? other_bytes : bytes, rows->jobs.workers, &rows->bins);
}

void smear_window_target(const struct smear_rows *rows, int32_t y0, int32_t y1, struct smear_raster_target *t)
{
    const struct smear_window *w = &rows->window;
    struct smear_plane_rows plane = { w->width, window_ring_row(w, y0), w->ring, 0 };
    *t = (struct smear_raster_target){
        .x0 = 0, .y0 = y0, .x1 = w->width, .y1 = y1,
        .color = w->color, .color_rows = plane, .depth = w->depth, .window_rows = plane,
        .moving = w->moving, .tile_shift = (uint8_t)w->tile_shift
    };
}

void smear_row_target(const struct smear_rows *rows, int row, struct smear_raster_target *t)
{
    smear_window_target(rows, row_top(rows, row), row_bottom(rows, row), t);
}

void smear_job_columns(const struct smear_rows *rows, int job, int32_t *x0, int32_t *x1)
{
    int32_t unit = max_i32(rows->window.tile, 16), n = rows->jobs.workers;
    int32_t units = (rows->window.width + unit - 1) / unit;
    *x0 = min_i32(units * job / n * unit, rows->window.width);
    *x1 = min_i32(units * (job + 1) / n * unit, rows->window.width);
}

/* The target's rows become [y0, y1) of them. */
static void take_rows(struct smear_raster_target *t, int32_t y0, int32_t y1)
{
    struct smear_plane_rows *const plane[2] = { &t->window_rows, &t->color_rows };
    for (int i = 0; i < 2; i++) {
        plane[i]->ring_row += y0 - t->y0;
        plane[i]->ring_row -= plane[i]->ring_row >= plane[i]->ring ? plane[i]->ring : 0;
    }
    t->y0 = y0;
    t->y1 = y1;
}

bool smear_job_area(const struct smear_rows *rows, int job, struct smear_raster_target *t)
{
    enum { ROWS_LEAST = 16 };
    const int32_t middle = min_i32(t->y0 + rows->bins.row_px / 2, t->y1), n = rows->jobs.workers;
    const int32_t width = rows->window.width, unit = max_i32(rows->window.tile, 16), units = (width + unit - 1) / unit;
    int32_t part = job, parts = n;
    if (SMEAR_WITH_WORKERS && n % 2 == 0 && rows->bins.row_px >= ROWS_LEAST && !rows->keeps_motion) {
        part = job / 2;
        parts = n / 2;
        if (job % 2 == 0)
            t->y1 = middle;
        else
            take_rows(t, middle, t->y1);
    }
    t->x0 = max_i32(t->x0, units * part / parts * unit);
    t->x1 = min_i32(t->x1, units * (part + 1) / parts * unit);
    return t->x0 < t->x1 && t->y0 < t->y1;
}

void smear_row_count(const struct smear_rows *rows, int kind, smear_method method)
{
    smear_stats *s = rows->stats;
    if (kind == TILE_STATIC) {
        s->tiles_static++;
        s->tiles[SMEAR_NONE]++;
        return;
    }
    s->tiles[method]++;
    if (kind == TILE_UNIFORM)
        s->tiles_uniform++;
    else
        s->tiles_complex++;
}

void smear_row_clear(const struct smear_rows *rows, const struct smear_raster_target *t, int velocity, uint32_t *sky_too)
{
    const int32_t width = t->x1 - t->x0;
    for (int32_t y = t->y0; y < t->y1; y++) {
        const int32_t at = target_row(&t->window_rows, t, y) + t->x0;
        int32_t n = width;
        /* Whole rows lie one behind the other, but at the end of the ring. */
        for (; !SMEAR_SMALL_FILE && y + 1 < t->y1 && target_row(&t->window_rows, t, y + 1) + t->x0 == at + n; y++)
            n += width;
        if (!rows_have_sky(rows))
            pixels_fill(t->color + at, rows->clear, n);
        pixels_clear_narrow(t->depth + at, n);
        if (SMEAR_WITH_RECONSTRUCT && t->velocity8 != NULL)
            pixels_fill_bytes((uint16_t *)(void *)(t->velocity8 + 2 * at), velocity, n);
        if (SMEAR_WITH_RECONSTRUCT && t->velocity16 != NULL)
            pixels_fill_bytes((uint16_t *)(t->velocity16 + 2 * at), velocity, 2 * n);
        if (target_is_inspected(t))
            __builtin_memset(t->inspect + 2 * at, 0, (size_t)n * 8);
    }
    if (rows_have_sky(rows) && (sky_too == NULL || sky_too != t->color))
        rows->sky->kind->fill(rows->sky, t, sky_too);
}

bool smear_row_draw_opaque(const struct row_job *r, int job, struct smear_raster_target *t, int velocity)
{
    const struct smear_rows *rows = r->rows;
    t->x0 = job_left(r);
    t->x1 = job_right(r);
    if (!smear_job_area(rows, job, t))
        return false;
    if ((r->steps & ROW_CLEAR) && !(SMEAR_STAYS_CLEAR && r->is_clear))
        smear_row_clear(rows, t, velocity, r->sky_too);
    t->over = rows->refill != NULL;
    t->cache = smear_raster_cache_of(&rows->cache, job);
    if (r->steps & ROW_DRAW)
        smear_raster_list(&rows->raster, t, rows->opaque);
    return true;
}

bool smear_row_fill(struct smear_rows *rows, int row, int kinds)
{
    return rows->refill == NULL || smear_row_fill_columns(rows, row, kinds, 0, INT16_MAX);
}

bool smear_row_fill_columns(struct smear_rows *rows, int row, int kinds, int32_t x0, int32_t x1)
{
    struct smear_refill *f = rows->refill;
    f->row = row;
    f->path_x0 = x0;
    f->path_x1 = x1;
    f->kinds = (uint8_t)kinds;
    f->draw = f->triangle = 0;
    f->parts = 0;
    f->fill(f);
    return true;
}

bool smear_row_fill_next(struct smear_rows *rows)
{
    if (rows->refill == NULL || !rows->refill->more)
        return false;
    rows->refill->fill(rows->refill);
    return true;
}

void smear_row_run(struct smear_rows *rows, smear_job_fn *job, struct row_job *argument, int kinds)
{
    argument->steps = rows->refill == NULL ? ROW_ALL : ROW_CLEAR;
    smear_jobs_run(&rows->jobs, job, argument, rows->jobs.workers);
    if (rows->refill == NULL)
        return;
    argument->steps = ROW_DRAW;
    for (bool any = smear_row_fill(rows, argument->row, kinds); any; any = smear_row_fill_next(rows))
        smear_jobs_run(&rows->jobs, job, argument, rows->jobs.workers);
    argument->steps = ROW_FINISH;
    smear_jobs_run(&rows->jobs, job, argument, rows->jobs.workers);
}

static void blend_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(r->rows, r->row, &t);
    if (SMEAR_WITH_DAMAGE) {
        t.x0 = job_left(r);
        t.x1 = job_right(r);
    }
    if ((r->steps & ROW_DRAW) && smear_job_area(r->rows, job, &t))
        smear_raster_list(&r->rows->raster, &t, r->rows->blend);
}

void smear_row_blend(struct smear_rows *rows, int row)
{
    if (!SMEAR_WITH_ALPHA || !rows->blends)
        return;
    struct row_job job = { .rows = rows, .row = row };
    row_advance_blended(rows, row);
    if (!SMEAR_SMALL_CODE && rows->refill == NULL && rows->blend == SMEAR_NO_TRIANGLE)
        return;
    smear_row_run(rows, blend_job, &job, FILL_BLENDED);
}

#if SMEAR_WITH_DAMAGE
void smear_row_blend_columns(struct row_job *job)
{
    if (SMEAR_WITH_ALPHA && job->rows->blends)
        smear_row_run(job->rows, blend_job, job, FILL_BLENDED);
}
#endif

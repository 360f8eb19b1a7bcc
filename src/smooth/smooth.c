/* SPDX-License-Identifier: MIT */
/* smooth.c - see temporal.h.
 *
 *     below       the pixel row below the tile row, which the last one is compared with
 *     find        where colours differ from pixel to pixel (edges.h)
 *     for each run of columns that there is memory for, and for each other place within the pixel:
 *         draw    what is static, where there are edges
 *     mean        of all places */
#include "methods/temporal.h"

#include "smooth/edges.h"

#if SMEAR_EDGES

/* What the jobs of a tile row share. */
struct smoothing {
    struct row_job row;
    const struct smear_temporal *temporal;
    struct smear_raster_target target;          /* what is static, drawn */
    struct smear_raster_target below;
    struct smear_edge_units units;
    int32_t columns;                            /* pixels of a run */
};

static void below_job(void *argument, int job, int worker)
{
    const struct smoothing *s = (const struct smoothing *)argument;
    const struct smear_rows *rows = s->row.rows;
    struct smear_raster_target t = s->below;
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(rows, job, &x0, &x1);
    t.x0 = max_i32(t.x0, x0);
    t.x1 = min_i32(t.x1, x1);
    if (t.x0 >= t.x1)
        return;
    if ((s->row.steps & ROW_CLEAR) != 0)
        smear_row_clear(rows, &t, 0, NULL);
    if ((s->row.steps & ROW_DRAW) != 0)
        smear_raster_list(&rows->raster, &t, rows->opaque);
}

/* Finds edges, in as many columns at once as there is memory for. */
static void find(struct smoothing *s)
{
    enum { COLUMN = sizeof(uint32_t) + sizeof(uint16_t), TILE_MAX = 64 };
    struct smear_rows *rows = s->row.rows;
    const int32_t width = rows->window.width, most = (int32_t)(s->temporal->work_bytes / COLUMN) & ~(TILE_MAX - 1);
    const bool has_below = s->target.y1 < rows->window.height;
    struct smear_raster_target t = s->target;
    for (t.x0 = 0; t.x0 < width; t.x0 = t.x1) {
        t.x1 = min_i32(width, t.x0 + most);
        const struct smear_plane_rows plane = { t.x1 - t.x0, 0, 1, t.x0 };
        uint32_t *color = (uint32_t *)(void *)s->temporal->work;
        s->below = (struct smear_raster_target){ .x0 = t.x0, .y0 = t.y1, .x1 = t.x1, .y1 = t.y1 + 1, .color = color,
                                                 .color_rows = plane, .depth = (uint16_t *)(void *)(color + plane.stride),
                                                 .window_rows = plane, .tile_shift = t.tile_shift };
        if (has_below)
            smear_row_run(rows, below_job, &s->row, FILL_STATIC | FILL_MOVING);
        smear_edges_find(&s->units, &t, has_below ? color : NULL, width);
    }
}

/* Smooths a run of columns. */
static void smooth_job(void *argument, int job, int worker)
{
    const struct smoothing *s = (const struct smoothing *)argument;
    struct smear_rows *rows = s->row.rows;
    const int32_t tile = rows->window.tile, pitch = smear_strip_columns(s->temporal->strip, rows->window.width);
    const int32_t pixels = s->columns * tile;
    uint32_t *work = (uint32_t *)(void *)(s->temporal->work + (uint32_t)worker * s->temporal->work_bytes);
    const struct smear_edge_planes planes = { { rows->scratch + worker * pitch * tile, work, work + pixels },
                                              (uint16_t *)(void *)(work + 2 * pixels) };
    struct smear_raster_target t = s->target;
    t.x0 = job * s->columns;
    t.x1 = min_i32(t.x0 + s->columns, rows->window.width);
    if (!smear_edges_any(&s->units, t.x0, t.x1))
        return;
    for (int k = 0; k < EDGE_PLACES; k++) {
        const struct smear_raster_target place = smear_edges_target(&t, &planes, k);
        smear_edges_clear(&s->units, &place, rows->clear);
        if (rows_have_sky(rows))
            rows->sky->kind->fill(rows->sky, &place, NULL);
        if (rows->refill == NULL)
            smear_edges_draw(&s->units, &rows->raster, &place, rows->opaque, k);
        else
            for (bool any = smear_row_fill(rows, s->row.row, FILL_STATIC | FILL_MOVING); any; any = smear_row_fill_next(rows))
                smear_edges_draw(&s->units, &rows->raster, &place, rows->opaque, k);
    }
    smear_edges_mean(&s->units, &t, &planes, frame_transfer(&rows->raster));
}

void smear_smooth_static(struct smear_rows *rows, int row, const struct smear_temporal *temporal)
{
    enum { PIXEL = 2 * sizeof(uint32_t) + sizeof(uint16_t) };       /* besides the scratch */
    const int32_t strip = temporal->strip, tile = rows->window.tile;
    const int32_t most = (int32_t)(smear_subframes_work(strip, tile) / (uint32_t)(PIXEL * tile)) & ~7;
    struct smoothing s = { .row = { .rows = rows, .row = row }, .temporal = temporal, .columns = min_i32(most, strip) };
    smear_row_target(rows, row, &s.target);
    find(&s);
    const int runs = (int)((rows->window.width + s.columns - 1) / s.columns);
    if (rows->refill == NULL)
        smear_jobs_run(&rows->jobs, smooth_job, &s, runs);
    for (int run = 0; rows->refill != NULL && run < runs; run++)
        smooth_job(&s, run, 0);
}

#endif

/* SPDX-License-Identifier: MIT */
/* timed.c - tile rows by methods that look at several instants.
 *
 *     still       triangles that do not move, into the window; with smooth tiles (smooth.h) into rows of their own
 *     list        movers of the row, and what they mean for its tiles
 *     movers      with smooth tiles: as they are in the middle of the exposure, into the window
 *     finish      each tile by its method (choose.h): a copy, a smooth field, a time mask, or subframes; then flush
 *
 * Smooth tiles take pixels from their neighbours, so a row is finished when the one below it has been drawn. */
#include "timed.h"

#include "pixel.h"

/* ------------------------------------------------------------------ lists */

static struct smear_row_movers *movers_of(struct smear_context *c, int row)
{
    return &c->row_movers[chooser_has_window(&c->chooser) ? row % ROWS_LISTED : 0];
}

/* What columns [x0, x1) of pixels hold; with bounds, of one mover. */
static void load_tiles(const struct smear_context *c, struct smear_row_movers *r, int32_t x0, int32_t x1,
                       const struct smear_path_bounds *b, uint16_t flags)
{
    const struct smear_window *w = &c->window;
    int32_t first = max_i32(x0, 0) >> w->tile_shift, last = (min_i32(x1, w->width) - 1) >> w->tile_shift;
    for (int32_t column = first; column <= last; column++) {
        struct smear_tile_load *load = &r->load[column];
        load->flags |= flags;
        if (b == NULL)
            continue;
        load->flags |= b->flags;
        load->travel = (uint16_t)max_i32(load->travel, b->travel);
        load->bend = (uint16_t)max_i32(load->bend, b->bend);
        load->count++;
    }
}

/* Columns of pixels that a still triangle may cover. */
static void still_columns(const struct smear_geometry *g, const struct smear_triangle *t, int32_t *x0, int32_t *x1)
{
    *x0 = INT32_MAX;
    *x1 = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        int32_t x = geometry_vertex(g, &g->segment[t->segment], t->vertex[i])[VERTEX_X];
        *x0 = min_i32(*x0, x >> 8);
        *x1 = max_i32(*x1, (x >> 8) + 1);
    }
}

/* Marks the tiles of blended draws. */
static void load_list(const struct smear_context *c, struct smear_row_movers *r, uint32_t head)
{
    const struct smear_geometry *g = &c->geometry;
    for (uint32_t i = head; i != SMEAR_NO_TRIANGLE; i = geometry_triangle(g, i)->next) {
        const struct smear_triangle *t = geometry_triangle(g, i);
        int32_t x0, x1;
        if (g->segment[t->segment].path) {
            const struct smear_path_bounds *b = geometry_bounds(g, i);
            load_tiles(c, r, b->x0, b->x1, b, TILE_BLENDED);
        } else {
            still_columns(g, t, &x0, &x1);
            load_tiles(c, r, x0, x1, NULL, TILE_BLENDED);
        }
    }
}

static void list_movers(struct smear_context *c, int row)
{
    const struct smear_geometry *g = &c->geometry;
    struct smear_row_movers *r = movers_of(c, row);
    int shift = c->window.tile_shift;
    for (int32_t i = 0; i < c->window.columns; i++)
        r->load[i] = (struct smear_tile_load){ 0, 0, 0, 0, 0 };
    r->count = 0;
    c->moving = smear_geometry_advance(g, g->mover_last, c->moving, row);
    for (uint32_t i = c->moving; i != SMEAR_NO_TRIANGLE; i = geometry_triangle(g, i)->next) {
        const struct smear_path_bounds *b = geometry_bounds(g, i);
        r->mover[r->count++] = (struct smear_mover){ i, (uint8_t)(b->x0 >> shift), (uint8_t)((b->x1 - 1) >> shift),
                                                     b->nearest };
        load_tiles(c, r, b->x0, b->x1, b, 0);
    }
}

/* Blended draws of the row that is finished. */
static void list_blended(struct smear_context *c, int row)
{
    if (!c->blends)
        return;
    c->blend = smear_geometry_advance(&c->geometry, c->geometry.blend_last, c->blend, row);
    load_list(c, movers_of(c, row), c->blend);
}

/* ------------------------------------------------------------------ drawing */

/* Rows of the still scene. */
static void still_target(const struct smear_context *c, int row, struct smear_raster_target *t)
{
    smear_row_target(c, row, t);
    if (!chooser_has_window(&c->chooser))
        return;
    int32_t rows = 2 * c->window.tile;
    t->color = c->still_color;
    t->depth = c->still_depth;
    t->color_rows = t->window_rows = (struct smear_plane_rows){ c->window.width, (row & 1) * c->window.tile, rows, 0 };
}

static void clear(const struct smear_raster_target *t, uint32_t color)
{
    int32_t n = t->x1 - t->x0;
    for (int32_t y = t->y0; y < t->y1; y++) {
        int32_t slot = t->window_rows.slot0 + (y - t->y0);
        if (slot >= t->window_rows.ring)
            slot -= t->window_rows.ring;
        pixels_fill(t->color + slot * t->window_rows.stride + t->x0, color, n);
        __builtin_memset(t->depth + slot * t->window_rows.stride + t->x0, 0, (size_t)n * 2);
    }
}

static void still_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_raster_target t;
    (void)worker;
    still_target(r->c, r->row, &t);
    smear_job_columns(r->c, job, &t.x0, &t.x1);
    if (t.x0 >= t.x1)
        return;
    clear(&t, r->c->frame.clear & 0xffffffu);
    smear_raster_list(&r->c->raster, &t, r->c->opaque);
}

static void movers_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(r->c, r->row, &t);
    smear_job_columns(r->c, job, &t.x0, &t.x1);
    if (t.x0 >= t.x1)
        return;
    clear(&t, 0);
    smear_raster_list(&r->c->raster, &t, r->c->moving);
}

/* ------------------------------------------------------------------ tiles */

/* A row to be finished. */
struct finish {
    struct row_job row;
    struct smear_raster_target still;
    int first, last;            /* rows whose lists and pixels are there */
};

static bool is_still(const struct smear_tile_load *load)
{
    return load->count == 0 && (load->flags & PATH_WITHOUT_MASK) == 0;
}

/* Still tiles go to the display as they lie, a run of them at once: the job of the run's first tile. */
static void convert_still(const struct finish *f, const struct smear_row_movers *m, int column)
{
    const struct smear_context *c = f->row.c;
    if (column > 0 && is_still(&m->load[column - 1]))
        return;
    int end = column + 1;
    while (end < c->window.columns && is_still(&m->load[end]))
        end++;
    smear_band_convert_rows(&f->row, &f->still, tile_left(c, column), tile_right(c, end - 1));
}

/* Blended draws over a tile without movers. */
static void blend_still(const struct smear_moving_tile *t, const struct smear_context *c)
{
    const struct smear_raster_target *s = &t->still;
    for (int32_t y = s->y0; y < s->y1; y++) {
        const uint32_t *in = s->color + target_row(&s->color_rows, s, y) + s->x0;
        for (int32_t i = 0; i < s->x1 - s->x0; i++)
            t->out[(y - s->y0) * t->tile + i] = in[i];
    }
    struct smear_raster_target over = *s;
    over.color = t->out;
    over.color_rows = (struct smear_plane_rows){ t->tile, 0, t->tile, s->x0 };
    smear_raster_list(&c->raster, &over, t->blend);
}

/* A tile whose movers move as one. False when they do not, or when pixels are needed that are not there. */
static bool try_smooth(const struct finish *f, const struct smear_moving_tile *t, const struct smear_tile_choice *choice,
                       int column, int worker)
{
    struct smear_context *c = f->row.c;
    const struct smear_window *w = &c->window;
    const struct smear_smooth_area area = { t->still.x0, t->still.y0, t->still.x1, t->still.y1, w->tile, w->tile_shift };
    struct smear_smooth_list list[ROWS_LISTED];
    struct smear_smooth_field field;
    int lists = 0, row = f->row.row;
    list[lists++] = (struct smear_smooth_list){ t->mover, t->mover_count };
    for (int k = row - 1; k <= row + 1; k += 2)
        if (k >= f->first && k <= f->last)
            list[lists++] = (struct smear_smooth_list){ movers_of(c, k)->mover, movers_of(c, k)->count };
    if (!smear_smooth_fit(&field, &area, &c->geometry, list, lists, movers_of(c, row)->load[column].travel * 16,
                          choice->tolerance, t->work, t->work_bytes))
        return false;
    /* The frame's outermost row may stand for the one beyond it. */
    int32_t top = max_i32(area.y0 - field.reach_y, -1), bottom = min_i32(area.y1 + field.reach_y, w->height + 1);
    if (area.x0 < field.reach_x || area.x1 + field.reach_x > w->width || field.reach_y > w->reach
        || top > area.y0 - field.reach_y || bottom < area.y1 + field.reach_y
        || max_i32(top, 0) < row_top(c, f->first) || min_i32(bottom, w->height) > row_bottom(c, f->last))
        return false;
    const struct smear_raster_target *s = &t->still;
    struct smear_smooth_source source = {
        w->color, w->depth, c->row_offset, area.y0 - w->reach,
        s->color + target_row(&s->color_rows, s, s->y0) + s->x0, s->depth + target_row(&s->window_rows, s, s->y0) + s->x0,
        s->color_rows.stride
    };
    c->worker_samples[worker] += smear_smooth_tile(t->out, &source, &field, &area, choice->taps, c->raster.linear);
    return true;
}

static void finish_job(void *argument, int column, int worker)
{
    const struct finish *f = (const struct finish *)argument;
    struct smear_context *c = f->row.c;
    const struct smear_window *w = &c->window;
    struct smear_row_movers *m = movers_of(c, f->row.row);
    struct smear_tile_load *load = &m->load[column];
    if (is_still(load)) {
        load->method = TILE_COPY;
        convert_still(f, m, column);
        return;
    }
    struct smear_moving_tile t = {
        .frame = &c->raster, .shutter = &c->shutter, .still = f->still, .mover = m->mover, .mover_count = m->count,
        .column = column, .blend = c->blend, .out = c->scratch + worker * w->tile * w->tile, .tile = w->tile,
        .work = c->work + (uint32_t)worker * c->work_bytes, .work_bytes = c->work_bytes
    };
    t.still.x0 = tile_left(c, column);
    t.still.x1 = tile_right(c, column);
    struct smear_tile_choice choice;
    smear_choose(&choice, &c->chooser, load);
    if (SMEAR_WITH_SMOOTH && choice.method == TILE_SMOOTH && !try_smooth(f, &t, &choice, column, worker)) {
        struct smear_chooser closed = c->chooser;
        closed.has_window = false;
        smear_choose(&choice, &closed, load);
    }
    if (SMEAR_WITH_TIMEMASK && choice.method == TILE_TIMEMASK)
        c->worker_samples[worker] += smear_timemask_tile(&t, &choice.timemask);
    else if (choice.method == TILE_SUBFRAMES)
        c->worker_samples[worker] += smear_subframes_tile(&t, choice.instants);
    else if (choice.method == TILE_COPY)
        blend_still(&t, c);
    load->method = (uint8_t)choice.method;
    smear_band_convert_tile(&f->row, column, t.out);
}

/* ------------------------------------------------------------------ rows */

static void count_tiles(struct smear_context *c, int row)
{
    const struct smear_tile_load *load = movers_of(c, row)->load;
    smear_stats *s = &c->stats;
    for (int32_t i = 0; i < c->window.columns; i++) {
        s->tiles_still += load[i].method == TILE_COPY;
        s->tiles_none += load[i].method == TILE_COPY;
        s->tiles_uniform += load[i].method == TILE_SMOOTH;
        s->tiles_smooth += load[i].method == TILE_SMOOTH;
        s->tiles_complex += load[i].method == TILE_TIMEMASK || load[i].method == TILE_SUBFRAMES;
        s->tiles_timemask += load[i].method == TILE_TIMEMASK;
        s->tiles_subframes += load[i].method == TILE_SUBFRAMES;
    }
}

static int finish_row(struct smear_context *c, int row, int first, int last)
{
    const struct smear_window *w = &c->window;
    uint32_t start = stage_start(c);
    struct finish finish = { .row = { c, row, smear_band_begin(c) }, .first = first, .last = last };
    still_target(c, row, &finish.still);
    list_blended(c, row);
    if (chooser_has_window(&c->chooser)) {
        int32_t top = row_top(c, row) - w->reach;
        for (int32_t i = 0; i < w->tile + 2 * w->reach; i++)
            c->row_offset[i] = (uint32_t)(window_slot(w, clamp_i32(top + i, 0, w->height - 1)) * w->width);
    }
    smear_jobs_run(&c->jobs, finish_job, &finish, w->columns);
    count_tiles(c, row);
    stage_end(c, &c->stats.time_blur, start);
    return smear_band_flush(c, row, finish.row.band);
}

int smear_timed_rows(struct smear_context *c, int top, int first, int end)
{
    for (int row = top; row < first; row++) {       /* drawn before; all but the last are finished, too */
        list_movers(c, row);
        if (row < first - 1)
            list_blended(c, row);
    }
    for (int row = first; row < end; row++) {
        uint32_t start = stage_start(c);
        struct row_job job = { c, row, NULL };
        c->opaque = smear_geometry_advance(&c->geometry, c->geometry.opaque_last, c->opaque, row);
        smear_jobs_run(&c->jobs, still_job, &job, c->jobs.workers);
        list_movers(c, row);
        if (chooser_has_window(&c->chooser))
            smear_jobs_run(&c->jobs, movers_job, &job, c->jobs.workers);
        stage_end(c, &c->stats.time_raster, start);
        int result = SMEAR_OK;
        if (!chooser_has_window(&c->chooser))
            result = finish_row(c, row, row, row);
        else if (row > 0)
            result = finish_row(c, row - 1, top, row);
        if (result == SMEAR_OK && chooser_has_window(&c->chooser) && row == c->window.rows - 1)
            result = finish_row(c, row, top, row);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}

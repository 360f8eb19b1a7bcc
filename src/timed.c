/* SPDX-License-Identifier: MIT */
/* timed.c - a tile row by subframes, time masks and smooth fields.
 *
 *     list        movers of the row, and what they mean for its tiles
 *     finish      tiles in which nothing moves, and those whose movers are drawn over the still scene by themselves
 *
 * and, with a window, where the sharp picture of a tile may be enough (smooth.h):
 *
 *     draw        movers over the still scene, as they are in the middle of the exposure
 *     blur        waiting tiles of the row above, which now has neighbours on both sides
 *
 * A waiting tile whose pixels come from where the background or something still is seen gets a time mask after all; no
 * still triangle is in it, so its still scene is the background. */
#include "timed.h"

/* ------------------------------------------------------------------ lists */

static struct smear_row_movers *movers_of(struct smear_context *c, int row)
{
    return &c->row_movers[c->row_movers[1].mover != NULL ? row & 1 : 0];
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
    if (t->segment == SMEAR_POINT) {
        *x0 = t->x;
        *x1 = t->x + 1;
        return;
    }
    *x0 = INT32_MAX;
    *x1 = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        int32_t x = geometry_vertex(g, &g->segment[t->segment], t->vertex[i])[VERTEX_X];
        *x0 = min_i32(*x0, x >> 8);
        *x1 = max_i32(*x1, (x >> 8) + 1);
    }
}

/* Marks the tiles of a list. */
static void load_list(const struct smear_context *c, struct smear_row_movers *r, uint32_t head, uint16_t flag)
{
    const struct smear_geometry *g = &c->geometry;
    for (uint32_t i = head; i != SMEAR_NO_TRIANGLE; i = geometry_triangle(g, i)->next) {
        const struct smear_triangle *t = geometry_triangle(g, i);
        const struct smear_path_bounds *b = NULL;
        int32_t x0, x1;
        if (t->segment != SMEAR_POINT && g->segment[t->segment].path) {
            b = geometry_bounds(g, i);
            x0 = b->x0;
            x1 = b->x1;
        } else {
            still_columns(g, t, &x0, &x1);
        }
        load_tiles(c, r, x0, x1, flag == TILE_BLENDED ? b : NULL, flag);
    }
}

static void list_movers(struct smear_context *c, int row)
{
    const struct smear_geometry *g = &c->geometry;
    struct smear_row_movers *r = movers_of(c, row);
    int shift = c->window.tile_shift;
    for (int32_t i = 0; i < c->window.columns; i++)
        r->load[i] = (struct smear_tile_load){ 0, 0, 0, 0 };
    r->count = 0;
    c->moving = smear_geometry_advance(g, g->mover_last, c->moving, row);
    for (uint32_t i = c->moving; i != SMEAR_NO_TRIANGLE; i = geometry_triangle(g, i)->next) {
        const struct smear_path_bounds *b = geometry_bounds(g, i);
        r->mover[r->count++] = (struct smear_mover){ i, (uint8_t)(b->x0 >> shift), (uint8_t)((b->x1 - 1) >> shift),
                                                     b->nearest };
        load_tiles(c, r, b->x0, b->x1, b, 0);
    }
    load_list(c, r, c->blend, TILE_BLENDED);
    if (c->chooser.has_window && r->count != 0)
        load_list(c, r, c->opaque, TILE_STILL_SEEN);
}

/* ------------------------------------------------------------------ tiles over the still scene */

static struct smear_moving_tile tile_of(struct smear_context *c, int row, int column, int worker)
{
    const struct smear_window *w = &c->window;
    const struct smear_row_movers *r = movers_of(c, row);
    struct smear_moving_tile t = {
        .frame = &c->raster, .shutter = &c->shutter, .mover = r->mover, .mover_count = r->count,
        .column = column, .blend = c->blend, .out = c->scratch + worker * w->tile * w->tile, .tile = w->tile,
        .work = c->work + (uint32_t)worker * c->work_bytes, .work_bytes = c->work_bytes
    };
    smear_row_target(c, row, &t.still);
    t.still.x0 = tile_left(c, column);
    t.still.x1 = tile_right(c, column);
    return t;
}

static bool is_still(const struct smear_tile_load *load)
{
    return load->count == 0 && (load->flags & (PATH_SUBFRAMES | TILE_BLENDED)) == 0;
}

/* Still tiles go to the display as they lie in the window, a run of them at once: the job of the run's first tile. */
static void convert_still(const struct row_job *r, const struct smear_row_movers *m, int column)
{
    if (column > 0 && is_still(&m->load[column - 1]))
        return;
    int end = column + 1;
    while (end < r->c->window.columns && is_still(&m->load[end]))
        end++;
    smear_band_convert_window(r, tile_left(r->c, column), tile_right(r->c, end - 1));
}

/* The movers of a tile over its still scene. */
static void draw_tile(const struct row_job *r, const struct smear_moving_tile *t, const struct smear_tile_choice *choice,
                      int column, int worker)
{
    struct smear_context *c = r->c;
    if (choice->method == TILE_TIMEMASK) {
        c->worker_samples[worker] += smear_timemask_tile(t, &choice->timemask);
    } else if (choice->method == TILE_SUBFRAMES) {
        c->worker_samples[worker] += smear_subframes_tile(t, choice->instants);
    } else {
        smear_blur_copy(t->out, &c->window, r->row, column);
        smear_band_blend_tile(r, column, t->out);
    }
    smear_band_convert_tile(r, column, t->out);
}

static void still_scene_job(void *argument, int column, int worker)
{
    const struct row_job *r = argument;
    struct smear_context *c = r->c;
    struct smear_row_movers *m = movers_of(c, r->row);
    struct smear_tile_choice choice;
    smear_choose(&choice, &c->chooser, &m->load[column]);
    if (choice.method == TILE_SMOOTH) {
        if (smear_smooth_fit(&m->field[column], &c->geometry, m->mover, m->count, column, tile_left(c, column),
                             row_top(c, r->row), c->window.tile, m->load[column].travel * 16, choice.tolerance)) {
            m->waits[column] = 1;
            return;
        }
        struct smear_chooser closed = c->chooser;
        closed.has_window = false;
        smear_choose(&choice, &closed, &m->load[column]);
    }
    if (is_still(&m->load[column])) {
        convert_still(r, m, column);
        return;
    }
    struct smear_moving_tile t = tile_of(c, r->row, column, worker);
    draw_tile(r, &t, &choice, column, worker);
}

/* ------------------------------------------------------------------ tiles from the sharp picture */

static void draw_job(void *argument, int job, int worker)
{
    const struct row_job *r = argument;
    struct smear_context *c = r->c;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(c, r->row, &t);
    smear_job_columns(c, job, &t.x0, &t.x1);
    if (t.x0 < t.x1)
        smear_raster_list(&c->raster, &t, c->moving);
}

static uint8_t *open_of(const struct smear_context *c, int row)
{
    return c->open + (uint32_t)row % 3u * (uint32_t)c->window.columns;
}

/* Finds the tiles in which the background shows, or something still may. */
static void open_job(void *argument, int column, int worker)
{
    const struct row_job *r = argument;
    const struct smear_window *w = &r->c->window;
    uint16_t lowest = UINT16_MAX;
    int32_t n = tile_right(r->c, column) - tile_left(r->c, column);
    (void)worker;
    for (int32_t y = row_top(r->c, r->row); y < row_bottom(r->c, r->row); y++) {
        const uint16_t *depth = w->depth + window_slot(w, y) * w->width + tile_left(r->c, column);
        for (int32_t x = 0; x < n; x++)
            lowest = depth[x] < lowest ? depth[x] : lowest;
    }
    open_of(r->c, r->row)[column] = lowest == 0 || (movers_of(r->c, r->row)->load[column].flags & TILE_STILL_SEEN) != 0;
}

/* All that the taps of a tile may touch moves with it, and lies in the window. `last`: there is no row below. */
static bool can_be_smooth(struct smear_context *c, int row, int column, bool last)
{
    const struct smear_window *w = &c->window;
    const struct smear_smooth_field *f = &movers_of(c, row)->field[column];
    int32_t x0 = tile_left(c, column) - f->reach_x, x1 = tile_right(c, column) + f->reach_x;
    int32_t y0 = row_top(c, row) - f->reach_y, y1 = row_bottom(c, row) + f->reach_y;
    if (x0 < 0 || y0 < 0 || x1 > w->width || y1 > w->height || f->reach_y > w->reach
        || (last && y1 > row_bottom(c, row)))
        return false;
    for (int r = y0 >> w->tile_shift; r <= (y1 - 1) >> w->tile_shift; r++)
        for (int32_t k = x0 >> w->tile_shift; k <= (x1 - 1) >> w->tile_shift; k++)
            if (open_of(c, r)[k])
                return false;
    return true;
}

/* The tile's movers over the background. */
static void draw_late(const struct row_job *r, int column, int worker)
{
    struct smear_context *c = r->c;
    struct smear_moving_tile t = tile_of(c, r->row, column, worker);
    struct smear_tile_choice choice;
    struct smear_chooser closed = c->chooser;
    int32_t pixels = c->window.tile * c->window.tile;
    uint32_t *color = (uint32_t *)(void *)(c->still_tile + (size_t)worker * (size_t)pixels * 6);
    uint16_t *depth = (uint16_t *)(void *)(color + pixels);
    for (int32_t i = 0; i < pixels; i++) {
        color[i] = c->frame.clear & 0xffffffu;
        depth[i] = 0;
    }
    t.still.color = color;
    t.still.depth = depth;
    t.still.color_rows = t.still.window_rows = (struct smear_plane_rows){ t.tile, 0, t.tile, t.still.x0 };
    closed.has_window = false;
    smear_choose(&choice, &closed, &movers_of(c, r->row)->load[column]);
    draw_tile(r, &t, &choice, column, worker);
}

struct smooth_job {
    struct row_job row;
    bool last;
};

static void smooth_job(void *argument, int column, int worker)
{
    const struct smooth_job *job = argument;
    const struct row_job *r = &job->row;
    struct smear_context *c = r->c;
    const struct smear_window *w = &c->window;
    struct smear_row_movers *m = movers_of(c, r->row);
    if (!m->waits[column])
        return;
    if (!can_be_smooth(c, r->row, column, job->last)) {
        m->waits[column] = 0;
        draw_late(r, column, worker);
        return;
    }
    struct smear_tile_choice choice;
    smear_choose(&choice, &c->chooser, &m->load[column]);
    uint32_t *out = c->scratch + worker * w->tile * w->tile;
    struct smear_smooth_source source = { w->color, c->row_offset, row_top(c, r->row) - w->reach };
    c->worker_samples[worker] += smear_smooth_tile(out, w->tile, &source, &m->field[column], tile_left(c, column),
                                                   row_top(c, r->row), tile_right(c, column), row_bottom(c, r->row),
                                                   w->tile, choice.taps, c->raster.linear);
    smear_band_convert_tile(r, column, out);
}

/* ------------------------------------------------------------------ rows */

static void count_tiles(struct smear_context *c, int row)
{
    const struct smear_row_movers *m = movers_of(c, row);
    struct smear_chooser closed = c->chooser;
    closed.has_window = false;
    for (int32_t i = 0; i < c->window.columns; i++) {
        bool smooth = c->chooser.has_window && m->waits[i];
        struct smear_tile_choice choice;
        smear_choose(&choice, &closed, &m->load[i]);
        c->stats.tiles_smooth += smooth;
        c->stats.tiles_uniform += smooth;
        c->stats.tiles_still += choice.method == TILE_COPY;
        c->stats.tiles_none += choice.method == TILE_COPY;
        c->stats.tiles_complex += choice.method != TILE_COPY && !smooth;
        c->stats.tiles_subframes += choice.method == TILE_SUBFRAMES && !smooth;
        c->stats.tiles_timemask += choice.method == TILE_TIMEMASK && !smooth;
    }
}

/* Finishes a row whose still scene jobs are done; `known`: the last row that has been drawn. */
static int finish_row(struct smear_context *c, int row, bool last)
{
    const struct smear_window *w = &c->window;
    struct smooth_job job = { { c, row, c->held }, last };
    if (c->chooser.has_window) {
        int32_t first = row_top(c, row) - w->reach;
        for (int32_t i = 0; i < w->tile + 2 * w->reach; i++)
            c->row_offset[i] = (uint32_t)(window_slot(w, clamp_i32(first + i, 0, w->height - 1)) * w->width);
        smear_jobs_run(&c->jobs, smooth_job, &job, w->columns);
    }
    count_tiles(c, row);
    return smear_band_flush(c, row, c->held);
}

void smear_timed_begin(struct smear_context *c)
{
    c->held = NULL;
}

int smear_timed_row(struct smear_context *c, int row, bool last)
{
    uint32_t start = stage_start(c);
    int result = SMEAR_OK;
    if (c->blends)
        c->blend = smear_geometry_advance(&c->geometry, c->geometry.blend_last, c->blend, row);
    list_movers(c, row);
    struct row_job job = { c, row, smear_band_begin(c, c->held != NULL) };
    if (c->chooser.has_window)
        for (int32_t i = 0; i < c->window.columns; i++)
            movers_of(c, row)->waits[i] = 0;
    smear_jobs_run(&c->jobs, still_scene_job, &job, c->window.columns);
    if (c->chooser.has_window) {
        smear_jobs_run(&c->jobs, draw_job, &job, c->jobs.workers);
        smear_jobs_run(&c->jobs, open_job, &job, c->window.columns);
        if (c->held != NULL)
            result = finish_row(c, row - 1, false);
    }
    c->held = job.band;
    if (result == SMEAR_OK && (last || !c->chooser.has_window)) {
        result = finish_row(c, row, true);
        c->held = NULL;
    }
    stage_end(c, &c->stats.time_blur, start);
    return result;
}

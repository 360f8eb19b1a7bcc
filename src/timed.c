/* SPDX-License-Identifier: MIT */
/* timed.c - tile rows by methods that look at several instants.
 *
 *     still       triangles that do not move, into the row's pixels
 *     list        movers of the row, and what they mean for its tiles
 *     finish      each tile by its method (choose.h): a copy, a time mask, or subframes; then flush
 */
#include "timed.h"

#include "pixel.h"

/* ------------------------------------------------------------------ lists */

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
    struct smear_row_movers *r = &c->row_movers;
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
    load_list(c, &c->row_movers, c->blend);
}

/* ------------------------------------------------------------------ drawing */

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
    smear_row_target(r->c, r->row, &t);
    smear_job_columns(r->c, job, &t.x0, &t.x1);
    if (t.x0 >= t.x1)
        return;
    clear(&t, r->c->frame.clear & 0xffffffu);
    smear_raster_list(&r->c->raster, &t, r->c->opaque);
}

/* ------------------------------------------------------------------ tiles */

/* A row to be finished. */
struct finish {
    struct row_job row;
    struct smear_raster_target still;
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

static void finish_job(void *argument, int column, int worker)
{
    const struct finish *f = (const struct finish *)argument;
    struct smear_context *c = f->row.c;
    const struct smear_window *w = &c->window;
    const struct smear_row_movers *m = &c->row_movers;
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
    load->method = (uint8_t)choice.method;
    if (SMEAR_WITH_TIMEMASK && choice.method == TILE_TIMEMASK) {
        bool is_smooth;
        c->worker_samples[worker] += smear_timemask_tile(&t, &choice.timemask, &is_smooth);
        load->method = is_smooth ? TILE_SMOOTH : TILE_TIMEMASK;
    } else if (choice.method == TILE_SUBFRAMES) {
        c->worker_samples[worker] += smear_subframes_tile(&t, choice.instants);
    } else {
        blend_still(&t, c);
    }
    smear_band_convert_tile(&f->row, column, t.out);
}

/* ------------------------------------------------------------------ rows */

static void count_tiles(struct smear_context *c)
{
    const struct smear_tile_load *load = c->row_movers.load;
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

static int finish_row(struct smear_context *c, int row)
{
    uint32_t start = stage_start(c);
    struct finish finish = { .row = { c, row, smear_band_begin(c) } };
    smear_row_target(c, row, &finish.still);
    list_blended(c, row);
    smear_jobs_run(&c->jobs, finish_job, &finish, c->window.columns);
    count_tiles(c);
    stage_end(c, &c->stats.time_blur, start);
    return smear_band_flush(c, row, finish.row.band);
}

int smear_timed_rows(struct smear_context *c, int first, int end)
{
    for (int row = first; row < end; row++) {
        uint32_t start = stage_start(c);
        struct row_job job = { .c = c, .row = row };
        c->opaque = smear_geometry_advance(&c->geometry, c->geometry.opaque_last, c->opaque, row);
        smear_jobs_run(&c->jobs, still_job, &job, c->jobs.workers);
        list_movers(c, row);
        stage_end(c, &c->stats.time_raster, start);
        int result = finish_row(c, row);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}

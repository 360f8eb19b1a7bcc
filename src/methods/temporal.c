/* SPDX-License-Identifier: MIT */
/* temporal.c - see temporal.h.
 *
 *     list        moving triangles of the row, and what they mean for its tiles
 *     for each run of tiles that must be drawn (one, unless the display keeps some):
 *         static      triangles that do not move, into the row's pixels
 *         finish      tiles by their method (tile_method.h): a copy, subframes of tiles beside each other, or a time
 *                     mask; then flush */
#include "methods/temporal.h"

#include "display/band.h"
#include "display/points.h"
#include "smear_memory.h"

#if SMEAR_WITH_SUBFRAMES

enum { LISTS_PER_WORKER = 2 };      /* jobs: the more there are, the more of them look at the same triangles */

int32_t smear_strip_columns(int32_t strip, int32_t width)
{
    return strip + (strip >= SMEAR_STRIP && strip < width ? 16 : 0);
}

static bool is_static(const struct smear_tile_travel *tile)
{
    return (tile->flags & (TILE_MOVES | PATH_WITHOUT_MASK)) == 0;
}

/* ------------------------------------------------------------------ tiles */

void smear_background_job(void *argument, int job, int worker)
{
    const struct smear_finish *f = (const struct smear_finish *)argument;
    struct smear_raster_target t = f->background;
    (void)worker;
    smear_row_draw_opaque(&f->row, job, &t, 0);
}

/* Points `out` at the finished pixels of tiles, with the depths of the background. */
static void finished_target(const struct smear_tile_run *t, struct smear_raster_target *out)
{
    *out = t->background;
    out->color = t->out;
    out->color_rows = (struct smear_plane_rows){ t->pitch, 0, out->y1 - out->y0, out->x0 };
}

/* Draws blended triangles over a tile without moving ones. */
static void blend_static(struct smear_tile_run *t, const struct smear_rows *rows)
{
    struct smear_raster_target over;
    smear_tile_run_take_background(t, t->out, false);
    finished_target(t, &over);
    for (bool any = tile_run_fill(t, FILL_BLENDED, false); any; any = tile_run_fill(t, FILL_BLENDED, true))
        smear_raster_list(&rows->raster, &over, t->blend);
}

/* Fills the store with the first or next triangles of the row: smear_tile_run.fill. */
static bool fill_tiles(struct smear_tile_run *t, int kinds, bool next)
{
    const struct smear_finish *f = (const struct smear_finish *)t->fill_of;
    struct smear_rows *rows = f->row.rows;
    struct smear_row_moving *moving = &f->self->moving;
    if (next ? !smear_row_fill_next(rows)
             : !smear_row_fill_columns(rows, f->row.row, kinds, t->fill_x0, t->fill_x1))
        return false;
    smear_list_moving(moving, &rows->bins, &rows->window, rows->moving);
    t->moving_count = moving->count;
    t->blend = rows->blend;
    return true;
}

/* Where the row is refilled: fills the store with what the tiles need. When that is all of it, they are drawn as ever. */
static void refill_tiles(struct smear_tile_run *t, const struct smear_finish *f)
{
    struct smear_rows *rows = f->row.rows;
    if (rows->refill == NULL)
        return;
    t->fill_of = f;
    t->fill_x0 = tile_left(rows, t->column);
    t->fill_x1 = tile_right(rows, t->last_column);
    fill_tiles(t, FILL_MOVING | FILL_BLENDED, false);
    t->fill = rows->refill->more ? fill_tiles : NULL;
}

/* Describes tiles [first, end) of the row to a method. */
static struct smear_tile_run tiles_of(const struct smear_finish *f, int first, int end, int worker)
{
    const struct smear_temporal *self = f->self;
    const struct smear_rows *rows = f->row.rows;
    const int32_t pitch = smear_strip_columns(self->strip, rows->window.width);
    struct smear_tile_run t = {
        .frame = &rows->raster, .shutter = &self->shutter, .background = f->background,
        .is_bare = rows->refill == NULL && rows->opaque == SMEAR_NO_TRIANGLE && self->damage == NULL,
        .moving = self->moving.moving, .moving_count = self->moving.count,
        .column = first, .last_column = end - 1, .blend = rows->blend,
        .out = rows->scratch + worker * pitch * rows->window.tile, .pitch = pitch, .tile = rows->window.tile,
        .work = self->work + (uint32_t)worker * self->work_bytes
    };
    t.x0 = t.background.x0 = tile_left(rows, first);
    t.x1 = t.background.x1 = tile_right(rows, end - 1);
    return t;
}

static SMEAR_NOINLINE void hand_on(const struct smear_finish *f, const struct smear_tile_run *t)
{
    struct smear_raster_target out;
    finished_target(t, &out);
    int32_t x0 = t->x0, x1 = t->x1;
    if (rows_have_points(f->row.rows) && smear_points_listed(f->row.rows, &x0, &x1)) {
        out.depth = smear_subframes_depth(t, x0, x1);
        out.window_rows = out.color_rows;
    }
    smear_band_convert_rows(&f->row, &out, t->x0, t->x1);
}

/* Converts static tiles from `first` on; returns the first that is not, or `end`. What lies over the frame is drawn over what the
 * next frame needs no more. */
static int finish_static(const struct smear_finish *f, int first, int end, int worker)
{
    const struct smear_rows *rows = f->row.rows;
    int next = first;
    while (next < end && is_static(&f->self->moving.travel[next]))
        next++;
    const int32_t x0 = tile_left(rows, first), x1 = tile_right(rows, next - 1);
    const struct overlay_box box = { x0, job_top(&f->row), x1, job_bottom(&f->row) };
    if (!static_is_kept(f->self->damage) || !(rows_list_has_points(rows, x0, x1) || rows_are_covered(rows, &box))) {
        smear_band_convert_rows(&f->row, &f->background, x0, x1);
        return next;
    }
    const struct smear_tile_run t = tiles_of(f, first, next, worker);
    struct smear_raster_target out;
    finished_target(&t, &out);
    smear_tile_run_take_background(&t, t.out, false);
    smear_band_convert_rows(&f->row, &out, x0, x1);
    return next;
}

/* Returns the columns beyond a strip's border in which its moving triangles are drawn, too, so that gaps of its last
 * tile close with what is there. `neighbour`: the tile beyond, or null. */
static int32_t margin_of(const struct smear_finish *f, const struct smear_tile_travel *tile, const struct smear_tile_travel *neighbour)
{
    enum { GAP_SEEN = 2 * 16 };
    const int32_t strip = f->self->strip, most = (smear_strip_columns(strip, f->row.rows->window.width) - strip) / 2;
    const int32_t gap = abs_i32(smear_tile_widest_step(&f->self->chooser, tile));       /* 1/16 px */
    return neighbour == NULL || neighbour->weight == 0 || gap <= GAP_SEEN ? 0 : min_i32((gap + 31) >> 5, most);
}

static void widen(struct smear_tile_run *t, const struct smear_finish *f)
{
    const struct smear_tile_travel *travel = f->self->moving.travel;
    const struct smear_window *w = &f->row.rows->window;
    const int first = t->column, last = t->last_column;
    t->background.x0 -= margin_of(f, &travel[first], first > 0 ? &travel[first - 1] : NULL);
    t->background.x1 += margin_of(f, &travel[last], last + 1 < w->columns ? &travel[last + 1] : NULL);
    t->background.x1 = min_i32(t->background.x1, w->width);
    t->column -= t->background.x0 < t->x0;
    t->last_column += t->background.x1 > t->x1;
}

/* Draws tiles beside each other from `first` on, which share instants: as many as the one that needs most, or as the plan
 * says. Tiles that need none are drawn apart from others, and so are those in which something is blended, as nothing is
 * closed there. Returns the first tile that is not among them. */
static int finish_subframes(const struct smear_finish *f, int first, int end, int32_t instants, int worker)
{
    struct smear_temporal *self = f->self;
    struct smear_tile_travel *travel = self->moving.travel;
    int next = first + 1;
    travel_set_method(&travel[first], TILE_SUBFRAMES);
    for (; next < end && !is_static(&travel[next]); next++) {
        int32_t more;
        if (smear_tile_method_choose(&self->chooser, &travel[next], &more) != TILE_SUBFRAMES
            || ((travel[next].flags ^ travel[first].flags) & TILE_BLENDED) != 0)
            break;
        travel_set_method(&travel[next], TILE_SUBFRAMES);
        instants = max_i32(instants, more);
    }
    const struct smear_tile_plan plan = { &self->chooser, &travel[first], &self->moving.blocks, self->tiles };
    const bool plans = self->chooser.method == SMEAR_AUTO && self->moving.measures;
    struct smear_tile_run t = tiles_of(f, first, next, worker);
    widen(&t, f);
    refill_tiles(&t, f);
    t.mixes = !self->moving.measures;
    if (t.mixes)
        instants = 1 + self->lines->pictures;
    const uint32_t samples = smear_subframes_tiles(&t, instants, plans ? &plan : NULL);
    f->row.rows->samples[worker] += temporal_is_sharp(self) ? 0 : samples;
    hand_on(f, &t);
    return next;
}

static SMEAR_RARE void finish_tile(const struct smear_finish *f, int column, enum smear_tile_method method, int worker)
{
    struct smear_rows *rows = f->row.rows;
    struct smear_tile_run t = tiles_of(f, column, column + 1, worker);
    refill_tiles(&t, f);
    if (SMEAR_WITH_TIMEMASK && method == TILE_TIMEMASK) {
        /* Samples of pixels are merged by depth, all at once. */
        if (t.fill != NULL) {
            rows->refill->failed = true;
            return;
        }
        rows->samples[worker] += smear_timemask_tile(&t, f->self->chooser.samples);
        travel_set_method(&f->self->moving.travel[column], TILE_TIMEMASK);
    } else {
        blend_static(&t, rows);
    }
    hand_on(f, &t);
}

/* ------------------------------------------------------------------ lists */

/* What the moving triangles of a row mean for some of its tiles. */
static void list_job(void *argument, int job, int worker)
{
    struct smear_finish *f = (struct smear_finish *)argument;
    const struct smear_rows *rows = f->row.rows;
    const int32_t columns = rows->window.columns, workers = rows->jobs.workers, jobs = workers == 1 ? 1 : workers * LISTS_PER_WORKER;
    (void)worker;
    smear_list_columns(&f->self->moving, &rows->bins, &rows->window, rows->moving, row_top(rows, f->row.row), columns * job / jobs,
                       columns * (job + 1) / jobs);
}

static void list_tiles(struct smear_temporal *self, struct smear_rows *rows, int row)
{
    struct smear_finish finish = { .row = { .rows = rows, .row = row }, .self = self };
    const int workers = rows->jobs.workers;
    if (rows->moving != SMEAR_NO_TRIANGLE)
        smear_jobs_run(&rows->jobs, list_job, &finish, workers == 1 ? 1 : workers * LISTS_PER_WORKER);
}

/* ------------------------------------------------------------------ strips */

/* Finishes the tiles of the run that lie in a strip. */
static void finish_job(void *argument, int strip, int worker)
{
    const struct smear_finish *f = (const struct smear_finish *)argument;
    const struct smear_window *w = &f->row.rows->window;
    const int tiles = f->self->strip >> w->tile_shift,
              end = min_i32((strip + 1) * tiles, (job_right(&f->row) + w->tile - 1) >> w->tile_shift);
    for (int column = max_i32(strip * tiles, job_left(&f->row) >> w->tile_shift); column < end;) {
        const struct smear_tile_travel *tile = &f->self->moving.travel[column];
        if (is_static(tile)) {
            column = finish_static(f, column, end, worker);
            continue;
        }
        int32_t instants;
        const enum smear_tile_method method = smear_tile_method_choose(&f->self->chooser, tile, &instants);
        if (method == TILE_SUBFRAMES)
            column = finish_subframes(f, column, end, instants, worker);
        else
            finish_tile(f, column++, method, worker);
    }
}

/* ------------------------------------------------------------------ rows */

/* What lines blur counts as SMEAR_CAMERA, after which they are made. */
static void count_tiles(const struct smear_temporal *self, const struct smear_rows *rows)
{
    for (int32_t i = 0; i < rows->window.columns; i++) {
        const enum smear_tile_method method = travel_method(&self->moving.travel[i]);
        if (method == TILE_COPY && temporal_has_lines(self))
            smear_row_count(rows, TILE_UNIFORM, SMEAR_CAMERA);
        else
            smear_row_count(rows, method == TILE_COPY || temporal_is_sharp(self) ? TILE_STATIC : TILE_COMPLEX,
                            method == TILE_TIMEMASK ? SMEAR_TIMEMASK : SMEAR_SUBFRAMES);
    }
}

static bool run_is_static(const struct smear_temporal *self, const struct smear_damage_run *run)
{
    for (int i = run->first; i < run->end; i++)
        if (!is_static(&self->moving.travel[i]))
            return false;
    return true;
}

/* Finds the next tiles to be drawn: all, but for those that the display keeps. */
static bool next_run(const struct smear_temporal *self, const struct smear_rows *rows, int row,
                     struct smear_damage_run *run)
{
    if (SMEAR_WITH_DAMAGE)
        return smear_damage_next_run(self->damage, rows, row, run);
    run->first = run->end;
    run->end = (int)rows->window.columns;
    return run->first < run->end;
}

void smear_draw_run(struct smear_temporal *self, struct smear_finish *f)
{
    struct smear_rows *rows = f->row.rows;
    const uint32_t start = stage_start(rows);
    smear_row_target(rows, f->row.row, &f->background);
    if (!static_is_cached(self->damage)) {
        smear_row_run(rows, smear_background_job, &f->row, FILL_STATIC | FILL_MOVING);
        if (SMEAR_EDGES && bins_margin(&rows->bins) != 0)
            smear_smooth_static(rows, f->row.row, self);
    }
    stage_end(rows, &rows->stats->time.raster, start);
}

int smear_finish_run(struct smear_temporal *self, struct smear_finish *f, const struct smear_damage_run *run)
{
    struct smear_rows *rows = f->row.rows;
    const uint32_t start = stage_start(rows);
    const int row = f->row.row;
    f->row.band = smear_band_begin(rows);
    rows_list_points(rows, row_top(rows, row), row_bottom(rows, row));
    const int strips = (int)((rows->window.width + self->strip - 1) / self->strip);
    if (rows->jobs.workers == 1 && run_is_static(self, run) && !(static_is_kept(self->damage) && rows_have_overlay(rows)))
        finish_static(f, run->first, run->end, 0);
    else if (rows->refill == NULL)
        smear_jobs_run(&rows->jobs, finish_job, f, strips);
    else
        for (int strip = 0; strip < strips; strip++)
            finish_job(f, strip, 0);
    stage_end(rows, &rows->stats->time.blur, start);
    if (rows->refill != NULL && rows->refill->failed)
        return SMEAR_ERR_ROOM;
    return smear_band_flush(&f->row);
}

/* Finds what moves and is blended in a row. */
static void list_row(struct smear_temporal *self, struct smear_rows *rows, int row)
{
    const struct smear_bins *bins = &rows->bins;
    smear_list_begin(&self->moving, &rows->window);
    if (rows->refill == NULL) {
        rows->moving = row_advance(rows, bins->moving_last, rows->moving, row);
        smear_list_moving(&self->moving, bins, &rows->window, rows->moving);
    }
    for (bool any = smear_row_fill(rows, row, FILL_MOVING); any; any = smear_row_fill_next(rows))
        list_tiles(self, rows, row);
    if (SMEAR_FRONT_ORDER && SMEAR_HAS_MUL64 && rows->refill == NULL && self->moving.measures && self->chooser.method != SMEAR_TIMEMASK)
        smear_list_order(&self->moving, bins, &rows->window, row_top(rows, row));
    row_advance_blended(rows, row);
    for (bool any = rows->blends && smear_row_fill(rows, row, FILL_BLENDED); any; any = smear_row_fill_next(rows))
        smear_list_blended(&self->moving, bins, &rows->window, rows->blend, row_top(rows, row));
}

void smear_temporal_begin_row(struct smear_temporal *self, struct smear_rows *rows, int row)
{
    const uint32_t start = stage_start(rows);
    list_row(self, rows, row);
    for (int32_t i = 0; i < rows->window.columns; i++)
        self->tiles[!is_static(&self->moving.travel[i])]++;
    stage_end(rows, &rows->stats->time.raster, start);
}

void smear_temporal_end_row(struct smear_temporal *self, const struct smear_rows *rows)
{
    count_tiles(self, rows);
}

/* Draws and finishes a row whose tiles are listed. Not part of what calls it: listing needs the stack, too. */
static SMEAR_RARE int draw_listed(struct smear_temporal *self, struct smear_rows *rows, int row)
{
    struct smear_damage_run run = { 0, 0 };
    if (rows->refill == NULL)
        rows->opaque = row_advance(rows, rows->bins.opaque_last, rows->opaque, row);
    while (next_run(self, rows, row, &run)) {
        struct smear_finish finish = { .row = { .rows = rows, .row = row }, .self = self };
        finish.row.x0 = tile_left(rows, run.first);
        finish.row.x1 = tile_right(rows, run.end - 1);
        smear_draw_run(self, &finish);
        int result = smear_finish_run(self, &finish, &run);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}

static int draw_row(struct smear_temporal *self, struct smear_rows *rows, int row)
{
    smear_temporal_begin_row(self, rows, row);
    const int result = draw_listed(self, rows, row);
    if (result != SMEAR_OK)
        return result;
    smear_temporal_end_row(self, rows);
    if (SMEAR_WITH_DAMAGE)
        smear_damage_row_sent(self->damage, rows, row);
    return SMEAR_OK;
}

/* ------------------------------------------------------------------ parts of a frame */

/* Returns the error that tile rows [first, end) may have, for their share of the frame's budget. */
static SMEAR_RARE int32_t target_within_budget(const struct smear_temporal *self, struct smear_rows *rows, int first, int end)
{
    const uint32_t part = (uint32_t)(end - first), all = (uint32_t)rows->window.rows, budget = self->budget;
    struct smear_travel_areas areas = { { 0 } };
    for (int row = first; rows->refill == NULL && row < end; row++) {
        const uint32_t last = rows->bins.moving_last[row];
        if (last != SMEAR_NO_TRIANGLE)
            smear_add_areas(&areas, &rows->bins, bins_triangle(&rows->bins, last)->next, last);
    }
    if (rows->refill != NULL)
        for (bool any = smear_row_fill(rows, first, FILL_MOVING); any; any = smear_row_fill_next(rows))
            smear_add_areas(&areas, &rows->bins, rows->moving, SMEAR_NO_TRIANGLE);
    uint32_t work;
    const int32_t target = smear_tile_method_target(&self->chooser, &areas, budget / all * part + budget % all * part / all,
                                                    &work);
    rows->stats->work = min_u32(rows->stats->work, UINT32_MAX - work) + work;
    return target;
}

void smear_temporal_begin(struct smear_temporal *self, const smear_frame *frame, const struct smear_rows *rows,
                          const struct smear_shot *shot)
{
    const struct smear_window *w = &rows->window;
    /* Pairs of taps of the widest gap, 8 to either side, find room between the borders of a frame this large. */
    self->chooser = (struct smear_chooser){
        frame->method, frame->samples, frame->target,
        frame_transfer(&rows->raster),
        min_i32(w->width, w->height) >= 24 && smear_shutter_is_box(&self->shutter)
    };
    if (SMEAR_WITH_LINES && self->lines != NULL) {
        struct smear_lines *lines = self->lines;
        const bool may = frame->method == SMEAR_AUTO && shot->camera_moves && !shot->cut && smear_shutter_is_box(&self->shutter)
                      && target_has_lines(frame->target) && (frame->edges == SMEAR_EDGES_HARD || target_is_sketch(frame->target));
        lines->on = may && lines->wait == 0
                 && smear_lines_begin(lines, shot, w, frame->target, frame_transfer(&rows->raster), frame->edges != SMEAR_EDGES_HARD);
        lines->wait = (uint8_t)(lines->wait - (may && lines->wait != 0));
        if (!may)
            lines_forget(lines);
    }
    self->target = frame->target;
    self->budget = frame->budget;
    self->tiles[0] = self->tiles[1] = 0;
}

int smear_temporal_rows(struct smear_temporal *self, struct smear_rows *rows, int first, int *end)
{
    const bool plans = self->chooser.method == SMEAR_AUTO;
    self->moving.measures = !temporal_has_lines(self) || self->lines->measures;
    self->moving.blocks.columns = plans && self->moving.measures ? block_columns(rows->window.width) : 0;
    if (plans) {
        self->chooser.target = self->target;        /* the part before may have had another */
        if (self->budget != 0)
            self->chooser.target = target_within_budget(self, rows, first, *end);
        rows->stats->target = max_u32(rows->stats->target, (uint32_t)self->chooser.target);
    }
    for (int row = first; row < *end; row++) {
        const int result = temporal_has_lines(self) ? smear_draw_along_lines(self, rows, row, end) : draw_row(self, rows, row);
        if (result != SMEAR_OK)
            return result;
    }
    return SMEAR_OK;
}

#endif

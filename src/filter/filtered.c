/* SPDX-License-Identifier: MIT */
/* filtered.c - see filtered.h.
 *
 *     reduce      finds the longest velocity of each tile of the row that was drawn
 *     finish      the row above: neighbourhoods, then per tile: filter, blended draws, conversion; then flush */
#include "filter/filtered.h"

#include "base/fixmath.h"
#include "draws.h"
#include "display/band.h"
#include "display/points.h"
#include "filter/filter.h"
#include "methods/sharp.h"

#if SMEAR_WITH_RECONSTRUCT

/* What the jobs of a tile row, or of a part of it, share. */
struct filter_job {
    struct row_job row;
    struct smear_filtered *filtered;
};

/* ------------------------------------------------------------------ rows of the window that is read */

static int32_t filtered_top(const struct smear_filtered *f, int row)
{
    return row << f->window->tile_shift;
}

static int32_t filtered_bottom(const struct smear_filtered *f, int row)
{
    return min_i32(filtered_top(f, row + 1), f->window->height);
}

/* Fills in the offsets of rows that a filter of tile row `row` may read; those from row `end` on stand for
 * row end - 1. */
static void fill_row_table(const struct smear_filtered *f, int row, int32_t end)
{
    const struct smear_window *w = f->window;
    const int32_t first = filtered_top(f, row) - w->reach;
    for (int32_t i = 0; i < w->tile + 2 * w->reach; i++)
        f->row_offset[i] = (uint32_t)(window_ring_row(w, clamp_i32(first + i, 0, end - 1)) * w->width);
}

static struct smear_row_table row_table(const struct smear_filtered *f, int row, int32_t y0, int32_t y1)
{
    return (struct smear_row_table){ f->row_offset, filtered_top(f, row) - f->window->reach, y0, y1 };
}

/* Whether blocks are blurred along lines. */
static inline bool goes_along_lines(const struct smear_filtered *f) { return SMEAR_WITH_FILTERS && f->blur.lines; }

/* ------------------------------------------------------------------ reduce */

static void half_job(void *argument, int column, int worker)
{
    const struct filter_job *r = (const struct filter_job *)argument;
    (void)worker;
    smear_half_reduce(r->filtered->half, &r->row.rows->window, r->row.row, column, r->filtered->blur.transfer);
}

static void reduce_job(void *argument, int column, int worker)
{
    const struct filter_job *r = (const struct filter_job *)argument;
    const struct smear_window *w = r->filtered->window;
    (void)worker;
    if (goes_along_lines(r->filtered))
        smear_line_look(w, &r->filtered->plan.flow, r->row.row, column);
    else if (r->row.rows->window.moving[column])
        smear_tilemax(w, r->row.row, column);
    else
        window_motion(w, r->row.row)[column] = (struct smear_tile_motion){ 0, 0, 0, 0, 0, 0 };
}

static void reduce_row(struct smear_filtered *f, struct smear_rows *rows, int row)
{
    struct filter_job job = { .row = { .rows = rows, .row = row }, .filtered = f };
    const uint32_t start = stage_start(rows);
    if (SMEAR_WITH_FILTERS && f->window == f->half)
        smear_jobs_run(&rows->jobs, half_job, &job, rows->window.columns);
    smear_jobs_run(&rows->jobs, reduce_job, &job, rows->window.columns);
    stage_end(rows, &rows->stats->time.reduce, start);
}

/* ------------------------------------------------------------------ tiles */

/* Returns what a pass reads: what the one before it left, or the picture. */
static const uint32_t *pass_input(const struct smear_filtered *f, int pass)
{
    return pass == 0 ? f->window->color : f->pass_plane[pass - 1];
}

/* Filters rows [y0, y1) of a tile of the window that is read; rows of `tile` are that window's tile apart. Returns the
 * samples taken. */
static uint32_t filter_tile(const struct smear_filtered *f, uint32_t *tile, int row, int column, int32_t y0, int32_t y1)
{
    const struct smear_window *w = f->window;
    const struct smear_row_table rows = row_table(f, row, y0, y1);
    const uint8_t kind = window_around(w, row)[column].kind;
    if (kind == TILE_STATIC) {
        smear_blur_copy(tile, w, &rows, column);
        return 0;
    }
    if (SMEAR_WITH_FILTERS && f->kind == SMEAR_FILTER_PINGPONG) {
        const int last = f->passes - 1;
        return smear_pingpong_pass(tile, w->tile, pass_input(f, last), w, &rows, &f->plan.pass[last], row, column, y0, y1,
                                   &f->blur);
    }
    if (SMEAR_WITH_FILTERS && f->kind != SMEAR_FILTER_MEAN && f->blur.weights != SMEAR_WEIGHTS_STACK)
        return smear_blur_weights(tile, w, &rows, row, column, &f->blur);
    if (SMEAR_WITH_FILTERS && (f->kind == SMEAR_FILTER_MEAN || (kind == TILE_UNIFORM && !(f->blur.flags & SMEAR_PUBLISHED))))
        return smear_blur_mean(tile, w, &rows, row, column, &f->blur);
    return smear_blur_reconstruct(tile, w, &rows, row, column, &f->blur);
}

/* Filters the tile at half the size and blends it with the whole frame's. Returns the samples taken. */
static uint32_t filter_half(const struct filter_job *r, uint32_t *tile, int column, int worker)
{
    const struct smear_filtered *f = r->filtered;
    const struct smear_window *w = f->window;
    const int row = r->row.row;
    if (window_around(w, row)[column].kind == TILE_STATIC) {
        const struct smear_row_table rows = row_table(f, row, r->row.y0, r->row.y1);
        smear_blur_copy(tile, &r->row.rows->window, &rows, column);
        return 0;
    }
    uint32_t *blurred = f->half_scratch + worker * w->tile * w->tile;
    const uint32_t samples = filter_tile(f, blurred, row, column, filtered_top(f, row), filtered_bottom(f, row));
    smear_half_blend(tile, blurred, w, &r->row.rows->window, row, column);
    return samples;
}

static uint32_t filter_any(const struct filter_job *r, uint32_t *tile, int column, int worker)
{
    return SMEAR_WITH_FILTERS && r->filtered->window == r->filtered->half
             ? filter_half(r, tile, column, worker)
             : filter_tile(r->filtered, tile, r->row.row, column, r->row.y0, r->row.y1);
}

static void tile_job(void *argument, int column, int worker)
{
    const struct filter_job *r = (const struct filter_job *)argument;
    struct smear_rows *rows = r->row.rows;
    uint32_t *tile = rows->scratch + worker * rows->window.tile * rows->desc->band_rows;
    rows->samples[worker] += filter_any(r, tile, column, worker);
    if (rows->blend != SMEAR_NO_TRIANGLE)
        smear_band_blend_tile(&r->row, column, tile);
    smear_band_convert_tile(&r->row, column, tile);
}

/* Finishes a tile over which more is blended than the store holds at once. */
static void finish_refilled(const struct filter_job *r, int column)
{
    struct smear_rows *rows = r->row.rows;
    uint32_t *tile = rows->scratch;
    rows->samples[0] += filter_any(r, tile, column, 0);
    for (bool any = smear_row_fill(rows, r->row.row, FILL_BLENDED); any; any = smear_row_fill_next(rows))
        smear_band_blend_tile(&r->row, column, tile);
    smear_band_convert_tile(&r->row, column, tile);
}

/* ------------------------------------------------------------------ passes before the last */

/* A part of tile row `row` in pass `pass`: pixel rows [y0, y1). */
struct pass_job {
    struct smear_filtered *filtered;
    struct smear_rows *rows;
    int pass, row;
    int32_t y0, y1;
};

static void pass_tile_job(void *argument, int column, int worker)
{
    const struct pass_job *r = (const struct pass_job *)argument;
    const struct smear_filtered *f = r->filtered;
    const struct smear_row_table table = row_table(f, r->row, r->y0, r->y1);
    r->rows->samples[worker] += smear_pingpong_pass(f->pass_plane[r->pass], 0, pass_input(f, r->pass), f->window,
                                                    &table, &f->plan.pass[r->pass], r->row, column, r->y0, r->y1,
                                                    &f->blur);
}

/* Carries every pass but the last on, as far down as the rows drawn up to tile row `known` allow: each stays as far
 * behind the one before it as it reaches. Returns the end of the rows that the last pass may read. */
static int32_t run_passes(struct smear_filtered *f, struct smear_rows *rows, int known)
{
    int32_t end = filtered_bottom(f, known);
    for (int i = 0; i < f->passes - 1; i++) {
        const int32_t input_end = end;
        if (known != rows->window.rows - 1)
            end = max_i32(end - f->plan.pass[i].reach, 0);
        for (int32_t y = f->pass_end[i]; y < end;) {
            const int row = y >> f->window->tile_shift;
            struct pass_job job = { f, rows, i, row, y, min_i32(end, filtered_bottom(f, row)) };
            fill_row_table(f, row, input_end);
            smear_jobs_run(&rows->jobs, pass_tile_job, &job, rows->window.columns);
            y = job.y1;
        }
        f->pass_end[i] = max_i32(f->pass_end[i], end);
    }
    return end;
}

/* ------------------------------------------------------------------ finish */

static void count_tiles(const struct smear_filtered *f, const struct smear_rows *rows, int row)
{
    const struct smear_tile_neighborhood *around = window_around(f->window, row);
    for (int32_t i = 0; i < rows->window.columns; i++)
        smear_row_count(rows, around[i].kind, (smear_method)f->method);
}

/* Whether two tiles beside each other write into one byte: then one core finishes them. */
static bool tiles_share_bytes(const smear_desc *d)
{
    return SMEAR_WITH_GREY && d->format == SMEAR_L1 && d->tile < 8;
}

/* Finishes tile row `row`; rows up to `known` are in the window. */
static int finish_row(struct smear_filtered *f, struct smear_rows *rows, int row, int known)
{
    const struct smear_window *w = f->window;
    const bool corner = f->blur.flags & SMEAR_CORNER;
    if (!goes_along_lines(f))
        smear_neighbormax_row(w, row, known, corner);
    if (!goes_along_lines(f) && known > row)       /* looked at by the pixels of this row, and by passes that are ahead */
        smear_neighbormax_row(w, row + 1, known, corner);
    count_tiles(f, rows, row);
    int32_t end = w->height;
    if (SMEAR_WITH_FILTERS && f->kind == SMEAR_FILTER_PINGPONG && f->passes > 1)
        end = run_passes(f, rows, known);
    fill_row_table(f, row, end);
    if (rows->blends && rows->refill != NULL)
        smear_row_fill(rows, row, FILL_BLENDED);
    else if (rows->blends)
        rows->blend = row_advance(rows, rows->bins.blend_last, rows->blend, row);
    const bool refilled = rows->blends && rows->refill != NULL && rows->refill->more;

    struct filter_job job = { .row = { .rows = rows, .row = row }, .filtered = f };
    int result = SMEAR_OK;
    while (result == SMEAR_OK && smear_band_next(&job.row)) {
        const uint32_t start = stage_start(rows);
        for (int column = 0; refilled && column < w->columns; column++)
            finish_refilled(&job, column);
        for (int column = 0; !refilled && tiles_share_bytes(rows->desc) && column < w->columns; column++)
            tile_job(&job, column, 0);
        if (!refilled && !tiles_share_bytes(rows->desc))
            smear_jobs_run(&rows->jobs, tile_job, &job, w->columns);
        stage_end(rows, &rows->stats->time.blur, start);
        result = smear_band_flush(&job.row);
    }
    return result;
}

int smear_filtered_roll(struct smear_filtered *f, struct smear_rows *rows, int row)
{
    reduce_row(f, rows, row);
    const int lag = SMEAR_WITH_FILTERS ? f->window->lag : 1;
    int result = SMEAR_OK;
    if (row >= lag)
        result = finish_row(f, rows, row - lag, row);
    if (row == rows->window.rows - 1)
        for (int last = max_i32(row - lag + 1, 0); last <= row && result == SMEAR_OK; last++)
            result = finish_row(f, rows, last, row);
    return result;
}

/* ------------------------------------------------------------------ rows with velocities */

static void draw_job(void *argument, int job, int worker)
{
    const struct filter_job *r = (const struct filter_job *)argument;
    struct smear_rows *rows = r->row.rows;
    const struct smear_filtered *f = r->filtered;
    const struct smear_window *w = &rows->window;
    const bool by_depth = frame_has_depth_velocity(&rows->raster), velocities = !goes_along_lines(f) || rows->inspect != NULL;
    struct smear_raster_target t;
    (void)worker;
    smear_row_target(rows, r->row.row, &t);
    t.velocity8 = velocities ? w->velocity8 : NULL;
    t.velocity16 = velocities ? w->velocity16 : NULL;
    t.inspect = rows->inspect;
    if (!smear_row_draw_opaque(&r->row, job, &t, by_depth ? SMEAR_VELOCITY_UNKNOWN8 : 0) || !by_depth || !velocities
        || !(r->row.steps & ROW_FINISH))
        return;
    const struct smear_camera_store store = { rows->raster.velocity_scale, rows->raster.inspect_scale,
                                              rows->raster.reach_q3, rows->inspect };
    smear_camera_velocity(w, &f->reprojection, &store, f->camera_step, t.x0, t.x1, t.y0, t.y1);
}

static void draw_row(struct smear_filtered *f, struct smear_rows *rows, int row)
{
    struct filter_job job = { .row = { .rows = rows, .row = row }, .filtered = f };
    const uint32_t start = stage_start(rows);
    smear_sharp_advance_lists(rows, row);
    smear_row_run(rows, draw_job, &job.row, FILL_STATIC | FILL_MOVING);
    if (SMEAR_WITH_DEBUG && rows->inspect != NULL)
        smear_sharp_inspect_row(rows, row);
    stage_end(rows, &rows->stats->time.raster, start);
}

/* ------------------------------------------------------------------ a frame */

/* Returns far over range of an orthographic camera, in q16: where "5 % nearer" is. */
static uint32_t far_over_range(const smear_camera *camera)
{
    const uint32_t range = (uint32_t)(camera->far_plane - camera->near_plane);
    const int zeros = count_leading_zeros(range);
    const uint64_t over = (uint64_t)recip_norm_precise(range << zeros) * (uint32_t)camera->far_plane >> (45 - zeros);
    return over > 0xffffffffu ? 0xffffffffu : (uint32_t)over;
}

static void begin_filter(struct smear_filtered *f, const struct smear_rows *rows, const smear_frame *frame,
                         const smear_camera *camera)
{
    f->method = frame->method;
    f->kind = frame->filter.kind;
    f->blur = (struct smear_blur_settings){
        .transfer = frame_transfer(&rows->raster),
        .orthographic = SMEAR_WITH_VIEWS && camera->half_height > 0,
        .samples = frame->samples, .flags = frame->filter.flags, .weights = frame->filter.weights
    };
    if (f->blur.orthographic)
        f->blur.far_over_range = far_over_range(camera);
    f->window = frame->method == SMEAR_HALF ? f->half : &rows->window;
    f->camera_step = frame->filter.camera_step;
    if (!SMEAR_WITH_FILTERS)
        return;
    f->passes = smear_pingpong_plan(f->plan.pass, &frame->filter.pingpong, f->window->reach);
    for (int i = 0; i < PINGPONG_PASSES_MAX - 1; i++)
        f->pass_end[i] = 0;
}

void smear_filtered_begin(struct smear_context *c, bool by_depth)
{
    struct smear_raster_frame *raster = &c->rows.raster;
    const bool spans = shot_spans_exposure(&c->shot);
    raster->velocity_scale = spans ? 32768 : c->shot.half_exposure >> 8;
    raster->inspect_scale = spans ? (int32_t)((360u << 16) / c->frame.shutter.degrees) : 65536;
    raster->reach_q3 = c->rows.window.reach * 8;
    raster->velocity_from_depth = by_depth && c->frame.filter.camera_step != 0 && c->shot.camera_moves && !c->shot.cut;
    if (smear_method_is_filter(c->frame.method))
        begin_filter(c->filtered, &c->rows, &c->frame, &c->shot.camera[0]);
}

/* All is drawn once with velocities; a row is filtered when those below it, as far as the reach, are there. Blended
 * draws go over a row when it is finished, so a part of the frame begins with the rows that are not. */
int smear_filtered_render(struct smear_context *c)
{
    const struct smear_instant middle = smear_instant_middle(&c->shot);
    struct smear_filtered *f = c->filtered;
    const int rows = c->rows.window.rows, late = c->rows.blends ? f->window->lag : 0;
    int result = SMEAR_OK;
    f->blur.held = c->has_fixed;
    f->blur.lines = SMEAR_WITH_FILTERS && frame_has_depth_velocity(&c->rows.raster) && c->frame.method == SMEAR_CAMERA
                 && f->kind == SMEAR_FILTER_MEAN && !c->has_fixed;
    if (frame_has_depth_velocity(&c->rows.raster)) {
        const struct smear_shutter_order at = smear_shot_order(&c->shot);
        const bool spans = shot_spans_exposure(&c->shot);
        const smear_camera *camera = c->shot.camera;
        smear_reproject_make(&f->reprojection, &camera[at.middle], &camera[at.open],
                             &camera[at.close], spans ? smear_instant_now.weight : middle.weight, spans,
                             c->rows.window.width, c->rows.window.height);
        if (goes_along_lines(f))
            smear_flow_make(&f->plan.flow, &f->reprojection, spans ? 65536 : c->shot.half_exposure >> 7);
    }
    for (int row = 0, end; row < rows && result == SMEAR_OK;) {
        struct smear_refill refill;
        end = smear_draws_assemble(c, max_i32(row - late, 0), row, rows, &middle, &refill);
        for (; row < end && result == SMEAR_OK; row++) {
            draw_row(f, &c->rows, row);
            result = smear_filtered_roll(f, &c->rows, row);
        }
    }
    return result;
}

#endif

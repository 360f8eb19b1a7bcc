/* SPDX-License-Identifier: MIT */
/* frame.c - the order of the stages. Start reading here.
 *
 *     prepare     settings of the frame; what each draw is, and whether it moves
 *     for each part of the frame (one, unless the store of triangles is too small):
 *         assemble    every draw's triangles into lists per tile row (draws.c)
 *         for each tile row:
 *             the method's way to draw it, finish it and hand it to the display (methods/) */
#include "frame.h"

#include "draws.h"
#include "display/band.h"
#include "methods/layered.h"
#include "methods/sharp.h"

/* ------------------------------------------------------------------ SMEAR_AUTO, SMEAR_SUBFRAMES, SMEAR_TIMEMASK */

/* What is static is drawn once; tiles in which something moves draw their moving triangles at several instants. */
static int render_temporal(struct smear_context *c)
{
    const struct smear_instant middle = smear_instant_middle(&c->shot);
    int result = SMEAR_OK;
    smear_draws_find_damage(c);
    for (int row = 0, end; row < c->rows.window.rows && result == SMEAR_OK; row = end) {
        struct smear_refill refill;
        end = smear_draws_assemble(c, row, row, c->rows.window.rows, &middle, &refill);
        result = smear_temporal_rows(&c->temporal, &c->rows, row, end);
    }
    smear_draws_end_damage(c, result);
    return result;
}

/* ------------------------------------------------------------------ SMEAR_NONE */

static int render_sharp(struct smear_context *c)
{
    int result = SMEAR_OK;
    smear_draws_find_changes(c);
    for (int row = 0, end; row < c->rows.window.rows && result == SMEAR_OK; row = end) {
        struct smear_refill refill;
        end = smear_draws_assemble(c, row, row, c->rows.window.rows, &smear_instant_now, &refill);
        result = smear_sharp_rows(&c->rows, c->damage, c->direct, row, end);
    }
    smear_draws_end_damage(c, result);
    return result;
}

/* ------------------------------------------------------------------ SMEAR_OBJECT, SMEAR_LAYERED */

/* What is static is drawn once; each group of draws that move alike is drawn once, blurred and merged over it. */
static int render_layered(struct smear_context *c)
{
    const struct smear_instant middle = smear_instant_middle(&c->shot);
    int result = SMEAR_OK;
    smear_draws_find_layers(c, &middle);
    for (int row = 0, end; row < c->rows.window.rows && result == SMEAR_OK; row = end) {
        struct smear_refill refill;
        end = smear_draws_assemble(c, row, row, c->rows.window.rows, &middle, &refill);
        result = smear_layered_rows(c->layers, &c->rows, c->frame.samples, row, end);
    }
    return result;
}

/* ------------------------------------------------------------------ SMEAR_RECONSTRUCT and other filters of a window */

/* All is drawn once with velocities; a row is filtered when those below it, as far as the reach, are there. Blended
 * draws go over a row when it is finished, so a part of the frame begins with the rows that are not. */
static int render_filtered(struct smear_context *c)
{
    const struct smear_instant middle = smear_instant_middle(&c->shot);
    const int rows = c->rows.window.rows, late = c->rows.blends ? c->filtered.window->lag : 0;
    int result = SMEAR_OK;
    if (frame_has_depth_velocity(&c->rows.raster)) {
        const struct smear_shutter_order at = smear_shot_order(&c->shot);
        const bool spans = shot_spans_exposure(&c->shot);
        const smear_camera *camera = c->shot.camera;
        smear_reproject_make(&c->filtered.ports->by_depth.reprojection, &camera[at.middle], &camera[at.open],
                             &camera[at.close], spans ? smear_instant_now.weight : middle.weight, spans,
                             c->rows.window.width, c->rows.window.height);
    }
    for (int row = 0, end; row < rows && result == SMEAR_OK; row = end) {
        struct smear_refill refill;
        end = smear_draws_assemble(c, max_i32(row - late, 0), row, rows, &middle, &refill);
        result = smear_filtered_rows(&c->filtered, &c->rows, row, end);
    }
    return result;
}

/* ------------------------------------------------------------------ SMEAR_ACCUMULATE */

/* Draws tile rows [first, end) at every instant and adds them up. */
static void accumulate_rows(struct smear_context *c, int first, int end)
{
    const uint32_t n = c->frame.samples;
    smear_sums_clear(&c->sums, &c->rows, first, end);
    for (uint32_t k = 0; k < n; k++) {
        const struct smear_instant instant = smear_instant_at(&c->shot, (int32_t)((2 * k + 1) * 65536u / n) - 65536);
        draws_begin_exposure(c, (int32_t)(2 * k * 65536u / n) - 65536, (int32_t)(2 * (k + 1) * 65536u / n) - 65536);
        for (int row = first; row < end;) {
            struct smear_refill refill;
            const int part = smear_draws_assemble(c, row, row, end, &instant, &refill);
            for (; row < part; row++) {
                smear_sharp_draw_row(&c->rows, row, NULL);
                smear_row_blend(&c->rows, row);
                rows_draw_points(&c->rows, row);
                smear_sums_add_row(&c->sums, &c->rows, row);
            }
        }
    }
    rows_hide_points(&c->rows);
}

static int render_accumulated(struct smear_context *c)
{
    int result = SMEAR_OK;
    c->stats.samples = c->frame.samples * c->stats.pixels;
    if (c->sums.whole)
        accumulate_rows(c, 0, c->rows.window.rows);
    for (int row = 0; row < c->rows.window.rows && result == SMEAR_OK; row++) {
        if (!c->sums.whole)
            accumulate_rows(c, row, row + 1);
        smear_sums_average_row(&c->sums, &c->rows, row, c->frame.samples);
        result = smear_band_finish_row(&c->rows, row);
    }
    return result;
}

/* ------------------------------------------------------------------ a frame */

/* Settings of stages that hold for the frame. `filters`: velocities may come from depth. */
static void prepare_stages(struct smear_context *c, bool filters)
{
    const uint8_t method = c->frame.method;
    struct smear_rows *rows = &c->rows;
    struct smear_raster_frame *raster = &rows->raster;
    const bool spans = shot_spans_exposure(&c->shot);
    const bool camera_moves = c->shot.camera_moves
                           && !(smear_camera_is_same(&c->shot.camera[0], &c->shot.camera[1])
                                && (!spans || smear_camera_is_same(&c->shot.camera[0], &c->shot.camera[2])));
    raster->linear = c->frame.light_space == SMEAR_LIGHT_LINEAR;
    c->shot.camera_moves = camera_moves;
    if (SMEAR_WITH_RECONSTRUCT) {
        raster->velocity_scale = spans ? 32768 : c->shot.half_exposure >> 8;
        raster->inspect_scale = spans ? (int32_t)((360u << 16) / c->frame.shutter.degrees) : 65536;
        raster->reach_q3 = rows->window.reach * 8;
        raster->velocity_from_depth = filters && c->frame.filter.camera_step != 0 && camera_moves && !c->shot.cut;
    }
    rows->clear = c->frame.clear & 0xffffffu;
    rows->keeps_motion = c->assembler.keep_motion = smear_method_is_filter(method);
    c->assembler.keep_paths = smear_method_is_temporal(method);
    c->assembler.damaged = NULL;        /* until smear_draws_find_damage */
    c->assembler.triangles_drawn = c->assembler.triangles_dropped = 0;
    rows->refill = NULL;
    rows->bins.margin = c->frame.edges;
    c->direct = method == SMEAR_NONE && smear_sharp_may_be_direct(&c->desc, c->filtered.ports != NULL);
}

static void prepare_methods(struct smear_context *c)
{
    const uint8_t method = c->frame.method;
    const struct smear_window *w = &c->rows.window;
    if (SMEAR_WITH_LAYERS && c->layers != NULL)
        c->layers->on = false;
    smear_draws_begin_damage(c);
    if (SMEAR_WITH_RECONSTRUCT && smear_method_is_filter(method))
        smear_filtered_begin(&c->filtered, &c->rows, &c->frame, &c->shot.camera[0]);
    if (!SMEAR_WITH_SUBFRAMES)
        return;
    smear_temporal_begin(&c->temporal, &c->frame, w);
}

static SMEAR_NOINLINE void prepare(struct smear_context *c, bool filters)
{
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    c->stats = (smear_stats){ .arena_bytes = c->stats.arena_bytes };
    c->stats.pixels = (uint32_t)(c->rows.window.width * c->rows.window.height);
    for (int i = 0; i < c->rows.jobs.workers; i++)
        c->rows.samples[i] = 0;
    smear_draws_find_curves(c);
    prepare_stages(c, filters);
    prepare_methods(c);
    smear_draws_prepare(c);
}

static void sum_up(struct smear_context *c)
{
    smear_stats *s = &c->stats;
    const struct smear_window *w = &c->rows.window;
    s->triangles_drawn = c->assembler.triangles_drawn;
    s->triangles_dropped = c->assembler.triangles_dropped;
    for (int i = 0; i < c->rows.jobs.workers; i++)
        s->samples += c->rows.samples[i];
    const uint32_t tiles = (uint32_t)(w->columns * ((w->height + w->tile - 1) >> w->tile_shift));
    if (c->frame.method == SMEAR_NONE)
        s->tiles[SMEAR_NONE] = s->tiles_static = tiles;
    else if (c->frame.method == SMEAR_ACCUMULATE)
        s->tiles[SMEAR_ACCUMULATE] = s->tiles_complex = tiles;
}

/* What was not compiled in has been refused by smear_begin. */
static int render(struct smear_context *c)
{
    const uint8_t method = c->frame.method;
    if (SMEAR_WITH_SUBFRAMES && smear_method_is_temporal(method))
        return render_temporal(c);
    if (SMEAR_WITH_LAYERS && smear_method_has_layers(method))
        return render_layered(c);
    if (SMEAR_WITH_RECONSTRUCT && smear_method_is_filter(method))
        return render_filtered(c);
    if (SMEAR_WITH_ACCUMULATE && method == SMEAR_ACCUMULATE)
        return render_accumulated(c);
    return render_sharp(c);
}

int smear_frame_render(struct smear_context *c)
{
    const uint32_t start = stage_start(&c->rows);
    prepare(c, smear_method_is_filter(c->frame.method));
    const int result = render(c);
    smear_jobs_end_frame(&c->rows.jobs);
    sum_up(c);
    stage_end(&c->rows, &c->stats.time.total, start);
    return result;
}

#if SMEAR_WITH_RECONSTRUCT
void smear_frame_filter_begin(struct smear_context *c)
{
    c->draw_count = 0;
    prepare(c, false);
    SMEAR_ENTER_STAGE(SMEAR_STAGE_DRAW);
    c->rows.opaque = c->rows.blend = SMEAR_NO_TRIANGLE;
    c->filter_row = 0;
}

int smear_frame_filter_row(struct smear_context *c, const uint32_t *color, const uint32_t *depth,
                           const int16_t *velocity)
{
    const struct smear_window *w = &c->rows.window;
    const int32_t y = c->filter_row++;
    const int row = y >> w->tile_shift;
    smear_filtered_take_row(&c->rows, y, color, depth, velocity, c->shot.camera[0].near_plane);
    if (y + 1 != row_bottom(&c->rows, row))
        return SMEAR_OK;
    const int result = smear_filtered_roll(&c->filtered, &c->rows, row);
    if (row == w->rows - 1)
        sum_up(c);
    return result;
}
#endif

/* SPDX-License-Identifier: MIT */
/* frame.c - the order of the stages. Start reading here.
 *
 *     prepare     settings of the frame; what each draw is, and whether it moves
 *     for each part of the frame (one, unless the store of triangles is too small):
 *         assemble    every draw's triangles into lists per tile row (draws.c)
 *         for each tile row:
 *             the method's way to draw it, finish it and hand it to the display (methods/)
 *
 * The methods of other systems have such functions in rooms of their own (others.h). */
#include "frame.h"

#include "draws.h"
#include "methods/sharp.h"
#include "base/compiled.h"

/* ------------------------------------------------------------------ SMEAR_AUTO, SMEAR_SUBFRAMES, SMEAR_TIMEMASK */

/* What is static is drawn once; tiles in which something moves draw their moving triangles at several instants. Along lines a
 * row is finished late, with the triangles that move in it; what a display shows is not what is static then, nor is it where one
 * instant is all. Where lines do not do for what is left of the frame, all that moves does so along paths. */
static int render_temporal(struct smear_context *c)
{
    const struct smear_instant middle = smear_instant_middle(&c->shot);
    const bool keeps = !frame_has_lines(c) && c->assembler.keep_paths;
    int result = SMEAR_OK;
    if (keeps)
        smear_draws_find_damage(c);
    else
        damage_forget(c->damage);
    for (int row = 0, end; row < c->rows.window.rows && result == SMEAR_OK; row = end) {
        struct smear_refill refill;
        const int top = frame_has_lines(c) ? c->temporal.lines->finished : row;
        end = smear_draws_assemble(c, top, row, c->rows.window.rows, &middle, &refill);
        result = smear_temporal_rows(&c->temporal, &c->rows, row, &end);
        if (c->assembler.lines && !frame_has_lines(c)) {
            c->assembler.lines = false;
            smear_draws_classify(c);
        }
    }
    if (keeps)
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

/* ------------------------------------------------------------------ a frame */

/* What is behind everything is the mean of the exposure, but where filters blur that, too. */
static void aim_sky(struct smear_context *c)
{
    const bool blurs = smear_method_is_filter(c->frame.method) && frame_has_depth_velocity(&c->rows.raster);
    const struct smear_instant one = blurs ? smear_instant_middle(&c->shot) : smear_instant_now;
    const bool mean = !blurs && c->frame.method != SMEAR_NONE && c->shot.camera_moves;
    c->rows.sky->kind->aim(c->rows.sky, &c->shot, mean ? NULL : &one, c->rows.window.width, c->rows.raster.transfer);
}

/* Settings of stages that hold for the frame. */
static void prepare_stages(struct smear_context *c, bool by_depth)
{
    const uint8_t method = c->frame.method;
    struct smear_rows *rows = &c->rows;
    struct smear_raster_frame *raster = &rows->raster;
    const bool spans = shot_spans_exposure(&c->shot);
    const bool camera_moves = c->shot.camera_moves
                           && !(smear_camera_is_same(&c->shot.camera[0], &c->shot.camera[1])
                                && (!spans || smear_camera_is_same(&c->shot.camera[0], &c->shot.camera[2])));
    raster->transfer = c->frame.light_space == SMEAR_LIGHT_LINEAR ? TRANSFER_LINEAR : TRANSFER_CODES;
    c->shot.camera_moves = camera_moves;
    if (SMEAR_WITH_SUBFRAMES)
        smear_temporal_begin(&c->temporal, &c->frame, rows, &c->shot);
    if (SMEAR_WITH_RECONSTRUCT)
        smear_filtered_begin(c, by_depth);
    rows->clear = c->frame.clear & 0xffffffu;
    if (rows_have_sky(rows))
        aim_sky(c);
    rows->keeps_motion = c->assembler.keep_motion = smear_method_is_filter(method);
    /* One instant is drawn as if nothing moved, but where what moves has edges of its own. */
    c->assembler.keep_paths = smear_method_is_temporal(method)
                           && !(temporal_is_sharp(&c->temporal) && c->frame.edges == SMEAR_EDGES_HARD);
    c->assembler.lines = frame_has_lines(c);
    c->assembler.damaged = NULL;        /* until smear_draws_find_damage */
    c->assembler.triangles_drawn = c->assembler.triangles_dropped = 0;
    rows->refill = NULL;
    rows->bins.margin = c->frame.edges;
    c->direct = method == SMEAR_NONE && smear_sharp_may_be_direct(&c->desc, has_window(&c->desc) || has_lines(&c->desc));
}

SMEAR_NOINLINE void smear_frame_prepare(struct smear_context *c, bool by_depth)
{
    c->stats = (smear_stats){ .arena_bytes = c->stats.arena_bytes };
    c->stats.pixels = (uint32_t)(c->rows.window.width * c->rows.window.height);
    for (int i = 0; i < c->rows.jobs.workers; i++)
        c->rows.samples[i] = 0;
    smear_draws_find_curves(c);
    smear_shot_find_turn(&c->shot);
    prepare_stages(c, by_depth);
    c->has_groups = c->has_fixed = false;
    smear_draws_begin_damage(c);
    smear_draws_prepare(c);
}

void smear_frame_sum_up(struct smear_context *c)
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
        return smear_layers_render(c);
    if (SMEAR_WITH_RECONSTRUCT && smear_method_is_filter(method))
        return smear_filtered_render(c);
    if (SMEAR_WITH_ACCUMULATE && method == SMEAR_ACCUMULATE)
        return smear_accumulate_render(c);
    return render_sharp(c);
}

int smear_frame_render(struct smear_context *c)
{
    const uint32_t start = stage_start(&c->rows);
    smear_frame_prepare(c, smear_method_is_filter(c->frame.method));
    const int result = render(c);
    smear_jobs_end_frame(&c->rows.jobs);
    smear_frame_sum_up(c);
    stage_end(&c->rows, &c->stats.time.total, start);
    return result;
}

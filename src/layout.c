/* SPDX-License-Identifier: MIT */
/* layout.c - cuts a context's memory. smear_memory.h has the same sum of usual descs as a constant. */
#include "frame.h"

#include "smear_memory.h"

#include "display/band.h"
#include "methods/sharp.h"
#include "base/compiled.h"
#include "others.h"

SMEAR_STATIC_ASSERT(sizeof(struct smear_context) <= SMEAR_CONTEXT_BYTES, "SMEAR_CONTEXT_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_submitted) <= SMEAR_SUBMITTED_BYTES, "SMEAR_SUBMITTED_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_raster_draw) <= SMEAR_SAMPLER_BYTES, "SMEAR_SAMPLER_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_kept_pose) <= SMEAR_KEPT_BYTES, "SMEAR_KEPT_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_older) <= SMEAR_OLDER_CAMERA_BYTES, "SMEAR_OLDER_CAMERA_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_older_pose) <= SMEAR_OLDER_BYTES, "SMEAR_OLDER_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_flow) + 1 <= SMEAR_FLOW_BYTES, "SMEAR_FLOW_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_cached_vertex) <= SMEAR_CACHE_BYTES, "SMEAR_CACHE_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_segment) <= SMEAR_SEGMENT_BYTES, "SMEAR_SEGMENT_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_triangle) == 16, "pool words per triangle");

/* Returns words for triangles and vertices. */
static uint32_t pool_words(const smear_desc *d)
{
    const uint32_t bytes = is_temporal(d) ? SMEAR_TEMPORAL_TRIANGLE_BYTES : SMEAR_TRIANGLE_BYTES;
    return max_u32(d->max_triangles * (bytes / 4), POOL_WORDS_LEAST);
}

static void lay_out_window(struct smear_window *w, struct smear_arena *a, const smear_desc *d)
{
    *w = (struct smear_window){ .width = d->width, .height = d->height, .tile = d->tile, .reach = d->reach };
    for (w->tile_shift = 2; 1 << w->tile_shift < d->tile;)
        w->tile_shift++;
    w->columns = (d->width + d->tile - 1) / d->tile;
    w->rows = (d->height + row_px(d) - 1) / row_px(d);
    w->lag = (d->reach + d->tile - 1) / d->tile;
    w->ring = has_window(d) || has_lines(d) ? (w->lag + 1) * d->tile + d->reach : min_i32(row_px(d), d->height);
    if (caches_static(d))
        w->ring = max_i32(w->ring, d->height);
    w->color = SMEAR_PLACE(d, SMEAR_PART_COLOR, arena_take(a, window_plane(w), 4), window_plane(w) * 4);
    w->depth = SMEAR_PLACE(d, SMEAR_PART_DEPTH, arena_take(a, window_plane(w), 2), window_plane(w) * 2);
    w->moving = arena_take(a, (size_t)w->columns, 1);
}

static void lay_out_lines(struct smear_temporal *t, struct smear_arena *a, const smear_desc *d)
{
    const size_t pixels = (size_t)d->width * (size_t)d->tile;
    uint32_t *row = SMEAR_PLACE(d, SMEAR_PART_LINES, arena_take(a, pixels, sizeof *row), pixels * sizeof *row);
    uint16_t *depth = SMEAR_PLACE(d, SMEAR_PART_LINES, arena_take(a, pixels, sizeof *depth), pixels * sizeof *depth);
    uint32_t *over = (uint32_t *)(void *)t->work;       /* until tiles are finished, if there is room */
    if ((size_t)d->workers * t->work_bytes < pixels * sizeof *over)
        over = arena_take(a, pixels, sizeof *over);
    struct smear_flow *own = arena_take(a, d->max_draws, sizeof *own);
    uint8_t *kind = arena_take(a, d->max_draws, sizeof *kind);
    const size_t blocks = (size_t)line_blocks(d->width) * (size_t)line_blocks(d->tile);
    struct smear_line_block *block = arena_take(a, blocks, sizeof *block);
    struct smear_line_seen *seen = arena_take(a, LINE_ROWS_SEEN * blocks, sizeof *seen);
    t->lines = arena_take(a, 1, sizeof *t->lines);
    if (t->lines != NULL)           /* else it is only measured */
        *t->lines = (struct smear_lines){ .seen = seen, .row = row, .depth = depth, .kind = kind, .own = own, .block = block,
                                          .over = over };
}

static void lay_out_temporal(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_temporal *t = &c->temporal;
    if (!is_temporal(d))
        return;
    c->assembler.path_limit = d->max_triangles;
    t->moving.room = d->max_triangles;
    t->moving.moving = arena_take(a, d->max_triangles, sizeof *t->moving.moving);
    t->moving.travel = arena_take(a, (size_t)c->rows.window.columns, sizeof *t->moving.travel);
    if ((d->methods & SMEAR_SET(SMEAR_AUTO)) != 0)
        t->moving.blocks.block = arena_take(a, (size_t)block_columns(d->width) * (size_t)block_rows(d->tile),
                                            sizeof *t->moving.blocks.block);
    t->work_bytes = (uint32_t)smear_subframes_work(smear_strip_columns(d->strip, d->width), d->tile);
    if (SMEAR_WITH_TIMEMASK && wants(d, SMEAR_SET(SMEAR_TIMEMASK)))
        t->work_bytes = max_u32(t->work_bytes, (uint32_t)smear_timemask_work());
    t->work_bytes = (t->work_bytes + 7u) & ~7u;
    t->work = SMEAR_PLACE(d, SMEAR_PART_SUMS, arena_take(a, d->workers, t->work_bytes), d->workers * t->work_bytes);
    /* Other methods work in both where one lies behind the other: SMEAR_PLACE may have moved either. */
    const uintptr_t scratch = (uintptr_t)c->rows.scratch, from = (uintptr_t)a->memory;
    const bool beside = t->work != NULL && t->work + d->workers * (size_t)t->work_bytes == a->memory + a->used && scratch >= from
                     && scratch < (uintptr_t)t->work;
    c->rows.scratch_end = beside ? a->memory + a->used : NULL;
    if (has_lines(d))               /* not among what cores assemble parts in */
        lay_out_lines(t, a, d);
}

static void lay_out_draws(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    c->submitted = SMEAR_PLACE(d, SMEAR_PART_DRAWS, arena_take(a, d->max_draws, sizeof *c->submitted), d->max_draws * sizeof *c->submitted);
    smear_history_lay_out(&c->history, a, d->max_draws, d->reuse.one_pose);
    c->raster_draw = arena_take(a, d->max_draws, sizeof *c->raster_draw);
}

static void lay_out_store(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_bins *g = &c->rows.bins;
    const size_t rows = (size_t)c->rows.window.rows;
    g->row_px = row_px(d);
    g->row_count = c->rows.window.rows;
    g->shot = &c->shot;
    g->pool_words = pool_words(d);
    g->pool = SMEAR_PLACE(d, SMEAR_PART_TRIANGLES, arena_take(a, g->pool_words, 4), g->pool_words * 4);
    const uint32_t pictures = has_lines(d) ? LINE_PICTURES : 1;
    g->segment_limit = min_u32(pictures * d->max_draws + 2u + g->pool_words / 50000u, 65536u);      /* 16-bit numbers */
    g->segment = SMEAR_PLACE(d, SMEAR_PART_SEGMENTS, arena_take(a, g->segment_limit, sizeof *g->segment),
                             g->segment_limit * sizeof *g->segment);
    g->opaque_last = arena_take(a, rows, sizeof *g->opaque_last);
    g->blend_last = arena_take(a, rows, sizeof *g->blend_last);
    g->more_lists = has_lines(d) ? LINE_LISTS : 0;
    g->more_last = g->more_lists != 0 ? arena_take(a, g->more_lists * rows, sizeof *g->more_last) : NULL;
    g->moving_rows = has_layers(d) ? 2 : 0;
    g->moving_last = is_temporal(d) || has_layers(d)
                   ? arena_take(a, rows + (size_t)g->moving_rows, sizeof *g->moving_last) : NULL;
    c->assembler.cache = arena_take(a, d->vertex_cache, sizeof *c->assembler.cache);
    c->assembler.cache_mask = d->vertex_cache - 1u;
}

static void lay_out_scratch(struct smear_rows *rows, struct smear_arena *a, const smear_desc *d)
{
    const size_t pixels = (size_t)d->workers * (size_t)d->band_rows
                        * (size_t)(is_temporal(d) ? smear_strip_columns(d->strip, d->width) : d->strip);
    rows->scratch = SMEAR_PLACE(d, SMEAR_PART_INSTANTS, arena_take(a, pixels, 4), pixels * 4);
}

/* Where sharp frames are all that a context draws. */
static void lay_out_apart(struct smear_rows *rows, struct smear_arena *a, const smear_desc *d)
{
    const size_t bytes = smear_workers_rows_bytes(d->workers, (size_t)d->width * (size_t)row_px(d));
    rows->scratch = arena_take(a, bytes, 1);
    rows->scratch_end = rows->scratch != NULL ? (uint8_t *)rows->scratch + bytes : NULL;
}

void smear_layout(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_rows *rows = &c->rows;
    lay_out_window(&rows->window, a, d);
    if (SMEAR_WITH_RECONSTRUCT && has_window(d))
        smear_filtered_lay_out(c, a, d);
    c->temporal.strip = d->strip;
    if (has_window(d) || is_temporal(d))
        lay_out_scratch(rows, a, d);
    else if (SMEAR_POOL_PARTS && d->workers > 1 && !smear_sharp_may_be_direct(d, false))
        lay_out_apart(rows, a, d);
    lay_out_temporal(c, a, d);
    if (caches_static(d) || has_buffer_age(d))
        smear_damage_lay_out(c, a, d);
    if (SMEAR_WITH_LAYERS && has_layers(d))
        smear_layers_lay_out(c, a, d);
    if (SMEAR_WITH_ACCUMULATE && wants(d, SMEAR_SET_SUMS))
        smear_accumulate_lay_out(c, a, d);
    rows->bands.bytes = band_bytes(d);
    for (int i = 0; i < d->bands; i++) {
        const size_t bytes = rows->bands.bytes + (i == 0 ? band_state_bytes(d) : 0);
        rows->bands.buffer[i] = SMEAR_PLACE(d, SMEAR_PART_BAND, arena_take(a, bytes, 1), bytes);
    }
    lay_out_draws(c, a, d);
    lay_out_store(c, a, d);
}

/* SPDX-License-Identifier: MIT */
/* layout.c - see layout.h. smear_memory.h has the same sum as a constant. */
#include "layout.h"

#include "smear_memory.h"

#include "display/band.h"
#include "layers/layer_gather.h"
#include "layers/streak.h"
#include "needs.h"

SMEAR_STATIC_ASSERT(sizeof(struct smear_context) <= SMEAR_CONTEXT_BYTES, "SMEAR_CONTEXT_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_ports) <= SMEAR_FILTERING_BYTES, "SMEAR_FILTERING_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_submitted) <= SMEAR_SUBMITTED_BYTES, "SMEAR_SUBMITTED_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_raster_draw) <= SMEAR_SAMPLER_BYTES, "SMEAR_SAMPLER_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_kept_pose) <= SMEAR_KEPT_BYTES, "SMEAR_KEPT_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_older) <= SMEAR_OLDER_CAMERA_BYTES, "SMEAR_OLDER_CAMERA_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_older_pose) <= SMEAR_OLDER_BYTES, "SMEAR_OLDER_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_window) <= SMEAR_WINDOW_BYTES, "SMEAR_WINDOW_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_damage) <= SMEAR_DAMAGE_BYTES, "SMEAR_DAMAGE_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_damaged_draw) <= SMEAR_DAMAGED_DRAW_BYTES, "SMEAR_DAMAGED_DRAW_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_group) <= SMEAR_GROUP_BYTES, "SMEAR_GROUP_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_layer_setting) <= SMEAR_LAYER_BYTES, "SMEAR_LAYER_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_layers) <= SMEAR_LAYERS_BYTES, "SMEAR_LAYERS_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_cached_vertex) <= SMEAR_CACHE_BYTES, "SMEAR_CACHE_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_segment) <= SMEAR_SEGMENT_BYTES, "SMEAR_SEGMENT_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_triangle) == 16, "pool words per triangle");

/* Returns words for triangles and vertices: at least a few triangles with every attribute can be kept at any
 * capacity. */
static uint32_t pool_words(const smear_desc *d)
{
    const uint32_t least = 64;
    return max_u32(d->max_triangles * ((is_temporal(d) ? SMEAR_TEMPORAL_TRIANGLE_BYTES : SMEAR_TRIANGLE_BYTES) / 4),
                   least);
}

/* Velocities of `pixels` pixels, in as many bits as the reach takes. */
static void lay_out_velocity(int8_t **velocity8, int16_t **velocity16, struct smear_arena *a, size_t pixels,
                             int32_t reach)
{
    *velocity8 = reach <= 15 ? arena_take(a, pixels, 2) : NULL;
    *velocity16 = reach <= 15 ? NULL : arena_take(a, pixels, 4);
}

static void lay_out_motion(struct smear_window *w, struct smear_arena *a)
{
    const size_t tiles = (size_t)w->columns * (size_t)(2 * w->lag + 1);
    w->motion = arena_take(a, tiles, sizeof *w->motion);
    w->around = arena_take(a, tiles, sizeof *w->around);
}

static size_t plane_of(const struct smear_window *w)
{
    return (size_t)w->width * (size_t)w->ring;
}

static void lay_out_window(struct smear_window *w, struct smear_arena *a, const smear_desc *d)
{
    *w = (struct smear_window){ .width = d->width, .height = d->height, .tile = d->tile, .reach = d->reach };
    for (w->tile_shift = 2; 1 << w->tile_shift < d->tile;)
        w->tile_shift++;
    w->columns = (d->width + d->tile - 1) / d->tile;
    w->rows = (d->height + row_px(d) - 1) / row_px(d);
    w->lag = (d->reach + d->tile - 1) / d->tile;
    w->ring = has_window(d) ? (w->lag + 1) * d->tile + d->reach : min_i32(row_px(d), d->height);
    if (caches_static(d))
        w->ring = max_i32(w->ring, d->height);
    w->color = SMEAR_PLACE(d, SMEAR_PART_COLOR, arena_take(a, plane_of(w), 4), plane_of(w) * 4);
    w->depth = SMEAR_PLACE(d, SMEAR_PART_DEPTH, arena_take(a, plane_of(w), 2), plane_of(w) * 2);
    w->moving = arena_take(a, (size_t)w->columns, 1);
}

/* A window of half the size of `full`. */
static void lay_out_half(struct smear_window *w, struct smear_arena *a, const struct smear_window *full)
{
    *w = (struct smear_window){ .width = (full->width + 1) / 2, .height = (full->height + 1) / 2,
                                .tile = full->tile / 2, .tile_shift = full->tile_shift - 1,
                                .reach = (full->reach + 1) / 2, .columns = full->columns,
                                .rows = full->rows, .lag = 1 };
    w->ring = 2 * w->tile + w->reach;
    w->color = arena_take(a, plane_of(w), 4);
    w->depth = arena_take(a, plane_of(w), 2);
    lay_out_velocity(&w->velocity8, &w->velocity16, a, plane_of(w), w->reach);
    lay_out_motion(w, a);
}

static void lay_out_filtered(struct smear_filtered *f, struct smear_window *w, struct smear_arena *a,
                             const smear_desc *d)
{
    struct smear_window spare;
    if (!has_window(d))
        return;
    lay_out_velocity(&w->velocity8, &w->velocity16, a, plane_of(w), d->reach);
    lay_out_motion(w, a);
    f->row_offset = arena_take(a, (size_t)(d->tile + 2 * d->reach), sizeof *f->row_offset);
    f->ports = arena_take(a, 1, sizeof *f->ports);
    for (int i = 0; SMEAR_WITH_FILTERS && i + 1 < d->filter.passes; i++) {
        uint32_t *pass = arena_take(a, plane_of(w), 4);
        if (f->ports != NULL)       /* not only measured */
            f->ports->pass_plane[i] = pass;
    }
    if (!has_half(d))
        return;
    f->half = arena_take(a, 1, sizeof *f->half);
    lay_out_half(f->half != NULL ? f->half : &spare, a, w);
    f->half_scratch = arena_take(a, (size_t)d->workers * (size_t)(d->tile / 2) * (size_t)(d->tile / 2), 4);
}

static void lay_out_temporal(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_temporal *t = &c->temporal;
    if (!is_temporal(d))
        return;
    c->assembler.path_limit = d->max_triangles;
    t->moving.moving = arena_take(a, d->max_triangles, sizeof *t->moving.moving);
    const size_t rows = d->workers > 1 ? 2 : 1;         /* the next one is listed beside this one */
    t->beside = (int8_t)(rows - 1);
    t->moving.travel = arena_take(a, rows * (size_t)c->rows.window.columns, sizeof *t->moving.travel);
    if ((d->methods & SMEAR_SET(SMEAR_AUTO)) != 0)
        t->moving.blocks.block = arena_take(a, rows * (size_t)block_columns(d->width) * (size_t)block_rows(d->tile),
                                            sizeof *t->moving.blocks.block);
    t->work_bytes = (uint32_t)smear_subframes_work(smear_strip_columns(d->strip, d->width), d->tile);
    if (SMEAR_WITH_TIMEMASK && wants(d, SMEAR_SET(SMEAR_TIMEMASK)))
        t->work_bytes = max_u32(t->work_bytes, (uint32_t)smear_timemask_work(d->tile));
    t->work_bytes = (t->work_bytes + 7u) & ~7u;
    t->work = SMEAR_PLACE(d, SMEAR_PART_SUMS, arena_take(a, d->workers, t->work_bytes), d->workers * t->work_bytes);
    rows_set_scratch_end(&c->rows, t->work, (size_t)d->workers * t->work_bytes);
}

static void lay_out_damage(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    const struct smear_window *w = &c->rows.window;
    const bool tiles = has_buffer_age(d);
    if (!caches_static(d) && !tiles)
        return;
    const bool compares = compares_sharp(d);
    struct smear_tile_box *seen = tiles && is_temporal(d) ? arena_take(a, d->max_draws, sizeof *seen) : NULL;
    uint32_t *over = SMEAR_OVERLAY_MOST && tiles ? arena_take(a, (size_t)w->columns * (size_t)w->rows, sizeof *over) : NULL;
    const struct smear_damaged_tiles damaged = {
        tiles ? arena_take(a, (size_t)w->columns * (size_t)w->rows, 1) : NULL,
        (uint8_t)(w->columns - 1), (uint8_t)w->tile_shift, false, NULL
    };
    const size_t draws = compares ? d->max_draws * sizeof(struct smear_damaged_draw) : 0;
    c->damage = c->temporal.damage = arena_take(a, 1, sizeof *c->damage + draws);
    if (c->damage == NULL)          /* only measured */
        return;
    *c->damage = (struct smear_damage){ .caches = caches_static(d), .compares = (uint8_t)(compares ? COMPARES_OTHERS : COMPARES_NEVER),
                                        .tiles = damaged, .seen = seen, .over = over };
    if (over != NULL)
        __builtin_memset(over, 0, (size_t)w->columns * (size_t)w->rows * sizeof *over);
}

static void lay_out_layer_rows(struct smear_layer_rows *r, struct smear_arena *a, const smear_desc *d)
{
    const int32_t margin = (d->reach + 3) & ~3;     /* nodes of streaks lie 4 px apart, from the frame's side on */
    *r = (struct smear_layer_rows){ .margin = margin, .width = d->width + 2 * margin,
                                    .height = d->height + 2 * d->tile, .rows = d->tile + 2 * d->reach };
    const size_t layer = (size_t)r->width * (size_t)r->rows, cells = (size_t)(r->width / d->tile) + 1u;
    r->color = arena_take(a, layer, 4);
    r->depth = arena_take(a, layer, 2);
    lay_out_velocity(&r->velocity8, &r->velocity16, a, layer, d->reach);
    r->cell = arena_take(a, 2 * cells, sizeof *r->cell);
    r->over = arena_take(a, (size_t)d->width * (size_t)d->tile, 4);
    r->over_depth = arena_take(a, (size_t)d->width * (size_t)d->tile, 2);
    r->row_first = arena_take(a, (size_t)r->rows, sizeof *r->row_first);
    r->row_end = arena_take(a, (size_t)r->rows, sizeof *r->row_end);
    r->edge = arena_take(a, (size_t)max_i32(r->width, r->rows) + 2u, sizeof *r->edge);
    r->work_bytes = (uint32_t)smear_streak_work(d->tile);
    r->work = arena_take(a, d->workers, r->work_bytes);
}

static void lay_out_layers(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    if (!has_layers(d))
        return;
    struct smear_layers measured, *l = arena_take(a, 1, sizeof *l);
    c->layers = l;
    if (l == NULL)          /* only measured */
        l = &measured;
    *l = (struct smear_layers){ 0 };
    lay_out_layer_rows(&l->rows, a, d);
    l->group_of = arena_take(a, d->max_draws, sizeof *l->group_of);
    l->group = arena_take(a, d->max_draws, sizeof *l->group);
    l->order = arena_take(a, d->max_draws, sizeof *l->order);
    l->sequence = arena_take(a, d->max_draws, sizeof *l->sequence);
    l->layer_of = arena_take(a, d->max_draws, sizeof *l->layer_of);
    l->setting = arena_take(a, SMEAR_LAYERS_MAX, sizeof *l->setting);
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
    g->camera = &c->shot.camera[0];
    g->pool_words = pool_words(d);
    g->pool = SMEAR_PLACE(d, SMEAR_PART_TRIANGLES, arena_take(a, g->pool_words, 4), g->pool_words * 4);
    g->segment_limit = min_u32(d->max_draws + 2u + g->pool_words / 50000u, 65536u);    /* 16-bit numbers */
    g->segment = SMEAR_PLACE(d, SMEAR_PART_SEGMENTS, arena_take(a, g->segment_limit, sizeof *g->segment),
                             g->segment_limit * sizeof *g->segment);
    g->opaque_last = arena_take(a, rows, sizeof *g->opaque_last);
    g->blend_last = arena_take(a, rows, sizeof *g->blend_last);
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

void smear_layout(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_rows *rows = &c->rows;
    lay_out_window(&rows->window, a, d);
    lay_out_filtered(&c->filtered, &rows->window, a, d);
    c->temporal.strip = d->strip;
    if (has_window(d) || is_temporal(d))
        lay_out_scratch(rows, a, d);
    lay_out_temporal(c, a, d);
    lay_out_damage(c, a, d);
    lay_out_layers(c, a, d);
    rows->inspect = SMEAR_WITH_DEBUG && d->debug.inspect != NULL && has_window(d) ? arena_take(a, plane_of(&rows->window), 8)
                                                                                  : NULL;
    c->sums.whole = wants(d, SMEAR_SET(SMEAR_ACCUMULATE));
    if (wants(d, SMEAR_SET_SUMS))
        c->sums.sum = arena_take(a, (size_t)d->width * (size_t)(c->sums.whole ? d->height : row_px(d)),
                                 3 * sizeof *c->sums.sum);
    rows->bands.bytes = band_bytes(d);
    for (int i = 0; i < d->bands; i++) {
        const size_t bytes = rows->bands.bytes + (i == 0 ? band_state_bytes(d) : 0);
        rows->bands.buffer[i] = SMEAR_PLACE(d, SMEAR_PART_BAND, arena_take(a, bytes, 1), bytes);
    }
    lay_out_draws(c, a, d);
    lay_out_store(c, a, d);
}

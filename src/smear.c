/* SPDX-License-Identifier: MIT */
/* smear.c - the public functions: check, fill in defaults, cut memory, keep poses, call frame.c. */
#include "context.h"

#include "geometry/arc.h"
#include "base/arena.h"
#include "display/pixel_format.h"
#include "layers/layer_gather.h"
#include "layers/streak.h"
#include "base/fixmath.h"

/* ------------------------------------------------------------------ desc */

static bool is_power_of_two(uint32_t x)
{
    return x != 0 && (x & (x - 1)) == 0;
}

/* What was compiled in (smear_config.h). */
static bool has_method(int method)
{
    return method == SMEAR_ACCUMULATE         ? SMEAR_WITH_ACCUMULATE
         : method == SMEAR_RECONSTRUCT        ? SMEAR_WITH_RECONSTRUCT
         : method == SMEAR_TIMEMASK           ? SMEAR_WITH_TIMEMASK
         : smear_method_is_temporal(method)      ? SMEAR_WITH_SUBFRAMES
         : method_has_layers((uint8_t)method) ? SMEAR_WITH_LAYERS
         : smear_method_is_filter(method)     ? SMEAR_WITH_FILTERS
                                              : true;
}

static inline bool has_window(const smear_desc *d) { return SMEAR_WITH_RECONSTRUCT && !d->sharp; }
static inline bool is_timed(const smear_desc *d) { return SMEAR_WITH_SUBFRAMES && d->timed; }
static inline bool keeps_still(const smear_desc *d) { return SMEAR_WITH_DAMAGE && d->cache_static; }
static inline bool display_keeps(const smear_desc *d) { return SMEAR_WITH_DAMAGE && d->buffer_age; }
static inline bool has_half(const smear_desc *d) { return SMEAR_WITH_FILTERS && d->half; }
static inline bool is_layered(const smear_desc *d) { return SMEAR_WITH_LAYERS && d->layers; }

/* Rows are drawn a tile at a time; else a band at a time. */
static inline bool has_tiles(const smear_desc *d) { return has_window(d) || is_timed(d) || is_layered(d); }
/* Pixel rows that are drawn together. */
static inline int32_t row_px(const smear_desc *d) { return has_tiles(d) ? d->tile : d->band_rows; }

/* Fills in defaults; false when something is out of range. */
static bool resolve(smear_desc *d)
{
    if ((d->timed && !SMEAR_WITH_SUBFRAMES) || (d->accumulate && !SMEAR_WITH_ACCUMULATE) || d->accumulate > 2
        || (d->inspect != NULL && !SMEAR_WITH_INSPECT) || (d->layers && !SMEAR_WITH_LAYERS)
        || ((d->passes > 1 || d->half || d->scatter) && !SMEAR_WITH_FILTERS))
        return false;
    /* Asked for, not as it turns out: the picture depends on the tile. */
    const bool has_reach = !is_timed(d) || !d->sharp;
    if (!SMEAR_WITH_RECONSTRUCT)
        d->sharp = 1;
    if (d->width < 1 || d->width > 2048 || d->height < 1 || d->height > 2048)
        return false;
    if (d->scatter > 1 || (d->scatter && (d->sharp || d->timed || d->half || d->passes > 1)))
        return false;
    if (d->reach == 0)
        d->reach = (int16_t)clamp_i32(d->height * 5 / 100, 1, 64);
    if (d->reach < 1 || d->reach > 64)
        return false;
    if (d->tile == 0)
        d->tile = (int16_t)(!has_reach ? 32
                          : d->reach <= 8 ? 8 : d->reach <= 16 ? 16 : d->reach <= 32 ? 32 : 64);
    if (!is_power_of_two((uint32_t)d->tile) || d->tile < 4 || d->tile > 64
        || (d->tile < d->reach && !d->scatter))
        return false;
    if (d->tile == 4 && (d->scatter || d->half || is_timed(d) || is_layered(d)))
        return false;
    if (d->band_rows == 0)
        d->band_rows = d->tile;
    if (d->band_rows < 2 || (d->format == SMEAR_L1_PAGES && d->band_rows % 8 != 0))
        return false;
    /* Tiles may be finished in strips, by filters that read the window alone. */
    if (has_tiles(d) && d->band_rows != d->tile
        && (d->tile % d->band_rows != 0 || is_timed(d) || is_layered(d) || d->half))
        return false;
    if (SMEAR_WITH_SUBFRAMES && (d->cache_static || d->buffer_age)
        && (!SMEAR_WITH_DAMAGE || !d->timed || d->cache_static > 1 || d->buffer_age > 7))
        return false;
    if (d->bands == 0)
        d->bands = 1;
    if (d->workers == 0)
        d->workers = 1;
    if (d->strip == 0 || !is_timed(d))
        d->strip = (int16_t)max_i32(d->tile, is_timed(d) ? SMEAR_STRIP : 0);
    if (d->strip % d->tile != 0 || d->strip > STRIP_TILES_MAX * d->tile)
        return false;
    d->strip = (int16_t)min_i32(d->strip, (d->width + d->tile - 1) / d->tile * d->tile);
    if (d->max_draws == 0)
        d->max_draws = 16;
    if (d->max_triangles == 0)
        d->max_triangles = 1024;
    if (d->passes == 0)
        d->passes = 1;
    if (d->vertex_cache == 0)
        d->vertex_cache = 64;
    if (d->passes > PINGPONG_PASSES_MAX || d->half > 1 || ((d->passes > 1 || d->half) && !has_window(d)))
        return false;
    return d->bands <= 2 && d->workers <= SMEAR_WORKERS_MAX && smear_format_has(d->format, d->dither)
        && d->max_triangles <= 16u << 20
        && is_power_of_two(d->vertex_cache) && d->vertex_cache >= 16 && d->vertex_cache <= 4096;
}

/* At least a few triangles with every attribute can be kept at any capacity. */
static uint32_t pool_words(const smear_desc *d)
{
    const uint32_t least = 64;
    return max_u32(d->max_triangles * ((is_timed(d) ? SMEAR_TIMED_TRIANGLE_BYTES : SMEAR_TRIANGLE_BYTES) / 4),
                   least);
}

SMEAR_STATIC_ASSERT(sizeof(struct smear_context) <= SMEAR_CONTEXT_BYTES, "SMEAR_CONTEXT_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_filtering) <= SMEAR_FILTERING_BYTES, "SMEAR_FILTERING_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_submitted) + sizeof(struct smear_kept_pose)
               + sizeof(struct smear_raster_draw) <= SMEAR_DRAW_BYTES, "SMEAR_DRAW_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_damage) <= SMEAR_DAMAGE_BYTES, "SMEAR_DAMAGE_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_group) + 7 <= SMEAR_LAYER_DRAW_BYTES, "SMEAR_LAYER_DRAW_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_layer_setting) <= 272, "SMEAR_LAYERS_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_layer_cell) == 6, "SMEAR_LAYERS_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_layers) <= 256, "SMEAR_LAYERS_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_cached_vertex) <= SMEAR_CACHE_BYTES, "SMEAR_CACHE_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_segment) <= SMEAR_SEGMENT_BYTES, "SMEAR_SEGMENT_BYTES");
SMEAR_STATIC_ASSERT(sizeof(struct smear_triangle) == 16, "pool words per triangle");

/* A window of half the size of `full`. */
static void layout_half(struct smear_window *w, struct smear_arena *a, const struct smear_window *full)
{
    *w = (struct smear_window){ .width = (full->width + 1) / 2, .height = (full->height + 1) / 2,
                                .tile = full->tile / 2, .tile_shift = full->tile_shift - 1,
                                .reach = (full->reach + 1) / 2, .columns = full->columns,
                                .rows = full->rows, .lag = 1 };
    w->ring = 2 * w->tile + w->reach;
    size_t plane = (size_t)w->width * (size_t)w->ring, columns = (size_t)w->columns;
    w->color = arena_take(a, plane, 4);
    w->depth = arena_take(a, plane, 2);
    if (w->reach <= 15)
        w->velocity8 = arena_take(a, plane, 2);
    else
        w->velocity16 = arena_take(a, plane, 4);
    w->motion = arena_take(a, 3 * columns, sizeof *w->motion);
    w->around = arena_take(a, 3 * columns, sizeof *w->around);
}

/* Measures or cuts all that a context needs; `c` receives the pieces. d is resolved. */
static void layout(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_window *w = &c->window, spare;
    *w = (struct smear_window){ .width = d->width, .height = d->height, .tile = d->tile,
                                .reach = d->reach };
    for (w->tile_shift = 2; 1 << w->tile_shift < d->tile;)
        w->tile_shift++;
    w->columns = (d->width + d->tile - 1) / d->tile;
    w->rows = (d->height + row_px(d) - 1) / row_px(d);
    w->lag = (d->reach + d->tile - 1) / d->tile;
    w->ring = has_window(d) ? (w->lag + 1) * d->tile + d->reach : min_i32(row_px(d), d->height);
    if (keeps_still(d))
        w->ring = max_i32(w->ring, d->height);
    size_t plane = (size_t)w->width * (size_t)w->ring, columns = (size_t)w->columns;
    size_t reduced = columns * (size_t)(2 * w->lag + 1);
    w->color = arena_take(a, plane, 4);
    w->depth = arena_take(a, plane, 2);
    w->moving = arena_take(a, columns, 1);
    w->velocity8 = NULL;
    w->velocity16 = NULL;
    if (has_window(d)) {
        if (d->reach <= 15)
            w->velocity8 = arena_take(a, plane, 2);
        else
            w->velocity16 = arena_take(a, plane, 4);
        w->motion = arena_take(a, reduced, sizeof *w->motion);
        w->around = arena_take(a, reduced, sizeof *w->around);
        c->row_offset = arena_take(a, (size_t)(d->tile + 2 * d->reach), sizeof *c->row_offset);
    }
    c->filtering = has_window(d) ? arena_take(a, 1, sizeof *c->filtering) : NULL;
    for (int i = 0; SMEAR_WITH_FILTERS && i + 1 < d->passes; i++) {
        uint32_t *pass = arena_take(a, plane, 4);
        if (c->filtering != NULL)
            c->filtering->pass_plane[i] = pass;
    }
    c->half = NULL;
    if (has_half(d)) {
        c->half = arena_take(a, 1, sizeof *c->half);
        layout_half(c->half != NULL ? c->half : &spare, a, w);
        c->half_scratch = arena_take(a, (size_t)d->workers * (size_t)(d->tile / 2) * (size_t)(d->tile / 2),
                                     4);
    }
    c->strip = d->strip;
    if (has_window(d) || is_timed(d))
        c->scratch = arena_take(a, (size_t)d->workers * (size_t)d->band_rows
                                       * (size_t)(is_timed(d) ? strip_columns(c) : c->strip), 4);
    if (is_timed(d)) {
        c->assembler.path_limit = d->max_triangles;
        c->row_moving.moving = arena_take(a, d->max_triangles, sizeof *c->row_moving.moving);
        c->row_moving.load = arena_take(a, columns, sizeof *c->row_moving.load);
        c->work_bytes = (uint32_t)smear_subframes_work(strip_columns(c), d->tile);
        if (SMEAR_WITH_TIMEMASK)
            c->work_bytes = max_u32(c->work_bytes, (uint32_t)smear_timemask_work(d->tile));
        c->work_bytes = (c->work_bytes + 7u) & ~7u;
        c->work = arena_take(a, d->workers, c->work_bytes);
    }
    if (keeps_still(d) || display_keeps(d)) {
        const bool tiles = display_keeps(d);
        struct smear_tile_box *seen = tiles ? arena_take(a, d->max_draws, sizeof *seen) : NULL;
        struct smear_damaged_tiles due = { tiles ? arena_take(a, columns * (size_t)w->rows, 1) : NULL,
                                 (uint8_t)(columns - 1), (uint8_t)w->tile_shift, false, NULL };
        c->still = arena_take(a, 1, sizeof *c->still);
        if (c->still != NULL)       /* not only measured */
            *c->still = (struct smear_damage){ .keeps = keeps_still(d), .due = due, .seen = seen };
    }
    if (is_layered(d)) {
        struct smear_layers measured, *l = arena_take(a, 1, sizeof *l);
        if (l == NULL)          /* only measured */
            l = &measured;
        else
            c->layers = l;
        *l = (struct smear_layers){ 0 };
        struct smear_layer_rows *r = &l->rows;
        int32_t margin = (d->reach + 3) & ~3;       /* nodes of streaks lie 4 px apart,
                                                     * from the frame's side on */
        *r = (struct smear_layer_rows){ .margin = margin, .width = d->width + 2 * margin,
                                        .height = d->height + 2 * d->tile, .rows = d->tile + 2 * d->reach };
        size_t layer = (size_t)r->width * (size_t)r->rows;
        r->color = arena_take(a, layer, 4);
        r->depth = arena_take(a, layer, 2);
        if (d->reach <= 15)
            r->velocity8 = arena_take(a, layer, 2);
        else
            r->velocity16 = arena_take(a, layer, 4);
        size_t cells = (size_t)(r->width >> w->tile_shift) + 1u;
        r->moving = arena_take(a, cells, 1);
        r->cell = arena_take(a, 2 * cells, sizeof *r->cell);
        r->over = arena_take(a, (size_t)d->width * (size_t)d->tile, 4);
        r->over_depth = arena_take(a, (size_t)d->width * (size_t)d->tile, 2);
        r->row_first = arena_take(a, (size_t)r->rows, sizeof *r->row_first);
        r->row_end = arena_take(a, (size_t)r->rows, sizeof *r->row_end);
        r->edge = arena_take(a, (size_t)max_i32(r->width, r->rows) + 2u, sizeof *r->edge);
        r->work_bytes = (uint32_t)smear_streak_work(d->tile);
        r->work = arena_take(a, d->workers, r->work_bytes);
        l->group_of = arena_take(a, d->max_draws, sizeof *l->group_of);
        l->group = arena_take(a, d->max_draws, sizeof *l->group);
        l->order = arena_take(a, d->max_draws, sizeof *l->order);
        l->sequence = arena_take(a, d->max_draws, sizeof *l->sequence);
        l->layer_of = arena_take(a, d->max_draws, sizeof *l->layer_of);
        l->setting = arena_take(a, SMEAR_LAYERS_MAX, sizeof *l->setting);
    }
    c->inspect = SMEAR_WITH_INSPECT && d->inspect != NULL && has_window(d) ? arena_take(a, plane, 8) : NULL;
    c->sums = NULL;
    if (SMEAR_WITH_ACCUMULATE && d->accumulate)
        c->sums = arena_take(a, (size_t)d->width * (size_t)(d->accumulate == 1 ? d->height : row_px(d)),
                             3 * sizeof *c->sums);

    c->band_bytes = smear_format_size(d->width, d->band_rows, (smear_format)d->format);
    for (int i = 0; i < d->bands; i++)
        c->band[i] = arena_take(a, c->band_bytes, 1);

    c->submitted = arena_take(a, d->max_draws, sizeof *c->submitted);
    c->kept = SMEAR_WITH_IDS ? arena_take(a, d->max_draws, sizeof *c->kept) : NULL;
    c->raster_draw = arena_take(a, d->max_draws, sizeof *c->raster_draw);

    struct smear_bins *g = &c->bins;
    g->row_px = row_px(d);
    g->row_count = w->rows;
    g->pool_words = pool_words(d);
    g->pool = arena_take(a, g->pool_words, 4);
    g->segment_limit = min_u32(d->max_draws + 2u + g->pool_words / 50000u, 65536u);    /* 16-bit numbers */
    g->segment = arena_take(a, g->segment_limit, sizeof *g->segment);
    g->opaque_last = arena_take(a, (size_t)w->rows, sizeof *g->opaque_last);
    g->blend_last = arena_take(a, (size_t)w->rows, sizeof *g->blend_last);
    g->moving_rows = is_layered(d) ? 2 : 0;
    g->moving_last = is_timed(d) || is_layered(d)
                  ? arena_take(a, (size_t)(w->rows + g->moving_rows), sizeof *g->moving_last) : NULL;
    c->assembler.cache = arena_take(a, d->vertex_cache, sizeof *c->assembler.cache);
    c->assembler.cache_mask = d->vertex_cache - 1u;
}

#if SMEAR_WITH_BOUNDS
void smear_mesh_find_bounds(smear_mesh *mesh)
{
    int16_t *b = mesh->bounds;
    for (int k = 0; k < 3; k++)
        b[k] = b[k + 3] = mesh->vertex_count != 0 ? mesh->position[k] : 0;
    for (uint32_t i = 3; i < mesh->vertex_count * 3u; i += 3)
        for (uint32_t k = 0; k < 3; k++) {
            const int16_t p = mesh->position[i + k];
            b[k] = p < b[k] ? p : b[k];
            b[k + 3] = p > b[k + 3] ? p : b[k + 3];
        }
}
#else
void smear_mesh_find_bounds(smear_mesh *mesh)
{
    (void)mesh;
}
#endif

size_t smear_memory_size(const smear_desc *desc)
{
    if (desc == NULL)
        return 0;
    smear_desc d = *desc;
    if (!resolve(&d))
        return 0;
    struct smear_context measured;
    struct smear_arena a = { NULL, 0 };
    arena_take(&a, 1, sizeof measured);
    layout(&measured, &a, &d);
    return a.used;
}

int smear_init(smear_context **ctx, const smear_desc *desc, void *memory, size_t bytes)
{
    if (ctx == NULL || desc == NULL || desc->flush == NULL)
        return SMEAR_ERR_ARG;
    *ctx = NULL;
    smear_desc d = *desc;
    if (!resolve(&d))
        return SMEAR_ERR_ARG;
    if (memory == NULL || ((uintptr_t)memory & 7u) != 0 || bytes < smear_memory_size(desc))
        return SMEAR_ERR_MEMORY;

    struct smear_arena a = { (uint8_t *)memory, 0 };
    struct smear_context *c = arena_take(&a, 1, sizeof *c);
    __builtin_memset(c, 0, sizeof *c);
    layout(c, &a, &d);
    c->desc = d;
    c->stats.arena_bytes = (uint32_t)a.used;
    c->assembler.viewport = (struct smear_viewport){ d.width, d.height };
    c->assembler.bins = &c->bins;
    c->raster.bins = &c->bins;
    c->raster.draw = c->raster_draw;
    c->raster.width = d.width;
    c->raster.height = d.height;
    c->jobs.workers = d.workers;
    c->jobs.idle = d.idle;
    c->jobs.user = d.user;
    for (uint32_t i = 0; SMEAR_WITH_IDS && i < d.max_draws; i++)
        c->kept[i].id = 0;
    *ctx = c;
    return SMEAR_OK;
}

/* ------------------------------------------------------------------ frame */

static bool is_camera(const smear_camera *c)
{
    for (int i = 0; i < 9; i++)
        if (c->pose.basis[i] > 2 * SMEAR_BASIS_ONE || c->pose.basis[i] < -2 * SMEAR_BASIS_ONE)
            return false;
    if (c->near_plane <= 0 || (c->far_plane != 0 && c->far_plane <= c->near_plane))
        return false;
    return SMEAR_WITH_ORTHOGRAPHIC && c->half_height > 0 ? c->far_plane != 0
                                                         : c->half_height == 0 && c->focal > 0;
}

/* a / b in q24, at most 100 of them. */
static int32_t ratio_q24(uint32_t a, uint32_t b)
{
    int zeros = count_leading_zeros(b);
    uint64_t ratio = (uint64_t)a * recip_norm_precise(b << zeros) >> (37 - zeros);
    return (int32_t)(ratio < (uint64_t)100 << 24 ? ratio : (uint64_t)100 << 24);
}

/* Half the exposure in frames, q24; brings frame->shutter_degrees up to date. */
static int32_t half_exposure(smear_frame *f)
{
    const int32_t whole = 1 << 24, longest = 10 << 24;
    int32_t exposure;
    if (SMEAR_WITH_SHUTTER_MODES && f->shutter_us != 0) {
        exposure = ratio_q24(f->shutter_us, f->frame_us);
        if (f->shutter_mode == SMEAR_SHUTTER_CAPPED)
            exposure = min_i32(exposure, whole);
    } else {
        /* Frames in which the shutter is to be as it is in one at the rate of reference. */
        int32_t frames = whole;
        if (SMEAR_WITH_SHUTTER_MODES && f->shutter_mode != SMEAR_SHUTTER_NATIVE)
            frames = ratio_q24(1000000, f->reference_hz * f->frame_us);
        if (SMEAR_WITH_SHUTTER_MODES && f->shutter_mode == SMEAR_SHUTTER_CAPPED)
            frames = min_i32(frames, whole);
        if (!SMEAR_WITH_SHUTTER_MODES || frames == whole)
            return (int32_t)(((uint32_t)f->shutter_degrees << 20) / 45u);
        /* 2^32 / 360 = 11930465 */
        uint64_t degrees = (uint64_t)f->shutter_degrees * (uint32_t)frames;
        degrees = (degrees >> 8) * 11930465u >> 24;
        exposure = (int32_t)(degrees < (uint64_t)longest ? degrees : (uint64_t)longest);
    }
    exposure = clamp_i32(exposure, 2, longest);
    f->shutter_degrees = (uint16_t)clamp_i32((int32_t)((int64_t)exposure * 360 >> 24), 1, 3600);
    return exposure / 2;
}

/* A scale of motion as it is used. False when out of range, or left out. */
static bool resolve_scale(uint16_t *scale)
{
    if (*scale == 0)
        *scale = 256;
    else if (*scale == SMEAR_SCALE_NONE)
        *scale = 0;
    return SMEAR_WITH_SCALES ? *scale <= 16128 : *scale == 256;
}

/* Brings a camera's pose nearer to that of now, or farther: its turn and its way each by their scale. */
static void scale_camera(smear_camera *other, const smear_camera *now, const smear_frame *f)
{
    smear_transform turned;
    if (f->turn_scale != 256) {
        smear_arc_between(&turned, &other->pose, &now->pose, -(int32_t)f->turn_scale * (1 << 16));
        for (int i = 0; i < 9; i++)
            other->pose.basis[i] = f->turn_scale == 0 ? now->pose.basis[i] : turned.basis[i];
        int64_t focal = now->focal + (((int64_t)other->focal - now->focal) * f->turn_scale >> 8);
        int64_t half = now->half_height
                     + (((int64_t)other->half_height - now->half_height) * f->turn_scale >> 8);
        other->focal = now->focal > 0 ? max_i32(narrow_sat(focal), 1) : 0;
        other->half_height = now->half_height > 0 ? max_i32(narrow_sat(half), 1) : 0;
    }
    for (int i = 0; i < 3 && f->way_scale != 256; i++)
        other->pose.origin[i] = narrow_sat(now->pose.origin[i]
                                           + (((int64_t)other->pose.origin[i] - now->pose.origin[i])
                                              * f->way_scale >> 8));
}

static bool is_one_bit(uint8_t format)
{
    return format == SMEAR_L1 || format == SMEAR_L1_PAGES;
}

/* Defaults of a frame; false when something is out of range. */
static bool resolve_frame(const struct smear_context *c, smear_frame *f)
{
    if (f->method == SMEAR_DEFAULT_METHOD)
        f->method = c->desc.timed                            ? SMEAR_AUTO
                  : c->desc.sharp || !SMEAR_WITH_RECONSTRUCT ? SMEAR_NONE
                                                             : SMEAR_RECONSTRUCT;
    if (f->samples == 0)
        f->samples = f->method == SMEAR_SUBFRAMES || f->method == SMEAR_TIMEMASK ? 32 : 8;
    /* Steps of so few greys hide an error of several codes. */
    if (f->target == 0)
        f->target = c->desc.format == SMEAR_L4 || is_one_bit(c->desc.format) ? SMEAR_DRAFT : SMEAR_BALANCED;
    if (f->shutter_degrees == 0)
        f->shutter_degrees = 180;
    if (SMEAR_WITH_FILTERS && f->method == SMEAR_CAMERA && f->camera_step == 0)
        f->camera_step = 1;
    if (f->method == SMEAR_RECONSTRUCT || !SMEAR_WITH_FILTERS
        || (f->method == SMEAR_HALF && f->filter == SMEAR_FILTER_DEFAULT))
        f->filter = SMEAR_FILTER_RECONSTRUCT;
    else if (f->method == SMEAR_PINGPONG)
        f->filter = SMEAR_FILTER_PINGPONG;
    else if (f->filter == SMEAR_FILTER_DEFAULT)
        f->filter = SMEAR_FILTER_MEAN;
    if (SMEAR_WITH_FILTERS
        && (f->filter > SMEAR_FILTER_PINGPONG || f->weights > SMEAR_WEIGHTS_JIMENEZ
            || (f->camera_step & (f->camera_step - 1)) != 0 || f->camera_step > 4))
        return false;
    if (f->method > SMEAR_LAYERED || !has_method(f->method) || f->exposure > SMEAR_LEADING
        || f->light > SMEAR_LIGHT_ENCODED || (f->light == SMEAR_LIGHT_LINEAR && !SMEAR_WITH_LINEAR)
        || f->samples > 1024 || f->shutter_degrees > 3600
        || (!SMEAR_WITH_LINEAR && f->method == SMEAR_SUBFRAMES && f->samples > SMEAR_PACKED_INSTANTS))
        return false;
    if (!SMEAR_WITH_FILTERS && (f->camera_step != 0 || f->weights != 0))
        return false;
    if (SMEAR_WITH_FILTERS && !smear_pingpong_resolve(&f->pingpong))
        return false;
    if (SMEAR_WITH_SHUTTER_MODES && f->reference_hz == 0)
        f->reference_hz = 30;
    if (!SMEAR_WITH_SHUTTER_MODES && (f->shutter_mode != SMEAR_SHUTTER_NATIVE || f->shutter_us != 0))
        return false;
    if (SMEAR_WITH_SHUTTER_MODES
        && (f->shutter_mode > SMEAR_SHUTTER_FIXED || f->reference_hz > 1000 || f->frame_us > 1000000
            || ((f->shutter_mode != SMEAR_SHUTTER_NATIVE || f->shutter_us != 0) && f->frame_us == 0)))
        return false;
    if (!resolve_scale(&f->turn_scale) || !resolve_scale(&f->way_scale) || !resolve_scale(&f->object_scale))
        return false;
    if (SMEAR_WITH_RECONSTRUCT && smear_method_is_filter(f->method) && c->desc.sharp)
        return false;
    if (SMEAR_WITH_FILTERS && smear_method_is_filter(f->method) && f->filter == SMEAR_FILTER_PINGPONG
        && f->pingpong.passes > c->desc.passes)
        return false;
    if (SMEAR_WITH_FILTERS && f->method == SMEAR_HALF && !c->desc.half)
        return false;
    if (SMEAR_WITH_LAYERS && method_has_layers(f->method) && !c->desc.layers)
        return false;
    if (SMEAR_WITH_SUBFRAMES && smear_method_is_temporal(f->method) && !c->desc.timed)
        return false;
    return f->method != SMEAR_ACCUMULATE || (c->desc.accumulate != 0 && f->samples <= SUM_SAMPLES_MAX);
}

static bool is_layer(const smear_layer *l)
{
    return l->mask != 0 && (l->method == 0 || l->method == SMEAR_NONE || method_has_layers(l->method))
        && l->shutter_degrees <= 3600
        && (l->camera == NULL ? l->open == NULL && l->close == NULL
                              : is_camera(l->camera) && (l->open == NULL || is_camera(l->open))
                                    && (l->close == NULL || is_camera(l->close)));
}

static bool are_layers(const smear_frame *f)
{
    if (!SMEAR_WITH_LAYERS)
        return f->layer == NULL && f->layer_count == 0;
    if ((f->layer == NULL) != (f->layer_count == 0) || f->layer_count > SMEAR_LAYERS_MAX)
        return false;
    for (int i = 0; i < f->layer_count; i++)
        if (!is_layer(&f->layer[i]))
            return false;
    return true;
}

/* Copies the frame's layers, or makes the one it has without. */
static void keep_layers(struct smear_context *c, const smear_frame *f)
{
    static const smear_layer all = { .mask = 255 };
    c->layers->setting_count = f->layer_count != 0 ? f->layer_count : 1;
    for (int i = 0; i < c->layers->setting_count; i++) {
        struct smear_layer_setting *s = &c->layers->setting[i];
        s->layer = f->layer_count != 0 ? f->layer[i] : all;
        if (s->layer.method == 0)
            s->layer.method = f->method;
        s->has_camera = s->layer.camera != NULL;
        if (s->has_camera) {
            s->camera[0] = *s->layer.camera;
            s->camera[1] = s->layer.open != NULL ? *s->layer.open : s->camera[0];
            s->camera[2] = s->layer.close != NULL ? *s->layer.close : s->camera[0];
        }
        s->layer.camera = s->layer.open = s->layer.close = NULL;
        s->shutter = s->layer.shutter_degrees != 0
                   ? (int32_t)(((uint32_t)s->layer.shutter_degrees << 16) / f->shutter_degrees) : 1 << 16;
    }
}

static bool same_kind(const smear_camera *a, const smear_camera *b)
{
    return !SMEAR_WITH_ORTHOGRAPHIC || (a->half_height > 0) == (b->half_height > 0);
}

int smear_begin(smear_context *c, const smear_frame *frame)
{
    if (c == NULL || frame == NULL || frame->camera == NULL || !is_camera(frame->camera)
        || (frame->open != NULL && !is_camera(frame->open))
        || (frame->close != NULL && !is_camera(frame->close)))
        return SMEAR_ERR_ARG;
    smear_frame f = *frame;
    if (!resolve_frame(c, &f) || !are_layers(&f)
        || (SMEAR_WITH_SUBFRAMES && !smear_shutter_make(&c->shutter, f.shutter)))
        return SMEAR_ERR_ARG;
    if (SMEAR_WITH_LAYERS && method_has_layers(f.method))
        keep_layers(c, &f);
    f.layer = NULL;
    const smear_camera *now = frame->camera, *close = frame->close != NULL ? frame->close : now, *open = now;
    c->camera_moves = true;
    if (frame->open != NULL)
        open = frame->open;
    else if (c->has_kept_camera && !f.shutter_poses)
        open = &c->kept_camera;
    else
        c->camera_moves = f.shutter_poses && frame->close != NULL;
    /* Between a perspective and an orthographic view there is no path: as after a cut. */
    if (!same_kind(open, now) || !same_kind(close, now)) {
        c->camera_moves = false;
        open = close = now;
    }
    c->camera = *now;
    c->camera_open = *open;
    c->camera_close = *close;
    if (SMEAR_WITH_SCALES) {
        scale_camera(&c->camera_open, &c->camera, &f);
        scale_camera(&c->camera_close, &c->camera, &f);
    }
    c->half_exposure = half_exposure(&f);
    c->kept_camera = *now;
    c->has_kept_camera = true;
    f.camera = f.open = f.close = NULL;
    f.shutter = NULL;
    c->frame = f;
    c->frame_number++;
    c->draw_count = 0;
    c->state = STATE_BEGUN;
    return SMEAR_OK;
}

static bool is_texture(const smear_texture *t)
{
    return SMEAR_WITH_TEXTURE && t->texels != NULL && t->width >= 1 && t->width <= 4096 && t->height >= 1
        && t->height <= 4096 && t->format <= SMEAR_TEXEL_PALETTE8
        && (t->format != SMEAR_TEXEL_PALETTE8 || t->palette != NULL) && t->wrap_u <= SMEAR_MIRROR
        && t->wrap_v <= SMEAR_MIRROR;
}

static bool is_mesh(const smear_mesh *m)
{
    if (m == NULL || m->position == NULL || (m->index == NULL && m->triangle_count != 0))
        return false;
    if (m->shift < -32 || m->shift > 62 || m->uv_shift > 15 || m->scale < 0)
        return false;
    for (int i = 0; i < 3; i++)
        if (m->offset[i] > 1 << 20 || m->offset[i] < -(1 << 20))
            return false;
    return true;
}

/* The kept pose of an id: its own, else a free one, else one not seen in the last frame; or -1. */
static int32_t find_kept(struct smear_context *c, uint32_t id)
{
    int32_t spare = -1;
    uint32_t n = c->desc.max_draws, at = id % n;
    for (uint32_t i = 0; i < n; i++, at = at + 1 == n ? 0 : at + 1) {
        struct smear_kept_pose *k = &c->kept[at];
        if (k->id == id)
            return (int32_t)at;
        if (k->id == 0)
            return spare >= 0 ? spare : (int32_t)at;
        if (spare < 0 && c->frame_number - k->frame > 1u)
            spare = (int32_t)at;
    }
    return spare;
}

static int32_t keep_pose(struct smear_context *c, const smear_draw *draw)
{
    if (!SMEAR_WITH_IDS || draw->id == 0)
        return -1;
    int32_t at = find_kept(c, draw->id);
    if (at < 0)
        return -1;
    struct smear_kept_pose *k = &c->kept[at];
    bool known = k->id == draw->id && k->frame + 1u == c->frame_number;
    k->has_before = known;
    if (known)
        k->before = k->now;
    k->now = draw->now != NULL ? *draw->now : smear_identity;
    k->id = draw->id;
    k->frame = c->frame_number;
    return at;
}

int smear_submit(smear_context *c, const smear_draw *draw)
{
    if (c == NULL || draw == NULL || !is_mesh(draw->mesh) || draw->motion > SMEAR_MOTION_NONE
        || draw->billboard > (SMEAR_WITH_BILLBOARDS ? SMEAR_BILLBOARD_UPRIGHT : SMEAR_BILLBOARD_NONE))
        return SMEAR_ERR_ARG;
    const smear_material *m = draw->material;
    if ((!SMEAR_WITH_IDS && draw->id != 0)
        || (!SMEAR_WITH_GOURAUD && (draw->mesh->normal != NULL || draw->mesh->color != NULL))
        || (!SMEAR_WITH_DEFORM && (draw->open_position != NULL || draw->close_position != NULL)))
        return SMEAR_ERR_ARG;
    if (m != NULL
        && (m->alpha > (SMEAR_WITH_ALPHA ? SMEAR_BLEND : SMEAR_OPAQUE)
            || (m->texture != NULL && !is_texture(m->texture)) || (m->bilinear && !SMEAR_WITH_BILINEAR)))
        return SMEAR_ERR_ARG;
    if (c->state != STATE_BEGUN)
        return SMEAR_ERR_ORDER;
    if (c->draw_count == c->desc.max_draws)
        return SMEAR_ERR_FULL;
    struct smear_submitted *s = &c->submitted[c->draw_count++];
    s->draw = *draw;
    s->kept = keep_pose(c, draw);
    return SMEAR_OK;
}

int smear_render(smear_context *c)
{
    if (c == NULL)
        return SMEAR_ERR_ARG;
    if (c->state != STATE_BEGUN)
        return SMEAR_ERR_ORDER;
    c->state = STATE_IDLE;
    return smear_frame_render(c);
}

void smear_band_done(smear_context *c)
{
    /* Only this function writes the word, so a plain increment is enough. */
    unsigned sent = word_own(&c->bands_sent);
    word_write(&c->bands_sent, sent + 1u);
}

void smear_work(smear_context *c, int worker)
{
    if (SMEAR_WITH_WORKERS && c != NULL && worker > 0 && worker < c->jobs.workers)
        smear_jobs_work(&c->jobs, worker);
}

void smear_get_stats(const smear_context *c, smear_stats *stats)
{
    *stats = c->stats;
}

/* ------------------------------------------------------------------ the filter alone */

int smear_filter_begin(smear_context *c, const smear_frame *frame)
{
    if (!SMEAR_WITH_FILTER_ALONE || c == NULL || frame == NULL || frame->camera == NULL
        || frame->camera->near_plane <= 0)
        return SMEAR_ERR_ARG;
    smear_frame f = *frame;
    if (!resolve_frame(c, &f) || !smear_method_is_filter(f.method) || f.method == SMEAR_CAMERA
        || c->desc.workers > 1)
        return SMEAR_ERR_ARG;
    f.camera = f.open = f.close = NULL;
    f.shutter_poses = 0;
    c->camera = *frame->camera;
    c->camera.half_height = 0;
    c->half_exposure = half_exposure(&f);
    c->frame = f;
    c->state = STATE_FILTER;
    smear_frame_filter_begin(c);
    return SMEAR_OK;
}

int smear_filter_row(smear_context *c, const uint32_t *color, const uint32_t *depth,
                     const int16_t *velocity)
{
    if (!SMEAR_WITH_FILTER_ALONE || c == NULL || color == NULL || depth == NULL || velocity == NULL)
        return SMEAR_ERR_ARG;
    if (c->state != STATE_FILTER)
        return SMEAR_ERR_ORDER;
    int result = smear_frame_filter_row(c, color, depth, velocity);
    if (result != SMEAR_OK || c->filter_row == c->window.height)
        c->state = STATE_IDLE;
    return result;
}

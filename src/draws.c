/* SPDX-License-Identifier: MIT */
/* draws.c - see draws.h. */
#include "draws.h"

#include "base/compiled.h"
#include "geometry/assemble.h"
#include "geometry/ranges.h"

/* Several cores assemble draws: not where size counts, or the assembler's state lies on the stack. */
#define SMEAR_ASSEMBLY_JOBS (SMEAR_WITH_WORKERS && !SMEAR_FAST_STACK && !SMEAR_SMALL_CODE)

/* ------------------------------------------------------------------ an assembly */

/* Velocity is measured from the open pose to the close pose, or to now: one further pose is enough where that is drawn. */
static void add_motion(struct smear_assembly *a, const struct smear_context *c, struct smear_draw_poses *p,
                       const struct smear_instant *instant)
{
    const struct smear_shutter_order at = smear_shot_order(&c->shot);
    const bool spans = shot_spans_exposure(&c->shot);
    smear_draw_poses_add(a, p, &c->shot, spans ? at.open : 1);
    if (spans || instant->weight[0] != 1 << 24)
        smear_draw_poses_add(a, p, &c->shot, spans ? at.close : 0);
}

/* Finds where a draw is, as struct smear_assembly says. */
static void place_fine(struct smear_placement *place, const struct smear_assembly *a, int key, int coarse)
{
    const struct smear_context *c = (const struct smear_context *)a->place_of;
    const struct smear_instant *at = (const struct smear_instant *)a->instant;
    struct smear_instant end;
    struct smear_draw_poses poses;
    if (assembly_has_path(a) && key != 2) {
        end = smear_instant_at(&c->shot, key == 0 ? -65536 : 65536);
        at = &end;
    }
    poses_of(&poses, c, a->draw);
    poses.coarse = coarse;
    smear_draw_poses_place(place, &poses, &c->shot, a->mesh, at);
}

/* Returns the instant of a draw in the picture that is assembled. */
static inline const struct smear_instant *line_instant(const struct smear_context *c, uint32_t draw)
{
    const struct smear_lines *lines = c->temporal.lines;
    return !draw_is_mover(c, draw) ? &lines->instant[lines->picture]
                                   : &lines->mover_instant[lines->picture == LINE_BEHIND ? 0 : lines->picture];
}

/* Whether the picture that is assembled is none of those that a draw is in. */
static inline bool draw_is_elsewhere(const struct smear_context *c, uint32_t draw)
{
    const struct smear_lines *lines = c->temporal.lines;
    if (!frame_has_lines(c))
        return false;
    return lines->picture == LINE_BEHIND ? !line_is_behind(lines, draw)
                                         : line_is_mover(lines, draw) && lines->picture >= line_mover_pictures(lines);
}

/* Finds where a draw is, at an instant and, with `has_path`, along its path. */
static void place(struct smear_assembly *a, const struct smear_context *c, struct smear_draw_poses *p, bool moves, bool has_path,
                  const struct smear_instant *instant)
{
    if (frame_has_lines(c) && !has_path)
        instant = line_instant(c, a->draw);
    a->place_fine = place_fine;
    a->place_of = c;
    a->instant = moves ? instant : &smear_instant_now;
    smear_draw_poses_place(&a->at, p, &c->shot, a->mesh, moves ? instant : &smear_instant_now);
    if (!has_path)
        return;
    const struct smear_instant open = smear_instant_at(&c->shot, -65536), close = smear_instant_at(&c->shot, 65536);
    a->path = true;
    smear_draw_poses_place(&a->motion.key[0], p, &c->shot, a->mesh, &open);
    smear_draw_poses_place(&a->motion.key[1], p, &c->shot, a->mesh, &close);
}

SMEAR_RARE bool smear_draws_assemble_one(const struct smear_context *c, struct smear_assembler *as, struct smear_assembly *a)
{
    struct smear_bins *g = as->bins;
    uint32_t *const opaque = g->opaque_last;
    if (assembly_has_path(a))
        return smear_assemble_path(as, a);
    if (draw_is_mover(c, a->draw))
        g->opaque_last = bins_more(g, c->temporal.lines->picture == LINE_BEHIND ? line_list(LINE_BEHIND)
                                                                                : line_movers_list(c->temporal.lines->picture));
    const bool done = smear_assemble(as, a);
    g->opaque_last = opaque;
    return done;
}

static bool turns_inside_out(const struct smear_draw_poses *p, bool mirrored)
{
    for (int i = 1; SMEAR_BLURS && i < 3; i++)
        if (p->object[i] != p->object[0] && smear_transform_is_mirrored(p->object[i]) != mirrored)
            return true;
    return false;
}

SMEAR_NOINLINE bool smear_draws_make_assembly(const struct smear_context *c, uint32_t i, const struct smear_instant *instant,
                                              struct smear_assembly *a)
{
    static const smear_material white = { 0 };
    const smear_draw *draw = &c->submitted[i].draw;
    struct smear_draw_poses poses;
    poses_of(&poses, c, i);
    a->mesh = draw->mesh;
    a->first = 0;
    a->end = draw->mesh->triangle_count;
    a->material = draw->material != NULL ? draw->material : &white;
    a->draw = (uint16_t)i;
    a->mirrored = smear_transform_is_mirrored(poses.object[0]);
    a->backs = a->material->double_sided || turns_inside_out(&poses, a->mirrored);
    a->moves = 0;
    a->uv_up = c->raster_draw[i].sampler.uv_up;
    a->path = a->has_rest = false;
    /* Fog, of which a tiny triangle has one part however the frame is cut, and velocities that are not those of the depth. */
    a->fixed = frame_has_fog(&c->rows.raster) || draw_is_fixed(&c->raster_draw[i]) || draw_is_mover(c, i);
    const bool moves = poses_differ(&poses);
    place(a, c, &poses, moves, assembler_keeps_paths(&c->assembler) && (frame_has_lines(c) ? c->raster_draw[i].moves : moves), instant);
    /* Layers reach beyond the frame. */
    if (!frame_has_layers(c) && assembly_is_beside(a, &c->assembler.viewport))
        return false;
    smear_shading_make(&a->shading, poses.object[0], a->material, SMEAR_VERTEX_COLORS_MOST && a->mesh->normal != NULL,
                       frame_transfer(&c->rows.raster), &c->sun);
    if (SMEAR_WITH_LIGHTS && c->sun.lights != NULL && c->lights.by->draw(&a->lights, &c->lights, a, poses.object[0]))
        a->shading.lit = 2;
    assembly_remember_light(a);
    assembly_find_flat(a);
    if (moves && assembler_keeps_motion(&c->assembler) && c->raster_draw[i].moves)
        add_motion(a, c, &poses, instant);
    return true;
}

/* What moves by less than a step of its vertices is drawn among what is static, and in order with it. */
static bool static_is_disturbed(const struct smear_context *c)
{
    return static_is_cached(c->damage) && c->assembler.path_static_count != 0;
}

/* ------------------------------------------------------------------ assembling */

/* The kind of draw that a fill takes. */
static uint8_t fill_kind(const struct smear_context *c, uint32_t i)
{
    if (draw_is_grouped(c, i))
        return FILL_GROUP;
    if (c->raster_draw[i].alpha >= SMEAR_BLEND)
        return FILL_BLENDED;
    return c->raster_draw[i].moves || draw_is_mover(c, i) ? FILL_MOVING : FILL_STATIC;
}

/* Whether draw `i`, number `k` in the order, is among those that a fill still lacks. */
static bool fill_lacks(const struct smear_context *c, const struct smear_refill *f, uint32_t k, uint32_t i)
{
    const uint8_t kind = fill_kind(c, i);
    return k >= f->draw && (f->kinds & kind) != 0 && (kind != FILL_GROUP || c->group_of[i] == f->group);
}

static bool assemble_draw(struct smear_context *c, struct smear_assembler *as, uint32_t i,
                          const struct smear_instant *instant)
{
    struct smear_assembly a;
    if (frame_has_layers(c))
        instant = smear_layers_instant(c, i, instant);
    if (!smear_draws_make_assembly(c, i, instant, &a)) {
        c->stats.draws_beside++;
        return true;
    }
    if (draw_is_grouped(c, i))
        return smear_layers_assemble(c, &a);
    return smear_draws_assemble_one(c, as, &a);
}

/* Whether a draw of the kind must be drawn. */
static inline bool is_wanted(struct smear_context *c, uint32_t i, enum draws kind, bool known, struct smear_tile_box **seen)
{
    return !SMEAR_WITH_DAMAGE || kind == DRAWS_ALL || frame_has_lines(c) || smear_draws_is_damaged(c, i, known, seen);
}

/* Whether a draw may be seen in what is filled. */
static bool draw_reaches(const struct smear_context *c, const struct smear_assembler *as, uint32_t i)
{
    uint32_t first = 0;
    const uint32_t count = c->submitted[i].draw.mesh->triangle_count;
    (void)ranges_next(as, ranges_filled(as, fill_kind(c, i) == FILL_MOVING), &first, count);
    return first < count;
}

/* Assembles draws into what `as` names. False when the store is full: of a fill, the rest is noted. */
static bool assemble_kind(struct smear_context *c, struct smear_assembler *as, const struct smear_instant *instant,
                          struct smear_refill *f, enum draws kind)
{
    struct smear_tile_box *seen = NULL;
    const struct smear_tile_box *ranges = ranges_all(as->bins);
    for (uint32_t k = 0; k < c->draw_count; k++) {
        const uint32_t i = frame_has_layers(c) ? c->sequence[k] : k;
        as->ranges = ranges;
        if (ranges != NULL)
            ranges += ranges_of(as->bins, c->submitted[i].draw.mesh->triangle_count);
        if (!draw_is_of_kind(c, i, kind) || !is_wanted(c, i, kind, f == NULL, &seen) || (f != NULL && !fill_lacks(c, f, k, i))
            || (ranges != NULL && !draw_reaches(c, as, i)) || draw_is_elsewhere(c, i))
            continue;
        if (f != NULL && k == f->draw)
            as->resume = (struct smear_resume){ f->triangle, f->parts };
        if (assemble_draw(c, as, i, instant))
            continue;
        if (f != NULL) {
            f->draw = k;
            f->triangle = as->resume.triangle;
            f->parts = as->resume.parts;
        }
        return false;
    }
    return true;
}

/* Assembles all draws, and those that are static again for each further picture. */
static bool assemble_pictures(struct smear_context *c, struct smear_assembler *as, const struct smear_instant *instant)
{
    struct smear_bins *g = as->bins;
    struct smear_lines *const lines = c->temporal.lines;
    uint32_t *const first = g->opaque_last;
    bool done = assemble_kind(c, as, instant, NULL, DRAWS_ALL);
    const uint32_t drawn = as->triangles_drawn, dropped = as->triangles_dropped, beside = c->stats.draws_beside;
    for (int k = 1; done && k < lines->pictures; k++) {
        lines->picture = (uint8_t)k;
        g->opaque_last = bins_more(g, line_list(k));
        done = assemble_kind(c, as, instant, NULL, DRAWS_STATIC);
    }
    lines->picture = LINE_BEHIND;
    done = done && (lines->behind == 0 || assemble_kind(c, as, instant, NULL, DRAWS_STATIC));
    lines->picture = 0;
    g->opaque_last = first;
    as->triangles_drawn = drawn;
    as->triangles_dropped = dropped;
    c->stats.draws_beside = beside;
    return done;
}

/* Assembles all draws. Where the display keeps tiles, what moves comes first: it says in which of them something must
 * be drawn. If some of it is drawn among what is static, the nearest of which wins or else the first, all is assembled
 * again in order. So are fills, which know no more than is in them. */
static bool assemble_draws(struct smear_context *c, struct smear_assembler *as, const struct smear_instant *instant,
                           struct smear_refill *f)
{
    if (f == NULL && (frame_has_pictures(c) || frame_has_movers(c)))
        return assemble_pictures(c, as, instant);
    if (!assembler_has_damage(as))
        return assemble_kind(c, as, instant, f, DRAWS_ALL);
    if (f == NULL && !damage_compares(c->damage)) {
        const uint32_t drawn = as->triangles_drawn, dropped = as->triangles_dropped, among = as->path_static_count,
                       beside = c->stats.draws_beside;
        if (!assemble_kind(c, as, instant, NULL, DRAWS_MOVING))
            return false;
        if (as->path_static_count == among)
            return assemble_kind(c, as, instant, NULL, DRAWS_STATIC);
        smear_bins_reset(as->bins, as->bins->row_first, as->bins->row_end);
        smear_assembler_reset(as);
        as->triangles_drawn = drawn;
        as->triangles_dropped = dropped;
        as->path_static_count = among;
        c->stats.draws_beside = beside;
    }
    return assemble_kind(c, as, instant, f, DRAWS_IN_ORDER);
}

/* Assembles with the assembler's state on the stack, where that is faster. */
static SMEAR_NOINLINE bool assemble_fast(struct smear_context *c, const struct smear_instant *instant)
{
    enum { VERTICES = 32 };
    struct smear_cached_vertex cache[VERTICES];
    struct smear_bins bins = c->rows.bins;
    struct smear_assembler as = c->assembler;
    as.bins = &bins;
    as.cache = cache;
    as.cache_mask = VERTICES - 1;
    as.serial = 0;
    smear_assembler_reset(&as);
    const bool done = assemble_draws(c, &as, instant, NULL);
    c->rows.bins = bins;
    c->assembler.path_count = as.path_count;
    c->assembler.path_static_count = as.path_static_count;
    c->assembler.triangles_drawn = as.triangles_drawn;
    c->assembler.triangles_dropped = as.triangles_dropped;
    return done;
}

/* Assembles all draws for the tile rows [first, end) on one core. False when the store is full. */
static SMEAR_RARE bool assemble_rows(struct smear_context *c, int first, int end, const struct smear_instant *instant)
{
    smear_bins_reset(&c->rows.bins, first, end);
    c->assembler.path_x0 = 0;
    c->assembler.path_x1 = INT16_MAX;
    if (SMEAR_FAST_STACK && !frame_has_layers(c))
        return assemble_fast(c, instant);
    smear_assembler_reset(&c->assembler);
    return assemble_draws(c, &c->assembler, instant, NULL);
}

/* Assembles the draws of a fill. The stack is deep where one is wanted: nothing is kept on it. False when the store is full. */
static SMEAR_RARE bool assemble_fill(struct smear_context *c, struct smear_refill *f)
{
    smear_bins_reset(&c->rows.bins, f->row, f->row + 1);
    c->assembler.path_x0 = (int16_t)f->path_x0;
    c->assembler.path_x1 = (int16_t)f->path_x1;
    smear_assembler_reset(&c->assembler);
    return assemble_draws(c, &c->assembler, (const struct smear_instant *)f->instant, f);
}

/* Assembles all draws for the tile rows [first, end), on several cores where that is faster. Fills, which a job may ask for,
 * never come here. False when the store is full. */
static bool assemble_all(struct smear_context *c, int first, int end, const struct smear_instant *instant)
{
    if (SMEAR_ASSEMBLY_JOBS && c->rows.jobs.workers > 1 && smear_workers_assemble(c, first, end, instant))
        return true;
    return assemble_rows(c, first, end, instant);
}

/* Setups are kept from tile row to tile row; also where a temporal method works, if the frame has another. */
static void make_cache(struct smear_context *c)
{
    const size_t work = SMEAR_WITH_SUBFRAMES && c->temporal.work != NULL && !smear_method_is_temporal(c->frame.method)
                      ? (size_t)c->temporal.work_bytes * (size_t)c->rows.jobs.workers : 0;
    smear_row_make_cache(&c->rows, c->temporal.work, work);
}

/* Notes how full the lists of a part of the frame are. */
static SMEAR_NOINLINE void note_fills(struct smear_context *c)
{
    const struct smear_bins *g = &c->rows.bins;
    if (!bins_in_parts(g)) {    /* else both have been noted */
        note_fill(&c->stats.fill.geometry, 4 * g->vertex_words + g->triangle_count * (uint32_t)sizeof(struct smear_triangle),
                  4 * g->pool_words);
        note_fill(&c->stats.fill.segments, g->segment_count, g->segment_limit);
    }
    note_fill(&c->stats.fill.draws, c->draw_count, c->desc.max_draws);
}

/* Begins the lists of rows [top, first), which have been drawn already, and of `first`. */
static void begin_lists(struct smear_context *c, int top, int first)
{
    struct smear_rows *rows = &c->rows;
    rows->opaque = rows->blend = rows->moving = SMEAR_NO_TRIANGLE;
    for (int list = 0; list < rows->bins.more_lists; list++)
        c->temporal.lines->list[list] = SMEAR_NO_TRIANGLE;
    if (SMEAR_RASTER_CACHE)
        make_cache(c);
    for (int row = top; row < first; row++) {
        rows->opaque = row_advance(rows, rows->bins.opaque_last, rows->opaque, row);
        for (int k = 1; frame_has_lines(c) && k <= LINE_BEHIND; k++)
            temporal_advance(&c->temporal, rows, line_list(k), row);
    }
}

/* Fills the store with the next triangles of a row that is refilled, and begins its lists. Statistics count what a kind of
 * draws has on the first way through it. */
static void fill(struct smear_refill *f)
{
    struct smear_context *c = (struct smear_context *)f->context;
    struct smear_rows *rows = &c->rows;
    const uint32_t start = stage_start(rows), drawn = c->assembler.triangles_drawn, dropped = c->assembler.triangles_dropped;
    const smear_stats stats = c->stats;
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    f->more = !assemble_fill(c, f);
    c->row_is_full = c->row_is_full || f->more;
    note_fills(c);
    if ((f->kinds & ~f->counted) == 0 || bins_kept(&rows->bins) != 0)
        c->assembler.triangles_dropped = dropped;
    if ((f->kinds & ~f->counted) == 0) {
        c->assembler.triangles_drawn = drawn;
        c->stats.draws_beside = stats.draws_beside;
    }
    f->counted |= f->more ? 0 : f->kinds;
    if (static_is_disturbed(c))
        damage_forget(c->damage);
    SMEAR_ENTER_STAGE(SMEAR_STAGE_DRAW);
    begin_lists(c, f->row, f->row);
    rows->opaque = row_advance(rows, rows->bins.opaque_last, SMEAR_NO_TRIANGLE, f->row);
    rows->blend = row_advance(rows, rows->bins.blend_last, SMEAR_NO_TRIANGLE, f->row);
    for (int list = 0; frame_has_lines(c) && list < LINE_LISTS; list++)
        temporal_advance(&c->temporal, rows, list, f->row);
    if (rows->bins.moving_last != NULL && !frame_has_layers(c))
        rows->moving = row_advance(rows, rows->bins.moving_last, SMEAR_NO_TRIANGLE, f->row);
    stage_end(rows, &c->stats.time.submit, start);
}

static bool is_half_empty(const struct smear_bins *g)
{
    return g->vertex_words + g->triangle_count * (uint32_t)(sizeof(struct smear_triangle) / 4) < g->pool_words / 2;
}

int smear_draws_assemble(struct smear_context *c, int top, int first, int end, const struct smear_instant *instant,
                         struct smear_refill *refill)
{
    const uint32_t start = stage_start(&c->rows);
    SMEAR_ENTER_STAGE(SMEAR_STAGE_ASSEMBLE);
    c->rows.refill = NULL;
    if (SMEAR_RANGES && c->part_rows != 0)
        end = min_i32(end, first + c->part_rows);
    bool is_full = SMEAR_RANGES && c->row_is_full;
    if (SMEAR_RANGES)
        c->row_is_full = false;
    for (bool again = true; again;) {
        const uint32_t drawn = c->assembler.triangles_drawn, dropped = c->assembler.triangles_dropped,
                       beside = c->stats.draws_beside;
        const bool done = !is_full && assemble_all(c, top, end, instant);
        note_fills(c);
        again = !done || static_is_disturbed(c);
        if (again || bins_kept(&c->rows.bins) != 0)     /* with ranges, they have been counted */
            c->assembler.triangles_dropped = dropped;
        if (!again)
            break;
        c->assembler.triangles_drawn = drawn;
        if (done) {
            damage_forget(c->damage);
            continue;
        }
        if (SMEAR_RANGES)
            c->stats.draws_beside = beside;
        if (2 * (end - first) <= c->rows.window.rows + 1)       /* more than two parts */
            smear_draws_find_ranges(c, instant);
        c->stats.parts_added++;
        if (end - first == 1) {
            *refill = (struct smear_refill){ .fill = fill, .context = c, .instant = instant };
            c->rows.refill = refill;
            again = false;
        }
        end = first + max_i32((end - first) / 2, 1);
    }
    if (bins_kept(&c->rows.bins) != 0)
        c->part_rows = (uint16_t)(end - first + (c->rows.refill == NULL && is_half_empty(&c->rows.bins) ? end - first : 0));
    SMEAR_ENTER_STAGE(SMEAR_STAGE_DRAW);
    begin_lists(c, top, c->rows.refill == NULL ? first : top);
    stage_end(&c->rows, &c->stats.time.submit, start);
    return end;
}

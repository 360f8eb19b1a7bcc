/* SPDX-License-Identifier: MIT */
/* draws_parts.c - draws that are assembled on several cores: see others.h. */
#include "draws.h"

#include "geometry/assemble.h"
#include "workers/parts.h"

#if SMEAR_POOL_PARTS

enum {
    PART_TRIANGLES_LEAST = 256,     /* submitted: below, one core is faster */
    PART_WORDS_LEAST = 2048,
    PARTS_RETRY = 32                /* assemblies on one core after one whose parts found no room */
};

/* Numbers of triangles tell the order of parts, as they count from a store's end. */
struct assembly_parts {
    struct smear_context *c;
    const struct smear_instant *instant;
    enum draws kind;
    struct smear_parts_cut cut;
    struct smear_part part[SMEAR_WORKERS_MAX];
};

enum { PARTS_WORDS = (sizeof(struct assembly_parts) + 7) / 8 * 2 };

/* Returns how many triangles of draw i are assembled. `seen`: the box of a static draw. */
static uint32_t part_triangles(const struct assembly_parts *all, uint32_t i, const struct smear_tile_box *seen)
{
    const struct smear_context *c = all->c;
    const bool left_out = !draw_is_of_kind(c, i, all->kind)
                       || (all->kind == DRAWS_STATIC && !tile_box_is_damaged(&c->damage->tiles, *seen));
    return left_out ? 0 : c->submitted[i].draw.mesh->triangle_count;
}

/* Assembles triangles [first, end) of draw i. */
static bool assemble_range(const struct assembly_parts *all, struct smear_part *p, uint32_t i, uint32_t first, uint32_t end,
                           struct smear_tile_box *seen)
{
    struct smear_assembly a;
    if (!smear_draws_make_assembly(all->c, i, all->instant, &a)) {
        p->beside += first == 0;
        return true;
    }
    p->tiles.only = all->kind == DRAWS_STATIC;
    p->tiles.seen = seen;
    if (seen != NULL && first != 0) {           /* the part in which it begins writes to it */
        p->rest = tile_box_none();
        p->rest_of = seen;
        p->tiles.seen = &p->rest;
    }
    a.first = first;
    a.end = end;
    return smear_draws_assemble_one(all->c, &p->as, &a);
}

static void assemble_job(void *argument, int job, int worker)
{
    struct assembly_parts *all = (struct assembly_parts *)argument;
    const struct smear_context *c = all->c;
    struct smear_part *p = &all->part[job];
    const bool notes = assembler_has_damage(&c->assembler) && !c->damage->is_same;
    struct smear_tile_box *seen = assembler_has_damage(&c->assembler) ? c->damage->seen : NULL;
    uint32_t at = 0;
    (void)worker;
    for (uint32_t i = 0; i < c->draw_count && at < p->end && p->done; i++) {
        const bool is_static = draw_is_static(c, i);
        const uint32_t count = part_triangles(all, i, seen), first = max_u32(p->first, at) - at, end = min_u32(p->end - at, count);
        if (first < end)
            p->done = assemble_range(all, p, i, first, end, notes && is_static ? seen : NULL);
        at += count;
        seen = seen != NULL && is_static ? seen + 1 : seen;
    }
}

/* Returns the bytes that each part but the first has in the memory of temporal methods, from rows.scratch on. */
static size_t room_apart(const struct smear_context *c)
{
    const uint32_t n = (uint32_t)c->rows.jobs.workers;
    const uintptr_t start = (uintptr_t)c->rows.scratch, end = (uintptr_t)c->rows.scratch_end;
    if (c->temporal.work == NULL || end == 0 || end - start < PARTS_WORDS * 4u)
        return 0;
    return (end - start - PARTS_WORDS * 4u) / (n - 1) & ~(size_t)7;
}

/* Whether parts lie there: where their triangles are likely to find room, or tiles are kept, which parts of the pool don't do. */
static bool are_apart(const struct smear_context *c)
{
    return assembler_has_damage(&c->assembler) || room_apart(c) >= 4u * c->rows.bins.pool_words / (uint32_t)c->rows.jobs.workers;
}

/* Whether it pays to assemble in parts. */
static bool has_parts(struct smear_context *c)
{
    const struct smear_bins *g = &c->rows.bins;
    const uint32_t n = (uint32_t)c->rows.jobs.workers;
    if (frame_has_layers(c) || frame_has_pictures(c) || frame_has_movers(c) || bins_kept(g) != 0 || static_is_cached(c->damage)
        || (damage_compares(c->damage) && assembler_has_damage(&c->assembler))
        || c->stats.triangles_in < PART_TRIANGLES_LEAST
        || (!are_apart(c)
            && g->pool_words < PARTS_WORDS + n * (PART_WORDS_LEAST + 3u * (uint32_t)(g->row_count + g->moving_rows))))
        return false;
    return c->parts_wait == 0 || c->parts_wait-- == 0;
}

/* Finds which triangles of draws of a kind each part takes. */
static void cut_parts(struct assembly_parts *all, enum draws kind, uint32_t n)
{
    const struct smear_context *c = all->c;
    all->kind = kind;
    all->cut = (struct smear_parts_cut){ .parts = n };
    for (int cuts = 0; cuts < 2; cuts++) {
        const struct smear_tile_box *seen = assembler_has_damage(&c->assembler) ? c->damage->seen : NULL;
        for (uint32_t i = 0; i < c->draw_count; i++) {
            smear_parts_cut(&all->cut, i, part_triangles(all, i, seen), cuts);
            seen = seen != NULL && draw_is_static(c, i) ? seen + 1 : seen;
        }
    }
}

/* Assembles draws of a kind into parts that have been made. False where one finds no room. */
static bool run_parts(struct assembly_parts *all, enum draws kind, uint32_t n)
{
    bool done = true;
    cut_parts(all, kind, n);
    for (uint32_t k = 0; k < n; k++) {
        all->part[k].first = all->cut.first[k];
        all->part[k].end = all->cut.first[k + 1];
    }
    smear_jobs_run(&all->c->rows.jobs, assemble_job, all, (int)n);
    for (uint32_t k = 0; k < n; k++)
        done = done && all->part[k].done;
    return done;
}

/* Assembles all draws in the memory of temporal methods, which is free until rows are drawn. What moves comes first where the
 * display keeps tiles, see assemble_draws(). */
static bool assemble_apart(struct smear_context *c, const struct smear_instant *instant)
{
    const uint32_t n = (uint32_t)c->rows.jobs.workers;
    struct assembly_parts *all = (struct assembly_parts *)(void *)c->rows.scratch;
    const size_t share = room_apart(c);
    const bool keeps = assembler_has_damage(&c->assembler) && c->damage->is_same;
    if (share == 0)
        return false;
    all->c = c;
    all->instant = instant;
    smear_part_within(&all->part[0], &c->assembler);
    for (uint32_t k = 1; k < n; k++)
        if (!smear_part_apart(&all->part[k], &c->assembler, c->rows.scratch + PARTS_WORDS + (k - 1) * (share / 4), share))
            return false;
    bool done = run_parts(all, keeps ? DRAWS_MOVING : DRAWS_ALL, n), moves = false;
    for (uint32_t k = 0; k < n; k++)
        moves = moves || all->part[k].as.path_static_count != 0;
    done = done && (!keeps || (!moves && run_parts(all, DRAWS_STATIC, n)));
    all->part[0].done = done;
    if (!smear_parts_join(&c->assembler, all->part, n))
        return false;
    c->stats.draws_beside += smear_parts_beside(all->part, n);
    return true;
}

/* Assembles all draws in parts of the pool. A draw may have triangles in many parts, each of which begins a segment. */
static bool assemble_within(struct smear_context *c, const struct smear_instant *instant)
{
    struct smear_bins *g = &c->rows.bins;
    struct assembly_parts *all = (struct assembly_parts *)(void *)g->pool;
    const uint32_t n = (uint32_t)c->rows.jobs.workers, spare = g->segment_limit - c->draw_count;
    all->c = c;
    all->instant = instant;
    for (uint32_t i = 0; i < g->segment_limit; i++)
        g->segment[i] = (struct smear_segment){ 0 };
    cut_parts(all, DRAWS_ALL, n);
    for (uint32_t k = 0; k < n; k++)
        smear_part_in_pool(all->part, &c->assembler, k, n, PARTS_WORDS, all->cut.draws[k] + spare * k / n);
    if (!run_parts(all, DRAWS_ALL, n))
        return false;
    note_fill(&c->stats.fill.geometry, 4 * smear_parts_join_pool(&c->assembler, all->part, n), 4 * g->pool_words);
    note_fill(&c->stats.fill.segments, smear_parts_segments(all->part, n), g->segment_limit);
    c->stats.draws_beside += smear_parts_beside(all->part, n);
    return true;
}

bool smear_workers_assemble(struct smear_context *c, int first, int end, const struct smear_instant *instant)
{
    const uint32_t drawn = c->assembler.triangles_drawn, dropped = c->assembler.triangles_dropped,
                   among = c->assembler.path_static_count;
    if (!has_parts(c))
        return false;
    smear_bins_reset(&c->rows.bins, first, end);
    c->assembler.path_x0 = 0;
    c->assembler.path_x1 = INT16_MAX;
    smear_assembler_reset(&c->assembler);
    if (are_apart(c) ? assemble_apart(c, instant) : assemble_within(c, instant))
        return true;
    c->assembler.triangles_drawn = drawn;
    c->assembler.triangles_dropped = dropped;
    c->assembler.path_static_count = among;
    c->parts_wait = PARTS_RETRY;
    return false;
}

#endif

/* SPDX-License-Identifier: MIT */
/* parts.c - parts of what was submitted, each with a store of its own, assembled on several cores: see others.h. */
#include "draws.h"

#include "base/base.h"
#include "base/jobs.h"
#include "geometry/assemble.h"

#if SMEAR_POOL_PARTS

struct smear_part {
    struct smear_assembler as;
    struct smear_bins bins;
    struct smear_damaged_tiles tiles;   /* as.damaged, which tells draws apart */
    struct smear_tile_box rest;         /* where a static draw's triangles are seen that begins in a part before */
    struct smear_tile_box *rest_of;     /* that draw's box, or null */
    uint32_t first, end;                /* triangles, counted through all draws */
    uint32_t beside;
    uint32_t number, segment;           /* with which it begins, in a part of the pool */
    bool done;
};

/* Returns total k / n without a product of 64 bits; k <= n. */
static inline uint32_t part_share(uint32_t total, uint32_t k, uint32_t n) { return total / n * k + total % n * k / n; }

/* How what is submitted is cut into parts that take about as long: a draw as long as some triangles before its first one. */
struct smear_parts_cut {
    uint32_t parts, total;              /* weight of all draws */
    uint32_t weight, triangles, next;   /* of the draws before, and the part that begins next */
    uint32_t first[SMEAR_WORKERS_MAX + 1];       /* triangles, counted through all draws */
    uint32_t draws[SMEAR_WORKERS_MAX];   /* draws that begin before that */
};

enum {
    APART_WORDS_LEAST = 1024,
    PART_CACHE = 128,               /* vertices */
    PART_DRAW = 12                  /* triangles: what a draw takes on a Cortex-M0+ with a flash cache */
};

/* Returns how many draws the parts left out as nothing of them is in view. */
static uint32_t parts_beside(const struct smear_part *part, uint32_t n)
{
    uint32_t sum = 0;
    for (uint32_t k = 0; k < n; k++)
        sum += part[k].beside;
    return sum;
}

/* Returns how many segments parts of the pool have. */
static uint32_t parts_segments(const struct smear_part *part, uint32_t n)
{
    uint32_t sum = 0;
    for (uint32_t k = 0; k < n; k++)
        sum += part[k].bins.segment_count - part[k].segment;
    return sum;
}

/* Takes in draw number i: for all draws without `cuts`, to find their weight, then with it. */
static void parts_cut(struct smear_parts_cut *cut, uint32_t i, uint32_t triangles, bool cuts)
{
    const uint32_t weight = triangles != 0 ? triangles + PART_DRAW : 0;
    if (!cuts) {
        cut->total += weight;
        return;
    }
    for (uint32_t at; cut->next < cut->parts && (at = part_share(cut->total, cut->next, cut->parts)) <= cut->weight + weight;
         cut->next++) {
        const uint32_t into = at > cut->weight + PART_DRAW ? at - cut->weight - PART_DRAW : 0;
        cut->first[cut->next] = cut->triangles + min_u32(into, triangles);
        cut->draws[cut->next] = i + (into != 0);
    }
    cut->weight += weight;
    cut->triangles += triangles;
    cut->first[cut->parts] = cut->triangles;
}

/* Makes a part that adds to the store itself. */
static void part_within(struct smear_part *p, const struct smear_assembler *a)
{
    *p = (struct smear_part){ .as = *a, .bins = *a->bins };
    if (assembler_has_damage(a)) {
        p->tiles = *a->damaged;
        p->as.damaged = &p->tiles;
    }
    p->done = true;
    p->as.bins = &p->bins;
    p->as.ranges = NULL;        /* those of the frame before may be left */
    p->as.path_static_count = p->as.triangles_drawn = p->as.triangles_dropped = 0;
}

/* Empties a part's rings, three of each row. */
static void place_rings(struct smear_part *p, const struct smear_bins *g, uint32_t *ring, size_t rows)
{
    for (size_t i = 0; i < 3 * rows; i++)
        ring[i] = SMEAR_NO_TRIANGLE;
    p->bins.opaque_last = ring;
    p->bins.blend_last = ring + rows;
    p->bins.moving_last = g->moving_last != NULL ? ring + 2 * rows : NULL;
}

/* Makes a part whose store, with its rings, segments and vertex cache, lies in memory of its own. False where that is too small. */
static bool part_apart(struct smear_part *p, const struct smear_assembler *a, void *memory, size_t bytes)
{
    struct smear_arena arena = { (uint8_t *)memory, 0 };
    const size_t rows = (size_t)(a->bins->row_count + a->bins->moving_rows);
    part_within(p, a);
    uint32_t *ring = arena_take(&arena, 3 * rows, sizeof *ring);
    p->bins.segment = arena_take(&arena, a->bins->segment_limit, sizeof *p->bins.segment);
    p->as.cache = arena_take(&arena, a->cache_mask + 1u, sizeof *p->as.cache);
    p->as.serial = 0;
    if (arena.used + APART_WORDS_LEAST * 4 > bytes)
        return false;
    smear_assembler_reset(&p->as);
    place_rings(p, a->bins, ring, rows);
    p->bins.pool_words = (uint32_t)((bytes - arena.used) / 16 * 4);
    p->bins.pool = arena_take(&arena, p->bins.pool_words, 4);
    return true;
}

/* Appends a part's rings, whose numbers are larger than all others, to those of the parts before it. */
static void join_rings(const struct smear_bins *g, uint32_t *last, const uint32_t *more)
{
    for (int row = g->row_first; row < g->row_end; row++) {
        if (more[row] == SMEAR_NO_TRIANGLE)
            continue;
        if (last[row] != SMEAR_NO_TRIANGLE) {
            struct smear_triangle *a = bins_triangle(g, last[row]), *b = bins_triangle(g, more[row]);
            const uint32_t first = a->next;
            a->next = b->next;
            b->next = first;
        }
        last[row] = more[row];
    }
}

/* Counts the numbers of rings, and their triangles' segments, from those of the store on. */
static void renumber(const struct smear_bins *g, uint32_t *last)
{
    for (int row = g->row_first; row < g->row_end; row++) {
        if (last[row] == SMEAR_NO_TRIANGLE)
            continue;
        const uint32_t end = last[row] += g->triangle_count;
        for (uint32_t i = end, next;; i = next) {
            struct smear_triangle *t = bins_triangle(g, i);
            next = t->next += g->triangle_count;
            if (t->segment != SMEAR_POINT)
                t->segment = (uint16_t)(t->segment + g->segment_count);
            if (next == end)
                break;
        }
    }
}

/* Appends all that another store has, with segments, rings and numbers of its own; its rings are used up. False where there is no room. */
static bool append_store(struct smear_bins *g, const struct smear_bins *more)
{
    if (!bins_has_room(g, more->vertex_words, more->triangle_count)
        || g->segment_count + more->segment_count > min_u32(g->segment_limit, SMEAR_POINT))
        return false;
    __builtin_memcpy(g->pool + g->vertex_words, more->pool, (size_t)more->vertex_words * 4);
    if (more->triangle_count != 0)
        __builtin_memcpy(bins_triangle(g, g->triangle_count + more->triangle_count - 1),
                         bins_triangle(more, more->triangle_count - 1), more->triangle_count * sizeof(struct smear_triangle));
    for (uint32_t i = 0; i < more->segment_count; i++) {
        g->segment[g->segment_count + i] = more->segment[i];
        g->segment[g->segment_count + i].base += g->vertex_words;
    }
    uint32_t *const from[3] = { more->opaque_last, more->blend_last, more->moving_last };
    uint32_t *const to[3] = { g->opaque_last, g->blend_last, g->moving_last };
    for (int i = 0; i < 3; i++)
        if (to[i] != NULL) {
            renumber(g, from[i]);
            join_rings(g, to[i], from[i]);
        }
    g->vertex_words += more->vertex_words;
    g->triangle_count += more->triangle_count;
    g->segment_count += more->segment_count;
    return true;
}

static void add_counts(struct smear_assembler *a, const struct smear_part *p)
{
    a->path_count += p->as.path_count;
    a->path_static_count += p->as.path_static_count;
    a->triangles_drawn += p->as.triangles_drawn;
    a->triangles_dropped += p->as.triangles_dropped;
}

/* Gives back what part_within() took, and adds what the others have. False where there is no room. */
static bool parts_join(struct smear_assembler *a, const struct smear_part *part, uint32_t n)
{
    struct smear_bins *g = a->bins;
    bool done = true;
    *g = part[0].bins;
    a->serial = part[0].as.serial;
    a->cache_has_paths = part[0].as.cache_has_paths;
    a->path_count = 0;
    for (uint32_t k = 0; k < n; k++) {
        const struct smear_part *p = &part[k];
        done = done && p->done && p->as.path_count <= a->path_limit - a->path_count && (k == 0 || append_store(g, &p->bins));
        if (!done)
            return false;
        add_counts(a, p);
        if (p->rest_of != NULL)
            tile_box_add(p->rest_of, p->rest);
    }
    return true;
}

/* Makes part k of n, those before it have been made: its share of the pool behind `head` words, of segments from number
 * `segment` on and of triangles with a path. */
static void part_in_pool(struct smear_part *part, const struct smear_assembler *a, uint32_t k, uint32_t n, uint32_t head,
                         uint32_t segment)
{
    const struct smear_bins *g = a->bins;
    struct smear_part *p = &part[k];
    const uint32_t rows = (uint32_t)(g->row_count + g->moving_rows), words = (g->pool_words - head) / n & ~3u;
    uint32_t *ring = g->pool + (g->pool_words - (k + 1) * words);
    part_within(p, a);
    p->as.cache = (struct smear_cached_vertex *)(void *)(ring + 3 * rows);
    p->as.cache_mask = PART_CACHE - 1;
    p->as.serial = 0;
    p->as.path_limit = a->path_limit / n;
    p->number = p->bins.triangle_count = k * words / 4;
    p->bins.vertex_words = g->pool_words - (k + 1) * words + 3 * rows
                         + PART_CACHE * (uint32_t)(sizeof(struct smear_cached_vertex) / 4);
    p->segment = p->bins.segment_count = segment;
    if (k != 0)
        part[k - 1].bins.segment_limit = segment;
    place_rings(p, g, ring, rows);
    smear_assembler_reset(&p->as);
}

/* Joins such parts; returns the words of the pool that are used. What is free of it becomes what is free in the part that has the most. */
static uint32_t parts_join_pool(struct smear_assembler *a, const struct smear_part *part, uint32_t n)
{
    struct smear_bins *g = a->bins;
    uint32_t most = 0, free = 0;
    g->parts_listed = 0;
    for (uint32_t k = 0; k < n; k++) {
        const struct smear_bins *b = &part[k].bins;
        const uint32_t rest = g->pool_words - b->vertex_words - b->triangle_count * (uint32_t)(sizeof(struct smear_triangle) / 4);
        join_rings(g, g->opaque_last, b->opaque_last);
        join_rings(g, g->blend_last, b->blend_last);
        if (g->moving_last != NULL)
            join_rings(g, g->moving_last, b->moving_last);
        add_counts(a, &part[k]);
        g->parts_listed += b->triangle_count - part[k].number;
        free += rest;
        if (k == 0 || rest > most) {
            most = rest;
            g->vertex_words = b->vertex_words;
            g->triangle_count = b->triangle_count;
        }
    }
    g->parts_end = part[n - 1].bins.triangle_count;
    g->segment_count = part[n - 1].bins.segment_count;
    return g->pool_words - free;
}

/* ------------------------------------------------------------------ draws that several cores assemble: see others.h */

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
            parts_cut(&all->cut, i, part_triangles(all, i, seen), cuts);
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
    part_within(&all->part[0], &c->assembler);
    for (uint32_t k = 1; k < n; k++)
        if (!part_apart(&all->part[k], &c->assembler, c->rows.scratch + PARTS_WORDS + (k - 1) * (share / 4), share))
            return false;
    bool done = run_parts(all, keeps ? DRAWS_MOVING : DRAWS_ALL, n), moves = false;
    for (uint32_t k = 0; k < n; k++)
        moves = moves || all->part[k].as.path_static_count != 0;
    done = done && (!keeps || (!moves && run_parts(all, DRAWS_STATIC, n)));
    all->part[0].done = done;
    if (!parts_join(&c->assembler, all->part, n))
        return false;
    c->stats.draws_beside += parts_beside(all->part, n);
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
        part_in_pool(all->part, &c->assembler, k, n, PARTS_WORDS, all->cut.draws[k] + spare * k / n);
    if (!run_parts(all, DRAWS_ALL, n))
        return false;
    note_fill(&c->stats.fill.geometry, 4 * parts_join_pool(&c->assembler, all->part, n), 4 * g->pool_words);
    note_fill(&c->stats.fill.segments, parts_segments(all->part, n), g->segment_limit);
    c->stats.draws_beside += parts_beside(all->part, n);
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

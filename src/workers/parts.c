/* SPDX-License-Identifier: MIT */
/* parts.c - see parts.h. */
#include "workers/parts.h"

#include "base/base.h"
#include "geometry/assemble.h"

#if SMEAR_POOL_PARTS

enum {
    APART_WORDS_LEAST = 1024,
    PART_CACHE = 128,               /* vertices */
    PART_DRAW = 12                  /* triangles: what a draw takes on a Cortex-M0+ with a flash cache */
};

uint32_t smear_parts_beside(const struct smear_part *part, uint32_t n)
{
    uint32_t sum = 0;
    for (uint32_t k = 0; k < n; k++)
        sum += part[k].beside;
    return sum;
}

uint32_t smear_parts_segments(const struct smear_part *part, uint32_t n)
{
    uint32_t sum = 0;
    for (uint32_t k = 0; k < n; k++)
        sum += part[k].bins.segment_count - part[k].segment;
    return sum;
}

void smear_parts_cut(struct smear_parts_cut *cut, uint32_t i, uint32_t triangles, bool cuts)
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

void smear_part_within(struct smear_part *p, const struct smear_assembler *a)
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

bool smear_part_apart(struct smear_part *p, const struct smear_assembler *a, void *memory, size_t bytes)
{
    struct smear_arena arena = { (uint8_t *)memory, 0 };
    const size_t rows = (size_t)(a->bins->row_count + a->bins->moving_rows);
    smear_part_within(p, a);
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

bool smear_parts_join(struct smear_assembler *a, const struct smear_part *part, uint32_t n)
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

void smear_part_in_pool(struct smear_part *part, const struct smear_assembler *a, uint32_t k, uint32_t n, uint32_t head,
                        uint32_t segment)
{
    const struct smear_bins *g = a->bins;
    struct smear_part *p = &part[k];
    const uint32_t rows = (uint32_t)(g->row_count + g->moving_rows), words = (g->pool_words - head) / n & ~3u;
    uint32_t *ring = g->pool + (g->pool_words - (k + 1) * words);
    smear_part_within(p, a);
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

uint32_t smear_parts_join_pool(struct smear_assembler *a, const struct smear_part *part, uint32_t n)
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

#endif

/* SPDX-License-Identifier: MIT */
/* draws_ranges.c - where the triangles of draws are seen (geometry/ranges.h), when the store turns out to be too small. */
#include "draws.h"

#include "geometry/ranges.h"


/* Makes ranges as short as it pays, and as a part of the pool has room for the boxes of. Returns how many there are; 0 where the
 * draws alone are too many. */
static uint32_t cut_ranges(const struct smear_context *c, struct smear_bins *g)
{
    enum { PATHS_SHIFT = 5, STILL_SHIFT = 7, POOL_PART = 8 };       /* triangles without a path cost less than to begin a range */
    const uint32_t most = (g->pool_words - POOL_WORDS_LEAST) / POOL_PART;
    uint32_t n = c->draw_count;
    for (g->range_shift = assembler_keeps_paths(&c->assembler) ? PATHS_SHIFT : STILL_SHIFT; c->draw_count <= most; g->range_shift++) {
        n = 0;
        for (uint32_t i = 0; i < c->draw_count; i++)
            n += ranges_of(g, c->submitted[i].draw.mesh->triangle_count);
        if (n <= most)
            return n;
    }
    return 0;
}

void smear_draws_find_ranges(struct smear_context *c, const struct smear_instant *instant)
{
    struct smear_assembler as = c->assembler;
    struct smear_bins *g = as.bins;
    if (!SMEAR_RANGES || bins_kept(g) != 0 || frame_has_layers(c) || frame_has_pictures(c))      /* of which each has others */
        return;
    g->kept_words = cut_ranges(c, g);
    struct smear_tile_box *box = ranges_all(g);
    if (box == NULL)
        return;
    uint32_t beside = 0;
    as.damaged = NULL;
    as.ranges = NULL;
    as.path_x0 = 0;
    as.path_x1 = INT16_MAX;
    for (uint32_t i = 0; i < c->draw_count; i++) {
        const uint32_t n = ranges_of(g, c->submitted[i].draw.mesh->triangle_count);
        struct smear_assembly a;
        for (uint32_t k = 0; k < n; k++)
            box[k] = tile_box_none();
        if (smear_draws_make_assembly(c, i, instant, &a))
            smear_ranges_find(&as, &a, box);
        else
            beside++;
        box += n;
    }
    c->stats.draws_beside += beside;
    c->assembler.triangles_dropped = as.triangles_dropped;
    c->assembler.serial = as.serial;
    c->assembler.cache_has_paths = as.cache_has_paths;
}


/* SPDX-License-Identifier: MIT */
/* ranges.h - where triangles are seen that follow each other in a mesh, so that who fills a part of the frame passes over others.
 *
 * When the store turns out to be too small, all draws are assembled once, range by range, into the empty store, and forgotten:
 * only the box of what is seen of a range is kept. The boxes lie at the bottom of the pool, those of a draw behind those of the
 * draw before. They hold for as long as the draws stay where they are. */
#ifndef SMEAR_RANGES_H
#define SMEAR_RANGES_H

#include "geometry/vertex.h"

/* Log2 of the pixels of a box's columns and rows: numbers of 8 bits do for the largest frame. */
enum { RANGE_BOX_SHIFT = 3 };

/* Returns how many ranges a mesh of so many triangles has. */
static inline uint32_t ranges_of(const struct smear_bins *g, uint32_t triangles)
{
    return (triangles + (1u << g->range_shift) - 1) >> g->range_shift;
}

/* Returns the boxes of all draws; null where there are none. */
static inline struct smear_tile_box *ranges_all(const struct smear_bins *g)
{
    return bins_kept(g) != 0 ? (struct smear_tile_box *)(void *)g->pool : NULL;
}

/* Returns the box of what is being filled, where ranges are known; with `columns`, without what lies beside those of the assembler. */
static inline struct smear_tile_box ranges_filled(const struct smear_assembler *a, bool columns)
{
    const struct smear_damaged_tiles tiles = { .shift = RANGE_BOX_SHIFT };
    const struct smear_bins *g = a->bins;
    if (!SMEAR_RANGES || a->ranges == NULL)
        return tile_box_none();
    return tile_box_of(&tiles, columns ? a->path_x0 : 0, columns ? min_i32(a->path_x1, a->viewport.width) : a->viewport.width,
                       g->row_first * g->row_px, g->row_end * g->row_px);
}

static inline bool tile_boxes_meet(struct smear_tile_box a, struct smear_tile_box b)
{
    return a.x0 <= b.x1 && a.x1 >= b.x0 && a.y0 <= b.y1 && a.y1 >= b.y0;
}

/* Moves *first on to the next triangle before `end` that may be seen in what is filled. Returns the end of those that follow it
 * and may be, too; `end` where there are none, or it is not known. */
static inline uint32_t ranges_next(const struct smear_assembler *a, struct smear_tile_box filled, uint32_t *first, uint32_t end)
{
    const struct smear_tile_box *const box = a->ranges;
    if (!SMEAR_RANGES || box == NULL)
        return end;
    const int shift = a->bins->range_shift;
    uint32_t at = *first >> shift, past;
    while (at << shift < end && !tile_boxes_meet(box[at], filled))
        at++;
    for (past = at; past << shift < end && tile_boxes_meet(box[past], filled);)
        past++;
    *first = min_u32(max_u32(*first, at << shift), end);
    return min_u32(past << shift, end);
}

/* Moves *first on, and returns an end, as ranges_next does, for a draw that is assembled: beyond what lies beside the view, too. */
uint32_t smear_ranges_seen(const struct smear_assembler *a, const struct smear_assembly *d, struct smear_tile_box filled, uint32_t *first);

/* Finds the boxes of a draw, from `box` on. What is in the store is lost. */
void smear_ranges_find(struct smear_assembler *a, struct smear_assembly *d, struct smear_tile_box *box);

#endif

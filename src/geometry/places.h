/* SPDX-License-Identifier: MIT */
/* places.h - where the vertices of a mesh are on the screen, all at once: for loops over triangles that take several. */
#ifndef SMEAR_PLACES_H
#define SMEAR_PLACES_H

#include "geometry/batch.h"
#include "kernels/triangles.h"

/* Vertices [first, end) of the mesh on the screen, by their index. They lie in the pool between its vertices and its
 * triangles, which must not grow beyond `bottom` and `top`. */
struct places {
    struct smear_place *place;
    uint32_t *stored;               /* as in struct smear_cached_vertex */
    uint32_t first, end;
    uint32_t bottom, top;           /* pool words */
    struct triangles_setup setup;
};

/* A place that no vertex has stands for those before the near plane, and one for those behind the far plane: triangles
 * of which all are there have no area, and the edges of others are too long. */
enum { PLACE_NEAR = -(1 << 29), PLACE_FAR = 1 << 29 };

enum {
    PLACE_WORDS = sizeof(struct smear_place) / 4 + 1,
    PLACES_BLOCK = 64,              /* triangles whose vertices are in `places` or not */
    PLACES_MARGIN = 512             /* words that a group of triangles, or a clipped one, may take at either side */
};

static inline bool places_have_room(const struct places *r, const struct smear_bins *g)
{
    return g->vertex_words + PLACES_MARGIN <= r->bottom
        && r->top + PLACES_MARGIN <= g->pool_words - g->triangle_count * (uint32_t)(sizeof(struct smear_triangle) / 4);
}

/* Returns how the triangles of a draw are looked at. */
static inline struct triangles_setup places_setup(const struct batch *b)
{
    const struct smear_assembler *a = b->a;
    const struct smear_bins *g = a->bins;
    const int32_t top = g->row_first * g->row_px, bottom = min_i32(a->viewport.height, g->row_end * g->row_px);
    return (struct triangles_setup){ pair_of(0, top), pair_of(a->viewport.width, bottom), b->double_sided, bins_margin(g),
                                     b->d->mirrored ? 1 : 2, b->d->mirrored ? 2 : 1 };
}

/* Whether offsets of twelve more vertices fit the segment; else begins a new one. False where there is none, for those of `triangle`. */
static inline bool segment_has_room(struct batch *b, uint32_t triangle)
{
    if (b->a->bins->vertex_words + 12u * b->segment->stride - b->segment->base <= 65536u)
        return true;
    struct smear_segment *s = smear_vertex_segment(b->a, b->d);
    if (s != NULL)
        b->segment = s;
    else
        b->a->resume = (struct smear_resume){ triangle, 0 };
    return s != NULL;
}

/* Takes as many triangles of [first, end) as name vertices that there is room for, and finds these. Returns the end of
 * them; `first` where there is no room, or an index that the mesh does not have. */
uint32_t smear_places_open(struct places *r, const struct batch *b, uint32_t first, uint32_t end);

#endif

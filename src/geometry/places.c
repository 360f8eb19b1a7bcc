/* SPDX-License-Identifier: MIT */
/* places.c - from the vertices of a mesh to the screen, by fours. */
#include "geometry/places.h"

#include "kernels/places.h"

static void find_place(struct smear_place *p, const struct batch *b, uint32_t index)
{
    const struct smear_assembly *d = b->d;
    const int code = placement_project(&p->screen, &d->at, index, &b->a->viewport);
    if ((code & (OUT_NEAR | OUT_FAR)) != 0)
        p->screen.x = p->screen.y = (code & OUT_NEAR) != 0 ? PLACE_NEAR : PLACE_FAR;
    p->first = place_first(p->screen.x, p->screen.y);
}

static SMEAR_NOINLINE void find_places(const struct batch *b, const struct places *r)
{
    const struct smear_placement *at = &b->d->at;
    const struct smear_projection *p = &at->now;
    const struct smear_depths *depths = &p->depths;
    const struct place_setup setup = {
        p->m, depths->near_distance, depths->far_distance, depths->depth_mantissa, depths->depth_shift, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX,
        b->a->viewport.width << 7, b->a->viewport.height << 7
    };
    const bool by_fours = !is_orthographic(p) && depths->up == 0 && !(SMEAR_WITH_DEFORM && at->extra_count != 0);
    struct place_rows rows;
    uint32_t i = r->first;
    if (SMEAR_PLACES && by_fours)
        place_rows_make(&rows, &setup);
    while (i < r->end) {
        const uint32_t end = min_u32(i + 4, r->end);
        if (SMEAR_PLACES && by_fours && end - i == 4 && places_find(r->place + i, at->position + 3 * i, &rows)) {
            i = end;
            continue;
        }
        for (; i < end; i++)
            find_place(r->place + i, b, i);
    }
    __builtin_memset(r->stored + r->first, 0, (r->end - r->first) * sizeof *r->stored);
}

/* Returns the words that places of vertices take, and what most triangles of a mesh add to the pool: backs are not seen. */
static inline uint32_t words_of(uint32_t vertices, uint32_t triangles, uint32_t stride)
{
    return vertices * PLACE_WORDS + (min_u32(vertices, 3 * triangles) * stride + triangles * 4) / 4 * 3 + 2 * PLACES_MARGIN;
}

uint32_t smear_places_open(struct places *r, const struct batch *b, uint32_t first, uint32_t end)
{
    const smear_mesh *mesh = b->d->mesh;
    const struct smear_bins *g = b->a->bins;
    const uint32_t stride = b->segment->stride, begin = g->vertex_words;
    const uint32_t free = g->pool_words - begin - g->triangle_count * (uint32_t)(sizeof(struct smear_triangle) / 4);
    struct index_range all = { UINT16_MAX, 0 };
    uint32_t last = first;
    while (SMEAR_PLACES && last < end) {
        const uint32_t next = min_u32(last + PLACES_BLOCK, end);
        const struct index_range range = indices_range(mesh->index + 3 * last, (int32_t)(3 * (next - last)));
        const struct index_range more = { min_u32(all.least, range.least), max_u32(all.most, range.most) };
        if (more.most >= mesh->vertex_count || words_of(more.most - more.least + 1, next - first, stride) > free)
            break;
        all = more;
        last = next;
    }
    if (!SMEAR_PLACES || last == first)
        return first;
    r->first = all.least;
    r->end = all.most + 1;
    const uint32_t words = (r->end - r->first) * PLACE_WORDS, rest = free - words;
    r->bottom = begin + (uint32_t)((uint64_t)rest * stride / (stride + 8u));
    r->top = r->bottom + words;
    r->place = (struct smear_place *)(void *)(g->pool + r->bottom) - r->first;
    r->stored = g->pool + r->bottom + words / PLACE_WORDS * (PLACE_WORDS - 1) - r->first;
    find_places(b, r);
    return last;
}

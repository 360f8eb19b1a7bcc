/* SPDX-License-Identifier: MIT */
/* batch_store.h - colours of faces, and the records of vertices that are stored. */
#ifndef SMEAR_BATCH_STORE_H
#define SMEAR_BATCH_STORE_H

#include "geometry/batch.h"

static SMEAR_NOINLINE uint32_t shade_face(const struct batch *b, uint32_t triangle, bool back)
{
    struct smear_face face = smear_face_of(b->d, triangle, back);
    return smear_face_color(b->d, b->segment, &face);
}

static inline uint32_t color_of_face(const struct batch *b, uint32_t triangle, bool back)
{
    if (b->face_color != NULL) {
        const uint8_t *c = b->face_color + 4 * triangle;
        return pixel_of_bytes(c);
    }
    return b->segment->shade == SHADE_FLAT ? shade_face(b, triangle, back) : 0xffffffffu;
}

/* Stores a vertex; returns the first word of its record. `known`: where it is now, before the division, or null. */
static SMEAR_NOINLINE uint32_t store_vertex(const struct batch *b, uint32_t index, const struct smear_screen *screen,
                                            const struct smear_homogeneous *known, uint32_t triangle, bool back)
{
    const struct smear_assembly *d = b->d;
    const struct smear_segment *s = b->segment;
    const smear_mesh *mesh = d->mesh;
    struct smear_bins *g = b->a->bins;
    uint32_t word = g->vertex_words;
    uint32_t *record = g->pool + word;
    g->vertex_words = word + s->stride;
    store_place(record, screen);
    if (segment_textured(s))
        store_uv(record + s->uv, mesh->uv[2 * index], mesh->uv[2 * index + 1]);
    if (SMEAR_WITH_GOURAUD && b->vertex_color != NULL) {      /* as smear_shade has it */
        const uint8_t *c = b->vertex_color + 4 * index;
        record[s->color] = (uint32_t)c[0] << 8 | (uint32_t)c[1] << 24;
        record[s->color + 1] = (uint32_t)c[2] << 8 | c[3] * 257u << 16;
    } else if (segment_colored(s)) {
        smear_vertex_store_color(record + s->color, d, index, triangle, back);
    }
    if (segment_moves(s) != 0)
        smear_batch_store_motion(record + s->motion, b, index, screen, known);
    return word;
}

/* Returns the first word of the vertex's record, which it stores where that has not been done. */
static inline uint32_t stored_vertex(const struct batch *b, struct smear_cached_vertex *v, uint32_t triangle,
                                     bool back)
{
    const bool shares = batch_shares(b, back);
    if (shares && v->stored > b->segment->base)
        return v->stored - 1;
    uint32_t word = store_vertex(b, index_of(v), &v->screen, cached_now(v), triangle, back);
    if (shares)
        v->stored = word + 1;
    return word;
}

#endif

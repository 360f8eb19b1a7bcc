/* SPDX-License-Identifier: MIT */
/* batch_find.h - where a draw's vertices are on the screen, one after the other. */
#ifndef SMEAR_BATCH_FIND_H
#define SMEAR_BATCH_FIND_H

#include "geometry/batch.h"
#include "kernels/triangle_scan.h"

/* Transforms and projects a vertex. */
static inline void find_vertex(const struct smear_assembler *a, const struct smear_assembly *d,
                               struct smear_cached_vertex *v, uint32_t tag)
{
#if SMEAR_FAST_STACK
    struct smear_homogeneous passing, *now = &passing;
#else
    struct smear_homogeneous *now = &v->now;
#endif
    v->tag = tag;
    v->stored = 0;
    v->outcode = placement_project(&v->screen, now, &d->at, tag & 0xffffu, &a->viewport);
}

#if SMEAR_VERTEX_SETUP
static SMEAR_RARE void batch_make_ready(struct batch *b)
{
    const struct smear_placement *p = &b->d->at;
    const struct smear_depths *depths = &p->now.depths;
    const struct smear_viewport *viewport = &b->a->viewport;
    const struct place_setup s = { p->now.m, depths->near_distance, depths->far_distance, depths->depth_mantissa,
                                   depths->depth_shift, SMEAR_DEPTH_MIN, SMEAR_DEPTH_MAX,
                                   viewport->width << 7, viewport->height << 7 };
    b->ready = !depths_are_even(depths) && p->extra_count == 0;
    if (b->ready)
        vertex_setup_make(&b->setup, &s);
}

static SMEAR_RARE int outcode_beside(const struct smear_screen *s, const struct smear_viewport *viewport)
{
    return outcode_sides(s, viewport);
}

/* A vertex that the setup has found. */
static inline void found_vertex(const struct batch *b, struct smear_cached_vertex *v, uint32_t tag)
{
    const struct smear_viewport *const viewport = &b->a->viewport;
    const bool inside = (uint32_t)v->screen.x <= (uint32_t)viewport->width << 8
                     && (uint32_t)v->screen.y <= (uint32_t)viewport->height << 8;
    v->tag = tag;
    v->stored = 0;
    v->outcode = inside ? 0 : outcode_beside(&v->screen, viewport);
}

/* Finds a vertex for which the setup is not ready: makes it ready for others like it. */
static SMEAR_RARE void find_unready(struct batch *b, struct smear_cached_vertex *v, uint32_t tag)
{
    struct vertex_setup *const s = &b->setup;
    const int16_t *const position = b->d->at.position + 3 * (tag & 0xffffu);
    const int32_t w = b->ready ? vertex_row_of(&s->row[2], position) : INT32_MIN;
    if (b->ready && w >= s->near_distance && w <= s->far_distance && vertex_setup_for(s, w)
        && vertex_find(&v->screen, &v->now, position, s))
        found_vertex(b, v, tag);
    else
        find_vertex(b->a, b->d, v, tag);
}
#endif

/* Triangles that are not seen pass without a look in C. */
#define ASSEMBLE_SCANS (SMEAR_VERTEX_SETUP && !SMEAR_FAST_STACK)

SMEAR_INLINE void find_in_batch(struct batch *b, struct smear_cached_vertex *v, uint32_t tag)
{
#if SMEAR_VERTEX_SETUP
    if (!b->ready || !vertex_find(&v->screen, &v->now, b->d->at.position + 3 * (tag & 0xffffu), &b->setup)) {
        find_unready(b, v, tag);
        return;
    }
    found_vertex(b, v, tag);
#else
    find_vertex(b->a, b->d, v, tag);
#endif
}

#endif

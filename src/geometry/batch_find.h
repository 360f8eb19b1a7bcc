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
static inline void batch_make_ready(struct batch *b)
{
    b->ready = smear_vertex_setup(&b->setup, &b->d->at, &b->a->viewport);
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

/* Finds a vertex for which the setup is not ready, or has none. */
static SMEAR_RARE void find_unready(struct batch *b, struct smear_cached_vertex *v, uint32_t tag)
{
    if (b->ready && smear_vertex_find_unready(&v->screen, &v->now, b->d->at.position + 3 * (tag & 0xffffu), &b->setup))
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

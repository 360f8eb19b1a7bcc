/* SPDX-License-Identifier: MIT */
/* path_places.h - where the vertices of a mesh that moves are on the screen, at the instants that tell their paths: on
 * cores where that pays with what they share made ready. */
#ifndef SMEAR_PATH_PLACES_H
#define SMEAR_PATH_PLACES_H

#include "geometry/vertex.h"

#if SMEAR_WITH_SUBFRAMES

enum { OPEN, CLOSE, MIDDLE, KEYS };     /* as keys of an assembly, then the instant that is drawn */

/* A vertex at all three instants: an entry of a direct-mapped cache in the memory of the other one. */
struct path_vertex {
    uint32_t tag, stored;               /* as in struct smear_cached_vertex */
    struct smear_screen screen[KEYS];
    uint32_t outcodes;                  /* a byte for each instant, see code_at() */
};

static inline const struct smear_placement *placement_of(const struct smear_assembly *d, int key)
{
    return key == MIDDLE ? &d->at : &d->motion.key[key];
}

SMEAR_STATIC_ASSERT(sizeof(struct path_vertex) <= 2 * sizeof(struct smear_cached_vertex), "two for one");

#if SMEAR_VERTEX_SETUP
struct path_places {
    bool ready;
    const struct smear_assembly *d;
    const struct smear_viewport *viewport;
    struct vertex_setup setup[KEYS];
};

void smear_path_places_open(struct path_places *p, const struct smear_assembler *a, const struct smear_assembly *d);
bool smear_path_places_take(struct path_vertex *v, struct path_places *p, uint32_t tag);

static inline void path_places_open(struct path_places *p, const struct smear_assembler *a, const struct smear_assembly *d)
{
    smear_path_places_open(p, a, d);
}

/* Makes a vertex. False where it is left out: it is before the near or behind the far plane at an instant, very near to the eye
 * or far away from it. */
static inline bool path_places_take(struct path_vertex *v, struct path_places *p, uint32_t tag)
{
    return p->ready && smear_path_places_take(v, p, tag);
}
#else
struct path_places {
    char none;
};

static inline void path_places_open(struct path_places *p, const struct smear_assembler *a, const struct smear_assembly *d)
{
    (void)p;
    (void)a;
    (void)d;
}

static inline bool path_places_take(struct path_vertex *v, struct path_places *p, uint32_t tag)
{
    (void)v;
    (void)p;
    (void)tag;
    return false;
}
#endif

#endif
#endif

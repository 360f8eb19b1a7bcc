/* SPDX-License-Identifier: MIT */
/* path_places.h - where the vertices of a mesh that moves are on the screen, at the instants that tell their paths. Processors
 * with AVX2 find them by eights, for as long as others of an eight may be asked for; cores where that pays one by one, with what
 * they share made ready. */
#ifndef SMEAR_PATH_PLACES_H
#define SMEAR_PATH_PLACES_H

#include "geometry/vertex.h"
#include "kernels/places8.h"

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

#if SMEAR_AVX2
enum { PATH_EIGHTS = 16 };              /* that are kept: 7 kB of stack */

struct path_places {
    const int16_t *position[KEYS];
    const struct smear_viewport *viewport;
    uint32_t count;                     /* vertices up to here may be found so */
    uint32_t eight[PATH_EIGHTS];        /* vertex / 8 + 1; 0: none */
    uint32_t found[PATH_EIGHTS];        /* bit k: vertex k of it was found at all instants */
    uint32_t outcodes[PATH_EIGHTS][8];
    struct place_setup setup[KEYS];
    struct place_rows8 rows[KEYS];
    struct smear_place place[PATH_EIGHTS][KEYS][8];
};

void smear_path_places_open(struct path_places *p, const struct smear_assembler *a, const struct smear_assembly *d);
bool smear_path_places_take(struct path_vertex *v, struct path_places *p, uint32_t tag);

/* Begins a draw. */
static inline void path_places_open(struct path_places *p, const struct smear_assembler *a, const struct smear_assembly *d)
{
    p->count = 0;
    if (smear_has_avx2())
        smear_path_places_open(p, a, d);
}

/* Makes a vertex. False where it is left out: it is behind the far plane, very near to the eye or far away from it, or has no
 * eight. */
static inline bool path_places_take(struct path_vertex *v, struct path_places *p, uint32_t tag)
{
    return (tag & 0xffffu) < p->count && smear_path_places_take(v, p, tag);
}
#elif SMEAR_VERTEX_SETUP
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

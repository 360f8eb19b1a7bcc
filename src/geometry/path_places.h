/* SPDX-License-Identifier: MIT */
/* path_places.h - where the vertices of a mesh that moves are on the screen, at the instants that tell their paths. */
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

#endif
#endif

/* SPDX-License-Identifier: MIT */
/* kept_found.h - what is kept of a triangle: looked up by its number. */
#ifndef SMEAR_RASTER_KEPT_FOUND_H
#define SMEAR_RASTER_KEPT_FOUND_H

#include "raster/kept.h"

enum { PROBES = 16 };

/* Whether an entry keeps nothing that rows from the target's on need. */
static inline bool entry_is_free(const struct kept *entry, const struct smear_raster_target *target)
{
    return entry->triangle == SMEAR_NO_TRIANGLE || entry->end <= target->y0;
}

/* The entry of a triangle that continues rows above the target's or goes on below them; null for others, and where all
 * entries that it may have are others' still. `known`: it holds the triangle's setup. */
static inline struct kept *find_kept(const struct smear_raster_target *target, uint32_t triangle,
                                     bool continues, bool goes_on, bool *known)
{
    *known = false;
    if (!SMEAR_RASTER_CACHE || target->cache.entries == 0 || !(continues || goes_on))
        return NULL;
    struct kept *free = NULL;
    uint32_t at = (triangle * 40503u & 0xffffu) * target->cache.entries >> 16;
    for (int i = 0; i < PROBES; i++) {
        struct kept *entry = kept_at(&target->cache, at);
        if (continues && entry->triangle == triangle) {
            *known = true;
            return entry;
        }
        if (free == NULL && entry_is_free(entry, target)) {
            free = entry;
            if (!continues)
                break;
        }
        if (++at == target->cache.entries)
            at = 0;
    }
    return goes_on ? free : NULL;
}

/* It has been taken. */
static inline void leave_kept(struct kept *k, bool goes_on)
{
    if (!goes_on)
        k->triangle = SMEAR_NO_TRIANGLE;
}

#endif

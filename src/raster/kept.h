/* SPDX-License-Identifier: MIT */
/* kept.h - setups of triangles that go on in the next rows, from tile row to tile row. Parts that no triangle of the frame has
 * use for are not kept, nor is what is found again at once: places take half of a struct setup, two thirds where triangles move
 * on their own, and the more triangles find room. */
#ifndef SMEAR_RASTER_KEPT_H
#define SMEAR_RASTER_KEPT_H

#include "raster/setup.h"
#include "raster/target.h"

/* Before the words of a setup. In memory of its own, between the pool's vertices and triangles (draws.c). */
struct kept {
    uint32_t triangle;
    int32_t end;                /* row of the frame behind its last one */
};

/* Keeps a setup for the rows before `end`. */
void smear_kept_keep(struct kept *k, struct setup *s, uint32_t triangle, int32_t end);

/* Gives it back to one whose segment is known. */
void smear_kept_take(struct kept *k, struct setup *s);

static inline struct kept *kept_at(const struct smear_raster_cache *cache, uint32_t i)
{
    return (struct kept *)(void *)((uint8_t *)cache->entry + (size_t)i * cache->entry_bytes);
}

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

/* Memory for a list's order lies before a cache's entries: this before them, the order before this. */
struct front_memory {
    uint32_t bytes;         /* of both */
};

/* Returns how many triangles of a list find room: each has a number of 16 bits and a level. */
static inline uint32_t front_order_most(const struct front_memory *m)
{
    return (m->bytes - (uint32_t)sizeof(struct front_memory)) / 3u;
}

/* Returns the bytes, a multiple of four, that the order of a frame's list takes; 0 where lists stay as they are. */
size_t smear_front_order_bytes(const struct smear_bins *bins);

/* The order of a target's list; null where there is no memory for it. */
static inline uint16_t *front_order_of(const struct smear_raster_cache *cache)
{
    const struct front_memory *const m = cache->entry != NULL ? (const struct front_memory *)cache->entry - 1 : NULL;
    return m != NULL && m->bytes > 2 * sizeof(struct front_memory) ? (uint16_t *)(void *)((uint8_t *)cache->entry - m->bytes) : NULL;
}

enum { FRONT_LEVELS = 48, FRONT_STRIPS = 16 };

/* Levels that were taken: of each strip of columns, from which level of a near end on how far back triangles were put; at first all
 * UINT8_MAX. */
struct front_taken {
    uint8_t back[FRONT_STRIPS][FRONT_LEVELS];
};

/* A triangle's columns and depths. */
struct front_range {
    int32_t x0, x1;                 /* q8 */
    int32_t farthest, nearest;      /* units q11 */
};

/* Finds how far back a triangle comes among those of columns [left, right) before it, and notes it: its level, below FRONT_LEVELS. Those of
 * higher levels may be drawn before it, and those of one level in order. */
uint32_t smear_front_level(struct front_taken *taken, const struct front_range *r, int32_t left, int32_t right);

/* Makes of how many have each level where the first of them stands, the nearest level first. Returns how many there are in all. */
static inline uint32_t front_places(uint16_t place[FRONT_LEVELS])
{
    uint32_t at = 0;
    for (int i = FRONT_LEVELS - 1; i >= 0; i--) {
        const uint32_t count = place[i];
        place[i] = (uint16_t)at;
        at += count;
    }
    return at;
}

/* Puts the numbers of a list's triangles into the target's order, the nearest first, so far as that makes no difference to any
 * pixel. Returns how many there are; 0 where the list is to be drawn as it is. */
uint32_t smear_front_order(const struct smear_raster_frame *frame, const struct smear_raster_target *target, struct smear_list list);

enum { FRONT_BLOCK = 32, FRONT_BLOCKS = 2048 / FRONT_BLOCK };

/* Whether something nearer hides all pixels of a triangle. `least`: of blocks of the target's columns, how near they have been found to be
 * in all rows; at first 0. */
bool smear_front_hides(const struct smear_raster_frame *frame, const struct smear_raster_target *target, const struct smear_triangle *t,
                       uint16_t least[FRONT_BLOCKS]);

#endif

/* SPDX-License-Identifier: MIT */
/* kept_list.h - what is kept of triangles, in the order in which they are drawn: beside a list of triangles, in which numbers only
 * grow, it is gone through once, and nothing is looked up. What is passed over has ended, and is free. */
#ifndef SMEAR_RASTER_KEPT_LIST_H
#define SMEAR_RASTER_KEPT_LIST_H

#include "raster/kept.h"

#if SMEAR_KEPT_LISTS

/* In the memory of the first entry. Entries have numbers, of which none is 0. */
struct kept_list {
    uint16_t *link;             /* the place of the number that comes next: in the list itself, or in an entry */
    uint32_t triangle;          /* of that entry; SMEAR_NO_TRIANGLE behind the last one */
    uint16_t first;             /* 0: none */
    uint16_t free;              /* those that were in use are a list, too */
    uint16_t used;              /* entries behind these never were */
    bool apart;                 /* no list of triangles has them meanwhile */
    struct flat_area area;      /* the target for which it is gone through */
    int32_t turn;               /* the row of the frame from which on rows lie at the ring's start, if they go round in the target */
    int32_t back;               /* pixels to there */
};

SMEAR_STATIC_ASSERT(sizeof(struct kept_list) <= sizeof(struct kept_face) && sizeof(struct kept_face) % 8 == 0,
                    "the list lies in an entry");

static const struct kept_list kept_none = { .triangle = SMEAR_NO_TRIANGLE };

static inline struct kept_list *kept_list_of(const struct smear_raster_cache *cache) { return (struct kept_list *)cache->entry; }

/* An empty one where nothing is kept. */
static inline const struct kept_list *kept_list_seen(const struct smear_raster_cache *cache)
{
    return SMEAR_RASTER_CACHE && cache->entries != 0 ? kept_list_of(cache) : &kept_none;
}

static inline uint32_t kept_triangle(const struct smear_raster_cache *cache, uint16_t number)
{
    return number != 0 ? kept_at(cache, number)->triangle : SMEAR_NO_TRIANGLE;
}

static inline void kept_list_clear(const struct smear_raster_cache *cache)
{
    struct kept_list *const l = kept_list_of(cache);
    *l = (struct kept_list){ .link = &l->first, .triangle = SMEAR_NO_TRIANGLE, .used = 1 };
}

/* Goes back to the first entry where another target comes. What is kept is for the same columns, and pixels of one kind. */
static inline void kept_list_begin(const struct smear_raster_target *t)
{
    if (!SMEAR_RASTER_CACHE || t->cache.entries == 0)
        return;
    struct kept_list *const l = kept_list_of(&t->cache);
    if (l->area.x0 != t->x0 || l->area.x1 != t->x1 || l->area.narrow != target_is_direct(t)) {
        SMEAR_ASSERT(!l->apart || l->first == 0);
        kept_list_clear(&t->cache);
    } else if (l->area.y0 != t->y0) {
        l->link = &l->first;
        l->triangle = kept_triangle(&t->cache, l->first);
    }
    const struct smear_plane_rows *const w = &t->window_rows;
    const int32_t at = target_row(w, t, t->y0);
    l->area = (struct flat_area){ .depth = t->depth + at, .stride = w->stride, .x0 = t->x0, .x1 = t->x1, .y0 = t->y0, .y1 = t->y1,
                                  .narrow = target_is_direct(t) };
    l->area.pixels = l->area.narrow ? (void *)(t->direct + at) : t->color + at;
    l->turn = t->y0 + (w->ring - w->ring_row);
    l->back = w->ring * w->stride;
}

/* Passes the next entry, which stays. */
static inline void kept_pass(const struct smear_raster_cache *cache, struct kept *k)
{
    struct kept_list *const l = kept_list_of(cache);
    l->link = &k->next;
    l->triangle = kept_triangle(cache, k->next);
}

/* Takes the next entry out of the list. */
static inline void kept_drop(const struct smear_raster_cache *cache)
{
    struct kept_list *const l = kept_list_of(cache);
    const uint16_t number = *l->link;
    struct kept *const k = kept_at(cache, number);
    *l->link = k->next;
    l->triangle = kept_triangle(cache, k->next);
    k->next = l->free;
    l->free = number;
}

/* Whether a triangle goes on in the target's rows: those between it and the last one may have been another worker's. */
static inline bool kept_goes_on(const struct kept_list *l, const struct kept *k) { return k->end > l->area.y0; }

/* The entry of a triangle, which is the next one then; null where it has none. */
static inline struct kept *kept_find(const struct smear_raster_cache *cache, uint32_t triangle)
{
    const struct kept_list *const l = kept_list_seen(cache);
    while (l->triangle < triangle)
        kept_drop(cache);
    if (l->triangle != triangle)
        return NULL;
    struct kept *const k = kept_at(cache, *l->link);
    if (kept_goes_on(l, k))
        return k;
    kept_drop(cache);
    return NULL;
}

/* Puts a new entry before the next one, and passes it. Null where there is no room. */
static inline struct kept *kept_add(const struct smear_raster_cache *cache, uint32_t triangle)
{
    if (!SMEAR_RASTER_CACHE || cache->entries == 0)
        return NULL;
    struct kept_list *const l = kept_list_of(cache);
    uint16_t number = l->free;
    if (number != 0)
        l->free = kept_at(cache, number)->next;
    else if (l->used < cache->entries)
        number = l->used++;
    else
        return NULL;
    struct kept *const k = kept_at(cache, number);
    k->triangle = triangle;
    k->next = *l->link;
    *l->link = number;
    l->link = &k->next;
    return k;
}

#endif

#endif

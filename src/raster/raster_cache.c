/* SPDX-License-Identifier: MIT */
/* raster_cache.c - memory for what is found out about a frame's triangles: setups of those that go on in the next rows, and orders
 * of lists. */
#include "kernels/fill.h"
#include "raster/cover.h"
#include "raster/kept.h"
#include "raster/raster.h"

enum {
    ENTRIES_MAX = 512,
    ORDER_PART = 4                  /* of the memory, at most, may hold orders of lists */
};

/* What is kept of rows of one colour has pointers. */
#define ALIGN ((uint32_t)sizeof(uintptr_t))

static inline uint32_t *kept_setup(struct kept *k) { return (uint32_t *)(void *)(k + 1); }

/* Bytes of a setup's members from one to just before another. */
#define KEPT_BYTES(from, end) (offsetof(struct setup, end) - offsetof(struct setup, from))

/* All parts are whole words. */
SMEAR_STATIC_ASSERT(offsetof(struct setup, depth) % 4 == 0 && offsetof(struct setup, texture) % 4 == 0
                        && offsetof(struct setup, texture.q) % 4 == 0 && offsetof(struct setup, channel) % 4 == 0
                        && offsetof(struct setup, area_recip) % 4 == 0 && sizeof(struct setup) % 4 == 0,
                    "setups are kept by words");

/* Copies n bytes, back to the setup or to what is kept of it. Returns what follows there. */
SMEAR_INLINE uint32_t *kept_part(struct setup *s, size_t from, size_t n, uint32_t *kept, bool back)
{
    uint32_t *const member = (uint32_t *)(void *)((uint8_t *)s + from);
    if (back)
        __builtin_memcpy(member, kept, n);
    else
        __builtin_memcpy(kept, member, n);
    return kept + n / 4;
}

/* Copies a setup whose segment is known, either way. */
SMEAR_INLINE void kept_copy(struct setup *s, uint32_t *kept, bool back)
{
    kept = kept_part(s, offsetof(struct setup, depth), KEPT_BYTES(depth, texture), kept, back);
    if (segment_textured(s->segment)) {
        kept = kept_part(s, offsetof(struct setup, texture), KEPT_BYTES(texture, texture.q), kept, back);
        if (s->texture.mode == TEXTURE_CURVED)
            kept = kept_part(s, offsetof(struct setup, texture.x0), KEPT_BYTES(texture.x0, channel), kept, back);
        else
            kept = kept_part(s, offsetof(struct setup, texture.q), KEPT_BYTES(texture.q, texture.x0), kept, back);
    }
    if (segment_gouraud(s->segment))
        kept = kept_part(s, offsetof(struct setup, channel), KEPT_BYTES(channel, area_recip), kept, back);
    if (segment_moves(s->segment) != 0)
        kept_part(s, offsetof(struct setup, area_recip), sizeof *s - offsetof(struct setup, area_recip), kept, back);
}

void smear_kept_keep(struct kept *k, struct setup *s, uint32_t triangle, int32_t end)
{
    k->triangle = triangle;
    k->end = end;
    kept_copy(s, kept_setup(k), false);
}

void smear_kept_take(struct kept *k, struct setup *s) { kept_copy(s, kept_setup(k), true); }

/* Returns how many bytes triangles of a segment need; `flat`: those of one colour. */
static inline size_t kept_bytes(const struct smear_segment *s, size_t flat)
{
    size_t bytes = sizeof(struct kept) + KEPT_BYTES(depth, texture);
    if (segment_textured(s))
        bytes += KEPT_BYTES(texture, texture.q) + KEPT_BYTES(texture.x0, channel);      /* which is more than planes take */
    if (segment_gouraud(s))
        bytes += KEPT_BYTES(channel, area_recip);
    if (segment_moves(s) != 0)
        bytes += sizeof(struct setup) - offsetof(struct setup, area_recip);
    return bytes < flat ? flat : bytes;
}

static uint32_t entry_bytes_of(const struct smear_bins *bins)
{
    const size_t flat = SMEAR_RASTER_CACHE ? smear_flat_kept_bytes() : 0;
    uint32_t entry_bytes = sizeof(struct kept);
    for (uint32_t i = 0; i < bins->segment_count; i++)
        entry_bytes = max_u32(entry_bytes, (uint32_t)kept_bytes(&bins->segment[i], flat));
    return (entry_bytes + ALIGN - 1u) & ~(ALIGN - 1u);
}

/* An order lies before the entries of each part, of fewer triangles where there is no room for all. */
static size_t order_bytes(const struct smear_bins *bins, size_t most)
{
    const size_t order = smear_front_order_bytes(bins), room = most / ORDER_PART & ~(size_t)3u;
    return ((order < room ? order : room) + sizeof(struct front_memory) + ALIGN - 1u) & ~(size_t)(ALIGN - 1u);
}

struct smear_raster_cache smear_raster_cache_make(void *memory, size_t bytes, int count, const struct smear_bins *bins)
{
    const size_t most = bytes / (size_t)count & ~(size_t)(ALIGN - 1u), before = SMEAR_FRONT_ORDER ? order_bytes(bins, most) : 0;
    if (most < before)
        return (struct smear_raster_cache){ NULL, 0, 0 };
    const uint32_t entry_bytes = entry_bytes_of(bins);
    const uint32_t entries = min_u32((uint32_t)((most - before) / entry_bytes), ENTRIES_MAX / (uint32_t)count);
    const struct smear_raster_cache cache = { (uint8_t *)memory + before, (uint16_t)entries, (uint16_t)entry_bytes };
    if (SMEAR_FRONT_ORDER)
        *((struct front_memory *)cache.entry - 1) = (struct front_memory){ (uint32_t)before };
    for (int k = 0; k < count; k++) {
        const struct smear_raster_cache part = smear_raster_cache_of(&cache, k);
        if (SMEAR_FRONT_ORDER)
            *((struct front_memory *)part.entry - 1) = (struct front_memory){ (uint32_t)before };
        for (uint32_t i = 0; i < entries; i++)
            kept_at(&part, i)->triangle = SMEAR_NO_TRIANGLE;
    }
    return cache;
}

struct smear_raster_cache smear_raster_cache_of(const struct smear_raster_cache *first, int i)
{
    struct smear_raster_cache cache = *first;
    if (i != 0 && first->entry != NULL) {
        const uint32_t before = SMEAR_FRONT_ORDER ? ((struct front_memory *)first->entry - 1)->bytes : 0;
        cache.entry = (uint8_t *)first->entry + (size_t)i * ((size_t)first->entries * first->entry_bytes + before);
    }
    return cache;
}

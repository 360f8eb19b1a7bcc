/* SPDX-License-Identifier: MIT */
/* raster_cache.c - memory for what is found out about a frame's triangles: setups of those that go on in the next rows, and orders
 * of lists. */
#include "raster/front_order.h"
#include "raster/kept.h"
#include "raster/raster.h"

enum {
    ENTRIES_MAX = 512,
    ORDER_PART = 4                  /* of the memory, at most, may hold orders of lists */
};

/* What is kept of rows of one colour has pointers. */
#define ALIGN ((uint32_t)sizeof(uintptr_t))

static uint32_t entry_bytes_of(const struct smear_bins *bins)
{
    uint32_t entry_bytes = sizeof(struct kept);
    for (uint32_t i = 0; i < bins->segment_count; i++)
        entry_bytes = max_u32(entry_bytes, (uint32_t)kept_bytes(&bins->segment[i]));
    return (entry_bytes + ALIGN - 1u) & ~(ALIGN - 1u);
}

#if SMEAR_FRONT_ORDER
struct smear_raster_cache smear_raster_cache_make(void *memory, size_t bytes, int count, const struct smear_bins *bins)
{
    const size_t n = (size_t)count, most = bytes / n & ~(size_t)(ALIGN - 1u), order = smear_front_order_bytes(bins);
    const size_t before = ((order <= most / ORDER_PART ? order : 0) + sizeof(struct front_memory) + ALIGN - 1u) & ~(size_t)(ALIGN - 1u);
    if (most < before)
        return (struct smear_raster_cache){ NULL, 0, 0 };
    const uint32_t entry_bytes = entry_bytes_of(bins);
    const uint32_t entries = min_u32((uint32_t)((most - before) / entry_bytes), ENTRIES_MAX / (uint32_t)count);
    const struct smear_raster_cache cache = { (uint8_t *)memory + before, (uint16_t)entries, (uint16_t)entry_bytes };
    ((struct front_memory *)cache.entry - 1)->bytes = (uint32_t)before;
    for (int k = 0; k < count; k++) {
        const struct smear_raster_cache part = smear_raster_cache_of(&cache, k);
        ((struct front_memory *)part.entry - 1)->bytes = (uint32_t)before;
        for (uint32_t i = 0; i < entries; i++)
            kept_at(&part, i)->triangle = SMEAR_NO_TRIANGLE;
    }
    return cache;
}

struct smear_raster_cache smear_raster_cache_of(const struct smear_raster_cache *first, int i)
{
    struct smear_raster_cache cache = *first;
    if (i != 0 && first->entry != NULL)
        cache.entry = (uint8_t *)first->entry
                    + (size_t)i * ((size_t)first->entries * first->entry_bytes + ((struct front_memory *)first->entry - 1)->bytes);
    return cache;
}
#else
struct smear_raster_cache smear_raster_cache_make(void *memory, size_t bytes, int count, const struct smear_bins *bins)
{
    const uint32_t entry_bytes = entry_bytes_of(bins);
    const uint32_t entries = min_u32((uint32_t)(bytes / entry_bytes), ENTRIES_MAX) / (uint32_t)count;
    const struct smear_raster_cache cache = { memory, (uint16_t)entries, (uint16_t)entry_bytes };
    for (uint32_t i = 0; i < entries * (uint32_t)count; i++)
        kept_at(&cache, i)->triangle = SMEAR_NO_TRIANGLE;
    return cache;
}

struct smear_raster_cache smear_raster_cache_of(const struct smear_raster_cache *first, int i)
{
    return (struct smear_raster_cache){ kept_at(first, (uint32_t)i * first->entries), first->entries, first->entry_bytes };
}
#endif

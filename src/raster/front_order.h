/* SPDX-License-Identifier: MIT */
/* front_order.h - lists of textured triangles, drawn from the front: what lies behind needs no pixels, and mostly no setup. */
#ifndef SMEAR_RASTER_FRONT_ORDER_H
#define SMEAR_RASTER_FRONT_ORDER_H

#include "raster/target.h"

/* Memory for a list's order lies before a cache's entries: this before them, the order before this. */
struct front_memory {
    uint32_t bytes;         /* of both */
};

/* Returns the bytes, a multiple of four, that the order of a frame's list takes; 0 where lists stay as they are. */
size_t smear_front_order_bytes(const struct smear_bins *bins);

/* The order of a target's list; null where there is no memory for it. */
static inline uint16_t *front_order_of(const struct smear_raster_cache *cache)
{
    const struct front_memory *const m = cache->entry != NULL ? (const struct front_memory *)cache->entry - 1 : NULL;
    return m != NULL && m->bytes > sizeof(uintptr_t) ? (uint16_t *)(void *)((uint8_t *)cache->entry - m->bytes) : NULL;
}

/* Puts the numbers of a list's triangles into the target's order, the nearest first, so far as that makes no difference to any
 * pixel. Returns how many there are; 0 where the list is to be drawn as it is. */
uint32_t smear_front_order(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head);

/* Whether something nearer hides all pixels of a triangle. */
bool smear_front_hides(const struct smear_raster_frame *frame, const struct smear_raster_target *target, const struct smear_triangle *t);

#endif

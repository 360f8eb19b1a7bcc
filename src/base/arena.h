/* SPDX-License-Identifier: MIT */
/* arena.h - cuts the caller's memory into aligned blocks; the only allocator.
 *
 * One walk over the blocks serves to measure and to cut: with no memory it only counts. */
#ifndef SMEAR_ARENA_H
#define SMEAR_ARENA_H

#include "base/base.h"

struct smear_arena {
    uint8_t *memory;            /* 8-byte aligned, or null to measure */
    size_t used;
};

/* Takes the next `count` x `size` bytes, 8-byte aligned; returns null while measuring. */
static inline void *arena_take(struct smear_arena *a, size_t count, size_t size)
{
    void *block = a->memory != NULL ? a->memory + a->used : NULL;
    a->used += (count * size + 7u) & ~(size_t)7u;
    return block;
}

#endif

/* SPDX-License-Identifier: MIT */
/* kept.h - setups of triangles that go on in the next rows, from tile row to tile row. Parts that no triangle of the frame has
 * use for are not kept, nor is what is found again at once: places take half of a struct setup, two thirds where triangles move
 * on their own, and the more triangles find room. */
#ifndef SMEAR_RASTER_KEPT_H
#define SMEAR_RASTER_KEPT_H

#include "kernels/fill.h"
#include "raster/flat_list.h"

/* Before the words of a setup. In memory of its own, between the pool's vertices and triangles (draws.c). */
struct kept {
    uint32_t triangle;
    int32_t end;                /* row of the frame behind its last one */
};

/* Of triangles of one colour that assembly draws in all of a row, the lines that it goes on from are kept. */
#define SMEAR_FLAT_KEPT SMEAR_RASTER_CACHE

#if SMEAR_FLAT_KEPT
struct kept_flat {
    struct kept kept;
    struct flat_lines lines;    /* of the next row */
    int32_t row;                /* that row */
    int32_t knee;               /* struct corners */
    uint8_t middle, bottom;     /* corners' numbers */
    bool whole_is_left;
};
#endif

static inline uint32_t *kept_setup(struct kept *k) { return (uint32_t *)(void *)(k + 1); }

/* Bytes of a setup's members from one to just before another. */
#define KEPT_BYTES(from, end) (offsetof(struct setup, end) - offsetof(struct setup, from))

/* Returns how many bytes triangles of a segment need. */
static inline size_t kept_bytes(const struct smear_segment *s)
{
    size_t bytes = sizeof(struct kept) + KEPT_BYTES(depth, texture);
    if (segment_textured(s))
        bytes += KEPT_BYTES(texture, texture.q) + KEPT_BYTES(texture.x0, channel);      /* which is more than planes take */
    if (segment_gouraud(s))
        bytes += KEPT_BYTES(channel, area_recip);
    if (segment_moves(s) != 0)
        bytes += sizeof(struct setup) - offsetof(struct setup, area_recip);
#if SMEAR_FLAT_KEPT
    if (bytes < sizeof(struct kept_flat))
        bytes = sizeof(struct kept_flat);
#endif
    return bytes;
}

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
        words_copy(member, kept, n);
    else
        words_copy(kept, member, n);
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

static inline void kept_keep(struct kept *k, struct setup *s, uint32_t triangle, int32_t end)
{
    k->triangle = triangle;
    k->end = end;
    kept_copy(s, kept_setup(k), false);
}

static inline struct kept *kept_at(const struct smear_raster_cache *cache, uint32_t i)
{
    return (struct kept *)(void *)((uint8_t *)cache->entry + (size_t)i * cache->entry_bytes);
}

static inline void kept_take(struct kept *k, struct setup *s) { kept_copy(s, kept_setup(k), true); }

#endif

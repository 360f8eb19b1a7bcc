/* SPDX-License-Identifier: MIT */
/* kept.h - setups of triangles that go on in the next rows, from tile row to tile row. Of each as many bytes are kept as its
 * triangle has use for, half of what a struct setup takes or less: the more triangles find room. */
#ifndef SMEAR_RASTER_KEPT_H
#define SMEAR_RASTER_KEPT_H

#include "raster/setup.h"

/* Memory of its own, between the pool's vertices and triangles (draws.c). */
struct kept {
    uint32_t triangle;
    int32_t end;                /* row of the frame behind its last one */
    uint8_t setup[];
};

/* Bytes of a setup's members from one to just before another. */
#define KEPT_BYTES(from, end) (offsetof(struct setup, end) - offsetof(struct setup, from))

/* Returns how many bytes triangles of a segment need. */
static inline size_t kept_bytes(const struct smear_segment *s)
{
    size_t bytes = sizeof(struct kept) + KEPT_BYTES(slope, rows);
    if (segment_textured(s))
        bytes += KEPT_BYTES(rows, texture.q) + KEPT_BYTES(texture.x0, channel);      /* which is more than planes take */
    if (segment_gouraud(s))
        bytes += KEPT_BYTES(channel, area_recip);
    if (segment_moves(s) != 0)
        bytes += sizeof(struct setup) - offsetof(struct setup, area_recip);
    return (bytes + 3u) & ~(size_t)3u;
}

/* Copies n bytes, back to the setup or to what is kept of it. Returns what follows there. */
SMEAR_INLINE uint8_t *kept_part(struct setup *s, size_t from, size_t n, uint8_t *kept, bool back)
{
    uint8_t *const member = (uint8_t *)s + from;
    if (back)
        __builtin_memcpy(member, kept, n);
    else
        __builtin_memcpy(kept, member, n);
    return kept + n;
}

/* Copies a setup whose segment is known, either way. */
SMEAR_INLINE void kept_copy(struct setup *s, uint8_t *kept, bool back)
{
    kept = kept_part(s, offsetof(struct setup, slope), KEPT_BYTES(slope, rows), kept, back);
    if (segment_textured(s->segment)) {
        kept = kept_part(s, offsetof(struct setup, rows), KEPT_BYTES(rows, texture.q), kept, back);
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
    kept_copy(s, k->setup, false);
}

static inline void kept_take(struct kept *k, struct setup *s) { kept_copy(s, k->setup, true); }

#endif

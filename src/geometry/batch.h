/* SPDX-License-Identifier: MIT */
/* batch.h - what the loops over a draw's triangles share (assemble.c, batch_clip.c). */
#ifndef SMEAR_BATCH_H
#define SMEAR_BATCH_H

#include "geometry/vertex.h"
#include "kernels/vector.h"

static inline uint32_t index_of(const struct smear_cached_vertex *v)
{
    return v->tag & 0xffffu;
}

/* Whether the display lacks one of the tiles that the box reaches into; notes where triangles are seen. */
bool smear_batch_is_damaged(const struct smear_damaged_tiles *d, const struct box *box);

static inline bool is_damaged(const struct smear_assembler *a, const struct box *box)
{
    if (!assembler_has_damage(a))
        return true;
    const struct box copy = *box;           /* elsewhere it is in registers */
    return smear_batch_is_damaged(a->damaged, &copy);
}

enum { ROOM_AHEAD = 32 };               /* triangles for which room is found at once */

/* What the loop over a draw's triangles needs for each of them. */
struct batch {
    struct smear_assembler *a;
    const struct smear_assembly *d;
    struct smear_segment *segment;      /* the newest */
    uint32_t tag;                       /* of its vertices in the cache; 0: none is there */
    bool shares;                        /* all faces of a vertex share its record */
    bool partial;                       /* only a part of the frame is being filled, or triangles have a margin */
    bool points;                        /* triangles have only a colour and a depth: tiny ones become points */
    bool double_sided;
    uint32_t *last;                     /* of the lists of tile rows that it goes to, the last triangles */
    const uint8_t *face_color;          /* flat colours that need no shading; null: they are shaded */
    const uint8_t *vertex_color;        /* codes of vertices that need no shading; null: they are shaded, or none */
    uint16_t parts;                     /* of the triangle that is clipped: those that have been added, now or before */
    uint16_t room;                      /* for so many more triangles there is room, if nothing else is added */
    struct smear_placement fine;        /* by which triangles are cut; without positions until there is one */
};

/* Whether the triangle's vertices are stored once for all faces around them. */
static inline bool batch_shares(const struct batch *b, bool back)
{
    /* Seen from behind, normals flip: such a vertex is not the one its front faces share. */
    return b->shares && (!back || !segment_by_vertices(b->segment));
}

/* Stores the words of MOTION_* of a vertex, whose segment has them. */
void smear_batch_store_motion(uint32_t *out, const struct batch *b, uint32_t index, const struct smear_screen *screen);

/* Adds what is left of a triangle that has to be clipped, as a fan. Its corners are in the mesh's order. Returns false where
 * there is no room. */
bool smear_batch_add_clipped(struct batch *b, const struct smear_cached_vertex *const corner[3], uint32_t triangle);

#endif

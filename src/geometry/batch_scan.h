/* SPDX-License-Identifier: MIT */
/* batch_scan.h - what scans of a draw's triangles (kernels/triangle_scan.h) may finish on their own. */
#ifndef SMEAR_BATCH_SCAN_H
#define SMEAR_BATCH_SCAN_H

#include "geometry/batch_find.h"

#if ASSEMBLE_SCANS

#if FRONT_COVERS
/* Where all of the frame is filled, scans find out what triangles cover, and make points of them if their colours are known, or
 * can be mixed. */
static void scan_fronts(struct triangle_scan *s, const struct batch *b, struct front_cover *front)
{
    s->front = b->partial ? NULL : front;
    const bool known = !b->points_even && !segment_colored(b->segment) && b->face_color != NULL;
#if SCAN_MIXES
    s->color = known ? b->face_color : NULL;
    s->vertex_color = b->vertex_color;
    s->even = b->points_even;
    s->rings = b->points && (known || s->vertex_color != NULL) ? &b->rings : NULL;
#else
    s->color = b->face_color;
    s->rings = b->points && known ? &b->rings : NULL;
#endif
    s->first = b->d->mesh->index;
}

/* Scans store triangles whose vertices have a record of a place alone, or with a colour that needs no shading. */
static void scan_stores(struct triangle_scan *s, const struct batch *b, struct scan_records *r)
{
    const struct smear_bins *g = b->a->bins;
    const uint32_t words = b->vertex_color != NULL ? VERTEX_BASE_WORDS + 2 : VERTEX_BASE_WORDS;
    const bool plain = b->shares && b->segment->stride == words && !is_blend(b->d)
                    && s->color == b->face_color && (s->color != NULL || b->segment->shade != SHADE_FLAT);
    *r = (struct scan_records){ &b->rings, g->pool, &b->a->bins->vertex_words, 0, 0, b->vertex_color };
    s->records = r;
    s->least = !plain ? INT32_MAX : b->points && s->rings == NULL ? SCAN_POINTS + 1 : 1;
}

/* The segment may be a new one. */
static inline void scan_segment(struct scan_records *r, const struct batch *b)
{
    r->first = b->segment->base + 1;
    r->segment = (uint32_t)(b->segment - b->a->bins->segment) << 16;
}
#endif

static inline enum scan_end scan_on(struct triangle_scan *s, struct batch *b)
{
#if FRONT_COVERS
    s->room = b->room;
    const enum scan_end at = triangle_scan(s);
    b->a->triangles_drawn += (uint32_t)(b->room - s->room);
    b->room = (uint16_t)s->room;
    return at;
#else
    (void)b;
    return triangle_scan(s);
#endif
}

#endif

#endif

/* SPDX-License-Identifier: MIT */
/* shade8.h - colours of eight vertices at once, and of points between them, for machines with AVX2. A loop over triangles
 * stores its vertices without, and lists them: colours are wanted when points are mixed of them, or at the end. */
#ifndef SMEAR_SHADE8_H
#define SMEAR_SHADE8_H

#include "geometry/vertex.h"
#include "kernels/avx2.h"

#if SMEAR_AVX2

enum { SHADE8_VERTICES = 8, SHADE8_POINTS = 32 };

/* A point between three records of the store. */
struct smear_mixed {
    struct smear_triangle *point;
    uint32_t word[3];               /* of the records */
    uint32_t w1, w2;                /* weights q16 of the second and the third one */
};

/* Of a draw: what vertices are shaded by; and those that wait for it, with points of them. */
struct smear_shade8 {
    const struct smear_shading *shading;
    const int8_t *normal;           /* or null where nothing is lit */
    const uint8_t *color;           /* or null */
    uint32_t last_normal;           /* byte from which on the last four of normals are */
    uint32_t *colors;               /* the store's pool, where the colour of a record at word 0 lies */
    uint32_t vertices, points;
    uint32_t index[SHADE8_VERTICES];        /* of vertices of the mesh */
    uint32_t back[SHADE8_VERTICES];         /* all ones where the vertex is seen from behind, else 0 */
    uint32_t word[SHADE8_VERTICES];         /* of their records */
    struct smear_triangle *point[SHADE8_POINTS];
    uint32_t corner[3][SHADE8_POINTS];      /* as struct smear_mixed has them */
    uint32_t w1[SHADE8_POINTS], w2[SHADE8_POINTS];
};

/* Whether vertices of the segment can be shaded so: by nothing of their triangle's. */
static inline bool shade8_serves(const struct smear_assembly *d, const struct smear_segment *s)
{
    const smear_mesh *mesh = d->mesh;
    return SMEAR_WITH_LINEAR && segment_colored(s) && mesh->face_color == NULL && mesh->vertex_count > 1
        && (!d->shading.lit || (mesh->normal != NULL && d->shading.even));
}

static inline void shade8_start(struct smear_shade8 *s, const struct smear_assembly *d, const struct smear_segment *segment,
                                const struct smear_bins *g)
{
    s->shading = &d->shading;
    s->normal = d->shading.lit ? d->mesh->normal : NULL;
    s->color = d->mesh->color;
    s->last_normal = 3u * d->mesh->vertex_count - 4u;
    s->colors = g->pool + segment->color;
    s->vertices = s->points = 0;
}

/* Shades the vertices that wait, as smear_shade does. */
void smear_shade8_vertices(struct smear_shade8 *s);

/* Shades all that waits, and gives points their colours: by tiny_color. */
void smear_shade8_all(struct smear_shade8 *s);

/* Lists a vertex whose record lies at `word`. */
SMEAR_AVX2_INLINE void shade8_add(struct smear_shade8 *s, uint32_t index, uint32_t word, bool back)
{
    const uint32_t i = s->vertices++;
    s->index[i] = index;
    s->back[i] = 0u - (uint32_t)back;
    s->word[i] = word;
    if (i == SHADE8_VERTICES - 1)
        smear_shade8_vertices(s);
}

/* Lists a point. */
SMEAR_AVX2_INLINE void shade8_add_point(struct smear_shade8 *s, const struct smear_mixed *p)
{
    const uint32_t i = s->points++;
    s->point[i] = p->point;
    for (int k = 0; k < 3; k++)
        s->corner[k][i] = p->word[k];
    s->w1[i] = p->w1;
    s->w2[i] = p->w2;
    if (i == SHADE8_POINTS - 1)
        smear_shade8_all(s);
}
#endif

#endif

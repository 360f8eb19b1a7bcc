/* SPDX-License-Identifier: MIT */
/* path_places.c - see path_places.h. */
#include "geometry/path_places.h"

#if SMEAR_WITH_SUBFRAMES && SMEAR_VERTEX_SETUP
void smear_path_places_open(struct path_places *p, const struct smear_assembler *a, const struct smear_assembly *d)
{
    p->d = d;
    p->viewport = &a->viewport;
    p->ready = true;
    for (int key = 0; key < KEYS && p->ready; key++)
        p->ready = smear_vertex_setup(&p->setup[key], placement_of(d, key), p->viewport);
}

bool smear_path_places_take(struct path_vertex *v, struct path_places *p, uint32_t tag)
{
    struct smear_homogeneous passing;
    v->tag = tag;
    v->stored = 0;
    v->outcodes = 0;
    for (int key = 0; key < KEYS; key++) {
        const int16_t *const position = placement_of(p->d, key)->position + 3 * (tag & 0xffffu);
        struct vertex_setup *const setup = &p->setup[key];
        if (!vertex_find(&v->screen[key], &passing, position, setup)
            && !smear_vertex_find_unready(&v->screen[key], &passing, position, setup))
            return false;
        v->outcodes |= (uint32_t)outcode_sides(&v->screen[key], p->viewport) << 8 * key;
    }
    return true;
}
#endif

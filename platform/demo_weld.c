/* SPDX-License-Identifier: MIT */
/* demo_weld.c - see demo_weld.h. */
#include "platform/demo_weld.h"

#include <string.h>

/* An array of a mesh, or null, and its copy. */
struct attribute {
    const void *from;
    void *to;
    size_t bytes;                   /* of a vertex */
};

enum { ATTRIBUTES = 4 };

/* Whether vertex `a` of the mesh is what vertex `b` of the copy is. */
static bool is_same(const struct attribute *all, uint32_t a, uint32_t b)
{
    for (int i = 0; i < ATTRIBUTES; i++)
        if (all[i].from != NULL
            && memcmp((const char *)all[i].from + a * all[i].bytes, (const char *)all[i].to + b * all[i].bytes, all[i].bytes) != 0)
            return false;
    return true;
}

/* Returns the copy of a vertex, which may be the next one, number `count`. */
static uint32_t copy_of(const struct attribute *all, uint32_t vertex, uint32_t count)
{
    uint32_t k = 0;
    while (k < count && !is_same(all, vertex, k))
        k++;
    for (int i = 0; i < ATTRIBUTES && k == count; i++)
        if (all[i].from != NULL)
            memcpy((char *)all[i].to + k * all[i].bytes, (const char *)all[i].from + vertex * all[i].bytes, all[i].bytes);
    return k;
}

bool demo_weld(struct demo_welded *out, smear_draw *draw)
{
    const smear_mesh *m = draw->mesh;
    const struct attribute all[ATTRIBUTES] = { { m->position, out->position, 3 * sizeof *m->position },
                                               { m->normal, out->normal, 3 * sizeof *m->normal },
                                               { m->uv, out->uv, 2 * sizeof *m->uv },
                                               { m->color, out->color, 4 * sizeof *m->color } };
    uint32_t count = 0;
    if (m->vertex_count > WELD_VERTICES || m->triangle_count > WELD_TRIANGLES)
        return false;
    for (uint32_t i = 0; i < 3 * m->triangle_count; i++) {
        const uint32_t k = copy_of(all, m->index[i], count);
        out->index[i] = (uint16_t)k;
        count += k == count;
    }
    out->mesh = *m;
    out->mesh.position = out->position;
    out->mesh.normal = m->normal != NULL ? out->normal : NULL;
    out->mesh.uv = m->uv != NULL ? out->uv : NULL;
    out->mesh.color = m->color != NULL ? out->color : NULL;
    out->mesh.index = out->index;
    out->mesh.vertex_count = (uint16_t)count;
    draw->mesh = &out->mesh;
    return true;
}

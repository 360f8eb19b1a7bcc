/* SPDX-License-Identifier: MIT */
/* weld.c - vertices that are equal in everything the device sees become one; triangles that lose a corner by
 * it go. Vertices keep the order in which they come first. */
#include "tools/convert/build.h"

#include <string.h>

/* Everything of vertex `v`, as bytes; returns how many. */
static size_t vertex_bytes(const struct raw_mesh *m, int v, uint8_t *out)
{
    size_t n = 0, at = (size_t)v, vertices = (size_t)m->vertex_count;
    memcpy(out, m->position + 3 * at, 6);
    n += 6;
    if (m->normal != NULL) {
        memcpy(out + n, m->normal + 3 * at, 3);
        n += 3;
    }
    if (m->uv != NULL) {
        memcpy(out + n, m->uv + 2 * at, 4);
        n += 4;
    }
    if (m->color != NULL) {
        memcpy(out + n, m->color + 4 * at, 4);
        n += 4;
    }
    if (m->influences > 0) {
        size_t bytes = 2 * (size_t)m->influences - 1;
        memcpy(out + n, m->influence + bytes * at, bytes);
        n += bytes;
    }
    for (size_t t = 0; t < (size_t)m->target_count; t++) {
        memcpy(out + n, m->delta + 3 * (t * vertices + at), 3 * sizeof *m->delta);
        n += 3 * sizeof *m->delta;
        if (m->delta_normal != NULL) {
            memcpy(out + n, m->delta_normal + 3 * (t * vertices + at), 3);
            n += 3;
        }
    }
    return n;
}

static void move_vertex(struct raw_mesh *m, int to, int from)
{
    memmove(m->position + 3 * to, m->position + 3 * from, 6);
    if (m->normal != NULL)
        memmove(m->normal + 3 * to, m->normal + 3 * from, 3);
    if (m->uv != NULL)
        memmove(m->uv + 2 * to, m->uv + 2 * from, 4);
    if (m->color != NULL)
        memmove(m->color + 4 * to, m->color + 4 * from, 4);
    if (m->influences > 0) {
        int bytes = 2 * m->influences - 1;
        memmove(m->influence + bytes * to, m->influence + bytes * from, (size_t)bytes);
    }
}

/* Deltas lie target after target, so they move when the number of vertices is known. */
static void compact_deltas(struct raw_mesh *m, const int *kept, int kept_count)
{
    for (int t = 0; t < m->target_count; t++)
        for (int i = 0; i < kept_count; i++) {
            size_t to = (size_t)t * (size_t)kept_count + (size_t)i;
            size_t from = (size_t)t * (size_t)m->vertex_count + (size_t)kept[i];
            memmove(m->delta + 3 * to, m->delta + 3 * from, 3 * sizeof *m->delta);
            if (m->delta_normal != NULL)
                memmove(m->delta_normal + 3 * to, m->delta_normal + 3 * from, 3);
        }
}

static void drop_triangles(struct raw_mesh *m, const int *new_index)
{
    int kept = 0;
    for (int t = 0; t < m->triangle_count; t++) {
        uint16_t corner[3];
        for (int k = 0; k < 3; k++)
            corner[k] = (uint16_t)new_index[m->index[3 * t + k]];
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0])
            continue;
        memcpy(m->index + 3 * kept, corner, sizeof corner);
        if (m->face_color != NULL)
            memmove(m->face_color + 4 * kept, m->face_color + 4 * t, 4);
        kept++;
    }
    m->triangle_count = kept;
}

bool weld_vertices(struct raw_mesh *m, struct convert_pile *pile, struct failure *f)
{
    size_t vertices = (size_t)m->vertex_count, slots = 16;
    while (slots < 2 * vertices)
        slots *= 2;
    size_t most = 6 + 3 + 4 + 4 + 8 + (size_t)m->target_count * 15;
    int *slot = pile_alloc(pile, slots, sizeof *slot, f);
    int *new_index = pile_alloc(pile, vertices, sizeof *new_index, f);
    int *kept = pile_alloc(pile, vertices, sizeof *kept, f);
    uint8_t *own = pile_alloc(pile, 2, most, f);
    if (slot == NULL || new_index == NULL || kept == NULL || own == NULL)
        return false;
    int count = 0;
    for (int v = 0; v < m->vertex_count; v++) {
        size_t bytes = vertex_bytes(m, v, own);
        uint32_t hash = 2166136261u;
        for (size_t i = 0; i < bytes; i++)
            hash = (hash ^ own[i]) * 16777619u;
        size_t at = (hash ^ hash >> 15) & (slots - 1);
        while (slot[at] != 0) {
            vertex_bytes(m, kept[slot[at] - 1], own + most);
            if (memcmp(own, own + most, bytes) == 0)
                break;
            at = (at + 1) & (slots - 1);
        }
        if (slot[at] == 0) {
            kept[count] = v;
            slot[at] = ++count;
        }
        new_index[v] = slot[at] - 1;
    }
    for (int i = 0; i < count; i++)
        if (kept[i] != i)
            move_vertex(m, i, kept[i]);
    compact_deltas(m, kept, count);
    for (int i = 0; i < m->origin_count; i++)
        m->origin[i].mesh_vertex = new_index[m->origin[i].mesh_vertex];
    drop_triangles(m, new_index);
    m->vertex_count = count;
    return true;
}

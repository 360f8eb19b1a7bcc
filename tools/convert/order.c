/* SPDX-License-Identifier: MIT */
/* order.c - triangles in an order that finds transformed vertices again.
 *
 * The library remembers them in a direct-mapped cache: vertex v lies in slot v mod 64, of draws that stand still
 * mod 128 (src/geometry/assemble.c). So both orders matter: that of the triangles, and the numbers of the vertices. Vertices are
 * numbered as they come first, which makes the cache hold the newest 64 as long as nothing older is asked for. Triangles are
 * taken one by one: of those at a vertex in the cache the one that has to transform the fewest vertices;
 * among equals the one whose vertices have the fewest triangles left, or lie there longest. Whichever order
 * transforms the fewest vertices is kept, the file's own among them. */
#include "tools/convert/build.h"

#include <limits.h>
#include <string.h>

enum {
    SLOTS = 64,                 /* half of smear_desc.vertex_cache by default: moving vertices take two */
    MAX_LOOKS = 128,            /* triangles at a vertex that are looked at: more share none but the hubs of wheels */
    FEW_LOOKS = 4,              /* in a try that has looked at so many, as only tangles do: a second */
    MANY_LOOKS = 1 << 26
};

int count_transforms(const uint32_t *index, int triangles)
{
    int64_t slot[SLOTS];
    int count = 0;
    for (int i = 0; i < SLOTS; i++)
        slot[i] = -1;
    for (int i = 0; i < 3 * triangles; i++) {
        if (slot[index[i] % SLOTS] == (int64_t)index[i])
            continue;
        slot[index[i] % SLOTS] = (int64_t)index[i];
        count++;
    }
    return count;
}

/* Of all tries together: seconds. Meshes of a quarter million triangles stay below it, tangles of as many do not. */
static const double max_looks = 1 << 30;

/* What decides between triangles that transform equally many vertices. */
struct taste {
    int left, age;
};

struct walk {
    const struct raw_mesh *mesh;
    int *first, *triangle;      /* triangles of vertex v: triangle[first[v]] .. triangle[first[v + 1] - 1] */
    int *left;                  /* per vertex: triangles not taken, which are the first of those */
    int *place;                 /* per corner of a triangle: where it stands among those of its vertex */
    int *number;                /* per vertex: its new number, or -1 */
    int *vertex;                /* per new number: the vertex */
    int numbers;
    int looks;                  /* in this try */
    int slot[SLOTS];            /* new number, or -1 */
    bool *taken;
    struct taste taste;
};

static bool is_cached(const struct walk *w, int vertex)
{
    return w->number[vertex] >= 0 && w->slot[w->number[vertex] % SLOTS] == w->number[vertex];
}

/* The smaller, the sooner. */
static int cost_of(const struct walk *w, int triangle)
{
    int misses = 0, left = 0, age = 0;
    for (int k = 0; k < 3; k++) {
        int v = w->mesh->index[3 * triangle + k];
        if (is_cached(w, v))
            age += w->numbers - w->number[v];
        else
            misses++;
        left += w->left[v];
    }
    return 4096 * misses + w->taste.left * (left < 60 ? left : 60) - w->taste.age * (age < 192 ? age : 192);
}

static int next_triangle(struct walk *w, int *lowest)
{
    const int most = w->looks < MANY_LOOKS ? MAX_LOOKS : FEW_LOOKS;
    int best = -1, best_cost = INT_MAX;
    for (int i = 0; i < SLOTS; i++) {
        if (w->slot[i] < 0)
            continue;
        int v = w->vertex[w->slot[i]];
        for (int k = 0; k < w->left[v] && k < most; k++) {
            w->looks++;
            int t = w->triangle[w->first[v] + k];
            int cost = cost_of(w, t);
            if (cost < best_cost || (cost == best_cost && t < best)) {
                best = t;
                best_cost = cost;
            }
        }
    }
    while (best < 0 && w->taken[*lowest])
        ++*lowest;
    return best >= 0 ? best : *lowest;
}

static int corner_of(const struct walk *w, int triangle, int vertex)
{
    const uint16_t *index = w->mesh->index + 3 * triangle;
    return 3 * triangle + (index[0] == vertex ? 0 : index[1] == vertex ? 1 : 2);
}

/* The triangle goes behind those at `vertex` that are not taken. */
static void drop(struct walk *w, int vertex, int triangle)
{
    int *at = w->triangle + w->first[vertex], last = --w->left[vertex];
    int *place = &w->place[corner_of(w, triangle, vertex)], *place_of_last = &w->place[corner_of(w, at[last], vertex)];
    at[*place] = at[last];
    *place_of_last = *place;
    at[last] = triangle;
    *place = last;
}

static void take(struct walk *w, int triangle)
{
    w->taken[triangle] = true;
    for (int k = 0; k < 3; k++) {
        int v = w->mesh->index[3 * triangle + k];
        drop(w, v, triangle);
        if (w->number[v] < 0) {
            w->number[v] = w->numbers;
            w->vertex[w->numbers++] = v;
        }
        w->slot[w->number[v] % SLOTS] = w->number[v];
    }
}

/* A whole order into `order`; vertices are numbered on the way. Returns how many are transformed. */
static int walk_all(struct walk *w, bool keep_order, int *order, uint32_t *index)
{
    const struct raw_mesh *m = w->mesh;
    int lowest = 0;
    for (int v = 0; v < m->vertex_count; v++) {
        w->number[v] = -1;
        w->left[v] = w->first[v + 1] - w->first[v];
    }
    for (int i = 0; i < SLOTS; i++)
        w->slot[i] = -1;
    memset(w->taken, 0, (size_t)m->triangle_count * sizeof *w->taken);
    w->numbers = 0;
    w->looks = 0;
    for (int i = 0; i < m->triangle_count; i++) {
        order[i] = keep_order ? i : next_triangle(w, &lowest);
        take(w, order[i]);
        for (int k = 0; k < 3; k++)
            index[3 * i + k] = (uint32_t)w->number[m->index[3 * order[i] + k]];
    }
    return count_transforms(index, m->triangle_count);
}

static bool list_triangles(struct walk *w, struct convert_pile *pile, struct failure *f)
{
    const struct raw_mesh *m = w->mesh;
    size_t vertices = (size_t)m->vertex_count, triangles = (size_t)m->triangle_count;
    w->first = pile_alloc(pile, vertices + 2, sizeof *w->first, f);
    w->triangle = pile_alloc(pile, 3 * triangles, sizeof *w->triangle, f);
    w->left = pile_alloc(pile, vertices, sizeof *w->left, f);
    w->place = pile_alloc(pile, 3 * triangles, sizeof *w->place, f);
    w->number = pile_alloc(pile, vertices, sizeof *w->number, f);
    w->vertex = pile_alloc(pile, vertices, sizeof *w->vertex, f);
    w->taken = pile_alloc(pile, triangles, sizeof *w->taken, f);
    if (w->first == NULL || w->triangle == NULL || w->left == NULL || w->place == NULL || w->number == NULL || w->vertex == NULL
        || w->taken == NULL)
        return false;
    for (size_t i = 0; i < 3 * triangles; i++)
        w->first[m->index[i] + 2]++;
    for (size_t v = 0; v < vertices; v++)
        w->first[v + 2] += w->first[v + 1];
    for (size_t i = 0; i < 3 * triangles; i++) {
        w->place[i] = w->first[m->index[i] + 1];
        w->triangle[w->first[m->index[i] + 1]++] = (int)(i / 3);
    }
    for (size_t i = 0; i < 3 * triangles; i++)
        w->place[i] -= w->first[m->index[i]];
    return true;
}

/* Puts triangles and vertices into the new order. */
static bool reorder(struct raw_mesh *m, const int *order, const uint32_t *index, struct convert_pile *pile,
                    struct failure *f)
{
    size_t vertices = (size_t)m->vertex_count, triangles = (size_t)m->triangle_count;
    int *number = pile_alloc(pile, vertices, sizeof *number, f);
    struct raw_mesh old = *m;
    old.position = pile_alloc(pile, vertices, 6, f);
    old.normal = pile_alloc(pile, vertices, 3, f);
    old.uv = pile_alloc(pile, vertices, 4, f);
    old.color = pile_alloc(pile, vertices, 4, f);
    old.influence = pile_alloc(pile, vertices, 7, f);
    old.face_color = pile_alloc(pile, triangles, 4, f);
    old.delta = pile_alloc(pile, vertices * (size_t)m->target_count, 3 * sizeof *old.delta, f);
    old.delta_normal = pile_alloc(pile, vertices * (size_t)m->target_count, 3, f);
    old.index = pile_alloc(pile, triangles, 6, f);
    if (number == NULL || old.position == NULL || old.normal == NULL || old.uv == NULL || old.color == NULL
        || old.influence == NULL || old.face_color == NULL || old.delta == NULL || old.delta_normal == NULL
        || old.index == NULL)
        return false;
    size_t bytes = m->influences > 0 ? 2 * (size_t)m->influences - 1 : 0, targets = (size_t)m->target_count;
    memcpy(old.position, m->position, 6 * vertices);
    memcpy(old.index, m->index, 6 * triangles);
    if (m->normal != NULL)
        memcpy(old.normal, m->normal, 3 * vertices);
    if (m->uv != NULL)
        memcpy(old.uv, m->uv, 4 * vertices);
    if (m->color != NULL)
        memcpy(old.color, m->color, 4 * vertices);
    if (bytes > 0)
        memcpy(old.influence, m->influence, bytes * vertices);
    if (m->face_color != NULL)
        memcpy(old.face_color, m->face_color, 4 * triangles);
    if (targets > 0)
        memcpy(old.delta, m->delta, 3 * sizeof *old.delta * vertices * targets);
    if (targets > 0 && m->delta_normal != NULL)
        memcpy(old.delta_normal, m->delta_normal, 3 * vertices * targets);

    for (size_t v = 0; v < vertices; v++)
        number[v] = -1;
    for (size_t i = 0; i < triangles; i++) {
        for (size_t k = 0; k < 3; k++) {
            number[old.index[3 * (size_t)order[i] + k]] = (int)index[3 * i + k];
            m->index[3 * i + k] = (uint16_t)index[3 * i + k];
        }
        if (m->face_color != NULL)
            memcpy(m->face_color + 4 * i, old.face_color + 4 * (size_t)order[i], 4);
    }
    size_t used = 0;
    for (size_t v = 0; v < vertices; v++)
        used += number[v] >= 0;
    for (size_t v = 0; v < vertices; v++) {
        if (number[v] < 0)
            continue;
        size_t to = (size_t)number[v];
        memcpy(m->position + 3 * to, old.position + 3 * v, 6);
        if (m->normal != NULL)
            memcpy(m->normal + 3 * to, old.normal + 3 * v, 3);
        if (m->uv != NULL)
            memcpy(m->uv + 2 * to, old.uv + 2 * v, 4);
        if (m->color != NULL)
            memcpy(m->color + 4 * to, old.color + 4 * v, 4);
        if (bytes > 0)
            memcpy(m->influence + bytes * to, old.influence + bytes * v, bytes);
        for (size_t t = 0; t < targets; t++) {
            memcpy(m->delta + 3 * (t * used + to), old.delta + 3 * (t * vertices + v), 3 * sizeof *m->delta);
            if (m->delta_normal != NULL)
                memcpy(m->delta_normal + 3 * (t * used + to), old.delta_normal + 3 * (t * vertices + v), 3);
        }
    }
    int origins = 0;
    for (int i = 0; i < m->origin_count; i++) {
        struct convert_origin o = m->origin[i];
        o.mesh_vertex = number[o.mesh_vertex];
        if (o.mesh_vertex >= 0)
            m->origin[origins++] = o;
    }
    m->origin_count = origins;
    m->vertex_count = (int)used;
    return true;
}

bool order_triangles(struct raw_mesh *m, bool keep_order, struct convert_pile *pile, struct failure *f)
{
    static const struct taste tastes[] = { { 0, 0 }, { 8, 0 }, { 0, 1 }, { 8, 1 }, { 4, 4 }, { 64, 1 } };
    int tries = keep_order ? 0 : (int)(sizeof tastes / sizeof *tastes), best = INT_MAX;
    struct walk w = { .mesh = m };
    size_t triangles = (size_t)m->triangle_count;
    double valence = 3.0 * (double)triangles / (m->vertex_count > 0 ? m->vertex_count : 1);
    if ((double)triangles * SLOTS * (valence < MAX_LOOKS ? valence : MAX_LOOKS) * tries > max_looks)
        tries = 1;
    int *order[2] = { pile_alloc(pile, triangles, sizeof(int), f),
                      pile_alloc(pile, triangles, sizeof(int), f) };
    uint32_t *index[2] = { pile_alloc(pile, triangles, 3 * sizeof(uint32_t), f),
                           pile_alloc(pile, triangles, 3 * sizeof(uint32_t), f) };
    if (order[0] == NULL || order[1] == NULL || index[0] == NULL || index[1] == NULL
        || !list_triangles(&w, pile, f))
        return false;
    for (int i = -1; i < tries; i++) {          /* -1: the file's order of triangles */
        if (i >= 0)
            w.taste = tastes[i];
        int count = walk_all(&w, i < 0, order[1], index[1]);
        if (count >= best)
            continue;
        best = count;
        memcpy(order[0], order[1], triangles * sizeof(int));
        memcpy(index[0], index[1], 3 * triangles * sizeof(uint32_t));
    }
    /* the file's numbers may suit the cache even better */
    bool uses_all = true;
    for (int v = 0; v < m->vertex_count; v++)
        uses_all = uses_all && w.first[v + 1] > w.first[v];
    for (size_t i = 0; i < 3 * triangles; i++)
        index[1][i] = m->index[i];
    if (uses_all && count_transforms(index[1], m->triangle_count) <= best)
        return true;
    return reorder(m, order[0], index[0], pile, f);
}

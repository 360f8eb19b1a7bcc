/* SPDX-License-Identifier: MIT */
/* limits.c - what is refused before any work is done: more than the flash of a small machine holds, or work that grows
 * with the product of two things of the model. A file of a few bytes may ask for either by naming one thing often. */
#include "tools/convert/build.h"

#include <math.h>

enum { MAX_DRAWS = 4096, MAX_TRIANGLES = 1 << 18, MAX_NODES = 16384, MAX_KEYS = 1 << 20, MAX_CHANNELS = 16384 };
/* Vertices at instants, each with its joints and targets; a few seconds of them. */
static const double max_terms = (double)((int64_t)1 << 31);
/* Instants at which a clip is looked at: for bounds at 120 Hz (nodes.c), for errors at 60 Hz (measure.c). */
static const double instants_per_second = 180, max_instants = 1242;
/* What a node's transform costs, in terms. */
enum { NODE_TERMS = 16 };

struct work {
    double draws, triangles, vertices, terms, climbs;   /* climbs: vertices times the nodes above them */
    double channels, keys, instants;
};

/* Nodes above each node; parents come first. */
static int *depths(struct converter *c)
{
    const struct model *m = c->model;
    int *depth = pile_alloc(c->pile, (size_t)m->node_count, sizeof *depth, c->f);
    for (int i = 0; depth != NULL && i < m->node_count; i++) {
        int node = m->order[i], parent = m->node[node].parent;
        depth[node] = parent >= 0 ? depth[parent] + 1 : 1;
    }
    return depth;
}

static void add_node(struct work *w, const struct model *m, const struct model_node *node, int depth)
{
    const struct model_mesh *mesh = &m->mesh[node->mesh];
    int deepest = depth;
    for (int k = 0; k < mesh->primitive_count; k++) {
        const struct model_primitive *p = &mesh->primitive[k];
        w->draws++;
        w->triangles += p->triangle_count;
        w->vertices += p->vertex_count;
        w->terms += (double)p->vertex_count * (1 + p->influences + p->target_count);
        w->climbs += (double)p->vertex_count * deepest * (1 + p->influences);
    }
}

bool check_work(struct converter *c)
{
    const struct model *m = c->model;
    struct work w = { 0 };
    if (m->node_count > MAX_NODES)
        return fail(c->f, "has %d nodes, more than %d", m->node_count, MAX_NODES);
    int *depth = depths(c);
    if (depth == NULL)
        return false;
    for (int i = 0; i < m->node_count; i++)
        if (m->in_scene[i] && m->node[i].mesh >= 0)
            add_node(&w, m, &m->node[i], depth[i]);
    for (int i = 0; i < c->options->clip_count; i++) {
        const struct model_clip *clip = &m->clip[c->options->clip[i]];
        w.instants += fmin(ceil(clip->duration * instants_per_second), max_instants) + 2;
        w.channels += clip->channel_count;
        for (int k = 0; k < clip->channel_count; k++)
            w.keys += clip->channel[k].key_count;
    }
    if (w.draws > MAX_DRAWS)
        return fail(c->f, "has %.0f draws, more than %d", w.draws, MAX_DRAWS);
    if (w.triangles > MAX_TRIANGLES)
        return fail(c->f, "has %.0f triangles, more than %d", w.triangles, MAX_TRIANGLES);
    if (w.channels > MAX_CHANNELS || w.keys > MAX_KEYS)
        return fail(c->f, "has %.0f channels and %.0f keys, more than %d or %d (--clip)", w.channels, w.keys, MAX_CHANNELS,
                    MAX_KEYS);
    double terms = (w.instants + 1) * (w.terms + NODE_TERMS * m->node_count) + NODE_TERMS * w.channels * m->node_count + w.climbs;
    return terms <= max_terms
        || fail(c->f, "is too much work: %.0f vertices and %d nodes at %.0f instants (--clip)", w.vertices, m->node_count, w.instants);
}

/* SPDX-License-Identifier: MIT */
/* nodes.c - which nodes of a model have to be nodes on the device. The others go into what hangs on them:
 * vertices of a mesh that stands still, matrices of joints. Then scales: every node's basis is kept near one
 * by a power of two, and places are counted in units that suit the model's size. */
#include "tools/convert/build.h"

#include "tools/model/exact.h"
#include "tools/convert/track.h"

#include "tools/model/matrix.h"

#include <math.h>
#include <string.h>

/* Places of a model lie within this many of its units; the device has room for eight
 * times as many, for what its joints take there. */
#define MODEL_UNITS 256.0

/* Q16.16 ends at 32768. */
#define WORLD_UNITS 30000.0

/* ------------------------------------------------------------------ what is drawn */

static bool is_skinned(const struct model_node *node, const struct model_primitive *p)
{
    return node->skin >= 0 && p->joint != NULL;
}

static void use_node(struct converter *c, int node)
{
    for (; node >= 0 && !c->used[node]; node = c->model->node[node].parent)
        c->used[node] = true;
}

static bool find_skin(struct converter *c, int source, int *skin)
{
    for (*skin = 0; *skin < c->skin_count; ++*skin)
        if (c->skin[*skin].source == source)
            return true;
    struct out_skin *s = &c->skin[c->skin_count++];
    int joints = c->model->skin[source].joint_count;
    s->source = source;
    s->in = s->out = empty_bounds;
    s->place_of = pile_alloc(c->pile, (size_t)joints, sizeof *s->place_of, c->f);
    for (int i = 0; s->place_of != NULL && i < joints; i++)
        s->place_of[i] = -1;
    return s->place_of != NULL;
}

bool find_draws(struct converter *c)
{
    const struct model *m = c->model;
    int count = 0;
    for (int i = 0; i < m->node_count; i++)
        if (m->in_scene[i] && m->node[i].mesh >= 0)
            count += m->mesh[m->node[i].mesh].primitive_count;
    c->draw = pile_alloc(c->pile, (size_t)count, sizeof *c->draw, c->f);
    c->skin = pile_alloc(c->pile, (size_t)m->skin_count, sizeof *c->skin, c->f);
    c->used = pile_alloc(c->pile, (size_t)m->node_count, sizeof *c->used, c->f);
    if (c->draw == NULL || c->skin == NULL || c->used == NULL)
        return false;
    for (int i = 0; i < m->node_count; i++) {
        const struct model_node *node = &m->node[i];
        for (int k = 0; m->in_scene[i] && node->mesh >= 0 && k < m->mesh[node->mesh].primitive_count; k++) {
            struct source_draw *d = &c->draw[c->draw_count++];
            *d = (struct source_draw){ .node = i, .primitive_of_mesh = k, .skin = -1,
                                       .primitive = &m->mesh[node->mesh].primitive[k] };
            if (!is_skinned(node, d->primitive)) {
                use_node(c, i);
                continue;
            }
            if (!find_skin(c, node->skin, &d->skin))
                return false;
            for (int j = 0; j < m->skin[node->skin].joint_count; j++)
                use_node(c, m->skin[node->skin].joint[j]);
        }
    }
    return true;
}

/* ------------------------------------------------------------------ what moves */

static void reach_vertex(struct converter *c, const struct track_pose *pose, int node, const double at[3])
{
    for (; node >= 0; node = c->model->node[node].parent) {
        const double *origin = pose->world[node] + 12;
        double x = at[0] - origin[0], y = at[1] - origin[1], z = at[2] - origin[2];
        double distance = sqrt(x * x + y * y + z * z);
        if (distance > c->reach[node])
            c->reach[node] = distance;
    }
}

static void reach_skinned(struct converter *c, const struct track_pose *pose, const struct source_draw *d)
{
    const struct model_primitive *p = d->primitive;
    const struct model_skin *skin = &c->model->skin[c->model->node[d->node].skin];
    for (int i = 0; i < p->vertex_count * p->influences; i++) {
        int joint = p->joint[i], node = skin->joint[joint];
        const float *v = p->position + 3 * (i / p->influences);
        const double at[3] = { (double)v[0], (double)v[1], (double)v[2] };
        double bound[3], world[3];
        if (!(p->weight[i] > 0))
            continue;
        transform_double(bound, skin->inverse_bind + 16 * joint, at);
        transform_double(world, pose->world[node], bound);
        reach_vertex(c, pose, node, world);
    }
}

/* How far from each node's place its vertices are. */
static void find_reach(struct converter *c, const struct track_pose *pose)
{
    for (int i = 0; i < c->draw_count; i++) {
        const struct source_draw *d = &c->draw[i];
        if (d->skin >= 0) {
            reach_skinned(c, pose, d);
            continue;
        }
        for (int v = 0; v < d->primitive->vertex_count; v++) {
            const float *p = d->primitive->position + 3 * v;
            const double at[3] = { (double)p[0], (double)p[1], (double)p[2] };
            double world[3];
            transform_double(world, pose->world[d->node], at);
            reach_vertex(c, pose, d->node, world);
        }
    }
}

bool find_moving_nodes(struct converter *c)
{
    const struct model *m = c->model;
    struct track_pose pose;
    c->reach = pile_alloc(c->pile, (size_t)m->node_count, sizeof *c->reach, c->f);
    c->moves = pile_alloc(c->pile, (size_t)m->node_count, sizeof *c->moves, c->f);
    if (c->reach == NULL || c->moves == NULL || !track_pose_alloc(&pose, m, c->f))
        return false;
    track_pose_set(&pose, m, -1, 0, c->root);
    find_reach(c, &pose);
    for (int i = 0; i < c->options->clip_count; i++)
        for (int k = 0; k < 5; k++) {
            track_pose_set(&pose, m, c->options->clip[i], m->clip[c->options->clip[i]].duration * k / 4,
                           c->root);
            find_reach(c, &pose);
        }
    track_pose_free(&pose);
    for (int i = 0; i < c->options->clip_count; i++) {
        const struct model_clip *clip = &m->clip[c->options->clip[i]];
        for (int k = 0; k < clip->channel_count; k++)
            if (c->used[clip->channel[k].node] && clip->channel[k].path != MODEL_WEIGHTS
                && channel_moves(c, &clip->channel[k]))
                c->moves[clip->channel[k].node] = true;
    }
    return true;
}

/* ------------------------------------------------------------------ nodes of the result */

static int add_node(struct converter *c, int source, int parent, bool moves, const double fixed[16])
{
    struct out_node *n = &c->node[c->node_count];
    *n = (struct out_node){ .source = source, .parent = parent, .moves = moves };
    memcpy(n->fixed, fixed, sizeof n->fixed);
    return c->node_count++;
}

/* The node of the result that stands exactly where this carrier is. */
static int node_at(struct converter *c, const struct carrier *at, int source)
{
    if (at->node != NO_NODE && is_identity(at->matrix))
        return at->node;
    return add_node(c, source, at->node, false, at->matrix);
}

/* Where the children of a node stand; of NO_NODE: the roots. */
static struct carrier *carrier_of(struct converter *c, int n)
{
    return n >= 0 ? &c->carrier[n] : &c->root_carrier;
}

static void stand_on_node(struct converter *c, struct carrier *at, int source)
{
    at->node = node_at(c, at, source);
    matrix_identity(at->matrix);
}

static void carry(struct converter *c, int n, const struct track_pose *rest)
{
    struct carrier *above = carrier_of(c, c->model->node[n].parent), *own = &c->carrier[n];
    bool is_kept = c->options->keep != NULL && c->options->keep[n];
    double local[16];
    if (c->moves[n] && !is_identity(above->matrix))
        stand_on_node(c, above, NO_NODE);
    track_local(rest, c->model, n, local);
    own->node = above->node;
    matrix_multiply(own->matrix, above->matrix, local);
    if (!c->moves[n] && !is_kept)
        return;
    own->node = add_node(c, n, above->node, c->moves[n], own->matrix);
    matrix_identity(own->matrix);
    c->node_of[n] = own->node;
}

/* Rigid draws: into the vertices, unless several nodes share the mesh. */
static void place_draws(struct converter *c)
{
    const struct model *m = c->model;
    for (int i = 0; i < c->draw_count; i++) {
        struct source_draw *d = &c->draw[i];
        int users = 0;
        if (d->skin >= 0)
            continue;
        for (int n = 0; n < m->node_count; n++)
            users += m->in_scene[n] && m->node[n].mesh == m->node[d->node].mesh;
        struct carrier *at = &c->carrier[d->node];
        if (users > 1 && !is_identity(at->matrix)) {
            stand_on_node(c, at, d->node);
            c->node_of[d->node] = at->node;
        }
        d->at = *at;
        d->is_shared = users > 1;
        d->bakes = !is_identity(at->matrix);
    }
}

bool find_carriers(struct converter *c)
{
    const struct model *m = c->model;
    struct track_pose rest;
    /* at most: each node, one above it, and one for its mesh or joint */
    c->node = pile_alloc(c->pile, 3 * (size_t)m->node_count, sizeof *c->node, c->f);
    c->carrier = pile_alloc(c->pile, (size_t)m->node_count, sizeof *c->carrier, c->f);
    c->node_of = pile_alloc(c->pile, (size_t)m->node_count, sizeof *c->node_of, c->f);
    if (c->node == NULL || c->carrier == NULL || c->node_of == NULL || !track_pose_alloc(&rest, m, c->f))
        return false;
    track_pose_set(&rest, m, -1, 0, c->root);
    c->root_carrier.node = NO_NODE;
    memcpy(c->root_carrier.matrix, c->root, sizeof c->root);
    for (int i = 0; i < m->node_count; i++)
        c->node_of[i] = NO_NODE;
    for (int i = 0; i < m->node_count; i++)
        if (c->used[m->order[i]])
            carry(c, m->order[i], &rest);
    track_pose_free(&rest);
    place_draws(c);
    /* joints need a node; what lies between goes into their matrices */
    for (int i = 0; i < c->skin_count; i++) {
        const struct model_skin *skin = &m->skin[c->skin[i].source];
        for (int j = 0; j < skin->joint_count; j++) {
            struct carrier *at = &c->carrier[skin->joint[j]];
            if (at->node == NO_NODE)
                stand_on_node(c, at, skin->joint[j]);
        }
    }
    if (c->node_count >= (int)SMEAR_MODEL_NONE)
        return fail(c->f, "has more than 65534 nodes that move");
    return true;
}

/* ------------------------------------------------------------------ bounds over all instants */

static bool list_instants(struct converter *c)
{
    const double rate = 120;
    int count = 1;
    for (int i = 0; i < c->options->clip_count; i++)
        count += (int)fmin(ceil(c->model->clip[c->options->clip[i]].duration * rate), 1000) + 1;
    c->instant = pile_alloc(c->pile, (size_t)count, sizeof *c->instant, c->f);
    if (c->instant == NULL)
        return false;
    c->instant[c->instant_count++] = (struct instant){ .clip = -1 };
    for (int i = 0; i < c->options->clip_count; i++) {
        double duration = c->model->clip[c->options->clip[i]].duration;
        int steps = (int)fmin(ceil(duration * rate), 1000);
        for (int k = 0; k <= steps; k++)
            c->instant[c->instant_count++] = (struct instant){
                .clip = c->options->clip[i], .time = steps > 0 ? duration * k / steps : 0
            };
    }
    return true;
}

static void add_point(struct bounds *b, const double at[3])
{
    for (int axis = 0; axis < 3; axis++) {
        b->min[axis] = fmin(b->min[axis], at[axis]);
        b->max[axis] = fmax(b->max[axis], at[axis]);
    }
}

/* A vertex of a shape with the weights of its morph targets. */
static void morphed(double out[3], const struct converter *c, const struct shape *s, int vertex,
                    const double *weight)
{
    const struct convert_origin *o = &s->origin[vertex];
    const struct source_draw *d = &c->draw[o->draw];
    const float *p = d->primitive->position + 3 * o->vertex;
    for (int axis = 0; axis < 3; axis++)
        out[axis] = (double)p[axis];
    for (int t = 0; t < s->target_count; t++) {
        const float *delta = d->primitive->target_position[t];
        for (int axis = 0; delta != NULL && axis < 3; axis++)
            out[axis] += weight[t] * (double)delta[3 * o->vertex + axis];
    }
    if (d->bakes) {
        double at[3] = { out[0], out[1], out[2] };
        transform_double(out, d->at.matrix, at);
    }
}

static void bound_morphs(struct converter *c, struct shape *s, const struct track_pose *pose)
{
    const double *weight = pose->weight + pose->weight_at[s->morph_node];
    for (int v = 0; v < s->vertex_count; v++) {
        double at[3];
        morphed(at, c, s, v, weight);
        add_point(&s->bounds, at);
        if (s->skin >= 0)
            add_point(&c->skin[s->skin].in, at);
    }
}

static void bound_skinned(struct converter *c, const struct shape *s, const struct track_pose *pose,
                          const double (*joint)[16])
{
    const double *weight = s->morph_node >= 0 ? pose->weight + pose->weight_at[s->morph_node] : NULL;
    for (int v = 0; v < s->vertex_count; v++) {
        const struct convert_origin *o = &s->origin[v];
        const struct model_primitive *p = c->draw[o->draw].primitive;
        double at[3], sum[3] = { 0, 0, 0 };
        morphed(at, c, s, v, weight);
        for (int k = 0; k < p->influences; k++) {
            double w = (double)p->weight[o->vertex * p->influences + k], moved[3];
            if (!(w > 0))
                continue;
            transform_double(moved, joint[p->joint[o->vertex * p->influences + k]], at);
            for (int axis = 0; axis < 3; axis++)
                sum[axis] += w * moved[axis];
        }
        add_point(&c->skin[s->skin].out, sum);
    }
}

/* Rigid shapes where their nodes are; those without a node stand still. */
static void bound_rigid(struct converter *c, const double (*world)[16])
{
    for (int i = 0; i < c->shape_count; i++) {
        const struct shape *s = &c->shape[i];
        for (int corner = 0; corner < 8 && s->skin < 0; corner++) {
            const double at[3] = { (corner & 1 ? s->bounds.max : s->bounds.min)[0],
                                   (corner & 2 ? s->bounds.max : s->bounds.min)[1],
                                   (corner & 4 ? s->bounds.max : s->bounds.min)[2] };
            double moved[3] = { at[0], at[1], at[2] };
            if (s->node != NO_NODE)
                transform_double(moved, world[s->node], at);
            add_point(&c->all, moved);
        }
    }
}

static double largest_coordinate(const struct bounds *b)
{
    double largest = 0;
    for (int axis = 0; axis < 3 && b->min[0] <= b->max[0]; axis++)
        largest = fmax(largest, fmax(fabs(b->min[axis]), fabs(b->max[axis])));
    return largest;
}

static void world_of(double out[16], const struct converter *c, const struct out_node *n,
                     const struct track_pose *pose)
{
    if (n->moves)
        memcpy(out, pose->world[n->source], 16 * sizeof *out);
    else if (n->parent == NO_NODE)
        memcpy(out, n->fixed, 16 * sizeof *out);
    else {
        double above[16];
        world_of(above, c, &c->node[n->parent], pose);
        matrix_multiply(out, above, n->fixed);
    }
}

static void bound_skins(struct converter *c, const struct track_pose *pose, double (*joint)[16])
{
    for (int i = 0; i < c->skin_count; i++) {
        const struct model_skin *skin = &c->model->skin[c->skin[i].source];
        for (int j = 0; j < skin->joint_count; j++)
            matrix_multiply(joint[j], pose->world[skin->joint[j]], skin->inverse_bind + 16 * j);
        for (int k = 0; k < c->shape_count; k++)
            if (c->shape[k].skin == i)
                bound_skinned(c, &c->shape[k], pose, (const double (*)[16])joint);
    }
}

bool find_bounds(struct converter *c)
{
    struct track_pose pose;
    double farthest = 0;
    int joints = 0;
    for (int i = 0; i < c->model->skin_count; i++)
        joints = joints > c->model->skin[i].joint_count ? joints : c->model->skin[i].joint_count;
    double (*joint)[16] = pile_alloc(c->pile, (size_t)joints, sizeof *joint, c->f);
    double (*world)[16] = pile_alloc(c->pile, (size_t)c->node_count, sizeof *world, c->f);
    c->all = empty_bounds;
    if (joint == NULL || world == NULL || !list_instants(c) || !track_pose_alloc(&pose, c->model, c->f))
        return false;
    for (int i = 0; i < c->instant_count; i++) {
        track_pose_set(&pose, c->model, c->instant[i].clip, c->instant[i].time, c->root);
        for (int k = 0; k < c->shape_count; k++)
            if (c->shape[k].morph_node >= 0)
                bound_morphs(c, &c->shape[k], &pose);
        bound_skins(c, &pose, joint);
        for (int n = 0; n < c->node_count; n++) {
            world_of(world[n], c, &c->node[n], &pose);
            c->node[n].size = fmax(c->node[n].size, largest_column(world[n]));
            for (int axis = 0; axis < 3; axis++)
                farthest = fmax(farthest, fabs(world[n][12 + axis]));
        }
        bound_rigid(c, (const double (*)[16])world);
    }
    track_pose_free(&pose);
    for (int i = 0; i < c->skin_count; i++)
        add_bounds(&c->all, &c->skin[i].out);
    farthest = fmax(farthest, largest_coordinate(&c->all));
    if (!(farthest <= WORLD_UNITS))
        return fail(c->f, "reaches %g units, more than %g: use --scale or --fit", farthest, WORLD_UNITS);
    c->unit_exponent = farthest > 0 ? exact_exponent(farthest / MODEL_UNITS) : 0;
    if (c->unit_exponent < -31 || c->unit_exponent > 31)
        return fail(c->f, "is too small (%g units): use --scale or --fit", farthest);
    return true;
}

/* ------------------------------------------------------------------ records */

bool write_nodes(struct converter *c)
{
    smear_model_node *table = pile_alloc(c->pile, (size_t)c->node_count, sizeof *table, c->f);
    const char **name = pile_alloc(c->pile, (size_t)c->node_count, sizeof *name, c->f);
    if (table == NULL || name == NULL)
        return false;
    const double factor = 7.9, place = 2047;
    double radius = 0;
    for (int i = 0; i < c->node_count; i++) {
        struct out_node *n = &c->node[i];
        smear_model_node *out = &table[i];
        n->exponent = n->size > 0 ? exact_exponent(n->size) : 0;
        int above = n->parent != NO_NODE ? c->node[n->parent].exponent : 0;
        double scale = ldexp(1, above - n->exponent), unit = ldexp(1, above - c->unit_exponent);
        out->parent = n->parent != NO_NODE ? (uint16_t)n->parent : (uint16_t)SMEAR_MODEL_NONE;
        out->moves = n->moves;
        name[i] = n->source != NO_NODE ? c->model->node[n->source].name : "";
        bool ok = true;
        if (n->moves) {
            const struct model_node *source = &c->model->node[n->source];
            double q[4] = { source->rotation[0], source->rotation[1], source->rotation[2],
                            source->rotation[3] };
            exact_normalize4(q);
            for (int k = 0; k < 3 && ok; k++)
                ok = to_fixed(&out->rest[k], source->translation[k] * unit, 16, place, c->f)
                  && to_fixed(&out->rest[3 + k], source->scale[k] * scale, 24, factor, c->f);
            for (int k = 0; k < 4 && ok; k++)
                ok = to_fixed(&out->rest[6 + k], q[k], 30, 1.1, c->f);
        } else {
            for (int row = 0; row < 3 && ok; row++) {
                for (int column = 0; column < 3 && ok; column++)
                    ok = to_fixed(&out->rest[3 * row + column], n->fixed[4 * column + row] * scale, 24,
                                  factor, c->f);
                ok = ok && to_fixed(&out->rest[9 + row], n->fixed[12 + row] * unit, 16, place, c->f);
            }
        }
        if (!ok)
            return false;
    }
    c->out->model.node = table;
    c->out->model.node_count = (uint16_t)c->node_count;
    c->out->model.unit_shift = c->unit_exponent;
    for (int axis = 0; axis < 3; axis++) {
        double half = (c->all.max[axis] - c->all.min[axis]) / 2;
        radius += half * half;
        if (!to_fixed(&c->out->model.center[axis], c->all.min[axis] + half, 16, 32767, c->f))
            return false;
    }
    if (!to_fixed(&c->out->model.radius, fmin(sqrt(radius) * 1.01, 32767), 16, 32767, c->f))
        return false;
    c->out->node_name = name;
    return true;
}

/* SPDX-License-Identifier: MIT */
/* deform.c - skins and morph targets in fixed point. */
#include "tools/convert/build.h"

#include "tools/model/exact.h"

#include "tools/model/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ influences */

struct influence {
    int joint;                  /* of the result's skin */
    double weight;
    int units;                  /* of 256 */
};

/* Heavier ones first; lower joints first among equals. */
static inline bool is_before(const struct influence *a, const struct influence *b)
{
    return a->weight > b->weight || (a->weight == b->weight && a->joint < b->joint);
}

static void sort_influences(struct influence *in, int count)
{
    for (int i = 1; i < count; i++)
        for (int k = i; k > 0 && is_before(&in[k], &in[k - 1]); k--) {
            struct influence swap = in[k];
            in[k] = in[k - 1];
            in[k - 1] = swap;
        }
}

/* Whole units of 1/256 that add up, each as near to its share as can be; the first one is the heaviest. */
static int share_units(struct influence *in, int count)
{
    double sum = 0;
    int rest = 256;
    for (int i = 0; i < count; i++)
        sum += in[i].weight;
    for (int i = 0; i < count; i++) {
        in[i].units = sum > 0 ? (int)floor(in[i].weight / sum * 256) : i == 0 ? 256 : 0;
        rest -= in[i].units;
    }
    for (; rest > 0; rest--) {
        int best = 0;
        double most = -1;
        for (int i = 0; i < count; i++) {
            double lack = sum > 0 ? in[i].weight / sum * 256 - in[i].units : 0;
            if (lack > most) {
                best = i;
                most = lack;
            }
        }
        in[best].units++;
    }
    /* rounding may leave a later one heavier, or one with nothing */
    for (int i = 0; i < count; i++)
        in[i].weight = in[i].units;
    sort_influences(in, count);
    while (count > 1 && in[count - 1].units == 0)
        count--;
    return count;
}

static int joint_place(struct out_skin *skin, int joint)
{
    if (skin->place_of[joint] < 0 && skin->joint_count < 256) {
        skin->joint[skin->joint_count] = joint;
        skin->place_of[joint] = skin->joint_count++;
    }
    return skin->place_of[joint];
}

static int influences_of(const struct converter *c, const struct convert_origin *o, struct influence in[8])
{
    const struct model_primitive *p = c->draw[o->draw].primitive;
    int count = 0;
    for (int k = 0; k < p->influences; k++) {
        double weight = (double)p->weight[o->vertex * p->influences + k];
        int joint = p->joint[o->vertex * p->influences + k], same = 0;
        if (!(weight > 0))
            continue;
        while (same < count && in[same].joint != joint)
            same++;
        if (same == count)
            in[count++] = (struct influence){ .joint = joint };
        in[same].weight += weight;
    }
    if (count == 0)
        in[count++] = (struct influence){ .joint = p->joint[o->vertex * p->influences], .weight = 1 };
    sort_influences(in, count);
    return share_units(in, count < c->options->influences ? count : c->options->influences);
}

bool skin_influences(struct converter *c, const struct shape *s, struct raw_mesh *mesh)
{
    struct influence in[8];
    if (s->skin < 0)
        return true;
    mesh->influences = 1;
    for (int v = 0; v < mesh->vertex_count; v++) {
        int count = influences_of(c, &mesh->origin[v], in);
        mesh->influences = count > mesh->influences ? count : mesh->influences;
    }
    size_t n = (size_t)mesh->influences;
    mesh->influence = pile_alloc(c->pile, (size_t)mesh->vertex_count, 2 * n - 1, c->f);
    if (mesh->influence == NULL)
        return false;
    for (int v = 0; v < mesh->vertex_count; v++) {
        uint8_t *at = mesh->influence + (2 * n - 1) * (size_t)v;
        int count = influences_of(c, &mesh->origin[v], in);
        for (int k = 0; k < count; k++) {
            int place = joint_place(&c->skin[s->skin], in[k].joint);
            if (place < 0)
                return fail(c->f, "a skin has more than 256 joints in use");
            at[k] = (uint8_t)place;
            if (k > 0)
                at[(int)n + k - 1] = (uint8_t)in[k].units;
        }
    }
    return true;
}

/* ------------------------------------------------------------------ skins */

/* Joint: posed steps = (world of the node x inverse bind x step at rest) / step posed. */
static bool write_joint(struct converter *c, const struct out_skin *skin, int joint, smear_model_joint *out)
{
    const struct model_skin *source = &c->model->skin[skin->source];
    const struct carrier *at = &c->carrier[source->joint[joint]];
    const struct grid *in = &skin->in_grid;
    int exponent = c->node[at->node].exponent;
    double bind[16], offset[3], origin[3];
    matrix_multiply(bind, at->matrix, source->inverse_bind + 16 * joint);
    for (int k = 0; k < 3; k++)
        offset[k] = in->offset[k] * in->step;
    transform_double(origin, bind, offset);
    double scale = ldexp(in->step / skin->out_grid.step, exponent),
           unit = ldexp(1, exponent - c->unit_exponent);
    out->node = (uint16_t)at->node;
    bool ok = true;
    for (int row = 0; row < 3 && ok; row++) {
        for (int column = 0; column < 3 && ok; column++)
            ok = to_fixed(&out->basis[3 * row + column], bind[4 * column + row] * scale, 24, 127, c->f);
        ok = ok && to_fixed(&out->origin[row], origin[row] * unit, 16, 2047, c->f);
    }
    return ok;
}

bool write_skins(struct converter *c)
{
    for (int i = 0; i < c->skin_count; i++) {
        struct out_skin *skin = &c->skin[i];
        smear_model_skin *out = list_add(&c->skins, 1, c->f);
        smear_model_joint *joint = list_add(&c->joint, skin->joint_count, c->f);
        if (out == NULL || joint == NULL)
            return false;
        /* 1/16 steps per model unit = origin x steps / 2^32 x 2^shift for an origin in q16 shifted up by 4 */
        double per_unit = ldexp(16 / skin->out_grid.step, c->unit_exponent);
        int exponent = exact_exponent(per_unit);
        out->joint_first = (uint16_t)(c->joint.count - skin->joint_count);
        out->joint_count = (uint16_t)skin->joint_count;
        out->steps = (int32_t)floor(ldexp(per_unit, 30 - exponent) + 0.5);
        out->shift = exponent - 30 + 32 - 20;
        if (out->shift < -31 || out->shift > 31)
            return fail(c->f, "a skin is too large or too small");
        for (int k = 0; k < 3; k++)
            if (!to_fixed(&out->offset[k], skin->out_grid.offset[k], 4, (1 << 22) - 1, c->f))
                return false;
        for (int j = 0; j < skin->joint_count; j++)
            if (!write_joint(c, skin, skin->joint[j], &joint[j]))
                return false;
        c->joint_limit = skin->joint_count > c->joint_limit ? skin->joint_count : c->joint_limit;
    }
    return true;
}

/* ------------------------------------------------------------------ morph targets */

/* As large as the weights of a target get: deltas take up powers of two, so that weights stay below two. */
static double weight_factor(const struct converter *c, int node, int target)
{
    const struct model *m = c->model;
    const struct model_node *n = &m->node[node];
    const float *rest = n->weight != NULL ? n->weight : m->mesh[n->mesh].weight;
    double largest = rest != NULL ? fabs((double)rest[target]) : 0, factor = 1;
    for (int i = 0; i < c->options->clip_count; i++) {
        const struct model_clip *clip = &m->clip[c->options->clip[i]];
        for (int k = 0; k < clip->channel_count; k++) {
            const struct model_channel *channel = &clip->channel[k];
            int step = channel->interpolation == MODEL_CUBICSPLINE ? 3 : 1;
            if (channel->node != node || channel->path != MODEL_WEIGHTS)
                continue;
            for (int key = 0; key < channel->key_count * step; key++)
                largest = fmax(largest, fabs((double)channel->value[key * channel->width + target]));
        }
    }
    while (largest * 1.01 > 2 * factor && factor < 1 << 20)
        factor *= 2;
    return factor;
}

static bool morph_weights(struct converter *c, int node, int count)
{
    if (c->weight_first[node] >= 0)
        return true;
    c->weight_first[node] = c->weight_count;
    for (int i = 0; i < count; i++) {
        double *factor = list_add(&c->weight_factor, 1, c->f);
        if (factor == NULL)
            return false;
        *factor = weight_factor(c, node, i);
        c->weight_count++;
    }
    return c->weight_count < (int)SMEAR_MODEL_NONE || fail(c->f, "has more than 65534 morph weights");
}

static double length_of(const float n[3])
{
    return sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] + (double)n[2] * (double)n[2]);
}

bool morph_deltas(struct converter *c, const struct shape *s, struct raw_mesh *mesh)
{
    if (s->target_count == 0)
        return true;
    size_t vertices = (size_t)mesh->vertex_count, targets = (size_t)s->target_count;
    bool has_normals = false;
    const struct source_draw *d = &c->draw[s->draw[0]];
    for (size_t t = 0; t < targets; t++)
        has_normals = has_normals || (s->normal != NULL && d->primitive->target_normal[t] != NULL);
    mesh->target_count = s->target_count;
    mesh->delta = pile_alloc(c->pile, vertices * targets, 3 * sizeof *mesh->delta, c->f);
    mesh->delta_normal = has_normals ? pile_alloc(c->pile, vertices * targets, 3, c->f) : NULL;
    if (mesh->delta == NULL || (has_normals && mesh->delta_normal == NULL)
        || !morph_weights(c, s->morph_node, s->target_count))
        return false;
    mesh->weight_first = c->weight_first[s->morph_node];
    for (size_t t = 0; t < targets; t++) {
        double factor = ((double *)c->weight_factor.data)[(size_t)mesh->weight_first + t];
        const float *moves = d->primitive->target_position[t], *turns = d->primitive->target_normal[t];
        for (size_t v = 0; v < vertices; v++) {
            size_t from = 3 * (size_t)mesh->origin[v].vertex, to = 3 * (t * vertices + v);
            double delta[3] = { 0, 0, 0 }, turn[3] = { 0, 0, 0 };
            for (int row = 0; row < 3; row++)
                for (int k = 0; k < 3; k++) {
                    double m = d->bakes ? d->at.matrix[4 * k + row] : row == k;
                    if (moves != NULL)
                        delta[row] += m * (double)moves[from + (size_t)k];
                }
            for (int k = 0; has_normals && turns != NULL && k < 3; k++)
                turn[k] = (double)turns[from + (size_t)k];
            if (d->bakes) {
                /* exact for turns and even scale, where the inverse
                 * transpose is the matrix itself over its scale */
                double turned[3], size = largest_column(d->at.matrix);
                for (int row = 0; row < 3; row++)
                    turned[row] = (d->at.matrix[row] * turn[0] + d->at.matrix[4 + row] * turn[1]
                                   + d->at.matrix[8 + row] * turn[2]) / (size > 0 ? size : 1);
                memcpy(turn, turned, sizeof turn);
            }
            double length = has_normals ? length_of(d->primitive->normal + from) : 0;
            for (int k = 0; k < 3; k++) {
                double steps = floor(delta[k] * factor / s->grid.step + 0.5);
                mesh->delta[to + (size_t)k] = (int32_t)fmax(-131068, fmin(131068, steps));
                if (has_normals && length > 0)
                    mesh->delta_normal[to + (size_t)k] =
                        (int8_t)fmax(-127, fmin(127, floor(turn[k] * factor / length * 63.5 + 0.5)));
            }
        }
    }
    return true;
}

static bool write_target(struct converter *c, const struct raw_mesh *mesh, int target)
{
    size_t vertices = (size_t)mesh->vertex_count, first = (size_t)target * vertices;
    smear_model_target *out = list_add(&c->target, 1, c->f);
    int32_t largest = 0;
    bool has_normals = false;
    if (out == NULL)
        return false;
    for (size_t i = 3 * first; i < 3 * (first + vertices); i++) {
        largest = abs(mesh->delta[i]) > largest ? abs(mesh->delta[i]) : largest;
        has_normals = has_normals || (mesh->delta_normal != NULL && mesh->delta_normal[i] != 0);
    }
    *out = (smear_model_target){ .delta_first = (uint32_t)c->delta.count,
                                 .normal_first = SMEAR_MODEL_NO_NORMALS,
                                 .shift = largest > 2 * 32767 ? 2 : largest > 32767 ? 1 : 0 };
    if (has_normals)
        out->normal_first = (uint32_t)c->delta_normal.count;
    double step = ldexp(1, (int)out->shift);
    for (size_t v = 0; v < vertices; v++) {
        const int32_t *delta = mesh->delta + 3 * (first + v);
        const int8_t *turn = has_normals ? mesh->delta_normal + 3 * (first + v) : NULL;
        if ((delta[0] | delta[1] | delta[2]) == 0 && (turn == NULL || (turn[0] | turn[1] | turn[2]) == 0))
            continue;
        smear_model_delta *d = list_add(&c->delta, 1, c->f);
        if (d == NULL)
            return false;
        d->vertex = (uint16_t)v;
        for (int k = 0; k < 3; k++)
            d->step[k] = (int16_t)floor(delta[k] / step + 0.5);
        if (turn != NULL) {
            int8_t *n = list_add(&c->delta_normal, 3, c->f);
            if (n == NULL)
                return false;
            memcpy(n, turn, 3);
        }
        out->delta_count++;
    }
    return true;
}

bool write_targets(struct converter *c, const struct raw_mesh *mesh, smear_model_draw *draw)
{
    if (mesh->target_count == 0)
        return true;
    draw->target_first = (uint16_t)c->target.count;
    draw->target_count = (uint16_t)mesh->target_count;
    draw->weight_first = (uint16_t)mesh->weight_first;
    for (int t = 0; t < mesh->target_count; t++)
        if (!write_target(c, mesh, t))
            return false;
    return c->target.count < (int)SMEAR_MODEL_NONE || fail(c->f, "has more than 65534 morph targets");
}

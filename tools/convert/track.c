/* SPDX-License-Identifier: MIT */
/* track.c - see track.h. */
#include "tools/convert/track.h"

#include "tools/model/exact.h"

#include "tools/model/matrix.h"

#include <stdlib.h>
#include <string.h>

/* A key's value; CUBICSPLINE keys are in-tangent, value, out-tangent. */
static const float *value_of_key(const struct model_channel *c, int key)
{
    size_t width = (size_t)c->width, index = (size_t)key;
    return c->interpolation == MODEL_CUBICSPLINE ? c->value + (3 * index + 1) * width
                                                 : c->value + index * width;
}

static void mix_cubic(const struct model_channel *c, int key, double t, double seconds, double *out)
{
    const float *from = value_of_key(c, key), *to = value_of_key(c, key + 1);
    const float *leave = from + c->width, *arrive = to - c->width;
    double t2 = t * t, t3 = t2 * t;
    for (int i = 0; i < c->width; i++)
        out[i] = (2 * t3 - 3 * t2 + 1) * (double)from[i] + seconds * (t3 - 2 * t2 + t) * (double)leave[i]
               + (3 * t2 - 2 * t3) * (double)to[i] + seconds * (t3 - t2) * (double)arrive[i];
}

static void mix_linear(const struct model_channel *c, int key, double t, double *out)
{
    const float *from = value_of_key(c, key), *to = value_of_key(c, key + 1);
    if (c->path == MODEL_ROTATION) {
        double a[4], b[4];
        for (int i = 0; i < 4; i++) {
            a[i] = (double)from[i];
            b[i] = (double)to[i];
        }
        exact_normalize4(a);
        exact_normalize4(b);
        exact_slerp(out, a, b, t);
        return;
    }
    for (int i = 0; i < c->width; i++)
        out[i] = (1 - t) * (double)from[i] + t * (double)to[i];
}

void track_sample(const struct model_channel *c, double time, double *out)
{
    int low = 0, high = c->key_count - 1;
    while (low < high) {                /* the last key at or before the time */
        int middle = low + (high - low + 1) / 2;
        if ((double)c->time[middle] <= time)
            low = middle;
        else
            high = middle - 1;
    }
    if (low == c->key_count - 1 || time <= (double)c->time[0] || c->interpolation == MODEL_STEP) {
        const float *value = value_of_key(c, low);
        for (int i = 0; i < c->width; i++)
            out[i] = (double)value[i];
    } else {
        double start = (double)c->time[low], seconds = (double)c->time[low + 1] - start;
        double t = (time - start) / seconds;
        if (c->interpolation == MODEL_CUBICSPLINE)
            mix_cubic(c, low, t, seconds, out);
        else
            mix_linear(c, low, t, out);
    }
    if (c->path == MODEL_ROTATION)
        exact_normalize4(out);
}

int track_weight_count(const struct model *model, int node)
{
    return model->node[node].mesh >= 0 ? model->mesh[model->node[node].mesh].weight_count : 0;
}

bool track_pose_alloc(struct track_pose *p, const struct model *model, struct failure *f)
{
    size_t nodes = (size_t)model->node_count, weights = 0;
    *p = (struct track_pose){ 0 };
    p->weight_at = calloc(nodes + 1, sizeof *p->weight_at);
    for (size_t i = 0; p->weight_at != NULL && i < nodes; i++) {
        p->weight_at[i] = (int)weights;
        weights += (size_t)track_weight_count(model, (int)i);
    }
    p->translation = calloc(nodes + 1, sizeof *p->translation);
    p->rotation = calloc(nodes + 1, sizeof *p->rotation);
    p->scale = calloc(nodes + 1, sizeof *p->scale);
    p->world = calloc(nodes + 1, sizeof *p->world);
    p->weight = calloc(weights + 1, sizeof *p->weight);
    if (p->weight_at != NULL && p->translation != NULL && p->rotation != NULL && p->scale != NULL
        && p->world != NULL && p->weight != NULL)
        return true;
    track_pose_free(p);
    return fail(f, "out of memory");
}

void track_pose_free(struct track_pose *p)
{
    free(p->translation);
    free(p->rotation);
    free(p->scale);
    free(p->world);
    free(p->weight);
    free(p->weight_at);
    *p = (struct track_pose){ 0 };
}

static void set_rest(struct track_pose *p, const struct model *model, int i)
{
    const struct model_node *node = &model->node[i];
    memcpy(p->translation[i], node->translation, sizeof node->translation);
    memcpy(p->rotation[i], node->rotation, sizeof node->rotation);
    memcpy(p->scale[i], node->scale, sizeof node->scale);
    int count = track_weight_count(model, i);
    const float *weight = node->weight != NULL ? node->weight
                        : count > 0            ? model->mesh[node->mesh].weight
                                               : NULL;
    for (int k = 0; k < count; k++)
        p->weight[p->weight_at[i] + k] = (double)weight[k];
}

void track_local(const struct track_pose *p, const struct model *model, int i, double out[16])
{
    if (model->node[i].has_matrix)
        memcpy(out, model->node[i].matrix, 16 * sizeof *out);
    else
        matrix_from_trs(out, p->translation[i], p->rotation[i], p->scale[i]);
}

void track_pose_set(struct track_pose *p, const struct model *model, int clip, double time,
                    const double root[16])
{
    for (int i = 0; i < model->node_count; i++)
        set_rest(p, model, i);
    for (int i = 0; clip >= 0 && i < model->clip[clip].channel_count; i++) {
        const struct model_channel *c = &model->clip[clip].channel[i];
        track_sample(c, time,
                     c->path == MODEL_TRANSLATION ? p->translation[c->node]
                     : c->path == MODEL_ROTATION  ? p->rotation[c->node]
                     : c->path == MODEL_SCALE     ? p->scale[c->node]
                                                  : p->weight + p->weight_at[c->node]);
    }
    for (int i = 0; i < model->node_count; i++) {
        double local[16];
        int n = model->order[i], parent = model->node[n].parent;
        track_local(p, model, n, local);
        matrix_multiply(p->world[n], parent >= 0 ? p->world[parent] : root, local);
    }
}

/* SPDX-License-Identifier: MIT */
/* gltf_instance.c - EXT_mesh_gpu_instancing: a mesh that a node draws many times. Each instance becomes a node below that
 * one, with its mesh; so poses, motion, conversion and names need not know of instances. */
#include "tools/model/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* More than a scene may draw. */
enum { MAX_INSTANCES = 65535 };

/* Where the instances of a node are, in its space; arrays that are null stand for none. */
struct instances {
    int object, count;          /* the extension's value; 0: the node has none */
    float *translation, *rotation, *scale;
};

static void free_places(struct instances *at)
{
    free(at->translation);
    free(at->rotation);
    free(at->scale);
}

/* All attributes have as many elements; those of other names are for programs that know them. */
static bool count_instances(struct gltf *g, int attributes, int *count)
{
    static const char *const keys[] = { "TRANSLATION", "ROTATION", "SCALE" };
    *count = 0;
    for (int i = 0; i < 3; i++) {
        int accessor;
        if (!gltf_get_accessor(g, attributes, keys[i], &accessor))
            return false;
        if (accessor < 0)
            continue;
        if (*count > 0 && g->accessor[accessor].count != *count)
            return json_fail(&g->json, attributes, keys[i], g->f, "accessor %d has %d elements, not %d", accessor,
                             g->accessor[accessor].count, *count);
        *count = g->accessor[accessor].count;
    }
    return true;
}

static bool find_instances(struct gltf *g, int node, int object, struct instances *out)
{
    int attributes;
    *out = (struct instances){ .object = gltf_extension(g, object, "EXT_mesh_gpu_instancing") };
    if (out->object < 0 || g->model->node[node].mesh < 0)
        return true;
    if (!json_get_object(&g->json, out->object, "attributes", &attributes, g->f) || !count_instances(g, attributes, &out->count))
        return false;
    if (out->count > 0 && g->model->node[node].skin >= 0) {
        model_warn(g->model, "instances of a skinned mesh stand where its joints do: drawn once (nodes[%d])", node);
        out->count = 0;
    }
    return true;
}

static bool read_place(struct gltf *g, int attributes, const char *key, enum gltf_shape shape, int count, float **out)
{
    int accessor;
    if (!gltf_get_accessor(g, attributes, key, &accessor))
        return false;
    if (accessor < 0)
        return true;
    if (!gltf_expect(g, accessor, shape, GLTF_FLOAT | GLTF_BYTE_OR_SHORT, count, attributes, key))
        return false;
    *out = gltf_alloc(g, (size_t)count * (size_t)g->accessor[accessor].width, sizeof **out);
    return *out != NULL && gltf_floats(g, accessor, NULL, count, false, *out, attributes, key);
}

static bool read_places(struct gltf *g, struct instances *at)
{
    int attributes;
    return json_get_object(&g->json, at->object, "attributes", &attributes, g->f) &&
           read_place(g, attributes, "TRANSLATION", GLTF_VEC3, at->count, &at->translation) &&
           read_place(g, attributes, "ROTATION", GLTF_VEC4, at->count, &at->rotation) &&
           read_place(g, attributes, "SCALE", GLTF_VEC3, at->count, &at->scale);
}

/* Quantised rotations have no length of exactly 1. */
static bool set_place(struct gltf *g, const struct instances *at, int i, struct model_node *out)
{
    double *q = out->rotation, length = 0;
    q[3] = 1;
    for (int k = 0; k < 3; k++) {
        out->translation[k] = at->translation != NULL ? (double)at->translation[3 * i + k] : 0;
        out->scale[k] = at->scale != NULL ? (double)at->scale[3 * i + k] : 1;
    }
    for (int k = 0; k < 4 && at->rotation != NULL; k++) {
        q[k] = (double)at->rotation[4 * i + k];
        length += q[k] * q[k];
    }
    if (at->rotation == NULL)
        return true;
    length = sqrt(length);
    if (!(length > 1e-6 && length < 1e6))
        return json_fail(&g->json, at->object, NULL, g->f, "the rotation of instance %d is no quaternion of length 1", i);
    for (int k = 0; k < 4; k++)
        q[k] /= length;
    return true;
}

/* Appends nodes, of which the arrays have room for. Their parent's mesh becomes theirs. */
static bool add_nodes(struct gltf *g, int parent, const struct instances *at)
{
    struct model *model = g->model;
    struct model_node *above = &model->node[parent];
    for (int i = 0; i < at->count; i++) {
        int index = model->node_count++;
        struct model_node *node = &model->node[index];
        *node = (struct model_node){ .parent = parent, .mesh = above->mesh, .skin = -1, .camera = -1,
                                     .is_instance = true, .weight_count = above->weight_count };
        model->order[index] = index;
        model->in_scene[index] = model->in_scene[parent];
        node->name = gltf_copy(g, "");
        if (above->weight != NULL) {
            node->weight = gltf_alloc(g, (size_t)above->weight_count, sizeof *node->weight);
            if (node->weight == NULL)
                return false;
            memcpy(node->weight, above->weight, (size_t)above->weight_count * sizeof *node->weight);
        }
        for (int k = 0; k < 16; k += 5)
            node->matrix[k] = 1;
        if (node->name == NULL || !set_place(g, at, i, node))
            return false;
    }
    above->mesh = -1;
    free(above->weight);
    above->weight = NULL;
    above->weight_count = 0;
    return true;
}

static void *grow(struct gltf *g, void *array, size_t before, size_t count, size_t size)
{
    void *larger = gltf_alloc(g, count, size);
    if (larger != NULL) {
        memcpy(larger, array, before * size);
        free(array);
    }
    return larger;
}

static bool make_room(struct gltf *g, size_t count)
{
    struct model *model = g->model;
    size_t before = (size_t)model->node_count;
    void *node = grow(g, model->node, before, count, sizeof *model->node);
    model->node = node != NULL ? node : model->node;
    void *order = grow(g, model->order, before, count, sizeof *model->order);
    model->order = order != NULL ? order : model->order;
    void *in_scene = grow(g, model->in_scene, before, count, sizeof *model->in_scene);
    model->in_scene = in_scene != NULL ? in_scene : model->in_scene;
    return node != NULL && order != NULL && in_scene != NULL;
}

/* ------------------------------------------------------------------ morph weights in motion */

static bool copy_channel(struct gltf *g, const struct model_channel *from, int node, struct model_channel *out)
{
    size_t values = (size_t)from->key_count * (size_t)from->width * (from->interpolation == MODEL_CUBICSPLINE ? 3 : 1);
    *out = *from;
    out->node = node;
    out->time = gltf_alloc(g, (size_t)from->key_count, sizeof *out->time);
    out->value = gltf_alloc(g, values, sizeof *out->value);
    if (out->time == NULL || out->value == NULL)
        return false;
    memcpy(out->time, from->time, (size_t)from->key_count * sizeof *out->time);
    memcpy(out->value, from->value, values * sizeof *out->value);
    return true;
}

/* The weights of a mesh that went to instances move each of them. */
static bool move_weights(struct gltf *g, struct model_clip *clip, const int *first, const int *count)
{
    size_t wanted = 0;
    int read = clip->channel_count;
    for (int i = 0; i < read; i++)
        wanted += clip->channel[i].path == MODEL_WEIGHTS ? (size_t)count[clip->channel[i].node] : 0;
    if (wanted == 0)
        return true;
    if (wanted > MAX_INSTANCES)
        return fail(g->f, "too many instances with morph targets in motion: above %d", MAX_INSTANCES);
    void *more = grow(g, clip->channel, (size_t)read, (size_t)read + wanted, sizeof *clip->channel);
    if (more == NULL)
        return false;
    clip->channel = more;
    for (int i = 0; i < read; i++) {
        struct model_channel *c = &clip->channel[i];
        int node = c->node;
        if (c->path != MODEL_WEIGHTS || count[node] == 0)
            continue;
        c->node = first[node];          /* the first instance takes the channel itself */
        for (int k = 1; k < count[node]; k++) {
            if (!copy_channel(g, c, first[node] + k, &clip->channel[clip->channel_count++]))
                return false;
        }
    }
    return true;
}

/* ------------------------------------------------------------------ all of them */

/* first and count: per node of the file, of its instances. */
static bool add_all(struct gltf *g, int nodes, int total, int *first, int *count)
{
    int index = 0;
    if (!make_room(g, (size_t)g->model->node_count + (size_t)total))
        return false;
    for (int i = json_first(&g->json, nodes); i >= 0; i = json_after(&g->json, i), index++) {
        if (count[index] == 0)
            continue;
        struct instances at = { .object = gltf_extension(g, i, "EXT_mesh_gpu_instancing"), .count = count[index] };
        first[index] = g->model->node_count;
        bool ok = read_places(g, &at) && add_nodes(g, index, &at);
        free_places(&at);
        if (!ok)
            return false;
    }
    for (int i = 0; i < g->model->clip_count; i++) {
        if (!move_weights(g, &g->model->clip[i], first, count))
            return false;
    }
    return true;
}

bool gltf_read_instances(struct gltf *g)
{
    int nodes, node_count, index = 0, total = 0;
    if (!gltf_list(g, 0, "nodes", &nodes, &node_count))
        return false;
    int *first = gltf_alloc(g, (size_t)node_count * 2, sizeof *first), *count = first + node_count;
    bool ok = first != NULL;
    for (int i = json_first(&g->json, nodes); ok && i >= 0; i = json_after(&g->json, i), index++) {
        struct instances at;
        ok = find_instances(g, index, i, &at);
        if (ok && at.count > MAX_INSTANCES - total)
            ok = json_fail(&g->json, i, NULL, g->f, "more than %d instances", MAX_INSTANCES);
        count[index] = ok ? at.count : 0;
        total += count[index];
    }
    if (ok && total > 0)
        ok = add_all(g, nodes, total, first, count);
    free(first);
    return ok;
}

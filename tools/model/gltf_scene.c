/* SPDX-License-Identifier: MIT */
/* gltf_scene.c - the node hierarchy, which of it is drawn, skins and cameras. */
#include "tools/model/gltf.h"
#include "tools/model/matrix.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool read_node_transform(struct gltf *g, int object, struct model_node *node)
{
    double *q = node->rotation;
    if (!json_get_numbers(&g->json, object, "matrix", 16, node->matrix, &node->has_matrix, g->f) ||
        !json_get_numbers(&g->json, object, "translation", 3, node->translation, NULL, g->f) ||
        !json_get_numbers(&g->json, object, "rotation", 4, q, NULL, g->f) ||
        !json_get_numbers(&g->json, object, "scale", 3, node->scale, NULL, g->f))
        return false;
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 1e-6 && length < 1e6))
        return json_fail(&g->json, object, "rotation", g->f, "no quaternion of length 1");
    for (int i = 0; i < 4; i++)
        q[i] /= length;
    return true;
}

static bool read_node_weights(struct gltf *g, int object, struct model_node *node)
{
    int array;
    if (!json_get_array(&g->json, object, "weights", &array, g->f))
        return false;
    if (array < 0)
        return true;
    int count = node->mesh < 0 ? 0 : g->model->mesh[node->mesh].weight_count;
    if (g->json.value[array].count != count)
        return json_fail(&g->json, array, NULL, g->f, "%d weights for %d morph targets",
                         g->json.value[array].count, count);
    node->weight_count = count;
    return gltf_weights(g, array, count, &node->weight);
}

static bool read_node(struct gltf *g, int object, int skin_count, int camera_count,
                      struct model_node *node)
{
    node->scale[0] = node->scale[1] = node->scale[2] = 1;
    node->rotation[3] = 1;
    matrix_identity(node->matrix);
    node->name = gltf_name(g, object);
    return node->name != NULL &&
           json_get_index(&g->json, object, "mesh", g->model->mesh_count, "mesh", &node->mesh,
                          g->f) &&
           json_get_index(&g->json, object, "skin", skin_count, "skin", &node->skin, g->f) &&
           json_get_index(&g->json, object, "camera", camera_count, "camera", &node->camera,
                          g->f) &&
           read_node_transform(g, object, node) && read_node_weights(g, object, node);
}

/* Sets `parent` of every child; each node may be a child once. */
static bool read_children(struct gltf *g, int nodes)
{
    struct model *model = g->model;
    int index = 0;
    for (int i = json_first(&g->json, nodes); i >= 0; i = json_after(&g->json, i), index++) {
        int children;
        if (!json_get_array(&g->json, i, "children", &children, g->f))
            return false;
        for (int c = json_first(&g->json, children); c >= 0; c = json_after(&g->json, c)) {
            int child;
            if (!json_to_index(&g->json, c, model->node_count, "node", &child, g->f))
                return false;
            if (model->node[child].parent >= 0)
                return json_fail(&g->json, c, NULL, g->f, "node %d has two parents, %d and %d",
                                 child, model->node[child].parent, index);
            model->node[child].parent = index;
        }
    }
    return true;
}

/* Roots first, then level by level. Nodes that no root leads to lie on or below a cycle. */
static bool sort_nodes(struct gltf *g)
{
    struct model *model = g->model;
    int n = model->node_count;
    model->order = gltf_alloc(g, (size_t)n, sizeof *model->order);
    /* Lists of children: first child per node, next sibling per node; stored as index + 1. */
    int *first = gltf_alloc(g, (size_t)n * 2, sizeof *first);
    if (model->order == NULL || first == NULL) {
        free(first);
        return false;
    }
    int *next = first + n, done = 0;
    for (int i = n - 1; i >= 0; i--) {
        int parent = model->node[i].parent;
        if (parent >= 0) {
            next[i] = first[parent];
            first[parent] = i + 1;
        }
    }
    for (int i = 0; i < n; i++) {
        if (model->node[i].parent < 0)
            model->order[done++] = i;
    }
    for (int at = 0; at < done; at++) {
        for (int child = first[model->order[at]]; child != 0; child = next[child - 1])
            model->order[done++] = child - 1;
    }
    bool ok = done == n;
    if (!ok) {
        /* Follow parents n times from an unreached node: that ends on the cycle itself. */
        for (int i = 0; i < done; i++)
            first[model->order[i]] = -1;
        int node = 0;
        while (first[node] == -1)
            node++;
        for (int i = 0; i < n; i++)
            node = model->node[node].parent;
        fail(g->f, "a cycle: it is its own ancestor (nodes[%d])", node);
    }
    free(first);
    return ok;
}

bool gltf_read_nodes(struct gltf *g)
{
    int array, count, skins, skin_count, cameras, camera_count;
    if (!gltf_list(g, 0, "nodes", &array, &count) ||
        !gltf_list(g, 0, "skins", &skins, &skin_count) ||
        !gltf_list(g, 0, "cameras", &cameras, &camera_count))
        return false;
    struct model *model = g->model;
    model->node = gltf_alloc(g, (size_t)count, sizeof *model->node);
    if (model->node == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        struct model_node *node = &model->node[model->node_count++];
        node->parent = node->mesh = node->skin = node->camera = -1;
        if (!read_node(g, i, skin_count, camera_count, node))
            return false;
    }
    return read_children(g, array) && sort_nodes(g);
}

static bool read_skin(struct gltf *g, int object, struct model_skin *skin)
{
    int array, matrices;
    skin->name = gltf_name(g, object);
    if (skin->name == NULL || !json_get_array(&g->json, object, "joints", &array, g->f) ||
        !gltf_get_accessor(g, object, "inverseBindMatrices", &matrices))
        return false;
    int count = array < 0 ? 0 : g->json.value[array].count;
    if (count == 0)
        return json_fail(&g->json, object, NULL, g->f, "no joints");
    skin->joint = gltf_alloc(g, (size_t)count, sizeof *skin->joint);
    skin->inverse_bind = gltf_alloc(g, (size_t)count * 16, sizeof *skin->inverse_bind);
    if (skin->joint == NULL || skin->inverse_bind == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        if (!json_to_index(&g->json, i, g->model->node_count, "node", &skin->joint[skin->joint_count++], g->f))
            return false;
    }
    for (int i = 0; i < count; i++)
        matrix_identity(skin->inverse_bind + 16 * (size_t)i);
    if (matrices < 0)
        return true;
    if (!gltf_expect(g, matrices, GLTF_MAT4, GLTF_FLOAT, -1, object, "inverseBindMatrices"))
        return false;
    if (g->accessor[matrices].count < count)
        return json_fail(&g->json, object, "inverseBindMatrices", g->f, "%d matrices for %d joints",
                         g->accessor[matrices].count, count);
    float *values = gltf_alloc(g, (size_t)count * 16, sizeof *values);
    bool ok = values != NULL && gltf_floats(g, matrices, NULL, count, false, values, object,
                                            "inverseBindMatrices");
    for (size_t i = 0; ok && i < (size_t)count * 16; i++)
        skin->inverse_bind[i] = (double)values[i];
    free(values);
    return ok;
}

/* A node may only wear a skin that has all the joints its mesh asks for. */
static bool check_skinned_nodes(struct gltf *g)
{
    const struct model *model = g->model;
    for (int i = 0; i < model->node_count; i++) {
        const struct model_node *node = &model->node[i];
        if (node->mesh < 0 || node->skin < 0)
            continue;
        int joints = model->skin[node->skin].joint_count;
        if (g->max_joint[node->mesh] >= joints)
            return fail(g->f, "mesh %d uses joint %d, skin %d has %d joints (nodes[%d])",
                        node->mesh, g->max_joint[node->mesh], node->skin, joints, i);
    }
    return true;
}

bool gltf_read_skins(struct gltf *g)
{
    int array, count;
    if (!gltf_list(g, 0, "skins", &array, &count))
        return false;
    g->model->skin = gltf_alloc(g, (size_t)count, sizeof *g->model->skin);
    if (g->model->skin == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        if (!read_skin(g, i, &g->model->skin[g->model->skin_count++]))
            return false;
    }
    return check_skinned_nodes(g);
}

/* The default scene, else the first, else everything. A listed node brings all below it. */
bool gltf_read_scene(struct gltf *g)
{
    struct model *model = g->model;
    int scenes, count, index = 0, nodes = -1;
    if (!gltf_list(g, 0, "scenes", &scenes, &count) ||
        !json_get_index(&g->json, 0, "scene", count, "scene", &index, g->f))
        return false;
    model->in_scene = gltf_alloc(g, (size_t)model->node_count, sizeof *model->in_scene);
    if (model->in_scene == NULL)
        return false;
    int scene = json_first(&g->json, scenes);
    for (int i = 0; scene >= 0 && i < index; i++)
        scene = json_after(&g->json, scene);
    if (scene < 0) {
        for (int i = 0; i < model->node_count; i++)
            model->in_scene[i] = true;
        return true;
    }
    if (!json_get_array(&g->json, scene, "nodes", &nodes, g->f))
        return false;
    for (int i = json_first(&g->json, nodes); i >= 0; i = json_after(&g->json, i)) {
        int node;
        if (!json_to_index(&g->json, i, model->node_count, "node", &node, g->f))
            return false;
        model->in_scene[node] = true;
    }
    for (int i = 0; i < model->node_count; i++) {
        int node = model->order[i], parent = model->node[node].parent;
        if (parent >= 0 && model->in_scene[parent])
            model->in_scene[node] = true;
    }
    return true;
}

static bool read_camera(struct gltf *g, int object, struct model_camera *camera)
{
    const double pi = 3.14159265358979323846;
    const char *type = "";
    int lens;
    if (!json_get_string(&g->json, object, "type", &type, g->f) ||
        !json_get_object(&g->json, object, type, &lens, g->f))
        return false;
    camera->orthographic = strcmp(type, "orthographic") == 0;
    if (lens < 0 || (!camera->orthographic && strcmp(type, "perspective") != 0))
        return json_fail(&g->json, object, NULL, g->f, "neither perspective nor orthographic");
    if (!json_get_number(&g->json, lens, "yfov", &camera->yfov, g->f) ||
        !json_get_number(&g->json, lens, "xmag", &camera->xmag, g->f) ||
        !json_get_number(&g->json, lens, "ymag", &camera->ymag, g->f) ||
        !json_get_number(&g->json, lens, "znear", &camera->znear, g->f) ||
        !json_get_number(&g->json, lens, "zfar", &camera->zfar, g->f))
        return false;
    camera->xmag = fabs(camera->xmag);
    camera->ymag = fabs(camera->ymag);
    if (!camera->orthographic && !(camera->yfov > 0 && camera->yfov < pi))
        return json_fail(&g->json, lens, "yfov", g->f, "%g is no field of view", camera->yfov);
    if (camera->orthographic && (camera->xmag == 0 || camera->ymag == 0))
        return json_fail(&g->json, lens, NULL, g->f, "xmag and ymag must not be 0");
    if (camera->znear < 0 || (!camera->orthographic && camera->znear == 0))
        return json_fail(&g->json, lens, "znear", g->f, "%g is no near distance", camera->znear);
    if (camera->zfar != 0 && camera->zfar <= camera->znear)
        return json_fail(&g->json, lens, "zfar", g->f, "%g is not beyond znear", camera->zfar);
    return true;
}

bool gltf_read_cameras(struct gltf *g)
{
    struct model *model = g->model;
    int array, count;
    if (!gltf_list(g, 0, "cameras", &array, &count))
        return false;
    struct model_camera *lens = gltf_alloc(g, (size_t)count, sizeof *lens);
    model->camera = gltf_alloc(g, (size_t)model->node_count, sizeof *model->camera);
    bool ok = lens != NULL && model->camera != NULL;
    int read = 0;
    for (int i = json_first(&g->json, array); ok && i >= 0; i = json_after(&g->json, i)) {
        lens[read].name = gltf_name(g, i);
        ok = lens[read].name != NULL && read_camera(g, i, &lens[read]);
        read++;
    }
    for (int i = 0; ok && i < model->node_count; i++) {
        if (model->node[i].camera < 0 || !model->in_scene[i])
            continue;
        struct model_camera *camera = &model->camera[model->camera_count++];
        *camera = lens[model->node[i].camera];
        camera->node = i;
        const char *name = camera->name[0] != '\0' ? camera->name : model->node[i].name;
        camera->name = gltf_copy(g, name);
        ok = camera->name != NULL;
    }
    for (int i = 0; i < read; i++)
        free(lens[i].name);
    free(lens);
    return ok;
}

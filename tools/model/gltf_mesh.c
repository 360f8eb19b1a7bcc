/* SPDX-License-Identifier: MIT */
/* gltf_mesh.c - primitives as plain triangle lists. Of a primitive's vertices only those that its
 * triangles use are decoded: files often share one big vertex buffer among many primitives. */
#include "tools/model/gltf.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MODE_TRIANGLES = 4, MODE_STRIP = 5, MODE_FAN = 6, MODE_LAST = 6 };

/* A primitive while it is read. */
struct source {
    int object, attributes;     /* JSON values */
    int vertex_count;           /* in the file */
    uint32_t *row;              /* the vertices in use, ascending */
    int row_count;
};

/* Reads an attribute of the rows in use into a new array; *out stays null when there is none. */
static bool read_attribute(struct gltf *g, const struct source *s, int object, const char *key,
                           enum gltf_shape shape, int components, bool normalize, float **out)
{
    int accessor;
    if (!gltf_get_accessor(g, object, key, &accessor))
        return false;
    if (accessor < 0)
        return true;
    if (!gltf_expect(g, accessor, shape, components, s->vertex_count, object, key))
        return false;
    *out = gltf_alloc(g, (size_t)s->row_count * (size_t)g->accessor[accessor].width, sizeof **out);
    return *out != NULL &&
           gltf_floats(g, accessor, s->row, s->row_count, normalize, *out, object, key);
}

/* corner[3 i ...] of triangle i as positions in the list of indices; glTF 2.0, 3.7.2.1. */
static void triangle_corners(int mode, size_t i, size_t corner[3])
{
    switch (mode) {
    case MODE_STRIP:
        corner[0] = i;
        corner[1] = i + 1 + i % 2;
        corner[2] = i + 2 - i % 2;
        break;
    case MODE_FAN:
        corner[0] = i + 1;
        corner[1] = i + 2;
        corner[2] = 0;
        break;
    default:
        corner[0] = 3 * i;
        corner[1] = 3 * i + 1;
        corner[2] = 3 * i + 2;
    }
}

/* The primitive's list of indices, or 0, 1, 2 ... without one. */
static bool read_indices(struct gltf *g, const struct source *s, int accessor, uint32_t *list,
                         int n)
{
    if (accessor < 0) {
        for (int i = 0; i < n; i++)
            list[i] = (uint32_t)i;
        return true;
    }
    gltf_indices(g, accessor, list);
    for (int i = 0; i < n; i++) {
        if (list[i] >= (uint32_t)s->vertex_count)
            return json_fail(&g->json, s->object, "indices", g->f, "index %u, but only %d vertices",
                             (unsigned)list[i], s->vertex_count);
    }
    return true;
}

/* Renumbers out->index to the vertices in use, which s->row then lists. */
static bool collect_rows(struct gltf *g, struct source *s, struct model_primitive *out)
{
    size_t corners = (size_t)out->triangle_count * 3;
    uint32_t first = UINT32_MAX, last = 0;
    for (size_t i = 0; i < corners; i++) {
        first = out->index[i] < first ? out->index[i] : first;
        last = out->index[i] > last ? out->index[i] : last;
    }
    uint32_t span = last - first + 1;
    uint32_t *number = gltf_alloc(g, span, sizeof *number);
    if (number == NULL)
        return false;
    for (size_t i = 0; i < corners; i++)
        number[out->index[i] - first] = 1;
    for (uint32_t v = 0; v < span; v++)
        s->row_count += (int)number[v];
    s->row = gltf_alloc(g, (size_t)s->row_count, sizeof *s->row);
    if (s->row == NULL) {
        free(number);
        return false;
    }
    uint32_t used = 0;
    for (uint32_t v = 0; v < span; v++) {
        if (number[v] != 0) {
            s->row[used] = first + v;
            number[v] = used++;
        }
    }
    for (size_t i = 0; i < corners; i++)
        out->index[i] = number[out->index[i] - first];
    free(number);
    return true;
}

static bool read_triangles(struct gltf *g, struct source *s, int mode, int accessor, int n,
                           struct model_primitive *out)
{
    uint32_t *list = gltf_alloc(g, (size_t)n, sizeof *list);
    out->triangle_count = mode == MODE_TRIANGLES ? n / 3 : n - 2;
    out->index = gltf_alloc(g, (size_t)out->triangle_count * 3, sizeof *out->index);
    bool ok = list != NULL && out->index != NULL && read_indices(g, s, accessor, list, n);
    for (size_t i = 0; ok && i < (size_t)out->triangle_count; i++) {
        size_t corner[3];
        triangle_corners(mode, i, corner);
        for (int k = 0; k < 3; k++)
            out->index[3 * i + (size_t)k] = list[corner[k]];
    }
    free(list);
    if (!ok)
        return false;
    ok = collect_rows(g, s, out);
    out->vertex_count = s->row_count;
    return ok;
}

static bool read_uv(struct gltf *g, const struct source *s, struct model_primitive *out)
{
    const struct gltf_material *m = &g->material[out->material];
    char key[32];
    snprintf(key, sizeof key, "TEXCOORD_%d", m->uv_set);
    if (!read_attribute(g, s, s->attributes, key, GLTF_VEC2, GLTF_FLOAT | GLTF_BYTE_OR_SHORT, false,
                        &out->uv))
        return false;
    if (out->uv == NULL) {
        if (m->picture < 0)
            return true;
        out->uv = gltf_alloc(g, (size_t)s->row_count * 2, sizeof *out->uv);
        if (out->uv == NULL)
            return false;
    }
    for (size_t i = 0; i < (size_t)s->row_count; i++) {
        double u = (double)out->uv[2 * i], v = (double)out->uv[2 * i + 1];
        out->uv[2 * i] = (float)(m->uv[0] * u + m->uv[1] * v + m->uv[2]);
        out->uv[2 * i + 1] = (float)(m->uv[3] * u + m->uv[4] * v + m->uv[5]);
        if (!isfinite(out->uv[2 * i]) || !isfinite(out->uv[2 * i + 1]))
            return json_fail(&g->json, s->object, NULL, g->f,
                             "its transformed texture coordinates are not finite");
    }
    return true;
}

static bool read_color(struct gltf *g, const struct source *s, struct model_primitive *out)
{
    int accessor;
    if (!gltf_get_accessor(g, s->attributes, "COLOR_0", &accessor))
        return false;
    if (accessor < 0)
        return true;
    enum gltf_shape shape = g->accessor[accessor].shape == GLTF_VEC3 ? GLTF_VEC3 : GLTF_VEC4;
    float *color = NULL;
    bool ok = read_attribute(g, s, s->attributes, "COLOR_0", shape, GLTF_FLOAT | GLTF_UNSIGNED,
                             true, &color);
    if (!ok || shape == GLTF_VEC4) {
        out->color = color;
        return ok;
    }
    out->color = gltf_alloc(g, (size_t)s->row_count * 4, sizeof *out->color);
    for (size_t i = 0; out->color != NULL && i < (size_t)s->row_count; i++) {
        memcpy(out->color + 4 * i, color + 3 * i, 3 * sizeof *color);
        out->color[4 * i + 3] = 1;
    }
    free(color);
    return out->color != NULL;
}

/* One of the two sets of four joints and weights per vertex, to places 4 * set of each vertex. */
static bool read_influence_set(struct gltf *g, const struct source *s, int set,
                               struct model_primitive *out)
{
    char joints_key[16], weights_key[16];
    snprintf(joints_key, sizeof joints_key, "JOINTS_%d", set);
    snprintf(weights_key, sizeof weights_key, "WEIGHTS_%d", set);
    float *joint = NULL, *weight = NULL;
    bool ok = read_attribute(g, s, s->attributes, joints_key, GLTF_VEC4, GLTF_UNSIGNED, false,
                             &joint) &&
              read_attribute(g, s, s->attributes, weights_key, GLTF_VEC4,
                             GLTF_FLOAT | GLTF_UNSIGNED, true, &weight);
    if (ok && (joint == NULL || weight == NULL))
        ok = json_fail(&g->json, s->attributes, joint == NULL ? joints_key : weights_key, g->f,
                       "joints and weights need each other");
    for (size_t i = 0; ok && i < (size_t)s->row_count * 4; i++) {
        size_t to = i / 4 * (size_t)out->influences + 4 * (size_t)set + i % 4;
        if (weight[i] < 0)
            ok = json_fail(&g->json, s->attributes, weights_key, g->f, "a weight is negative");
        out->weight[to] = weight[i];
        out->joint[to] = weight[i] > 0 ? (uint16_t)joint[i] : 0;
    }
    free(joint);
    free(weight);
    return ok;
}

/* Weights are made to sum to 1; a vertex without any is all the first joint's. */
static bool read_influences(struct gltf *g, const struct source *s, struct model_primitive *out,
                            int *max_joint)
{
    bool first = json_member(&g->json, s->attributes, "JOINTS_0") >= 0;
    bool second = json_member(&g->json, s->attributes, "JOINTS_1") >= 0;
    if (!first)
        return true;
    out->influences = second ? 8 : 4;
    size_t n = (size_t)out->influences;
    out->joint = gltf_alloc(g, (size_t)s->row_count * n, sizeof *out->joint);
    out->weight = gltf_alloc(g, (size_t)s->row_count * n, sizeof *out->weight);
    if (out->joint == NULL || out->weight == NULL || !read_influence_set(g, s, 0, out) ||
        (second && !read_influence_set(g, s, 1, out)))
        return false;
    for (size_t v = 0; v < (size_t)s->row_count; v++) {
        float *weight = out->weight + v * n;
        double sum = 0;
        for (size_t k = 0; k < n; k++) {
            sum += (double)weight[k];
            if (out->joint[v * n + k] > *max_joint)
                *max_joint = out->joint[v * n + k];
        }
        if (sum <= 0) {
            weight[0] = 1;
            sum = 1;
        }
        for (size_t k = 0; k < n; k++)
            weight[k] = (float)((double)weight[k] / sum);
    }
    return true;
}

static bool read_targets(struct gltf *g, const struct source *s, struct model_primitive *out)
{
    int array, count;
    if (!gltf_list(g, s->object, "targets", &array, &count))
        return false;
    if (count == 0)
        return true;
    out->target_position = gltf_alloc(g, (size_t)count, sizeof *out->target_position);
    out->target_normal = gltf_alloc(g, (size_t)count, sizeof *out->target_normal);
    if (out->target_position == NULL || out->target_normal == NULL)
        return false;
    out->target_count = count;
    int k = 0;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i), k++) {
        if (!read_attribute(g, s, i, "POSITION", GLTF_VEC3, GLTF_FLOAT | GLTF_BYTE_OR_SHORT, false,
                            &out->target_position[k]))
            return false;
        if (out->normal != NULL &&
            !read_attribute(g, s, i, "NORMAL", GLTF_VEC3, GLTF_FLOAT | GLTF_BYTE_OR_SHORT, false,
                            &out->target_normal[k]))
            return false;
    }
    return true;
}

static bool read_vertices(struct gltf *g, const struct source *s, struct model_primitive *out,
                          int *max_joint)
{
    return read_attribute(g, s, s->attributes, "POSITION", GLTF_VEC3,
                          GLTF_FLOAT | GLTF_BYTE_OR_SHORT, false, &out->position) &&
           read_attribute(g, s, s->attributes, "NORMAL", GLTF_VEC3,
                          GLTF_FLOAT | GLTF_BYTE_OR_SHORT, false, &out->normal) &&
           read_uv(g, s, out) && read_color(g, s, out) && read_influences(g, s, out, max_joint) &&
           read_targets(g, s, out);
}

/* *kept tells whether there is anything to draw. */
static bool read_primitive(struct gltf *g, int object, struct model_primitive *out, bool *kept,
                           int *max_joint)
{
    struct source s = { .object = object };
    int64_t mode = MODE_TRIANGLES;
    int material = -1, position, indices;
    *kept = false;
    if (!json_get_integer(&g->json, object, "mode", 0, MODE_LAST, &mode, g->f) ||
        !json_get_index(&g->json, object, "material", g->material_count, "material", &material,
                        g->f) ||
        !json_get_object(&g->json, object, "attributes", &s.attributes, g->f) ||
        !gltf_get_accessor(g, s.attributes, "POSITION", &position) ||
        !gltf_get_accessor(g, object, "indices", &indices))
        return false;
    if (s.attributes < 0)
        return json_fail(&g->json, object, NULL, g->f, "no attributes");
    if (indices >= 0 && !gltf_expect(g, indices, GLTF_SCALAR, GLTF_UNSIGNED | GLTF_WORD, -1, object,
                                     "indices"))
        return false;
    int n = indices >= 0 ? g->accessor[indices].count :
            position >= 0 ? g->accessor[position].count : 0;
    if (mode < MODE_TRIANGLES || position < 0 || n < 3)
        return true;
    if (g->accessor[position].bytes == NULL && g->accessor[position].sparse_count == 0 &&
        gltf_extension(g, object, "KHR_draco_mesh_compression") >= 0)
        return gltf_packed(g, object, "KHR_draco_mesh_compression");
    s.vertex_count = g->accessor[position].count;
    if (material < 0 && !gltf_default_material(g, &material))
        return false;
    g->material[material].is_drawn = true;
    out->material = material;
    *kept = true;
    bool ok = read_triangles(g, &s, (int)mode, indices, n, out) &&
              read_vertices(g, &s, out, max_joint);
    free(s.row);
    return ok;
}

bool gltf_weights(struct gltf *g, int array, int count, float **out)
{
    int k = 0;
    *out = gltf_alloc(g, (size_t)count, sizeof **out);
    if (*out == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0 && k < count; i = json_after(&g->json, i)) {
        double weight;
        if (!json_to_number(&g->json, i, &weight, g->f))
            return false;
        if (fabs(weight) > FLT_MAX)
            return json_fail(&g->json, i, NULL, g->f, "%g is no weight", weight);
        (*out)[k++] = (float)weight;
    }
    return true;
}

/* The default weights; as many as there are morph targets, whose number all primitives share. */
static bool read_mesh_weights(struct gltf *g, int object, struct model_mesh *mesh)
{
    int array;
    for (int i = 0; i < mesh->primitive_count; i++) {
        if (mesh->primitive[i].target_count != mesh->primitive[0].target_count)
            return json_fail(&g->json, object, NULL, g->f,
                             "its primitives differ in their number of morph targets");
    }
    int count = mesh->primitive_count > 0 ? mesh->primitive[0].target_count : 0;
    if (!json_get_array(&g->json, object, "weights", &array, g->f))
        return false;
    if (array >= 0 && g->json.value[array].count != count && mesh->primitive_count > 0)
        return json_fail(&g->json, array, NULL, g->f, "%d weights for %d morph targets",
                         g->json.value[array].count, count);
    mesh->weight_count = count;
    return gltf_weights(g, array, count, &mesh->weight);
}

static bool read_mesh(struct gltf *g, int object, struct model_mesh *mesh, int *max_joint)
{
    int array, count;
    mesh->name = gltf_name(g, object);
    if (mesh->name == NULL || !gltf_list(g, object, "primitives", &array, &count))
        return false;
    mesh->primitive = gltf_alloc(g, (size_t)count, sizeof *mesh->primitive);
    if (mesh->primitive == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        bool kept;
        /* Counted while it is read, so that what a failure leaves behind is freed. */
        struct model_primitive *primitive = &mesh->primitive[mesh->primitive_count++];
        if (!read_primitive(g, i, primitive, &kept, max_joint))
            return false;
        if (!kept) {
            mesh->primitive_count--;
            g->model->skipped_primitives++;
        }
    }
    return read_mesh_weights(g, object, mesh);
}

bool gltf_read_meshes(struct gltf *g)
{
    int array, count;
    if (!gltf_list(g, 0, "meshes", &array, &count))
        return false;
    g->model->mesh = gltf_alloc(g, (size_t)count, sizeof *g->model->mesh);
    g->max_joint = gltf_alloc(g, (size_t)count, sizeof *g->max_joint);
    if (g->model->mesh == NULL || g->max_joint == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        int index = g->model->mesh_count++;
        g->max_joint[index] = -1;
        if (!read_mesh(g, i, &g->model->mesh[index], &g->max_joint[index]))
            return false;
    }
    return true;
}

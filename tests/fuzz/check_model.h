/* SPDX-License-Identifier: MIT */
/* check_model.h - what must hold of any bytes that are given to the loader: they are a model that keeps what model.h promises, and can
 * be posed, shown and converted, or each of these is refused with a reason. And text and chunks, of which fuzzers write files. */
#pragma once

#include "tests/fuzz/require.h"
#include "tools/convert/convert.h"
#include "tools/image/buffer.h"
#include "tools/scenes/present.h"

#include <math.h>

/* ------------------------------------------------------------------ files */

/* What is written. */
static struct buffer text;
#define say(...) buffer_print(&text, __VA_ARGS__)

/* A GLB of its two chunks, which the caller frees. */
static inline uint8_t *glb_of(const void *json, size_t json_size, const void *bin, size_t bin_size, size_t *size)
{
    *size = 28 + json_size + bin_size;
    const uint32_t head[5] = { 0x46546c67, 2, (uint32_t)*size, (uint32_t)json_size, 0x4e4f534a };
    const uint32_t chunk[2] = { (uint32_t)bin_size, 0x004e4942 };
    uint8_t *glb = malloc(*size);
    require(glb != NULL);
    memcpy(glb, head, 20);
    memcpy(glb + 20, json, json_size);
    memcpy(glb + 20 + json_size, chunk, 8);
    if (bin_size > 0)
        memcpy(glb + 28 + json_size, bin, bin_size);
    return glb;
}

/* ------------------------------------------------------------------ what must hold */

static inline void require_finite(const float *values, size_t n)
{
    for (size_t i = 0; values != NULL && i < n; i++)
        require(isfinite(values[i]));
}

static inline void check_primitive(const struct model *m, const struct model_primitive *p)
{
    size_t n = (size_t)p->vertex_count;
    require(p->vertex_count > 0 && p->triangle_count > 0 && p->position != NULL);
    require(p->material >= 0 && p->material < m->material_count);
    require(p->uv != NULL || m->material[p->material].image < 0);
    require_finite(p->position, 3 * n);
    require_finite(p->normal, 3 * n);
    require_finite(p->uv, 2 * n);
    require_finite(p->color, 4 * n);
    for (size_t i = 0; i < 3 * (size_t)p->triangle_count; i++)
        require(p->index[i] < (uint32_t)p->vertex_count);
    for (int i = 0; i < p->target_count; i++) {
        require_finite(p->target_position[i], 3 * n);
        require_finite(p->target_normal[i], 3 * n);
    }
    require(p->influences == 0 || p->influences == 4 || p->influences == 8);
    for (size_t v = 0; v < n && p->influences > 0; v++) {
        float sum = 0;
        for (int k = 0; k < p->influences; k++)
            sum += p->weight[v * (size_t)p->influences + (size_t)k];
        require(fabsf(sum - 1) < 1e-4f);
    }
}

static inline void check_nodes(const struct model *m)
{
    for (int i = 0; i < m->node_count; i++) {
        const struct model_node *node = &m->node[i];
        require(node->name != NULL && m->order[i] >= 0 && m->order[i] < m->node_count);
        require(node->mesh < m->mesh_count && node->skin < m->skin_count);
        if (node->mesh < 0 || node->skin < 0)
            continue;
        const struct model_mesh *mesh = &m->mesh[node->mesh];
        for (int k = 0; k < mesh->primitive_count; k++) {
            const struct model_primitive *p = &mesh->primitive[k];
            size_t n = p->joint == NULL ? 0 : (size_t)p->vertex_count * (size_t)p->influences;
            for (size_t j = 0; j < n; j++)
                require(p->joint[j] < m->skin[node->skin].joint_count);
        }
    }
}

static inline void check_model(const struct model *m)
{
    for (int i = 0; i < m->mesh_count; i++) {
        for (int k = 0; k < m->mesh[i].primitive_count; k++) {
            require(m->mesh[i].primitive[k].target_count == m->mesh[i].weight_count);
            check_primitive(m, &m->mesh[i].primitive[k]);
        }
    }
    check_nodes(m);
    for (int i = 0; i < m->material_count; i++)
        require(m->material[i].image < m->image_count && m->material[i].name != NULL);
    for (int i = 0; i < m->clip_count; i++) {
        for (int k = 0; k < m->clip[i].channel_count; k++) {
            const struct model_channel *c = &m->clip[i].channel[k];
            require(c->node < m->node_count && c->key_count > 0);
            require_finite(c->time, (size_t)c->key_count);
        }
    }
}

static inline void check_pose(const struct model *m, int clip, double time, double now)
{
    struct model_pose pose = { 0 };
    struct failure f = { 0 };
    double min[3], max[3];
    if (model_pose_joined(m, clip, time, now, true, &pose, &f)) {
        for (int i = 0; i < pose.draw_count; i++) {
            size_t n = 3 * (size_t)pose.draw[i].primitive->vertex_count;
            require_finite(pose.draw[i].position, n);
            require_finite(pose.draw[i].normal, n);
        }
        if (model_pose_bounds(&pose, min, max)) {
            for (int k = 0; k < 3; k++)
                require(isfinite(min[k]) && min[k] <= max[k]);
        }
    } else {
        require(f.text[0] != '\0');
    }
    model_pose_free(&pose);
}

static inline void show(const struct model *m)
{
    struct failure f = { "" };
    struct scene scene;
    const struct scene_view view = { .clip = m->clip_count > 0 ? 0 : MODEL_CLIP_NONE, .camera = m->camera_count > 0 ? 0 : -1 };
    const struct present_options options = { .fps = 30.0, .shutter_degrees = 180.0 };
    if (scene_from_model(m, &view, &scene, &f)) {
        struct presenter *presenter = presenter_new(&scene, &f);
        require(presenter != NULL);
        require(presenter_frame(presenter, 0.25, &options, &f) != NULL || f.text[0] != '\0');
        presenter_free(presenter);
        scene_free(&scene);
    } else {
        require(f.text[0] != '\0');
    }
}

/* Sixteen bits choose the options. */
static inline void convert(const struct model *m, unsigned choice)
{
    int clip[8];
    struct failure f = { "" };
    struct conversion c;
    uint8_t *keep = calloc((size_t)m->node_count + 1, 1);
    require(keep != NULL);
    memset(keep, choice >> 15 & 1, (size_t)m->node_count);
    struct convert_options o = {
        .clip = clip, .scale = choice & 1 ? 1 : 0.01, .fit = choice & 2 ? 10 : 0, .z_up = choice & 4, .keep = keep,
        .texture = (enum convert_texture)((choice >> 3 & 31) % 5), .texture_edge = 1 << (choice >> 8 & 7), .colors = 16,
        .flat = choice & 64, .influences = 1 + (int)(choice >> 11 & 3), .clip_error_px = choice & 1 << 13 ? 1 : 0.1,
        .rows = 240, .fov_degrees = 45, .mipmaps = (choice & 2) != 0
    };
    for (; o.clip_count < m->clip_count && o.clip_count < 8; o.clip_count++)
        clip[o.clip_count] = o.clip_count;
    if (convert_model(m, &o, &c, &f)) {
        uint8_t *bytes;
        size_t size;
        require(convert_to_header(&c, "m", "m.glb", &bytes, &size, &f));
        require(size > 0 && bytes[size - 1] == '\n');
        free(bytes);
        require(convert_to_blob(&c, &bytes, &size, &f));
        require(smear_mesh_check(bytes, size) == SMEAR_OK);
        free(bytes);
        conversion_free(&c);
    } else {
        require(f.text[0] != '\0');
    }
    free(keep);
}

/* The bytes are copied to a block of exactly their size, so that one that is read too far is seen. */
static inline void check_file(const uint8_t *data, size_t size, unsigned choice)
{
    struct failure f = { "" };
    struct model m;
    uint8_t *exact = malloc(size + (size == 0));
    require(exact != NULL);
    memcpy(exact, data, size);
    if (model_parse(exact, size, NULL, &m, &f)) {
        check_model(&m);
        check_pose(&m, MODEL_CLIP_ALL, 0.3, 0.3);
        check_pose(&m, MODEL_CLIP_ALL, -0.4, 0.3);
        check_pose(&m, MODEL_CLIP_NONE, 0, 0);
        show(&m);
        convert(&m, choice);
        model_free(&m);
    } else {
        require(f.text[0] != '\0' && m.node == NULL);
    }
    free(exact);
}

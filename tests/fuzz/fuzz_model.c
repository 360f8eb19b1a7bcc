/* SPDX-License-Identifier: MIT */
/* fuzz_model.c - libFuzzer target: any bytes are a model or a clear failure, and what a model
 * promises (model.h) holds.
 *
 * Input that begins with byte 1 is JSON, a NUL and a BIN chunk, which are wrapped into a GLB
 * here, so that a mutation need not keep GLB's lengths right. Anything else goes to model_parse
 * as it is. Seeds are in tests/fuzz/corpus/model; gltf.dict there is the dictionary. */
#include "tests/fuzz/require.h"
#include "tools/model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require_finite(const float *values, size_t n)
{
    for (size_t i = 0; values != NULL && i < n; i++)
        require(isfinite(values[i]));
}

static void check_primitive(const struct model *m, const struct model_primitive *p)
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

static void check_nodes(const struct model *m)
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

static void check_model(const struct model *m)
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

static void check_pose(const struct model *m, int clip, double time, double now)
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

static void put_u32(uint8_t *at, size_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> 8 * i);
}

/* A GLB of the JSON before the first NUL and the BIN chunk after it. */
static uint8_t *wrap(const uint8_t *data, size_t size, size_t *glb_size)
{
    const uint8_t *nul = memchr(data, '\0', size);
    size_t text = nul == NULL ? size : (size_t)(nul - data);
    size_t bin = nul == NULL ? 0 : size - text - 1;
    *glb_size = 12 + 8 + text + 8 + bin;
    uint8_t *glb = malloc(*glb_size);
    if (glb == NULL)
        abort();
    memcpy(glb, "glTF", 4);
    put_u32(glb + 4, 2);
    put_u32(glb + 8, *glb_size);
    put_u32(glb + 12, text);
    memcpy(glb + 16, "JSON", 4);
    memcpy(glb + 20, data, text);
    put_u32(glb + 20 + text, bin);
    memcpy(glb + 24 + text, "BIN", 4);
    if (bin > 0)
        memcpy(glb + 28 + text, nul + 1, bin);
    return glb;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct model m;
    struct failure f = { 0 };
    uint8_t *glb = NULL;
    if (size > 0 && data[0] == 1) {
        size_t glb_size;
        glb = wrap(data + 1, size - 1, &glb_size);
        data = glb;
        size = glb_size;
    }
    if (model_parse(data, size, NULL, &m, &f)) {
        check_model(&m);
        check_pose(&m, MODEL_CLIP_ALL, 0.3, 0.3);
        check_pose(&m, MODEL_CLIP_ALL, -0.4, 0.3);
        check_pose(&m, MODEL_CLIP_NONE, 0, 0);
        model_free(&m);
    } else {
        require(f.text[0] != '\0' && m.node == NULL);
    }
    free(glb);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* model.c - loads a model of either format, frees it, finds things in it by name. */
#include "tools/model/model.h"

#include "tools/image/file.h"
#include "tools/model/external.h"
#include "tools/model/gltf.h"
#include "tools/model/obj.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* More draws, more to add up per pose (vertices times their morph targets and joints), or more
 * memory for what deforms, than any scene for small machines needs; a short file can ask for each
 * without end by using one mesh in many nodes. */
enum { MAX_DRAWS = 65535, MAX_TRIANGLES = 1 << 20, MAX_TERMS = 1 << 26, JOINT_TERMS = 64 };

static void free_primitive(struct model_primitive *p)
{
    for (int i = 0; i < p->target_count; i++) {
        free(p->target_position[i]);
        free(p->target_normal[i]);
    }
    free(p->target_position);
    free(p->target_normal);
    free(p->position);
    free(p->normal);
    free(p->uv);
    free(p->color);
    free(p->index);
    free(p->joint);
    free(p->weight);
}

static void free_meshes(struct model *model)
{
    for (int i = 0; i < model->mesh_count; i++) {
        struct model_mesh *mesh = &model->mesh[i];
        for (int k = 0; k < mesh->primitive_count; k++)
            free_primitive(&mesh->primitive[k]);
        free(mesh->primitive);
        free(mesh->weight);
        free(mesh->name);
    }
    free(model->mesh);
}

static void free_clips(struct model *model)
{
    for (int i = 0; i < model->clip_count; i++) {
        struct model_clip *clip = &model->clip[i];
        for (int k = 0; k < clip->channel_count; k++) {
            free(clip->channel[k].time);
            free(clip->channel[k].value);
        }
        free(clip->channel);
        free(clip->name);
    }
    free(model->clip);
}

void model_free(struct model *model)
{
    for (int i = 0; i < model->node_count; i++) {
        free(model->node[i].name);
        free(model->node[i].weight);
    }
    free(model->node);
    free(model->order);
    free(model->in_scene);
    free_meshes(model);
    for (int i = 0; i < model->material_count; i++)
        free(model->material[i].name);
    free(model->material);
    for (int i = 0; i < model->image_count; i++)
        image_free(&model->image[i]);
    free(model->image);
    for (int i = 0; i < model->skin_count; i++) {
        free(model->skin[i].name);
        free(model->skin[i].joint);
        free(model->skin[i].inverse_bind);
    }
    free(model->skin);
    for (int i = 0; i < model->camera_count; i++)
        free(model->camera[i].name);
    free(model->camera);
    free_clips(model);
    *model = (struct model){ 0 };
}

void model_show_both_sides(struct model *model)
{
    for (int i = 0; i < model->material_count; i++)
        model->material[i].double_sided = true;
    model->has_sides = true;
}

void model_warn(struct model *model, const char *format, ...)
{
    size_t used = strlen(model->warning);
    va_list args;
    if (used > 0 && used + 2 < sizeof model->warning) {
        memcpy(model->warning + used, "; ", 3);
        used += 2;
    }
    va_start(args, format);
    vsnprintf(model->warning + used, sizeof model->warning - used, format, args);
    va_end(args);
}

static bool check_instances(const struct model *model, struct failure *f)
{
    size_t draws = 0, bytes = 0, terms = 0, triangles = 0;
    for (int i = 0; i < model->node_count; i++) {
        const struct model_node *node = &model->node[i];
        if (node->mesh < 0)
            continue;
        const struct model_mesh *mesh = &model->mesh[node->mesh];
        bytes += (size_t)mesh->weight_count * sizeof(double);
        if (model->in_scene[i] && node->skin >= 0)
            terms += (size_t)model->skin[node->skin].joint_count * JOINT_TERMS;
        if (model->in_scene[i])
            draws += (size_t)mesh->primitive_count;
        for (int k = 0; model->in_scene[i] && k < mesh->primitive_count; k++) {
            const struct model_primitive *p = &mesh->primitive[k];
            if (p->target_count > 0 || (node->skin >= 0 && p->joint != NULL))
                bytes += (size_t)p->vertex_count * 6 * sizeof(float);
            terms += (size_t)p->vertex_count * (size_t)(p->target_count + p->influences);
            triangles += (size_t)p->triangle_count;
        }
        if (draws > MAX_DRAWS || bytes > MODEL_MAX_BYTES || terms > MAX_TERMS)
            return fail(f, "too many nodes use its meshes: above %d draws, %zu MB or %d terms a "
                        "pose", MAX_DRAWS, MODEL_MAX_BYTES >> 20, MAX_TERMS);
    }
    return triangles <= MAX_TRIANGLES ||
           fail(f, "draws %zu triangles, more than %d", triangles, MAX_TRIANGLES);
}

static bool is_gltf(const uint8_t *bytes, size_t size)
{
    static const uint8_t byte_order_mark[3] = { 0xef, 0xbb, 0xbf };
    if (size >= 4 && memcmp(bytes, "glTF", 4) == 0)
        return true;
    size_t at = size >= 3 && memcmp(bytes, byte_order_mark, 3) == 0 ? 3 : 0;
    while (at < size && (bytes[at] == ' ' || bytes[at] == '\t' || bytes[at] == '\n' ||
                         bytes[at] == '\r'))
        at++;
    return at < size && bytes[at] == '{';
}

static bool parse(const uint8_t *bytes, size_t size, struct external *files, struct model *out, struct failure *f)
{
    *out = (struct model){ 0 };
    if (size == 0)
        return fail(f, "the file is empty");
    if (size >= 4 && memcmp(bytes, "SMR1", 4) == 0)
        return fail(f, "a converted model, for firmware only: give the file it was made from");
    bool ok = is_gltf(bytes, size) ? gltf_parse(bytes, size, files, out, f) : obj_parse(bytes, size, files, out, f);
    if (ok && check_instances(out, f)) {
        if (out->skipped_primitives > 0)
            model_warn(out, "%d primitive%s no triangles and %s left out", out->skipped_primitives,
                       out->skipped_primitives > 1 ? "s hold" : " holds", out->skipped_primitives > 1 ? "are" : "is");
        return true;
    }
    model_free(out);
    return false;
}

bool model_parse(const uint8_t *bytes, size_t size, const char *folder, struct model *out,
                 struct failure *f)
{
    struct external files = { .folder = folder };
    return parse(bytes, size, &files, out, f);
}

static bool has_suffix(const char *path, const char *suffix)
{
    size_t length = strlen(path), n = strlen(suffix);
    if (length < n)
        return false;
    for (size_t i = 0; i < n; i++) {
        if (tolower((unsigned char)path[length - n + i]) != suffix[i])
            return false;
    }
    return true;
}

/* By the first bytes of a file: whether it can be what its name says. */
static bool look_at_head(const void *path, const uint8_t *head, size_t size, struct failure *f)
{
    if (size > 0 && !is_gltf(head, size) && (has_suffix(path, ".glb") || has_suffix(path, ".gltf")))
        return fail(f, "not glTF: begins neither like a GLB nor like JSON");
    if (size > 0 && !is_gltf(head, size) && memchr(head, '\0', size) != NULL && (size < 4 || memcmp(head, "SMR1", 4) != 0))
        return fail(f, "neither glTF nor text");
    return true;
}

bool model_load_from(const char *path, enum model_files files, struct model *out, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    *out = (struct model){ 0 };
    if (!file_keep(path, f))
        return false;
    FILE *stream = fopen(path, "rb");
    if (stream == NULL)
        return fail(f, "cannot be opened (%s)", strerror(errno));
    if (!file_read_stream(stream, MODEL_MAX_BYTES, look_at_head, path, &bytes, &size, f))
        return false;
    const char *slash = strrchr(path, '/');
    size_t length = slash == NULL ? 0 : (size_t)(slash - path) + 1;
    char *folder = malloc(length + 1);
    bool ok = folder != NULL || fail(f, "out of memory (a path)");
    if (ok) {
        memcpy(folder, path, length);
        folder[length] = '\0';
        struct external external = { .folder = folder, .anywhere = files == MODEL_FILES_ANYWHERE };
        ok = parse(bytes, size, &external, out, f);
    }
    free(folder);
    free(bytes);
    return ok;
}

bool model_load(const char *path, struct model *out, struct failure *f)
{
    return model_load_from(path, MODEL_FILES_BESIDE, out, f);
}

/* The whole text as a decimal index below count, else -1. */
static int decimal_index(const char *text, int count)
{
    long value = 0;
    if (*text == '\0')
        return -1;
    for (; *text != '\0'; text++) {
        if (*text < '0' || *text > '9' || value > INT_MAX / 10)
            return -1;
        value = value * 10 + (*text - '0');
    }
    return value < count ? (int)value : -1;
}

int model_find_clip(const struct model *model, const char *name_or_index)
{
    for (int i = 0; i < model->clip_count && *name_or_index != '\0'; i++) {
        if (strcmp(model->clip[i].name, name_or_index) == 0)
            return i;
    }
    return decimal_index(name_or_index, model->clip_count);
}

int model_find_camera(const struct model *model, const char *name_or_index)
{
    for (int i = 0; i < model->camera_count && *name_or_index != '\0'; i++) {
        if (strcmp(model->camera[i].name, name_or_index) == 0)
            return i;
    }
    return decimal_index(name_or_index, model->camera_count);
}

int model_find_node(const struct model *model, const char *name)
{
    for (int i = 0; i < model->node_count && *name != '\0'; i++) {
        if (strcmp(model->node[i].name, name) == 0)
            return i;
    }
    return -1;
}

bool model_node_is_under(const struct model *model, int node, int ancestor)
{
    while (node >= 0 && node != ancestor)
        node = model->node[node].parent;
    return node >= 0;
}

/* SPDX-License-Identifier: MIT */
/* gltf.c - the glTF 2.0 container (.glb and .gltf) and the order in which its parts are read. */
#include "tools/model/gltf.h"

#include <stdlib.h>
#include <string.h>

static uint32_t read_u32(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

void *gltf_alloc(struct gltf *g, size_t count, size_t size)
{
    size_t left = MODEL_MAX_BYTES - g->decoded_bytes;
    if (count > left / size) {
        fail(g->f, "its arrays need more than %zu MB", MODEL_MAX_BYTES >> 20);
        return NULL;
    }
    g->decoded_bytes += count * size;
    void *memory = calloc(count == 0 ? 1 : count, size);
    if (memory == NULL)
        fail(g->f, "out of memory (%zu bytes)", count * size);
    return memory;
}

bool gltf_list(struct gltf *g, int object, const char *key, int *array, int *count)
{
    *count = 0;
    if (!json_get_array(&g->json, object, key, array, g->f))
        return false;
    if (*array < 0)
        return true;
    for (int i = json_first(&g->json, *array); i >= 0; i = json_after(&g->json, i)) {
        if (g->json.value[i].type != JSON_OBJECT)
            return json_fail(&g->json, i, NULL, g->f, "expected an object");
    }
    *count = g->json.value[*array].count;
    return true;
}

char *gltf_copy(struct gltf *g, const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = gltf_alloc(g, size, 1);
    if (copy != NULL)
        memcpy(copy, text, size);
    return copy;
}

char *gltf_name(struct gltf *g, int object)
{
    const char *name = "";
    return json_get_string(&g->json, object, "name", &name, g->f) ? gltf_copy(g, name) : NULL;
}

int gltf_extension(struct gltf *g, int object, const char *name)
{
    return json_member(&g->json, json_member(&g->json, object, "extensions"), name);
}

/* GLB: magic, version, length; then chunks of length, type, bytes. JSON first, BIN second if any;
 * what follows is for extensions. */
static bool split_glb(const uint8_t *bytes, size_t size, const uint8_t **text, size_t *text_size,
                      struct gltf *g)
{
    enum { HEADER = 12, CHUNK_HEADER = 8 };
    const uint32_t json_chunk = 0x4e4f534a, bin_chunk = 0x004e4942;
    if (size < HEADER + CHUNK_HEADER)
        return fail(g->f, "GLB is cut off in its header");
    if (read_u32(bytes + 4) != 2)
        return fail(g->f, "GLB version %u, not 2", (unsigned)read_u32(bytes + 4));
    size_t length = read_u32(bytes + 8);
    if (length > size)
        return fail(g->f, "GLB is cut off: %zu of %zu bytes", size, length);
    size_t at = HEADER;
    for (int chunk = 0; chunk < 2 && at < length; chunk++) {
        if (length - at < CHUNK_HEADER)
            return fail(g->f, "GLB chunk %d is cut off in its header", chunk);
        size_t chunk_size = read_u32(bytes + at);
        uint32_t type = read_u32(bytes + at + 4);
        at += CHUNK_HEADER;
        if (chunk_size > length - at)
            return fail(g->f, "GLB chunk %d of %zu bytes reaches past the end", chunk, chunk_size);
        if (chunk == 0) {
            if (type != json_chunk)
                return fail(g->f, "the first GLB chunk is not JSON");
            *text = bytes + at;
            *text_size = chunk_size;
        } else if (type == bin_chunk) {
            g->bin = bytes + at;
            g->bin_size = chunk_size;
        }
        at += chunk_size;
    }
    return *text != NULL || fail(g->f, "GLB has no JSON chunk");
}

static bool check_asset(struct gltf *g)
{
    int asset;
    const char *version = NULL, *min_version = "2.0";
    if (g->json.value[0].type != JSON_OBJECT)
        return fail(g->f, "not glTF: the JSON is no object");
    if (!json_get_object(&g->json, 0, "asset", &asset, g->f) ||
        !json_get_string(&g->json, asset, "version", &version, g->f) ||
        !json_get_string(&g->json, asset, "minVersion", &min_version, g->f))
        return false;
    if (version == NULL)
        return fail(g->f, "not glTF: no version (asset.version)");
    if (strncmp(version, "2.", 2) != 0)
        return fail(g->f, "glTF version %.20s, not 2 (asset.version)", version);
    if (strcmp(min_version, "2.0") != 0)
        return fail(g->f, "needs glTF version %.20s (asset.minVersion)", min_version);
    return true;
}

static bool read_all(struct gltf *g)
{
    return check_asset(g) && gltf_read_extensions(g) && gltf_read_buffers(g) &&
           gltf_read_accessors(g) && gltf_read_materials(g) && gltf_read_meshes(g) &&
           gltf_read_nodes(g) && gltf_read_skins(g) && gltf_read_scene(g) &&
           gltf_read_cameras(g) && gltf_read_lights(g) && gltf_read_animations(g) && gltf_read_instances(g) &&
           gltf_read_pictures(g);
}

bool gltf_parse(const uint8_t *bytes, size_t size, struct external *files, struct model *model, struct failure *f)
{
    struct gltf g = { .model = model, .f = f, .files = files };
    const uint8_t *text = NULL;
    size_t text_size = 0;
    if (size >= 4 && memcmp(bytes, "glTF", 4) == 0) {
        if (!split_glb(bytes, size, &text, &text_size, &g))
            return false;
    } else {
        text = bytes;
        text_size = size;
    }
    g.source_bytes = text_size;
    model->has_sides = true;
    bool ok = json_parse(text, text_size, &g.json, f) && read_all(&g);
    gltf_free_buffers(&g);
    free(g.accessor);
    free(g.material);
    free(g.max_joint);
    json_free(&g.json);
    return ok;
}

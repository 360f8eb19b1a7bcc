/* SPDX-License-Identifier: MIT */
/* gltf_material.c - base colour, alpha and sidedness of materials; the pictures of those that are
 * drawn. Other maps are not looked at, so their pictures may be missing or of any format. */
#include "tools/model/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Value ids of an array's items, for access by index; null when out of memory. */
static int *list_values(struct gltf *g, int array, int count)
{
    int *values = gltf_alloc(g, (size_t)count, sizeof *values), n = 0;
    if (values == NULL)
        return NULL;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i))
        values[n++] = i;
    return values;
}

static bool read_wrap(struct gltf *g, int sampler, const char *key, enum model_wrap *out)
{
    enum { CLAMP_TO_EDGE = 33071, MIRRORED_REPEAT = 33648, REPEAT = 10497 };
    int64_t mode = REPEAT;
    if (!json_get_integer(&g->json, sampler, key, 0, INT32_MAX, &mode, g->f))
        return false;
    if (mode != CLAMP_TO_EDGE && mode != MIRRORED_REPEAT && mode != REPEAT)
        return json_fail(&g->json, sampler, key, g->f, "%d is no wrap mode", (int)mode);
    *out = mode == CLAMP_TO_EDGE ? MODEL_WRAP_CLAMP :
           mode == MIRRORED_REPEAT ? MODEL_WRAP_MIRROR : MODEL_WRAP_REPEAT;
    return true;
}

/* KHR_texture_transform: translation x rotation x scale. A positive rotation turns (1, 0) towards
 * (0, -1), which looks counter-clockwise as v points down; the extension's text and its example
 * say so, while its shader listing has the opposite sign. */
static bool read_uv_transform(struct gltf *g, int texture_info, struct gltf_material *m)
{
    int transform = gltf_extension(g, texture_info, "KHR_texture_transform");
    double offset[2] = { 0, 0 }, scale[2] = { 1, 1 }, angle = 0;
    int64_t set = m->uv_set;
    if (!json_get_numbers(&g->json, transform, "offset", 2, offset, NULL, g->f) ||
        !json_get_numbers(&g->json, transform, "scale", 2, scale, NULL, g->f) ||
        !json_get_number(&g->json, transform, "rotation", &angle, g->f) ||
        !json_get_integer(&g->json, transform, "texCoord", 0, INT32_MAX, &set, g->f))
        return false;
    m->uv_set = (int)set;
    double c = cos(angle), s = sin(angle);
    const double uv[6] = { c * scale[0], s * scale[1], offset[0],
                           -s * scale[0], c * scale[1], offset[1] };
    memcpy(m->uv, uv, sizeof uv);
    return true;
}

struct texture_lists {
    int texture_count, *texture;
    int sampler_count, *sampler;
    int image_count;
};

/* A texture without a source of its own: says in which format it has one. */
static bool refuse_source(struct gltf *g, int texture)
{
    static const struct { const char *extension, *name; } others[] = {
        { "KHR_texture_basisu", "a KTX" }, { "EXT_texture_webp", "a WebP" }, { "EXT_texture_avif", "an AVIF" },
        { "MSFT_texture_dds", "a DDS" }
    };
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (gltf_extension(g, texture, others[i].extension) >= 0)
            return json_fail(&g->json, texture, NULL, g->f, "%s picture alone; PNG and JPEG are read", others[i].name);
    return json_fail(&g->json, texture, NULL, g->f, "no source");
}

static bool read_base_texture(struct gltf *g, const struct texture_lists *lists, int info,
                              struct gltf_material *m, struct model_material *out)
{
    int texture = -1, source = -1, sampler = -1;
    int64_t set = 0;
    if (!json_get_index(&g->json, info, "index", lists->texture_count, "texture", &texture, g->f) ||
        !json_get_integer(&g->json, info, "texCoord", 0, INT32_MAX, &set, g->f))
        return false;
    if (texture < 0)
        return json_fail(&g->json, info, NULL, g->f, "no index");
    m->uv_set = (int)set;
    int object = lists->texture[texture];
    if (!read_uv_transform(g, info, m) ||
        !json_get_index(&g->json, object, "source", lists->image_count, "image", &source, g->f) ||
        !json_get_index(&g->json, object, "sampler", lists->sampler_count, "sampler", &sampler,
                        g->f))
        return false;
    if (source < 0)
        return refuse_source(g, object);
    m->picture = source;
    if (sampler < 0)
        return true;
    return read_wrap(g, lists->sampler[sampler], "wrapS", &out->wrap_u) &&
           read_wrap(g, lists->sampler[sampler], "wrapT", &out->wrap_v);
}

static bool read_alpha(struct gltf *g, int object, struct model_material *out)
{
    const char *mode = "OPAQUE";
    double cutoff = 0.5;
    if (!json_get_string(&g->json, object, "alphaMode", &mode, g->f) ||
        !json_get_number(&g->json, object, "alphaCutoff", &cutoff, g->f) ||
        !json_get_bool(&g->json, object, "doubleSided", &out->double_sided, g->f))
        return false;
    out->alpha_cutoff = (float)cutoff;
    if (strcmp(mode, "OPAQUE") == 0)
        out->alpha = MODEL_ALPHA_OPAQUE;
    else if (strcmp(mode, "MASK") == 0)
        out->alpha = MODEL_ALPHA_MASK;
    else if (strcmp(mode, "BLEND") == 0)
        out->alpha = MODEL_ALPHA_BLEND;
    else
        return json_fail(&g->json, object, "alphaMode", g->f, "'%.20s' is no alpha mode", mode);
    return true;
}

static void set_defaults(struct gltf_material *m, struct model_material *out)
{
    *m = (struct gltf_material){ .picture = -1, .uv = { 1, 0, 0, 0, 1, 0 } };
    *out = (struct model_material){ .base = { 1, 1, 1, 1 }, .image = -1, .alpha_cutoff = 0.5f };
}

/* Where the base colour stands: in the core's metal and roughness, or in specular and glossiness, whose diffuse part is what
 * smear draws of it. */
static bool find_base(struct gltf *g, int object, int *pbr, const char **factor, const char **texture)
{
    *pbr = gltf_extension(g, object, "KHR_materials_pbrSpecularGlossiness");
    *factor = *pbr >= 0 ? "diffuseFactor" : "baseColorFactor";
    *texture = *pbr >= 0 ? "diffuseTexture" : "baseColorTexture";
    return *pbr >= 0 || json_get_object(&g->json, object, "pbrMetallicRoughness", pbr, g->f);
}

/* Reads a highlight from the core's metal and roughness: that of a material that says how rough it is, without a picture of it. Its
 * exponent is that of Blinn and Phong which is as wide, 2 / roughness^4 - 2, its strength what a surface at right angles reflects of
 * the light, spread by the exponent: a rough one shows none. */
static bool read_gloss(struct gltf *g, int pbr, const double base[4], struct model_material *out)
{
    double metallic = 1, rough = 1;
    int picture = -1;
    if (!json_get_number(&g->json, pbr, "metallicFactor", &metallic, g->f) ||
        !json_get_number(&g->json, pbr, "roughnessFactor", &rough, g->f) ||
        !json_get_object(&g->json, pbr, "metallicRoughnessTexture", &picture, g->f))
        return false;
    const double r = rough < 0.2 ? 0.2 : rough, exponent = 2 / (r * r * r * r) - 2;
    const double most = base[0] > base[1] ? base[0] > base[2] ? base[0] : base[2] : base[1] > base[2] ? base[1] : base[2];
    const double part = metallic < 0 ? 0 : metallic > 1 ? 1 : metallic, strength = (0.04 + (most - 0.04) * part) * (exponent + 2) / 8;
    if (pbr < 0 || picture >= 0 || exponent < 2)
        return true;
    out->gloss = (uint8_t)(255 * (strength < 1 ? strength : 1) + 0.5);
    for (out->shine = 1; out->shine < 10 && exponent > 1.4142 * (1 << out->shine);)
        out->shine++;
    return true;
}

static bool read_material(struct gltf *g, const struct texture_lists *lists, int object,
                          struct gltf_material *m, struct model_material *out)
{
    int pbr, info;
    const char *factor, *texture;
    double base[4] = { 1, 1, 1, 1 };
    set_defaults(m, out);
    out->name = gltf_name(g, object);
    if (out->name == NULL || !read_alpha(g, object, out) ||
        !find_base(g, object, &pbr, &factor, &texture) ||
        !json_get_numbers(&g->json, pbr, factor, 4, base, NULL, g->f) ||
        !json_get_object(&g->json, pbr, texture, &info, g->f))
        return false;
    for (int i = 0; i < 4; i++) {
        if (base[i] < 0 || base[i] > 1)
            return json_fail(&g->json, pbr, factor, g->f, "%g is not in 0 to 1",
                             base[i]);
        out->base[i] = (float)base[i];
    }
    out->unlit = gltf_extension(g, object, "KHR_materials_unlit") >= 0;
    if (strcmp(factor, "baseColorFactor") == 0 && !read_gloss(g, pbr, base, out))
        return false;
    return info < 0 || read_base_texture(g, lists, info, m, out);
}

static bool read_list(struct gltf *g, const struct texture_lists *lists)
{
    int array, count;
    if (!gltf_list(g, 0, "materials", &array, &count))
        return false;
    /* One more for the default material. */
    g->material = gltf_alloc(g, (size_t)count + 1, sizeof *g->material);
    g->model->material = gltf_alloc(g, (size_t)count + 1, sizeof *g->model->material);
    if (g->material == NULL || g->model->material == NULL)
        return false;
    for (int i = json_first(&g->json, array); i >= 0; i = json_after(&g->json, i)) {
        int index = g->model->material_count++;
        if (!read_material(g, lists, i, &g->material[index], &g->model->material[index]))
            return false;
    }
    g->material_count = count;
    return true;
}

bool gltf_read_materials(struct gltf *g)
{
    struct texture_lists lists = { 0 };
    int textures, samplers, images;
    if (!gltf_list(g, 0, "textures", &textures, &lists.texture_count) ||
        !gltf_list(g, 0, "samplers", &samplers, &lists.sampler_count) ||
        !gltf_list(g, 0, "images", &images, &lists.image_count))
        return false;
    lists.texture = list_values(g, textures, lists.texture_count);
    lists.sampler = list_values(g, samplers, lists.sampler_count);
    bool ok = lists.texture != NULL && lists.sampler != NULL && read_list(g, &lists);
    free(lists.texture);
    free(lists.sampler);
    return ok;
}

bool gltf_default_material(struct gltf *g, int *out)
{
    *out = g->material_count;
    if (g->model->material_count > g->material_count)
        return true;
    set_defaults(&g->material[*out], &g->model->material[*out]);
    g->model->material_count++;
    g->model->material[*out].name = gltf_alloc(g, 1, 1);
    return g->model->material[*out].name != NULL;
}

static bool read_picture(struct gltf *g, int object, struct image *out)
{
    const char *uri = NULL;
    int view = -1;
    uint8_t *owned = NULL;
    const uint8_t *bytes;
    size_t size;
    if (!json_get_string(&g->json, object, "uri", &uri, g->f) ||
        !json_get_index(&g->json, object, "bufferView", g->view_count, "buffer view", &view, g->f))
        return false;
    if (view >= 0) {
        if (!gltf_has_bytes(g, view, object))
            return false;
        bytes = g->view[view].bytes;
        size = g->view[view].size;
    } else {
        if (uri == NULL)
            return json_fail(&g->json, object, NULL, g->f, "no uri and no bufferView");
        if (!gltf_read_uri(g, object, uri, &owned, &size))
            return false;
        bytes = owned;
    }
    struct failure why = { 0 };
    bool ok = size <= MODEL_MAX_BYTES - g->packed_bytes ? picture_decode(bytes, size, out, &why) :
              fail(&why, "the pictures are files of more than %zu MB", MODEL_MAX_BYTES >> 20);
    free(owned);
    g->packed_bytes += size;
    if (!ok)
        return json_fail(&g->json, object, NULL, g->f, "%s", why.text);
    size_t decoded = (size_t)out->width * (size_t)out->height * 4;
    if (decoded > MODEL_MAX_BYTES - g->decoded_bytes)
        return json_fail(&g->json, object, NULL, g->f, "the pictures need more than %zu MB",
                         MODEL_MAX_BYTES >> 20);
    g->decoded_bytes += decoded;
    return true;
}

static bool read_drawn(struct gltf *g, const int *object, int *model_image)
{
    struct model *model = g->model;
    for (int i = 0; i < model->material_count; i++) {
        int picture = g->material[i].picture;
        if (!g->material[i].is_drawn || picture < 0)
            continue;
        if (model_image[picture] < 0) {
            model_image[picture] = model->image_count++;
            if (!read_picture(g, object[picture], &model->image[model_image[picture]]))
                return false;
        }
        model->material[i].image = model_image[picture];
    }
    return true;
}

bool gltf_read_pictures(struct gltf *g)
{
    int array, count;
    if (!gltf_list(g, 0, "images", &array, &count))
        return false;
    int *object = list_values(g, array, count);
    int *model_image = gltf_alloc(g, (size_t)count, sizeof *model_image);
    g->model->image = gltf_alloc(g, (size_t)count, sizeof *g->model->image);
    bool ok = object != NULL && model_image != NULL && g->model->image != NULL;
    for (int i = 0; ok && i < count; i++)
        model_image[i] = -1;
    ok = ok && read_drawn(g, object, model_image);
    free(object);
    free(model_image);
    return ok;
}

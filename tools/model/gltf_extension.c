/* SPDX-License-Identifier: MIT */
/* gltf_extension.c - what becomes of the extensions that a file names: read, drawn without, or refused. */
#include "tools/model/gltf.h"

#include <string.h>

/* What a picture lacks without an extension. */
enum effect {
    EFFECT_READ,                /* nothing: it is read */
    EFFECT_NOTE,                /* nothing: notes, sounds, choices that the file has made already */
    EFFECT_LOOK,                /* shine, lights, a motion: the shape is there */
    EFFECT_MESHES,              /* triangles: they lie in the file in packed form */
    EFFECT_PICTURES,            /* pictures, likewise */
    EFFECT_UNKNOWN
};

/* The first that fits. A star stands for any ending. */
static const struct { const char *name; enum effect effect; } extensions[] = {
    { "EXT_mesh_gpu_instancing", EFFECT_READ }, { "KHR_lights_punctual", EFFECT_READ },
    { "KHR_materials_pbrSpecularGlossiness", EFFECT_READ }, { "KHR_materials_unlit", EFFECT_READ },
    { "KHR_mesh_quantization", EFFECT_READ }, { "KHR_texture_transform", EFFECT_READ },
    { "AGI_*", EFFECT_NOTE }, { "EXT_feature_metadata", EFFECT_NOTE }, { "EXT_instance_features", EFFECT_NOTE },
    { "EXT_mesh_features", EFFECT_NOTE }, { "EXT_structural_metadata", EFFECT_NOTE }, { "GODOT_*", EFFECT_NOTE },
    { "KHR_audio*", EFFECT_NOTE }, { "KHR_interactivity", EFFECT_NOTE }, { "KHR_materials_variants", EFFECT_NOTE },
    { "KHR_node_hoverability", EFFECT_NOTE }, { "KHR_node_selectability", EFFECT_NOTE }, { "KHR_physics_*", EFFECT_NOTE },
    { "KHR_xmp*", EFFECT_NOTE }, { "MSFT_audio_emitter", EFFECT_NOTE }, { "MSFT_lod", EFFECT_NOTE },
    { "MSFT_packing_*", EFFECT_NOTE }, { "OMI_*", EFFECT_NOTE },
    { "ADOBE_materials_*", EFFECT_LOOK }, { "CESIUM_*", EFFECT_LOOK }, { "EXT_lights_*", EFFECT_LOOK },
    { "EXT_materials_*", EFFECT_LOOK }, { "KHR_animation_pointer", EFFECT_LOOK }, { "KHR_environment_map", EFFECT_LOOK },
    { "KHR_lights_*", EFFECT_LOOK }, { "KHR_materials_*", EFFECT_LOOK }, { "KHR_node_visibility", EFFECT_LOOK },
    { "VRM", EFFECT_LOOK }, { "VRMC_*", EFFECT_LOOK },
    { "EXT_meshopt_compression", EFFECT_MESHES }, { "KHR_draco_mesh_compression", EFFECT_MESHES },
    { "KHR_meshopt_compression", EFFECT_MESHES },
    { "EXT_texture_avif", EFFECT_PICTURES }, { "EXT_texture_webp", EFFECT_PICTURES },
    { "KHR_texture_basisu", EFFECT_PICTURES }, { "MSFT_texture_dds", EFFECT_PICTURES }
};

static enum effect effect_of(const char *name)
{
    for (size_t i = 0; i < sizeof extensions / sizeof extensions[0]; i++) {
        const char *known = extensions[i].name;
        size_t length = strcspn(known, "*");
        if (strncmp(name, known, length) == 0 && (known[length] == '*' || name[length] == '\0'))
            return extensions[i].effect;
    }
    return EFFECT_UNKNOWN;
}

bool gltf_packed(struct gltf *g, int value, const char *extension)
{
    return json_fail(&g->json, value, NULL, g->f, "its triangles are packed by %s, which is not read; "
                     "`gltf-transform cp IN.glb OUT.glb` unpacks them", extension);
}

static bool refuse(struct gltf *g, int item, const char *name, enum effect effect)
{
    if (effect == EFFECT_MESHES)
        return gltf_packed(g, item, name);
    if (effect == EFFECT_PICTURES)
        return json_fail(&g->json, item, NULL, g->f, "its pictures need the extension %s, which is not read; "
                         "save them as PNG", name);
    return json_fail(&g->json, item, NULL, g->f, "needs the extension %.60s, which is not read", name);
}

static bool is_named_before(const struct gltf *g, int list, int item)
{
    for (int i = json_first(&g->json, list); i >= 0 && i != item; i = json_after(&g->json, i)) {
        if (g->json.value[i].type == JSON_STRING && strcmp(g->json.value[i].string, g->json.value[item].string) == 0)
            return true;
    }
    return false;
}

/* The names of a list that a picture lacks something without, behind those that `text` has. */
struct names {
    char text[800];
    int count, left_out;
};

static void add_name(struct names *names, const char *name)
{
    size_t used = strlen(names->text), room = sizeof names->text - used;
    int length = snprintf(names->text + used, room, "%s%.60s", used > 0 ? ", " : "", name);
    names->count++;
    if (length < 0 || (size_t)length >= room) {
        names->text[used] = '\0';
        names->left_out++;
    }
}

/* More than this many extensions are no file's; the list is gone through once for each. */
enum { MAX_NAMED = 1000 };

bool gltf_read_extensions(struct gltf *g)
{
    static const char *const keys[2] = { "extensionsRequired", "extensionsUsed" };
    struct names names = { .count = 0 };
    int list[2];
    for (int k = 0; k < 2; k++) {
        if (!json_get_array(&g->json, 0, keys[k], &list[k], g->f))
            return false;
        if (list[k] >= 0 && g->json.value[list[k]].count > MAX_NAMED)
            return json_fail(&g->json, list[k], NULL, g->f, "more than %d extensions", MAX_NAMED);
        for (int i = json_first(&g->json, list[k]); i >= 0; i = json_after(&g->json, i)) {
            if (g->json.value[i].type != JSON_STRING)
                return json_fail(&g->json, i, NULL, g->f, "expected a string");
            const char *name = g->json.value[i].string;
            enum effect effect = effect_of(name);
            bool is_needed = k == 0;
            if (is_needed && effect >= EFFECT_MESHES)
                return refuse(g, i, name, effect);
            if ((effect == EFFECT_LOOK || (effect == EFFECT_NOTE && is_needed) || effect == EFFECT_UNKNOWN)
                && !is_named_before(g, list[k], i) && (is_needed || !is_named_before(g, list[0], i)))
                add_name(&names, name);
        }
    }
    if (names.count > names.left_out && names.left_out > 0)
        model_warn(g->model, "drawn without %s and %d more extensions, which are not read", names.text, names.left_out);
    else if (names.count > 0)
        model_warn(g->model, "drawn without %s, which %s not read", names.text, names.count > 1 ? "are" : "is");
    return true;
}

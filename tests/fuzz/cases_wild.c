/* SPDX-License-Identifier: MIT */
/* cases_wild.c - fields of a case that hold anything: see cases.h. A new public field needs a line in a list here. */
#include "tests/fuzz/cases.h"

#include <stdlib.h>
#include <string.h>

struct part {
    uint16_t offset, size;
};

#define PART(type, field)                                                      \
    {                                                                          \
        (uint16_t) offsetof(type, field), (uint16_t)sizeof(((type *)0)->field) \
    }

static void spoil(struct source *s, void *record, const struct part *part, size_t count)
{
    const struct part *p = &part[source_range(s, 0, (int32_t)count - 1)];
    uint8_t *at = (uint8_t *)record + p->offset;
    if (source_chance(s, 3)) { /* any bytes */
        for (int i = 0; i < p->size; i++)
            at[i] = (uint8_t)source_word(s);
        return;
    }
    const int32_t v = source_any(s); /* any number, at some place of an array */
    const size_t size = p->size >= 4 ? 4 : p->size;
    const size_t places = p->size / size;
    memcpy(at + size * (size_t)source_range(s, 0, (int32_t)places - 1), &v, size);
}

#define SPOIL(record, parts) spoil(s, record, parts, sizeof(parts) / sizeof *(parts))

void case_spoil_desc(struct fuzz_case *c)
{
    static const struct part parts[] = {
        PART(smear_desc, width), PART(smear_desc, height), PART(smear_desc, max_triangles), PART(smear_desc, max_draws),
        PART(smear_desc, methods), PART(smear_desc, tile), PART(smear_desc, reach), PART(smear_desc, strip),
        PART(smear_desc, band_rows), PART(smear_desc, bands), PART(smear_desc, format), PART(smear_desc, workers),
        PART(smear_desc, vertex_cache), PART(smear_desc, reuse.cache_static), PART(smear_desc, reuse.buffer_age),
        PART(smear_desc, reuse.one_pose),
        PART(smear_desc, filter.passes), PART(smear_desc, filter.scatter), PART(smear_desc, display.dither),
        PART(smear_desc, display.doubled)
    };
    struct source *s = &c->source;
    do
        SPOIL(&c->desc, parts);
    while (source_chance(s, 3));
}

static const struct part camera_parts[] = {
    PART(smear_camera, pose.basis), PART(smear_camera, pose.origin), PART(smear_camera, focal),
    PART(smear_camera, half_height), PART(smear_camera, near_plane), PART(smear_camera, far_plane)
};
static const struct part frame_parts[] = {
    PART(smear_frame, method), PART(smear_frame, light_space), PART(smear_frame, cut), PART(smear_frame, refresh),
    PART(smear_frame, samples), PART(smear_frame, target), PART(smear_frame, budget), PART(smear_frame, clear),
    PART(smear_frame, shutter.degrees), PART(smear_frame, shutter.exposure), PART(smear_frame, shutter.poses),
    PART(smear_frame, shutter.mode), PART(smear_frame, shutter.path),
    PART(smear_frame, shutter.reference_hz), PART(smear_frame, shutter.frame_us),
    PART(smear_frame, shutter.us), PART(smear_frame, filter.kind), PART(smear_frame, filter.flags),
    PART(smear_frame, filter.weights), PART(smear_frame, filter.camera_step), PART(smear_frame, filter.pingpong.passes),
    PART(smear_frame, filter.pingpong.taps), PART(smear_frame, filter.pingpong.base),
    PART(smear_frame, filter.pingpong.jitter), PART(smear_frame, filter.pingpong.bias),
    PART(smear_frame, filter.pingpong.spread), PART(smear_frame, scale), PART(smear_frame, layer_count),
    PART(smear_frame, edges)
};
static const struct part layer_parts[] = {
    PART(smear_layer, mask), PART(smear_layer, method), PART(smear_layer, over), PART(smear_layer, two_camera),
    PART(smear_layer, shutter_degrees)
};
static const struct part draw_parts[] = {
    PART(smear_draw, id), PART(smear_draw, motion), PART(smear_draw, cut), PART(smear_draw, billboard), PART(smear_draw, path),
    PART(smear_draw, open_count), PART(smear_draw, close_count), PART(smear_draw, layers)
};
static const struct part mesh_parts[] = {
    PART(smear_mesh, shift), PART(smear_mesh, uv_shift), PART(smear_mesh, scale), PART(smear_mesh, offset),
    PART(smear_mesh, bounds)
};
static const struct part material_parts[] = {
    PART(smear_material, alpha), PART(smear_material, cutoff), PART(smear_material, unlit),
    PART(smear_material, double_sided), PART(smear_material, bilinear), PART(smear_material, gloss), PART(smear_material, shine)
};
static const struct part texture_parts[] = { PART(smear_texture, wrap_u), PART(smear_texture, wrap_v) };
static const struct part item_parts[] = {
    PART(smear_overlay_item, x), PART(smear_overlay_item, y), PART(smear_overlay_item, width),
    PART(smear_overlay_item, height), PART(smear_overlay_item, color), PART(smear_overlay_item, scale),
    PART(smear_overlay_item, cell)
};
static const struct part fog_parts[] = {
    PART(smear_fog, color), PART(smear_fog, near_plane), PART(smear_fog, far_plane)
};
static const struct part lights_parts[] = {
    PART(smear_lights, direction), PART(smear_lights, diffuse), PART(smear_lights, lamp_diffuse), PART(smear_lights, lamp),
    PART(smear_lights, reach)
};
static const struct part point_parts[] = {
    PART(smear_point, now), PART(smear_point, before), PART(smear_point, size), PART(smear_point, color),
    PART(smear_point, fade), PART(smear_point, mode), PART(smear_point, place)
};
static const struct part transform_parts[] = { PART(smear_transform, basis), PART(smear_transform, origin) };

static void spoil_index(struct fuzz_case *c, const smear_mesh *m)
{
    struct source *s = &c->source;
    uint16_t *index = (uint16_t *)(uintptr_t)m->index;
    for (int i = 0; i < 3 && m->triangle_count != 0; i++) {
        const int32_t at = source_range(s, 0, (int32_t)(3 * m->triangle_count) - 1);
        index[at] = (uint16_t)source_word(s);
    }
}

void case_spoil_frame(struct fuzz_case *c)
{
    struct source *s = &c->source;
    const int i = source_range(s, 0, CASE_DRAWS - 1), mesh = source_range(s, 0, CASE_MESHES - 1);
    switch (source_range(s, 0, 16)) {
    case 0: SPOIL(&c->camera[source_range(s, 0, 2)], camera_parts); break;
    case 1: SPOIL(&c->frame, frame_parts); break;
    case 2: SPOIL(&c->layer[source_range(s, 0, SMEAR_LAYERS_MAX - 1)], layer_parts); break;
    case 3: SPOIL(&c->draw[i], draw_parts); break;
    case 4: SPOIL(&c->mesh[mesh], mesh_parts); break;
    case 5: SPOIL(&c->material[i], material_parts); break;
    case 6: SPOIL(&c->texture[source_range(s, 0, CASE_TEXTURES - 1)], texture_parts); break;
    case 7: SPOIL(&c->pose[i][source_range(s, 0, 2)], transform_parts); break;
    case 8: spoil_index(c, &c->mesh[mesh]); break;
    case 9: c->draw[i].mesh = source_chance(s, 2) ? NULL : c->draw[i].mesh; break;
    case 10: SPOIL(&c->layer_camera[source_range(s, 0, 2)], camera_parts); break;
    case 11: c->frame.camera = source_chance(s, 4) ? NULL : &c->camera[1]; break;
    case 12: SPOIL(&c->item[source_range(s, 0, CASE_ITEMS - 1)], item_parts); break;
    case 13: SPOIL(&c->fog, fog_parts); break;
    case 14: SPOIL(&c->point[source_range(s, 0, CASE_POINTS - 1)], point_parts); break;
    case 15: SPOIL(&c->lights, lights_parts); break;
    default: memset(c->curve, source_chance(s, 2) ? 0 : 255, sizeof c->curve); break;
    }
}

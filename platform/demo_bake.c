/* SPDX-License-Identifier: MIT */
/* demo_bake.c - see demo_bake.h. Frames in encoded light show the same bits. */
#include "platform/demo_bake.h"

#include "base/pixel.h"
#include "geometry/light.h"

#include <string.h>

/* The cosine of the light on a face. */
static uint32_t cosine_of(const smear_mesh *m, const struct smear_shading *s, const uint16_t *index)
{
    if (m->normal != NULL)
        return smear_light_normal(s, m->normal + 3 * index[0]);
    return smear_light_face(s, m->position + 3 * index[0], m->position + 3 * index[1], m->position + 3 * index[2]);
}

/* A colour in this light, 0xAARRGGBB. */
static uint32_t color_of(const struct smear_shading *s, const uint8_t *face_color, uint32_t cosine)
{
    struct smear_color color;
    smear_shade(&color, s, NULL, face_color, cosine);
    return smear_color_pack(&color, false);
}

static bool bake_faces(struct demo_baked *out, const struct smear_shading *s)
{
    smear_mesh *m = &out->mesh;
    if (m->triangle_count > BAKE_FACES)
        return false;
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        const uint8_t *before = m->face_color != NULL ? m->face_color + 4 * i : NULL;
        const uint32_t color = color_of(s, before, cosine_of(m, s, m->index + 3 * i));
        const uint8_t after[4] = { (uint8_t)(color >> 16), (uint8_t)(color >> 8), (uint8_t)color, (uint8_t)(color >> 24) };
        memcpy(out->face_color + 4 * i, after, sizeof after);
    }
    m->face_color = out->face_color;
    return true;
}

static uint32_t lit_texel(uint32_t texel, uint32_t light)
{
    return pixel_make(texel >> 24, code_times(pixel_red(texel), pixel_red(light)), code_times(pixel_green(texel), pixel_green(light)),
                      code_times(pixel_blue(texel), pixel_blue(light)));
}

static bool bake_texels(struct demo_baked *out, const struct smear_shading *s)
{
    smear_texture *t = &out->texture;
    const smear_mesh *m = &out->mesh;
    const int count = t->width * t->height;
    if (count > BAKE_TEXELS || t->format != SMEAR_TEXEL_8888 || m->face_color != NULL || m->normal == NULL)
        return false;
    for (uint32_t i = 1; i < m->vertex_count; i++)
        if (memcmp(m->normal, m->normal + 3 * i, 3) != 0)
            return false;
    const uint32_t light = color_of(s, NULL, cosine_of(m, s, m->index)), *texel = t->texels;
    for (int i = 0; i < count; i++)
        out->texel[i] = lit_texel(texel[i], light);
    t->texels = out->texel;
    out->material.texture = t;
    return true;
}

bool demo_bake(struct demo_baked *out, smear_draw *draw)
{
    static const smear_transform straight = SMEAR_IDENTITY;
    struct smear_sun sun;
    struct smear_shading shading;
    out->mesh = *draw->mesh;
    out->material = *draw->material;
    if (out->mesh.color != NULL || out->material.unlit || out->material.double_sided)
        return false;
    smear_sun_make(&sun, NULL);
    smear_shading_make(&shading, &straight, &out->material, out->mesh.normal != NULL, false, &sun);
    if (out->material.texture != NULL)
        out->texture = *out->material.texture;
    if (!(out->material.texture != NULL ? bake_texels(out, &shading) : bake_faces(out, &shading)))
        return false;
    out->mesh.normal = NULL;
    out->material.unlit = 1;
    memset(out->material.color, 0, sizeof out->material.color);
    draw->mesh = &out->mesh;
    draw->material = &out->material;
    return true;
}

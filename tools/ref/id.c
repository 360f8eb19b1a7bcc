/* SPDX-License-Identifier: MIT */
/* ref_id.c - a scene in which the colour of a pixel names its triangle. Wraps another scene: poses
 * come from it, surfaces are copied with a face colour per triangle and no light. */
#include "tools/ref/ref.h"

#include <stdlib.h>
#include <string.h>

void ref_id_to_rgb(int32_t id, uint8_t rgb[3])
{
    uint32_t k = (uint32_t)(id + 1);
    for (int i = 0; i < 3; i++) {
        uint32_t digit = k >> (12 - 6 * i) & 63u;
        rgb[i] = (uint8_t)(digit == 0 ? 0 : 4 * digit + 2);
    }
}

int32_t ref_id_from_rgb(const uint8_t rgb[3])
{
    int32_t k = 0;
    for (int i = 0; i < 3; i++)
        k = k * 64 + rgb[i] / 4;
    return k - 1;
}

/* A surface of the inner scene in id colours. Handed-out surfaces stay where they are until the
 * scene goes. */
struct id_surface {
    struct scene_surface surface;
    const struct scene_surface *inner;
    int32_t first_id;
    float *face_color;
    struct image mask;          /* white, with the inner texture's alpha; empty when not cut out */
    struct id_surface *next;
};

struct id_scene {
    struct scene *inner;
    struct id_surface *surfaces;
};

struct id_instant {
    struct scene_instant inner;
    struct scene_draw *draw;
    int draw_capacity;
};

static float face_alpha(const struct scene_surface *s, int triangle)
{
    float alpha = 1.0f;
    const uint32_t *index = s->index + 3 * (size_t)triangle;
    if (s->face_color != NULL)
        alpha = s->face_color[4 * (size_t)triangle + 3];
    else if (s->color != NULL)
        alpha = (s->color[4 * (size_t)index[0] + 3] + s->color[4 * (size_t)index[1] + 3]
                 + s->color[4 * (size_t)index[2] + 3]) / 3.0f;
    return alpha;
}

static bool mask_copy(const struct image *from, struct image *to, struct failure *f)
{
    if (!image_alloc(to, from->width, from->height, f))
        return false;
    size_t pixels = (size_t)from->width * (size_t)from->height;
    for (size_t i = 0; i < pixels; i++) {
        memset(to->rgba + 4 * i, 255, 3);
        to->rgba[4 * i + 3] = from->rgba[4 * i + 3];
    }
    return true;
}

static struct id_surface *surface_make(const struct scene_surface *inner, int32_t first_id,
                                       struct failure *f)
{
    struct id_surface *made = calloc(1, sizeof *made);
    size_t triangles = (size_t)inner->triangle_count;
    bool cutout = inner->material.alpha == MODEL_ALPHA_MASK;
    if (made == NULL || (made->face_color = malloc((triangles + 1) * 4 * sizeof(float))) == NULL) {
        free(made);
        fail(f, "no memory for id colours");
        return NULL;
    }
    for (int t = 0; t < inner->triangle_count; t++) {
        uint8_t rgb[3];
        ref_id_to_rgb(first_id + t, rgb);
        for (int i = 0; i < 3; i++)
            made->face_color[4 * t + i] = (float)ref_srgb_decode(rgb[i] / 255.0);
        made->face_color[4 * t + 3] = cutout ? face_alpha(inner, t) : 1.0f;
    }
    made->inner = inner;
    made->first_id = first_id;
    made->surface = *inner;
    made->surface.color = NULL;
    made->surface.face_color = made->face_color;
    struct scene_material *m = &made->surface.material;
    m->unlit = true;
    m->image = NULL;
    m->base[0] = m->base[1] = m->base[2] = 1.0f;
    if (cutout && inner->material.image != NULL) {
        if (!mask_copy(inner->material.image, &made->mask, f)) {
            free(made->face_color);
            free(made);
            return NULL;
        }
        m->image = &made->mask;
    } else if (!cutout) {
        m->alpha = MODEL_ALPHA_OPAQUE;
        m->base[3] = 1.0f;
    }
    return made;
}

static const struct scene_surface *surface_find(struct id_scene *ids,
                                                const struct scene_surface *inner,
                                                int32_t first_id, struct failure *f)
{
    for (struct id_surface *s = ids->surfaces; s != NULL; s = s->next)
        if (s->inner == inner && s->first_id == first_id)
            return &s->surface;
    struct id_surface *made = surface_make(inner, first_id, f);
    if (made == NULL)
        return NULL;
    made->next = ids->surfaces;
    ids->surfaces = made;
    return &made->surface;
}

static bool id_pose(struct scene *scene, double time, struct scene_instant *out, struct failure *f)
{
    struct id_scene *ids = scene->data;
    if (out->store == NULL && (out->store = calloc(1, sizeof(struct id_instant))) == NULL)
        return fail(f, "no memory for a pose");
    struct id_instant *own = out->store;
    if (!scene_pose_joined(ids->inner, time, out->now, &own->inner, f))
        return false;
    int count = own->inner.draw_count;
    if (count > own->draw_capacity) {
        struct scene_draw *grown = realloc(own->draw, (size_t)count * sizeof *grown);
        if (grown == NULL)
            return fail(f, "no memory for a pose");
        own->draw = grown;
        own->draw_capacity = count;
    }
    int32_t id = 0;
    for (int i = 0; i < count; i++) {
        struct scene_draw *draw = &own->draw[i];
        *draw = own->inner.draw[i];
        int triangles = draw->surface->triangle_count;
        if (triangles > REF_ID_LIMIT - 1 - id)
            return fail(f, "more than %d triangles have no id colours", (int)REF_ID_LIMIT - 1);
        draw->hidden = draw->hidden || draw->surface->material.alpha == MODEL_ALPHA_BLEND;
        draw->surface = surface_find(ids, draw->surface, id, f);
        if (draw->surface == NULL)
            return false;
        id += triangles;
    }
    out->time = own->inner.time;
    out->camera = own->inner.camera;
    out->draw_count = count;
    out->draw = own->draw;
    return true;
}

static void id_instant_free(struct scene *scene, struct scene_instant *instant)
{
    struct id_scene *ids = scene->data;
    struct id_instant *own = instant->store;
    if (own != NULL) {
        scene_instant_free(ids->inner, &own->inner);
        free(own->draw);
        free(own);
    }
    memset(instant, 0, sizeof *instant);
}

static void id_destroy(struct scene *scene)
{
    struct id_scene *ids = scene->data;
    while (ids->surfaces != NULL) {
        struct id_surface *s = ids->surfaces;
        ids->surfaces = s->next;
        free(s->face_color);
        image_free(&s->mask);
        free(s);
    }
    free(ids);
    scene->data = NULL;
}

bool ref_id_scene(struct scene *scene, struct scene *out, struct failure *f)
{
    struct id_scene *ids = calloc(1, sizeof *ids);
    if (ids == NULL)
        return fail(f, "no memory for a scene");
    ids->inner = scene;
    *out = *scene;
    out->clear = 0x000000;
    out->pose = id_pose;
    out->instant_free = id_instant_free;
    out->destroy = id_destroy;
    out->data = ids;
    return true;
}

/* SPDX-License-Identifier: MIT */
/* layers.c - a scene around a scene that swaps every surface for glass. */
#include "tools/bench/layers.h"

#include <stdlib.h>
#include <string.h>

/* 51 of 255 is dark, exactly, also where alpha has 8 bits. */
static const double clear_share = 0.8;

struct glass {
    struct glass *next;
    const struct scene_surface *inner;
    struct scene_surface surface;
};

struct layer_scene {
    struct scene *inner;
    struct glass *glass;
};

struct layer_instant {
    struct scene_instant inner;
    struct scene_draw *draw;
    int capacity;
};

static const struct scene_surface *find_glass(struct layer_scene *layers,
                                              const struct scene_surface *inner, struct failure *f)
{
    for (struct glass *g = layers->glass; g != NULL; g = g->next)
        if (g->inner == inner)
            return &g->surface;
    struct glass *made = calloc(1, sizeof *made);
    if (made == NULL) {
        fail(f, "no memory for a surface");
        return NULL;
    }
    made->inner = inner;
    made->surface = *inner;
    made->surface.color = NULL;
    made->surface.face_color = NULL;
    made->surface.material = (struct scene_material){
        .base = { 0.0f, 0.0f, 0.0f, (float)(1.0 - clear_share) }, .alpha = MODEL_ALPHA_BLEND,
        .double_sided = inner->material.double_sided, .unlit = true
    };
    made->next = layers->glass;
    layers->glass = made;
    return &made->surface;
}

static bool pose(struct scene *scene, double time, struct scene_instant *out, struct failure *f)
{
    struct layer_scene *layers = scene->data;
    if (out->store == NULL && (out->store = calloc(1, sizeof(struct layer_instant))) == NULL)
        return fail(f, "no memory for a pose");
    struct layer_instant *own = out->store;
    if (!scene_pose(layers->inner, time, &own->inner, f))
        return false;
    int count = own->inner.draw_count;
    if (count > own->capacity) {
        struct scene_draw *grown = realloc(own->draw, (size_t)count * sizeof *grown);
        if (grown == NULL)
            return fail(f, "no memory for a pose");
        own->draw = grown;
        own->capacity = count;
    }
    for (int i = 0; i < count; i++) {
        own->draw[i] = own->inner.draw[i];
        own->draw[i].surface = find_glass(layers, own->draw[i].surface, f);
        if (own->draw[i].surface == NULL)
            return false;
    }
    out->time = own->inner.time;
    out->camera = own->inner.camera;
    out->draw_count = count;
    out->draw = own->draw;
    return true;
}

static void instant_free(struct scene *scene, struct scene_instant *instant)
{
    struct layer_scene *layers = scene->data;
    struct layer_instant *own = instant->store;
    if (own != NULL) {
        scene_instant_free(layers->inner, &own->inner);
        free(own->draw);
        free(own);
    }
    memset(instant, 0, sizeof *instant);
}

static void destroy(struct scene *scene)
{
    struct layer_scene *layers = scene->data;
    while (layers->glass != NULL) {
        struct glass *g = layers->glass;
        layers->glass = g->next;
        free(g);
    }
    free(layers);
    scene->data = NULL;
}

bool layers_scene(struct scene *scene, struct scene *out, struct failure *f)
{
    struct layer_scene *layers = calloc(1, sizeof *layers);
    if (layers == NULL)
        return fail(f, "no memory for a scene");
    layers->inner = scene;
    *out = *scene;
    out->clear = 0xffffff;
    out->pose = pose;
    out->instant_free = instant_free;
    out->destroy = destroy;
    out->data = layers;
    return true;
}

int layers_from_code(double code)
{
    double here = 255.0;
    int count = 0;
    /* The border between two counts lies midway between their codes. */
    while (count <= LAYER_LIMIT && code < here * (1.0 + clear_share) / 2.0) {
        here *= clear_share;
        count++;
    }
    return count;
}

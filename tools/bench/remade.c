/* SPDX-License-Identifier: MIT */
/* remade.c - a scene around a scene that swaps every surface for another. */
#include "tools/bench/remade.h"

#include <stdlib.h>
#include <string.h>

struct twin {
    struct twin *next;
    const struct scene_surface *inner;
    struct scene_surface surface;
};

struct remade_scene {
    struct scene *inner;
    void (*remake)(struct scene_surface *surface);
    struct twin *twin;
};

struct remade_instant {
    struct scene_instant inner;
    struct scene_draw *draw;
    int capacity;
};

static const struct scene_surface *find_twin(struct remade_scene *remade, const struct scene_surface *inner, struct failure *f)
{
    for (struct twin *t = remade->twin; t != NULL; t = t->next)
        if (t->inner == inner)
            return &t->surface;
    struct twin *made = calloc(1, sizeof *made);
    if (made == NULL) {
        fail(f, "no memory for a surface");
        return NULL;
    }
    made->inner = inner;
    made->surface = *inner;
    remade->remake(&made->surface);
    made->next = remade->twin;
    remade->twin = made;
    return &made->surface;
}

static bool pose(struct scene *scene, double time, struct scene_instant *out, struct failure *f)
{
    struct remade_scene *remade = scene->data;
    if (out->store == NULL && (out->store = calloc(1, sizeof(struct remade_instant))) == NULL)
        return fail(f, "no memory for a pose");
    struct remade_instant *own = out->store;
    if (!scene_pose_joined(remade->inner, time, out->now, &own->inner, f))
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
        own->draw[i].surface = find_twin(remade, own->draw[i].surface, f);
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
    struct remade_scene *remade = scene->data;
    struct remade_instant *own = instant->store;
    if (own != NULL) {
        scene_instant_free(remade->inner, &own->inner);
        free(own->draw);
        free(own);
    }
    memset(instant, 0, sizeof *instant);
}

static void destroy(struct scene *scene)
{
    struct remade_scene *remade = scene->data;
    while (remade->twin != NULL) {
        struct twin *t = remade->twin;
        remade->twin = t->next;
        free(t);
    }
    free(remade);
    scene->data = NULL;
}

bool remade_scene(struct scene *scene, void (*remake)(struct scene_surface *surface), struct scene *out, struct failure *f)
{
    struct remade_scene *remade = calloc(1, sizeof *remade);
    if (remade == NULL)
        return fail(f, "no memory for a scene");
    remade->inner = scene;
    remade->remake = remake;
    *out = *scene;
    out->pose = pose;
    out->instant_free = instant_free;
    out->destroy = destroy;
    out->data = remade;
    return true;
}

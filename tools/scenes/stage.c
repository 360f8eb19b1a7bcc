/* SPDX-License-Identifier: MIT */
/* stage.c - the life of a built-in scene: memory, instants, and the defaults that `move` starts
 * from. */
#include "tools/scenes/stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

struct stage_block {
    struct stage_block *next;
    max_align_t start[];
};

void *stage_alloc(struct stage *stage, size_t bytes)
{
    struct stage_block *block = calloc(1, sizeof *block + bytes);
    if (block == NULL) {
        stage->failed = true;
        return NULL;
    }
    block->next = stage->memory;
    stage->memory = block;
    return block->start;
}

static int add(struct stage *stage, const struct scene_surface *surface, bool soft)
{
    if (surface == NULL || stage->prop_count == STAGE_MAX_PROPS) {
        stage->failed = true;
        return 0;
    }
    stage->prop[stage->prop_count] = (struct stage_prop){.surface = surface, .soft = soft};
    return stage->prop_count++;
}

int stage_add(struct stage *stage, const struct scene_surface *surface)
{
    return add(stage, surface, false);
}

int stage_add_soft(struct stage *stage, const struct scene_surface *surface)
{
    return add(stage, surface, true);
}

struct image *stage_image(struct stage *stage, int width, int height)
{
    struct image *image = stage_alloc(stage, sizeof *image);
    uint8_t *rgba = stage_alloc(stage, (size_t)width * (size_t)height * 4);
    if (image == NULL || rgba == NULL)
        return NULL;
    *image = (struct image){.width = width, .height = height, .rgba = rgba};
    return image;
}

void stage_texel(struct image *image, int x, int y, uint32_t rgb)
{
    uint8_t *texel = image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
    texel[0] = (uint8_t)(rgb >> 16);
    texel[1] = (uint8_t)(rgb >> 8);
    texel[2] = (uint8_t)rgb;
    texel[3] = 255;
}

void stage_place(struct scene_instant *out, int draw, struct xform world)
{
    memcpy(out->draw[draw].world, world.m, sizeof world.m);
}

/* The posed arrays of an instant are its own, though readers see them as constant. */
float *stage_soft_position(struct scene_instant *out, int draw)
{
    const struct scene_draw *d = &out->draw[draw];
    return (float *)out->store + (d->position - (const float *)out->store);
}

float *stage_soft_normal(struct scene_instant *out, int draw)
{
    const struct scene_draw *d = &out->draw[draw];
    return d->normal == NULL ? NULL : (float *)out->store + (d->normal - (const float *)out->store);
}

void stage_camera(struct scene_instant *out, struct xform pose, double yfov_degrees)
{
    memcpy(out->camera.pose, pose.m, sizeof pose.m);
    out->camera.yfov = yfov_degrees * PI / 180;
}

static bool instant_alloc(const struct stage *stage, struct scene_instant *out)
{
    size_t floats = 1;
    for (int i = 0; i < stage->prop_count; i++)
        if (stage->prop[i].soft)
            floats += (size_t)stage->prop[i].surface->vertex_count * 6;
    out->draw = calloc((size_t)stage->prop_count + 1, sizeof *out->draw);
    out->store = calloc(floats, sizeof(float));
    out->draw_count = stage->prop_count;
    return out->draw != NULL && out->store != NULL;
}

static bool stage_pose(struct scene *scene, double time, struct scene_instant *out,
                       struct failure *f)
{
    const struct stage *stage = scene->data;
    if (!(fabs(time) <= STAGE_MAX_SECONDS))
        return fail(f, "built-in scenes end after %d seconds", STAGE_MAX_SECONDS);
    if (out->draw == NULL && !instant_alloc(stage, out))
        return fail(f, "out of memory");

    float *soft = out->store;
    for (int i = 0; i < stage->prop_count; i++) {
        const struct scene_surface *surface = stage->prop[i].surface;
        struct scene_draw *draw = &out->draw[i];
        *draw = (struct scene_draw){.surface = surface, .position = surface->position,
                                    .normal = surface->normal, .node = -1,
                                    .deformed = stage->prop[i].soft};
        stage_place(out, i, xform_identity());
        if (draw->deformed) {
            size_t floats = (size_t)surface->vertex_count * 3;
            draw->position = soft;
            draw->normal = surface->normal != NULL ? soft + floats : NULL;
            soft += 2 * floats;
        }
    }
    out->camera = (struct scene_camera){.znear = 0.25, .zfar = 64};
    stage_camera(out, xform_identity(), 60);
    out->of = stage;
    stage->kind->move(time, out);
    return true;
}

static void stage_instant_free(struct scene *scene, struct scene_instant *instant)
{
    (void)scene;
    free(instant->draw);
    free(instant->store);
}

static void stage_free(struct scene *scene)
{
    struct stage *stage = scene->data;
    while (stage != NULL && stage->memory != NULL) {
        struct stage_block *block = stage->memory;
        stage->memory = block->next;
        free(block);
    }
    free(stage);
}

bool stage_open(const struct stage_kind *kinds, int count, const char *name, struct scene *out,
                struct failure *f)
{
    const struct stage_kind *kind = NULL;
    for (int i = 0; i < count; i++)
        if (strcmp(kinds[i].name, name) == 0)
            kind = &kinds[i];
    if (kind == NULL)
        return fail(f, "there is no built-in scene of this name");

    struct stage *stage = calloc(1, sizeof *stage);
    if (stage == NULL)
        return fail(f, "out of memory");
    stage->kind = kind;
    *out = (struct scene){.name = kind->name, .width = kind->width, .height = kind->height,
                          .fps = 30, .time = kind->time, .clear = kind->clear, .pose = stage_pose,
                          .instant_free = stage_instant_free, .destroy = stage_free,
                          .data = stage};
    kind->build(stage);
    if (stage->failed) {
        scene_free(out);
        return fail(f, "out of memory");
    }
    return true;
}

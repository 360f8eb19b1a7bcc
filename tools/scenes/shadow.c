/* SPDX-License-Identifier: MIT */
/* shadow.c - see shadow.h. */
#include "tools/scenes/shadow.h"

#include "tools/scenes/xform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The sun stands so high at least, as a part of its distance: ten degrees. Lower ones cast shadows that leave all pictures. */
#define LOWEST_SUN 0.1736

/* A round shadow is so much larger than what it lies under, as its edge is soft. */
#define SOFT 1.25

static const float disc_position[] = { -1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1 };
static const float disc_uv[] = { 0, 0, 0, 1, 1, 1, 1, 0 };
static const uint32_t disc_index[] = { 0, 1, 2, 0, 2, 3 };
static const struct image disc_image = { .width = 32, .height = 32 };          /* its size alone: the library has the texels */

static struct scene_surface disc_of(const struct scene_shadow *wish)
{
    return (struct scene_surface){
        .vertex_count = 4, .triangle_count = 2, .position = disc_position, .uv = disc_uv, .index = disc_index,
        .material = { .image = &disc_image, .base = { 0, 0, 0, (float)wish->darkness }, .shadow = SCENE_SHADOW_BLOB },
    };
}

/* Holes of a texture let light through. */
static struct scene_surface flat_of(const struct scene_surface *of, const struct scene_shadow *wish)
{
    const bool has_holes = of->material.alpha == MODEL_ALPHA_MASK && of->material.image != NULL;
    struct scene_surface s = *of;
    s.normal = s.color = s.face_color = NULL;
    s.uv = has_holes ? of->uv : NULL;
    s.material.image = has_holes ? of->material.image : NULL;
    memcpy(s.material.base, (float[4]){ 0, 0, 0, (float)wish->darkness }, sizeof s.material.base);
    s.material.shadow = SCENE_SHADOW_PLANAR;
    return s;
}

bool shadow_open(struct shadow *shadow, const struct scene_shadow *wish, double ground, const struct scene_surface *surface, int count,
                 struct failure *f)
{
    const double *light = wish->light;
    const double length = sqrt(light[0] * light[0] + light[1] * light[1] + light[2] * light[2]);
    *shadow = (struct shadow){ .wish = *wish, .ground = ground };
    if (wish->kind == SCENE_SHADOW_NONE)
        return true;
    if (wish->kind == SCENE_SHADOW_PLANAR && !(light[1] > 0))
        return fail(f, "no shadow falls on the ground from a sun that is not above it (--sun says another, --shadow blob needs none)");
    shadow->wish.light[1] = fmax(light[1], LOWEST_SUN * length);
    shadow->surface = calloc((size_t)count + 1, sizeof *shadow->surface);
    if (shadow->surface == NULL)
        return fail(f, "out of memory");
    for (int i = 0; i < count && wish->kind == SCENE_SHADOW_PLANAR; i++)
        shadow->surface[i] = flat_of(&surface[i], wish);
    if (wish->kind == SCENE_SHADOW_BLOB)
        shadow->surface[0] = disc_of(wish);
    return true;
}

void shadow_close(struct shadow *shadow) { free(shadow->surface); }

int shadow_draws(const struct shadow *shadow, int count)
{
    return shadow->wish.kind == SCENE_SHADOW_NONE ? 0 : shadow->wish.kind == SCENE_SHADOW_BLOB ? count > 0 : count;
}

static bool casts(const struct scene_draw *d) { return !d->hidden && d->surface->material.alpha != MODEL_ALPHA_BLEND; }

/* Takes places along the light to the ground: each loses light / light.y times its height. */
static struct xform fall_of(const struct shadow *shadow)
{
    const double *light = shadow->wish.light;
    struct xform fall = xform_move(0, 0, 0);
    for (int row = 0; row < 3; row++) {
        const double along = light[row] / light[1];
        fall.m[4 + row] -= along;
        fall.m[12 + row] += along * shadow->ground;
    }
    return fall;
}

static void cast_flat(const struct shadow *shadow, const struct scene_surface *first, struct scene_draw *out, const struct scene_draw *in)
{
    struct xform world;
    memcpy(world.m, in->world, sizeof world.m);
    world = xform_mul(fall_of(shadow), world);
    *out = *in;
    memcpy(out->world, world.m, sizeof out->world);
    out->surface = &shadow->surface[in->surface - first];
    out->normal = NULL;
    out->hidden = !casts(in);
}

/* Puts the disc under the middle of what is drawn. */
static void cast_round(const struct shadow *shadow, struct scene_draw *out, const struct scene_draw *in, int count)
{
    double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (int i = 0; i < count; i++)
        for (int k = 0; k < in[i].surface->vertex_count && casts(&in[i]); k++) {
            struct xform world;
            memcpy(world.m, in[i].world, sizeof world.m);
            const float *at = in[i].position + 3 * (size_t)k;
            const struct vec3 p = xform_point(world, vec3((double)at[0], (double)at[1], (double)at[2]));
            const double place[3] = { p.x, p.y, p.z };
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = fmin(low[axis], place[axis]);
                high[axis] = fmax(high[axis], place[axis]);
            }
        }
    *out = (struct scene_draw){ .surface = shadow->surface, .position = disc_position, .node = -1, .hidden = !(low[0] <= high[0]) };
    if (out->hidden)
        return;
    const double wide = (high[0] - low[0]) / 2 * SOFT, deep = (high[2] - low[2]) / 2 * SOFT, least = fmax(wide, deep) / 8;
    const struct xform disc = xform_mul(xform_move((low[0] + high[0]) / 2, shadow->ground, (low[2] + high[2]) / 2),
                                        xform_scale(fmax(wide, least), 1, fmax(deep, least)));
    memcpy(out->world, disc.m, sizeof out->world);
}

void shadow_cast(const struct shadow *shadow, const struct scene_surface *first, struct scene_instant *instant)
{
    const int count = instant->draw_count;
    if (shadow->wish.kind == SCENE_SHADOW_BLOB && count > 0)
        cast_round(shadow, &instant->draw[count], instant->draw, count);
    for (int i = 0; i < count && shadow->wish.kind == SCENE_SHADOW_PLANAR; i++)
        cast_flat(shadow, first, &instant->draw[count + i], &instant->draw[i]);
    instant->draw_count += shadow_draws(shadow, count);
}

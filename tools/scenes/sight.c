/* SPDX-License-Identifier: MIT */
/* sight.c - see sight.h. A small picture in double precision, of which only the nearest side counts: no light, no texture,
 * and what the near plane cuts is left out. */
#include "tools/scenes/sight.h"

#include "tools/scenes/xform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 72 };

struct eye {
    struct xform to_camera;             /* of the draw at hand */
    bool orthographic, is_mirrored;
    double x_scale, y_scale, znear, zfar;
    float *depth;                       /* of the small picture, growing; null: no memory */
    bool *is_back;
};

static struct eye eye_of(const struct scene_camera *c, double aspect)
{
    double half = c->orthographic ? c->half_height : tan(c->yfov / 2);
    return (struct eye){ .orthographic = c->orthographic, .x_scale = 1 / (half * aspect), .y_scale = 1 / half,
                         .znear = c->znear, .zfar = c->zfar > 0 ? c->zfar : INFINITY };
}

/* The camera's pose is a rotation and a place. */
static struct xform to_camera(const double m[16])
{
    struct xform turned = xform_axes(vec3(m[0], m[4], m[8]), vec3(m[1], m[5], m[9]), vec3(m[2], m[6], m[10]), vec3(0, 0, 0));
    struct vec3 back = xform_direction(turned, vec3(-m[12], -m[13], -m[14]));
    turned.m[12] = back.x;
    turned.m[13] = back.y;
    turned.m[14] = back.z;
    return turned;
}

static double determinant(const double m[16])
{
    return vec3_dot(vec3(m[0], m[1], m[2]), vec3_cross(vec3(m[4], m[5], m[6]), vec3(m[8], m[9], m[10])));
}

/* Corners in the camera's space, which looks along -z; on the picture, -1 to 1, after the division by w. */
struct corner {
    double x, y, w, away;       /* away: along the view */
};

static struct corner corner_of(const struct eye *e, struct vec3 p)
{
    return (struct corner){ p.x * e->x_scale, p.y * e->y_scale, e->orthographic ? 1 : -p.z, -p.z };
}

/* Whether all corners lie beyond one plane of the view: which counter that is; null: none. */
static int *beyond(const struct eye *e, const struct corner c[3], struct sight *s)
{
    int sides[6] = { 0 };
    for (int i = 0; i < 3; i++) {
        sides[0] += c[i].away < e->znear;
        sides[1] += c[i].away > e->zfar;
        sides[2] += c[i].x > c[i].w;
        sides[3] += c[i].x < -c[i].w;
        sides[4] += c[i].y > c[i].w;
        sides[5] += c[i].y < -c[i].w;
    }
    if (sides[0] == 3)
        return &s->near;
    if (sides[1] == 3)
        return &s->far;
    for (int i = 2; i < 6; i++)
        if (sides[i] == 3)
            return &s->beside;
    return NULL;
}

static bool is_turned_away(const struct eye *e, const struct vec3 p[3])
{
    struct vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    double towards = e->orthographic ? n.z : -vec3_dot(n, p[0]);
    return e->is_mirrored ? towards > 0 : towards < 0;
}

/* The pixel, from 0 to most; what is no number is 0. */
static int within(double at, int most)
{
    return at > 0 ? (int)fmin(at, most) : 0;
}

/* Covers the middles of pixels; nearest wins. */
static void cover(const struct eye *e, const struct corner c[3], bool is_back)
{
    double x[3], y[3];
    for (int i = 0; i < 3; i++) {
        if (e->depth == NULL || c[i].away < e->znear)
            return;
        x[i] = (c[i].x / c[i].w + 1) * WIDTH / 2;
        y[i] = (1 - c[i].y / c[i].w) * HEIGHT / 2;
    }
    double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    int left = within(fmin(fmin(x[0], x[1]), x[2]), WIDTH), right = within(fmax(fmax(x[0], x[1]), x[2]), WIDTH - 1);
    int top = within(fmin(fmin(y[0], y[1]), y[2]), HEIGHT), bottom = within(fmax(fmax(y[0], y[1]), y[2]), HEIGHT - 1);
    for (int row = top; row <= bottom && area != 0; row++)
        for (int column = left; column <= right; column++) {
            double px = column + 0.5, py = row + 0.5, part[3], away = 0;
            for (int i = 0; i < 3; i++) {
                int a = (i + 1) % 3, b = (i + 2) % 3;
                part[i] = ((x[b] - x[a]) * (py - y[a]) - (px - x[a]) * (y[b] - y[a])) / area;
                away += part[i] * (e->orthographic ? c[i].away : 1 / c[i].away);
            }
            if (part[0] < 0 || part[1] < 0 || part[2] < 0)
                continue;
            float *depth = &e->depth[row * WIDTH + column], at = (float)(e->orthographic ? away : 1 / away);
            if (at < *depth) {
                *depth = at;
                e->is_back[row * WIDTH + column] = is_back;
            }
        }
}

static bool is_transparent(const struct scene_material *m)
{
    return (m->alpha == MODEL_ALPHA_BLEND && !(m->base[3] > 0)) || (m->alpha == MODEL_ALPHA_MASK && m->base[3] < m->alpha_cutoff);
}

static void look_at_draw(const struct eye *e, const struct scene_draw *draw, struct sight *s)
{
    const struct scene_surface *surface = draw->surface;
    s->triangles += surface->triangle_count;
    if (is_transparent(&surface->material)) {
        s->transparent += surface->triangle_count;
        return;
    }
    for (size_t t = 0; t < (size_t)surface->triangle_count; t++) {
        struct vec3 p[3];
        struct corner c[3];
        for (size_t k = 0; k < 3; k++) {
            const float *v = draw->position + 3 * (size_t)surface->index[3 * t + k];
            p[k] = xform_point(e->to_camera, vec3((double)v[0], (double)v[1], (double)v[2]));
            c[k] = corner_of(e, p[k]);
        }
        int *counter = beyond(e, c, s);
        bool is_back = !surface->material.double_sided && is_turned_away(e, p);
        if (counter == NULL) {
            cover(e, c, is_back);
            counter = is_back ? &s->backs : &s->facing;
        }
        ++*counter;
    }
}

void sight_find(const struct scene_instant *instant, double aspect, struct sight *out)
{
    struct eye e = eye_of(&instant->camera, aspect);
    struct xform view = to_camera(instant->camera.pose);
    e.depth = malloc(WIDTH * HEIGHT * sizeof *e.depth);
    e.is_back = calloc(WIDTH * HEIGHT, sizeof *e.is_back);
    if (e.is_back == NULL) {
        free(e.depth);
        e.depth = NULL;
    }
    for (int i = 0; i < WIDTH * HEIGHT && e.depth != NULL; i++)
        e.depth[i] = INFINITY;
    *out = (struct sight){ .triangles = 0 };
    for (int i = 0; i < instant->draw_count; i++) {
        struct xform world;
        memcpy(world.m, instant->draw[i].world, sizeof world.m);
        e.to_camera = xform_mul(view, world);
        e.is_mirrored = determinant(world.m) < 0;
        if (!instant->draw[i].hidden)
            look_at_draw(&e, &instant->draw[i], out);
    }
    for (int i = 0; i < WIDTH * HEIGHT && e.depth != NULL; i++) {
        out->pixels += e.depth[i] < INFINITY;
        out->back_pixels += e.depth[i] < INFINITY && e.is_back[i];
    }
    free(e.depth);
    free(e.is_back);
}

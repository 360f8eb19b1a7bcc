/* SPDX-License-Identifier: MIT */
/* sight.c - see sight.h. A small picture in double precision, of which only the nearest side counts: no light, no texture,
 * and what the near plane cuts is left out. */
#include "tools/scenes/sight.h"

#include "tools/scenes/eye.h"

#include <stdlib.h>

enum { WIDTH = 96, HEIGHT = 72 };

/* The small picture, growing; `depth` null: no memory. */
struct look {
    struct eye eye;
    float *depth;
    bool *is_back;
};

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
static void cover(const struct look *l, const struct corner c[3], bool is_back)
{
    const struct eye *e = &l->eye;
    double x[3], y[3];
    for (int i = 0; i < 3; i++) {
        if (l->depth == NULL || c[i].away < e->znear)
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
            float *depth = &l->depth[row * WIDTH + column], at = (float)(e->orthographic ? away : 1 / away);
            if (at < *depth) {
                *depth = at;
                l->is_back[row * WIDTH + column] = is_back;
            }
        }
}

static bool is_transparent(const struct scene_material *m)
{
    return (m->alpha == MODEL_ALPHA_BLEND && !(m->base[3] > 0)) || (m->alpha == MODEL_ALPHA_MASK && m->base[3] < m->alpha_cutoff);
}

static void look_at_draw(const struct look *l, const struct scene_draw *draw, struct sight *s)
{
    const struct eye *e = &l->eye;
    const struct scene_surface *surface = draw->surface;
    s->triangles += surface->triangle_count;
    if (is_transparent(&surface->material)) {
        s->transparent += surface->triangle_count;
        return;
    }
    for (size_t t = 0; t < (size_t)surface->triangle_count; t++) {
        struct vec3 p[3];
        struct corner c[3];
        eye_corners(e, draw, t, p);
        for (size_t k = 0; k < 3; k++)
            c[k] = corner_of(e, p[k]);
        int *counter = beyond(e, c, s);
        bool is_back = !surface->material.double_sided && is_turned_away(e, p);
        if (counter == NULL) {
            cover(l, c, is_back);
            counter = is_back ? &s->backs : &s->facing;
        }
        ++*counter;
    }
}

void sight_find(const struct scene_instant *instant, double aspect, struct sight *out)
{
    struct look l = { .eye = eye_of(&instant->camera, aspect), .depth = malloc(WIDTH * HEIGHT * sizeof *l.depth),
                      .is_back = calloc(WIDTH * HEIGHT, sizeof *l.is_back) };
    if (l.is_back == NULL) {
        free(l.depth);
        l.depth = NULL;
    }
    for (int i = 0; i < WIDTH * HEIGHT && l.depth != NULL; i++)
        l.depth[i] = INFINITY;
    *out = (struct sight){ .triangles = 0 };
    for (int i = 0; i < instant->draw_count; i++) {
        eye_look_at(&l.eye, &instant->draw[i]);
        if (!instant->draw[i].hidden)
            look_at_draw(&l, &instant->draw[i], out);
    }
    for (int i = 0; i < WIDTH * HEIGHT && l.depth != NULL; i++) {
        out->pixels += l.depth[i] < INFINITY;
        out->back_pixels += l.depth[i] < INFINITY && l.is_back[i];
    }
    free(l.depth);
    free(l.is_back);
}

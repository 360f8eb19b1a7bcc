/* SPDX-License-Identifier: MIT */
/* sight.c - see sight.h. A small picture in double precision, of which only the nearest side counts: no light, no texture,
 * and what the near plane cuts is left out. */
#include "tools/scenes/sight.h"

#include "tools/scenes/xform.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ the camera in double precision */

/* The picture is the square from -1 to 1 on the plane at distance 1, or at any for parallel light. */
struct eye {
    struct xform view;                  /* of the world; the camera looks along -z */
    struct xform to_camera;             /* of the draw at hand */
    bool orthographic, is_mirrored;
    double x_scale, y_scale, znear, zfar;
};

static struct eye eye_of(const struct scene_camera *c, double aspect)
{
    const double *m = c->pose, half = c->orthographic ? c->half_height : tan(c->yfov / 2);
    /* The pose is a rotation and a place. */
    struct xform view = xform_axes(vec3(m[0], m[4], m[8]), vec3(m[1], m[5], m[9]), vec3(m[2], m[6], m[10]), vec3(0, 0, 0));
    struct vec3 back = xform_direction(view, vec3(-m[12], -m[13], -m[14]));
    view.m[12] = back.x;
    view.m[13] = back.y;
    view.m[14] = back.z;
    return (struct eye){ .view = view, .orthographic = c->orthographic, .x_scale = 1 / (half * aspect), .y_scale = 1 / half,
                         .znear = c->znear, .zfar = c->zfar > 0 ? c->zfar : INFINITY };
}

/* From here on corners are those of this draw. */
static void eye_look_at(struct eye *e, const struct scene_draw *draw)
{
    const double *m = draw->world;
    struct xform world;
    memcpy(world.m, m, sizeof world.m);
    e->to_camera = xform_mul(e->view, world);
    e->is_mirrored = vec3_dot(vec3(m[0], m[1], m[2]), vec3_cross(vec3(m[4], m[5], m[6]), vec3(m[8], m[9], m[10]))) < 0;
}

/* The corners of a triangle in the camera's space. */
static void eye_corners(const struct eye *e, const struct scene_draw *draw, size_t triangle, struct vec3 corner[3])
{
    for (size_t k = 0; k < 3; k++) {
        const float *v = draw->position + 3 * (size_t)draw->surface->index[3 * triangle + k];
        corner[k] = xform_point(e->to_camera, vec3((double)v[0], (double)v[1], (double)v[2]));
    }
}

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

/* ------------------------------------------------------------------ how often the picture is covered */

/* How many times over a scene's triangles cover the picture, seen or hidden: what a frame costs at most, known before it is drawn. */

/* What of the triangle lies before the near plane: 0, 3 or 4 corners. */
static int clip(const struct vec3 in[3], double znear, struct vec3 out[4])
{
    int n = 0;
    for (int i = 0; i < 3; i++) {
        struct vec3 a = in[i], b = in[(i + 1) % 3];
        bool a_in = -a.z >= znear, b_in = -b.z >= znear;
        if (a_in)
            out[n++] = a;
        if (a_in != b_in)
            out[n++] = vec3_add(a, vec3_scale(vec3_sub(b, a), (-znear - a.z) / (b.z - a.z)));
    }
    return n;
}

/* Its area, or that of its box within the picture where that is less; 4 is the whole picture. */
static double area(const struct eye *v, const struct vec3 corner[3])
{
    struct vec3 clipped[4];
    double x[4], y[4], low[2] = { 1, 1 }, high[2] = { -1, -1 }, twice = 0;
    int n = v->orthographic ? 3 : clip(corner, v->znear, clipped);
    for (int i = 0; i < n; i++) {
        struct vec3 p = v->orthographic ? corner[i] : clipped[i];
        double w = v->orthographic ? 1 : -p.z;
        x[i] = p.x * v->x_scale / w;
        y[i] = p.y * v->y_scale / w;
        low[0] = fmin(low[0], x[i]);
        high[0] = fmax(high[0], x[i]);
        low[1] = fmin(low[1], y[i]);
        high[1] = fmax(high[1], y[i]);
    }
    for (int i = 0; i < n; i++)
        twice += x[i] * y[(i + 1) % n] - x[(i + 1) % n] * y[i];
    double wide = fmin(high[0], 1) - fmax(low[0], -1), tall = fmin(high[1], 1) - fmax(low[1], -1);
    return n == 0 || wide <= 0 || tall <= 0 ? 0 : fmin(fabs(twice) / 2, wide * tall);
}

static double draw_cover(const struct eye *v, const struct scene_draw *draw, double enough)
{
    const struct scene_surface *s = draw->surface;
    double sum = 0;
    for (size_t t = 0; t < (size_t)s->triangle_count && sum <= enough; t++) {
        struct vec3 corner[3];
        eye_corners(v, draw, t, corner);
        sum += area(v, corner) / 4;
    }
    return sum;
}

double scene_cover(const struct scene_instant *instant, double aspect, double enough)
{
    struct eye e = eye_of(&instant->camera, aspect);
    double sum = 0;
    for (int i = 0; i < instant->draw_count && sum <= enough; i++) {
        eye_look_at(&e, &instant->draw[i]);
        if (!instant->draw[i].hidden)
            sum += draw_cover(&e, &instant->draw[i], enough - sum);
    }
    return sum;
}

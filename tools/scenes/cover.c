/* SPDX-License-Identifier: MIT */
/* cover.c - how many times over a scene's triangles cover the picture, seen or hidden: what a frame costs at most,
 * known before it is drawn. */
#include "tools/scenes/eye.h"

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

/* SPDX-License-Identifier: MIT */
/* wire.c - see wire.h. From the library's integers, in double precision. */
#include "tools/view/wire.h"

#include <math.h>
#include <string.h>

struct canvas {
    uint32_t *picture;
    int width, height;
    const smear_camera *camera;
};

/* Camera space: x right, y up, z towards what is seen. */
struct point {
    double x, y, z;
};

static struct point transform(const smear_transform *t, struct point p)
{
    const double one = SMEAR_BASIS_ONE;
    const int32_t *b = t->basis;
    return (struct point){ (b[0] * p.x + b[1] * p.y + b[2] * p.z) / one + t->origin[0] / 65536.0,
                           (b[3] * p.x + b[4] * p.y + b[5] * p.z) / one + t->origin[1] / 65536.0,
                           (b[6] * p.x + b[7] * p.y + b[8] * p.z) / one + t->origin[2] / 65536.0 };
}

static struct point to_camera(const smear_transform *pose, struct point p)
{
    const double one = SMEAR_BASIS_ONE;
    const int32_t *b = pose->basis;
    double x = p.x - pose->origin[0] / 65536.0, y = p.y - pose->origin[1] / 65536.0;
    double z = p.z - pose->origin[2] / 65536.0;
    return (struct point){ (b[0] * x + b[3] * y + b[6] * z) / one,
                           (b[1] * x + b[4] * y + b[7] * z) / one,
                           -(b[2] * x + b[5] * y + b[8] * z) / one };
}

static struct point vertex(const smear_draw *draw, const smear_camera *camera, unsigned index)
{
    static const smear_transform identity = SMEAR_IDENTITY;
    const smear_mesh *mesh = draw->mesh;
    const int16_t *v = mesh->position + 3 * (size_t)index;
    double step = ldexp(mesh->scale != 0 ? mesh->scale : 1, -mesh->shift);
    struct point p = { (v[0] + mesh->offset[0]) * step, (v[1] + mesh->offset[1]) * step,
                       (v[2] + mesh->offset[2]) * step };
    return to_camera(&camera->pose, transform(draw->now != NULL ? draw->now : &identity, p));
}

/* On the screen, in pixels. */
static struct point project(const struct canvas *c, struct point p)
{
    double half = c->height / 2.0;
    double scale = c->camera->half_height > 0 ? 65536.0 / c->camera->half_height
                                              : c->camera->focal / 65536.0 / p.z;
    return (struct point){ c->width / 2.0 + half * scale * p.x, half - half * scale * p.y, p.z };
}

/* Cuts off what lies outside 0..limit along one axis. */
static bool cut(double a, double b, double limit, double *t0, double *t1)
{
    double d = b - a;
    const double at[2] = { -a, limit - a };
    if (d == 0.0)
        return a >= 0.0 && a <= limit;
    double enter = fmin(at[0] / d, at[1] / d), leave = fmax(at[0] / d, at[1] / d);
    *t0 = fmax(*t0, enter);
    *t1 = fmin(*t1, leave);
    return *t0 <= *t1;
}

static void line(const struct canvas *c, struct point a, struct point b, uint32_t color)
{
    double t0 = 0.0, t1 = 1.0;
    if (!isfinite(a.x) || !isfinite(a.y) || !isfinite(b.x) || !isfinite(b.y) ||
        !cut(a.x, b.x, c->width - 1.0, &t0, &t1) || !cut(a.y, b.y, c->height - 1.0, &t0, &t1))
        return;
    double x0 = a.x + (b.x - a.x) * t0, y0 = a.y + (b.y - a.y) * t0;
    double x1 = a.x + (b.x - a.x) * t1, y1 = a.y + (b.y - a.y) * t1;
    int steps = (int)ceil(fmax(fabs(x1 - x0), fabs(y1 - y0)));
    for (int i = 0; i <= steps; i++) {
        double t = steps > 0 ? (double)i / steps : 0.0;
        int x = (int)(x0 + (x1 - x0) * t), y = (int)(y0 + (y1 - y0) * t);
        if (x >= 0 && x < c->width && y >= 0 && y < c->height)
            c->picture[(size_t)y * (size_t)c->width + (size_t)x] = color;
    }
}

/* An edge up to the near plane. */
static void edge(const struct canvas *c, struct point a, struct point b, uint32_t color)
{
    double near_plane = c->camera->near_plane / 65536.0;
    if (a.z < near_plane && b.z < near_plane)
        return;
    if (a.z < near_plane || b.z < near_plane) {
        struct point *behind = a.z < near_plane ? &a : &b;
        double t = (near_plane - a.z) / (b.z - a.z);
        *behind = (struct point){ a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, near_plane };
    }
    line(c, project(c, a), project(c, b), color);
}

/* Whether the eye is on the front's side, in camera space (whose z is mirrored). */
static bool is_front(const struct canvas *c, const struct point p[3])
{
    struct point u = { p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z };
    struct point v = { p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z };
    struct point n = { u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x };
    double towards = c->camera->half_height > 0 ? n.z : n.x * p[0].x + n.y * p[0].y + n.z * p[0].z;
    return towards > 0.0;
}

static bool is_mirrored(const smear_transform *t)
{
    const int32_t *m = t->basis;
    double b[9];
    for (int i = 0; i < 9; i++)
        b[i] = m[i] / (double)SMEAR_BASIS_ONE;
    return b[0] * (b[4] * b[8] - b[5] * b[7]) - b[1] * (b[3] * b[8] - b[5] * b[6]) +
               b[2] * (b[3] * b[7] - b[4] * b[6]) < 0.0;
}

static bool moves(const smear_draw *d)
{
    const smear_transform *other[2] = { d->open, d->close };
    for (int i = 0; i < 2; i++)
        if (other[i] != NULL && d->now != NULL && memcmp(other[i], d->now, sizeof *d->now) != 0)
            return true;
    return (d->open_position != NULL && d->open_position != d->mesh->position) || d->close_position != NULL;
}

void wire_draw(const struct presented *presented, uint32_t *picture, int width, int height)
{
    const struct canvas c = { picture, width, height, &presented->camera[0] };
    for (int i = 0; i < presented->draw_count; i++) {
        const smear_draw *d = &presented->draw[i];
        const smear_mesh *mesh = d->mesh;
        uint32_t color = moves(d) ? 0xff9a30 : 0xb0b8c0;
        bool both = d->material != NULL && d->material->double_sided;
        bool flipped = d->now != NULL && is_mirrored(d->now);
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            struct point p[3];
            for (int k = 0; k < 3; k++)
                p[k] = vertex(d, c.camera, mesh->index[3 * t + (uint32_t)k]);
            if (!both && is_front(&c, p) == flipped)
                continue;
            for (int k = 0; k < 3; k++)
                edge(&c, p[k], p[(k + 1) % 3], color);
        }
    }
}

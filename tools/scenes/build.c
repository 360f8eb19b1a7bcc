/* SPDX-License-Identifier: MIT */
/* build.c - see build.h. Positions are computed in double precision and rounded to float once. */
#include "tools/scenes/build.h"

#include "tools/scenes/color.h"

#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

struct build build_begin(struct stage *stage, unsigned parts)
{
    return (struct build){.stage = stage, .parts = parts, .at = xform_identity(),
                          .color = {1, 1, 1, 1}};
}

void build_color(struct build *b, uint32_t rgb)
{
    color_from_hex(rgb, b->color);
}

/* Makes *array hold `count` times `width` floats. */
static bool grow(float **array, int count, int width)
{
    float *bigger = realloc(*array, (size_t)count * (size_t)width * sizeof **array);
    if (bigger == NULL)
        return false;
    *array = bigger;
    return true;
}

static bool vertex_room(struct build *b)
{
    if (b->vertex_count < b->vertex_room)
        return true;
    int room = b->vertex_room == 0 ? 256 : b->vertex_room * 2;
    if (!grow(&b->position, room, 3) || !grow(&b->normal, room, 3) || !grow(&b->uv, room, 2) ||
        !grow(&b->vertex_color, room, 4))
        return false;
    b->vertex_room = room;
    return true;
}

static bool triangle_room(struct build *b)
{
    if (b->triangle_count < b->triangle_room)
        return true;
    int room = b->triangle_room == 0 ? 256 : b->triangle_room * 2;
    uint32_t *index = realloc(b->index, (size_t)room * 3 * sizeof *index);
    if (index == NULL)
        return false;
    b->index = index;
    if (!grow(&b->face_color, room, 4))
        return false;
    b->triangle_room = room;
    return true;
}

uint32_t build_vertex(struct build *b, struct vec3 p, struct vec3 normal, double u, double v)
{
    if (b->failed || !vertex_room(b)) {
        b->failed = true;
        return 0;
    }
    size_t i = (size_t)b->vertex_count;
    struct vec3 q = xform_point(b->at, p), n = vec3_unit(xform_normal(b->at, normal));
    b->position[3 * i] = (float)q.x;
    b->position[3 * i + 1] = (float)q.y;
    b->position[3 * i + 2] = (float)q.z;
    b->normal[3 * i] = (float)n.x;
    b->normal[3 * i + 1] = (float)n.y;
    b->normal[3 * i + 2] = (float)n.z;
    b->uv[2 * i] = (float)u;
    b->uv[2 * i + 1] = (float)v;
    memcpy(b->vertex_color + 4 * i, b->color, sizeof b->color);
    b->vertex_count++;
    return (uint32_t)i;
}

void build_triangle(struct build *b, uint32_t a, uint32_t c, uint32_t d)
{
    if (b->failed || !triangle_room(b)) {
        b->failed = true;
        return;
    }
    size_t i = (size_t)b->triangle_count;
    b->index[3 * i] = a;
    b->index[3 * i + 1] = c;
    b->index[3 * i + 2] = d;
    memcpy(b->face_color + 4 * i, b->color, sizeof b->color);
    b->triangle_count++;
}

void build_quad(struct build *b, struct vec3 p0, struct vec3 p1, struct vec3 p2, struct vec3 p3)
{
    struct vec3 n = vec3_cross(vec3_sub(p2, p0), vec3_sub(p3, p1));
    uint32_t a = build_vertex(b, p0, n, 0, 1), c = build_vertex(b, p1, n, 1, 1);
    uint32_t d = build_vertex(b, p2, n, 1, 0), e = build_vertex(b, p3, n, 0, 0);
    build_triangle(b, a, c, d);
    build_triangle(b, a, d, e);
}

void build_box(struct build *b, struct vec3 min, struct vec3 max)
{
    /* Corner k has the maximum of x, y, z where bit 0, 1, 2 of k is set. */
    static const uint8_t face[6][4] = {
        {4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4},
    };
    struct vec3 corner[8];
    for (int k = 0; k < 8; k++)
        corner[k] = vec3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z);
    if (b->parts & (BUILD_NORMAL | BUILD_UV)) {
        for (int i = 0; i < 6; i++)
            build_quad(b, corner[face[i][0]], corner[face[i][1]], corner[face[i][2]],
                       corner[face[i][3]]);
        return;
    }
    uint32_t v[8];
    for (int k = 0; k < 8; k++)
        v[k] = build_vertex(b, corner[k], vec3(0, 0, 0), 0, 0);
    for (int i = 0; i < 6; i++) {
        build_triangle(b, v[face[i][0]], v[face[i][1]], v[face[i][2]]);
        build_triangle(b, v[face[i][0]], v[face[i][2]], v[face[i][3]]);
    }
}

/* The outward normal of a profile at a point: across the chord between its neighbours. */
static struct vec3 lathe_slope(const double *profile, int points, int i)
{
    const double *below = profile + 2 * (i > 0 ? i - 1 : 0);
    const double *above = profile + 2 * (i < points - 1 ? i + 1 : i);
    return vec3(above[1] - below[1], below[0] - above[0], 0);
}

void build_lathe(struct build *b, const double *profile, int points, int sides)
{
    /* A seam of double vertices only where a texture has to end and start again. */
    int columns = b->parts & BUILD_UV ? sides + 1 : sides;
    uint32_t first = 0;
    for (int i = 0; i < points; i++) {
        struct vec3 slope = lathe_slope(profile, points, i);
        for (int k = 0; k < columns; k++) {
            double angle = 2 * PI * k / sides, c = cos(angle), s = sin(angle);
            double r = profile[2 * i];
            uint32_t v = build_vertex(b, vec3(r * s, profile[2 * i + 1], r * c),
                                      vec3(slope.x * s, slope.y, slope.x * c), (double)k / sides,
                                      1 - (double)i / (points - 1));
            if (i == 0 && k == 0)
                first = v;
        }
    }
    for (int i = 0; i + 1 < points; i++)
        for (int k = 0; k < sides; k++) {
            uint32_t low = first + (uint32_t)(i * columns + k);
            uint32_t low_next = first + (uint32_t)(i * columns + (k + 1) % columns);
            uint32_t high = low + (uint32_t)columns, high_next = low_next + (uint32_t)columns;
            if (profile[2 * i] > 0)
                build_triangle(b, low, low_next, high_next);
            if (profile[2 * i + 2] > 0)
                build_triangle(b, low, high_next, high);
        }
}

void build_ball(struct build *b, double radius, int sides, int rings)
{
    double profile[2 * 65];
    if (rings > 64)
        rings = 64;
    for (int i = 0; i <= rings; i++) {
        double angle = PI * i / rings;
        profile[2 * i] = i == 0 || i == rings ? 0 : radius * sin(angle);
        profile[2 * i + 1] = -radius * cos(angle);
    }
    build_lathe(b, profile, rings + 1, sides);
}

static void disc(struct build *b, double radius, double y, int sides, bool upward)
{
    struct vec3 n = vec3(0, upward ? 1 : -1, 0);
    uint32_t centre = build_vertex(b, vec3(0, y, 0), n, 0.5, 0.5), rim = centre + 1;
    for (int k = 0; k < sides; k++) {
        double angle = 2 * PI * k / sides;
        build_vertex(b, vec3(radius * sin(angle), y, radius * cos(angle)), n,
                     0.5 + 0.5 * sin(angle), 0.5 + 0.5 * cos(angle));
    }
    for (int k = 0; k < sides; k++) {
        uint32_t a = rim + (uint32_t)k, c = rim + (uint32_t)((k + 1) % sides);
        build_triangle(b, centre, upward ? a : c, upward ? c : a);
    }
}

void build_drum(struct build *b, double radius0, double radius1, double y0, double y1, int sides)
{
    double profile[4] = {radius0, y0, radius1, y1};
    build_lathe(b, profile, 2, sides);
    if (radius0 > 0)
        disc(b, radius0, y0, sides, false);
    if (radius1 > 0)
        disc(b, radius1, y1, sides, true);
}

void build_loft(struct build *b, const struct vec3 *corner, int rings, int sides)
{
    uint32_t first = 0, n = (uint32_t)sides;
    for (int i = 0; i < rings * sides; i++) {
        uint32_t v = build_vertex(b, corner[i], vec3(0, 0, 0), 0, 0);
        if (i == 0)
            first = v;
    }
    for (int i = 0; i + 1 < rings; i++)
        for (uint32_t k = 0; k < n; k++) {
            uint32_t here = first + (uint32_t)i * n, next = here + n, k1 = (k + 1) % n;
            build_triangle(b, here + k, here + k1, next + k1);
            build_triangle(b, here + k, next + k1, next + k);
        }
    uint32_t last = first + (uint32_t)(rings - 1) * n;
    for (uint32_t k = 1; k + 1 < n; k++) {
        build_triangle(b, first, first + k + 1, first + k);
        build_triangle(b, last, last + k, last + k + 1);
    }
}

void build_field(struct build *b, double x0, double z0, double x1, double z1, int nx, int nz,
                 double (*height)(double x, double z))
{
    uint32_t first = 0;
    double dx = (x1 - x0) / nx, dz = (z1 - z0) / nz;
    for (int j = 0; j <= nz; j++)
        for (int i = 0; i <= nx; i++) {
            double x = x0 + dx * i, z = z0 + dz * j, y = 0;
            struct vec3 n = vec3(0, 1, 0);
            if (height != NULL) {
                double e = 1e-3;
                y = height(x, z);
                n = vec3(height(x - e, z) - height(x + e, z), 2 * e,
                         height(x, z - e) - height(x, z + e));
            }
            uint32_t v = build_vertex(b, vec3(x, y, z), n, (double)i / nx, (double)j / nz);
            if (i == 0 && j == 0)
                first = v;
        }
    for (int j = 0; j < nz; j++)
        for (int i = 0; i < nx; i++) {
            uint32_t a = first + (uint32_t)(j * (nx + 1) + i), c = a + (uint32_t)(nx + 1);
            build_triangle(b, a, c, c + 1);
            build_triangle(b, a, c + 1, a + 1);
        }
}

static float *keep(struct stage *stage, const float *from, int count, int width)
{
    size_t bytes = (size_t)count * (size_t)width * sizeof *from;
    float *to = stage_alloc(stage, bytes);
    if (to != NULL && bytes > 0)
        memcpy(to, from, bytes);
    return to;
}

struct scene_surface *build_finish(struct build *b)
{
    struct stage *stage = b->stage;
    struct scene_surface *s = stage_alloc(stage, sizeof *s);
    if (b->failed)
        stage->failed = true;
    if (!stage->failed) {
        uint32_t *index = stage_alloc(stage, (size_t)b->triangle_count * 3 * sizeof *index);
        if (index != NULL && b->triangle_count > 0)
            memcpy(index, b->index, (size_t)b->triangle_count * 3 * sizeof *index);
        s->vertex_count = b->vertex_count;
        s->triangle_count = b->triangle_count;
        s->index = index;
        s->position = keep(stage, b->position, b->vertex_count, 3);
        s->normal = b->parts & BUILD_NORMAL ? keep(stage, b->normal, b->vertex_count, 3) : NULL;
        s->uv = b->parts & BUILD_UV ? keep(stage, b->uv, b->vertex_count, 2) : NULL;
        s->color = b->parts & BUILD_COLOR ? keep(stage, b->vertex_color, b->vertex_count, 4) : NULL;
        s->face_color = b->parts & BUILD_FACE_COLOR
            ? keep(stage, b->face_color, b->triangle_count, 4) : NULL;
        s->material.alpha_cutoff = 0.5f;
        for (int k = 0; k < 4; k++)
            s->material.base[k] = 1;
    }
    free(b->position);
    free(b->normal);
    free(b->uv);
    free(b->vertex_color);
    free(b->face_color);
    free(b->index);
    *b = build_begin(stage, b->parts);
    return stage->failed ? NULL : s;
}

/* SPDX-License-Identifier: MIT */
/* build.h - shapes made of triangles, collected into one surface after the other.
 *
 * Set `at` (where) and `color` (which) and add shapes; build_finish turns what was added into a
 * surface of the stage. Which arrays the surface has is decided before the first vertex by the
 * flags. Without normals, shapes share vertices between faces and are shaded flat. Running out
 * of memory is remembered and makes build_finish fail the stage. */
#ifndef SMEAR_TOOLS_SCENES_BUILD_H
#define SMEAR_TOOLS_SCENES_BUILD_H

#include "tools/scenes/stage.h"

enum build_parts { BUILD_NORMAL = 1, BUILD_UV = 2, BUILD_COLOR = 4, BUILD_FACE_COLOR = 8 };

struct build {
    struct stage *stage;
    unsigned parts;                 /* build_parts or-ed together */
    struct xform at;
    float color[4];                 /* linear */
    int vertex_count, triangle_count, vertex_room, triangle_room;
    float *position, *normal, *uv, *vertex_color, *face_color;
    uint32_t *index;
    bool failed;
};

struct build build_begin(struct stage *stage, unsigned parts);
void build_color(struct build *b, uint32_t rgb);        /* 0xRRGGBB display code */

/* One vertex, taken through `at`; returns its index. The normal need not be of length one. */
uint32_t build_vertex(struct build *b, struct vec3 p, struct vec3 normal, double u, double v);
void build_triangle(struct build *b, uint32_t a, uint32_t c, uint32_t d);
/* Corners counter-clockwise; uv (0,1) (1,1) (1,0) (0,0), so that the first edge is the picture's
 * bottom. */
void build_quad(struct build *b, struct vec3 p0, struct vec3 p1, struct vec3 p2, struct vec3 p3);

void build_box(struct build *b, struct vec3 min, struct vec3 max);
/* Rings about the y axis from `profile` (radius, height pairs from bottom to top), smooth around
 * and along; radii of zero make a tip. Without normals the facets are flat. */
void build_lathe(struct build *b, const double *profile, int points, int sides);
void build_ball(struct build *b, double radius, int sides, int rings);
/* Along y from y0 to y1, closed at both ends; the rim is sharp. */
void build_drum(struct build *b, double radius0, double radius1, double y0, double y1, int sides);
/* `rings` polygons of `sides` corners each, ring after ring, joined to a closed solid with flat
 * ends; seen from beyond the last ring the corners run counter-clockwise. Convex rings, flat
 * shading only. */
void build_loft(struct build *b, const struct vec3 *corner, int rings, int sides);
/* nx by nz squares over x and z, counter-clockwise from above; `height` (may be null) gives y. */
void build_field(struct build *b, double x0, double z0, double x1, double z1, int nx, int nz,
                 double (*height)(double x, double z));

/* The finished surface, unlit or lit, white base colour, opaque; null when the stage has failed.
 * The caller may still change its material. `b` is empty afterwards. */
struct scene_surface *build_finish(struct build *b);

#endif

/* SPDX-License-Identifier: MIT */
/* eye.h - a scene's camera in double precision, for what looks at triangles before anything is drawn. */
#ifndef SMEAR_TOOLS_SCENES_EYE_H
#define SMEAR_TOOLS_SCENES_EYE_H

#include "tools/scenes/scene.h"
#include "tools/scenes/xform.h"

#include <math.h>
#include <string.h>

/* The picture is the square from -1 to 1 on the plane at distance 1, or at any for parallel light. */
struct eye {
    struct xform view;                  /* of the world; the camera looks along -z */
    struct xform to_camera;             /* of the draw at hand */
    bool orthographic, is_mirrored;
    double x_scale, y_scale, znear, zfar;
};

static inline struct eye eye_of(const struct scene_camera *c, double aspect)
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
static inline void eye_look_at(struct eye *e, const struct scene_draw *draw)
{
    const double *m = draw->world;
    struct xform world;
    memcpy(world.m, m, sizeof world.m);
    e->to_camera = xform_mul(e->view, world);
    e->is_mirrored = vec3_dot(vec3(m[0], m[1], m[2]), vec3_cross(vec3(m[4], m[5], m[6]), vec3(m[8], m[9], m[10]))) < 0;
}

/* The corners of a triangle in the camera's space. */
static inline void eye_corners(const struct eye *e, const struct scene_draw *draw, size_t triangle, struct vec3 corner[3])
{
    for (size_t k = 0; k < 3; k++) {
        const float *v = draw->position + 3 * (size_t)draw->surface->index[3 * triangle + k];
        corner[k] = xform_point(e->to_camera, vec3((double)v[0], (double)v[1], (double)v[2]));
    }
}

#endif

/* SPDX-License-Identifier: MIT */
/* orbit.c - see orbit.h. */
#include "tools/view/orbit.h"

#include "tools/scenes/xform.h"

#include <math.h>
#include <string.h>

#define MAX_PITCH 1.5
#define MIN_DISTANCE 0.02
#define MAX_DISTANCE 50.0

static void turn_camera(const struct orbit *orbit, double time, struct scene_camera *camera)
{
    struct xform pose;
    memcpy(pose.m, camera->pose, sizeof pose.m);
    struct vec3 eye = vec3(pose.m[12], pose.m[13], pose.m[14]);
    struct vec3 back = vec3(pose.m[8], pose.m[9], pose.m[10]);
    struct vec3 pivot = vec3_sub(eye, vec3_scale(back, orbit->focus));
    /* camera' = (about the pivot: yaw about the world's y) x camera x (about the pivot: pitch) */
    struct xform to_pivot = xform_move(0, 0, -orbit->focus);
    struct xform from_pivot = xform_move(0, 0, orbit->focus * orbit->distance);
    pose = xform_mul(xform_mul(pose, to_pivot),
                     xform_mul(xform_turn_x(orbit->pitch), from_pivot));
    struct xform yaw = xform_mul(xform_move(pivot.x, pivot.y, pivot.z),
                                 xform_mul(xform_turn_y(orbit->yaw + orbit->spin * time),
                                           xform_move(-pivot.x, -pivot.y, -pivot.z)));
    pose = xform_mul(yaw, pose);
    memcpy(camera->pose, pose.m, sizeof pose.m);
    if (camera->orthographic)
        camera->half_height *= orbit->distance;
    else if (orbit->distance < 1.0)
        camera->znear *= orbit->distance;
    /* what was seen stays before the far plane */
    double back_by = orbit->focus * fabs(orbit->distance - 1.0);
    if (camera->zfar > 0.0)
        camera->zfar += 2.0 * back_by + orbit->focus;
}

static bool pose_turned(struct scene *scene, double time, struct scene_instant *out,
                        struct failure *f)
{
    const struct orbit *orbit = scene->data;
    if (!scene_pose_joined(orbit->inner, time, out->now, out, f))
        return false;
    if (orbit_is_turned(orbit))
        turn_camera(orbit, time, &out->camera);
    return true;
}

static void free_instant(struct scene *scene, struct scene_instant *instant)
{
    scene_instant_free(((struct orbit *)scene->data)->inner, instant);
}

void orbit_open(struct orbit *orbit, struct scene *inner)
{
    *orbit = (struct orbit){ .scene = *inner, .inner = inner, .distance = 1.0 };
    orbit->scene.pose = pose_turned;
    orbit->scene.instant_free = free_instant;
    orbit->scene.destroy = NULL;
    orbit->scene.data = orbit;
}

void orbit_turn(struct orbit *orbit, double yaw, double pitch)
{
    orbit->yaw = remainder(orbit->yaw + yaw, 2.0 * 3.14159265358979323846);
    orbit->pitch = clamp(orbit->pitch + pitch, -MAX_PITCH, MAX_PITCH);
}

void orbit_move(struct orbit *orbit, double factor)
{
    orbit->distance = clamp(orbit->distance * factor, MIN_DISTANCE, MAX_DISTANCE);
}

void orbit_reset(struct orbit *orbit)
{
    orbit->yaw = orbit->pitch = orbit->spin = 0.0;
    orbit->distance = 1.0;
    orbit->focus = 0.0;
}

bool orbit_is_turned(const struct orbit *orbit)
{
    return orbit->focus > 0.0 &&
           (orbit->yaw != 0.0 || orbit->pitch != 0.0 || orbit->distance != 1.0 || orbit->spin != 0.0);
}

/* ------------------------------------------------------------------ focus */

/* The centre of a draw's bounds, in the camera's axes: x right, y up, z towards what it sees. */
static bool draw_centre(const struct scene_draw *draw, const struct scene_camera *camera,
                        double out[3])
{
    double low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (int i = 0; i < draw->surface->vertex_count * 3; i++) {
        low[i % 3] = fmin(low[i % 3], (double)draw->position[i]);
        high[i % 3] = fmax(high[i % 3], (double)draw->position[i]);
    }
    struct xform world, pose;
    memcpy(world.m, draw->world, sizeof world.m);
    memcpy(pose.m, camera->pose, sizeof pose.m);
    struct vec3 p = xform_point(world, vec3((low[0] + high[0]) / 2, (low[1] + high[1]) / 2,
                                            (low[2] + high[2]) / 2));
    p = vec3_sub(p, vec3(pose.m[12], pose.m[13], pose.m[14]));
    out[0] = vec3_dot(p, vec3(pose.m[0], pose.m[1], pose.m[2]));
    out[1] = vec3_dot(p, vec3(pose.m[4], pose.m[5], pose.m[6]));
    out[2] = -vec3_dot(p, vec3(pose.m[8], pose.m[9], pose.m[10]));
    return !draw->hidden && isfinite(out[0]) && isfinite(out[1]) && out[2] > camera->znear;
}

/* The mean of the draws' distances, those near the line of sight counting most: something that is
 * looked at, not the sky behind it. */
bool orbit_find_focus(struct orbit *orbit, double time, struct failure *f)
{
    struct scene_instant instant = { 0 };
    double sum = 0.0, weights = 0.0;
    bool ok = scene_pose(orbit->inner, time, &instant, f);
    for (int i = 0; i < instant.draw_count && ok; i++) {
        double at[3];
        if (!draw_centre(&instant.draw[i], &instant.camera, at))
            continue;
        double off = (at[0] * at[0] + at[1] * at[1]) / (at[2] * at[2]);
        double weight = 1.0 / ((1.0 + 25.0 * off * off) * at[2]);
        sum += weight * at[2];
        weights += weight;
    }
    if (ok)
        orbit->focus = weights > 0.0 ? sum / weights : 4.0 * instant.camera.znear;
    scene_instant_free(orbit->inner, &instant);
    return ok;
}

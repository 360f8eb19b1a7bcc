/* SPDX-License-Identifier: MIT */
/* orbit.h - a scene seen by a camera that the user has turned about what it looks at.
 *
 * While nothing has been turned, poses are passed on bit for bit. */
#ifndef SMEAR_TOOLS_VIEW_ORBIT_H
#define SMEAR_TOOLS_VIEW_ORBIT_H

#include "tools/scenes/scene.h"

#include <stdbool.h>

struct orbit {
    struct scene scene;         /* to be shown instead of `inner` */
    struct scene *inner;
    double yaw, pitch;          /* radians, about the world's y and the camera's x */
    double spin;                /* radians per second of the scene's time, added to yaw: a turntable */
    double distance;            /* factor of `focus` */
    double focus;               /* world units to what the camera looks at; 0: not known yet */
};

/* `inner` must outlive it. */
void orbit_open(struct orbit *orbit, struct scene *inner);

/* Turns by radians and moves closer by a factor; the pose is that of the moving camera, turned. */
void orbit_turn(struct orbit *orbit, double yaw, double pitch);
void orbit_move(struct orbit *orbit, double factor);
void orbit_reset(struct orbit *orbit);
bool orbit_is_turned(const struct orbit *orbit);

/* How far away things are that the camera sees at `time`: the middle of the depths of the draws
 * near its line of sight. */
bool orbit_find_focus(struct orbit *orbit, double time, struct failure *f);

#endif

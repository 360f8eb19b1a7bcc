/* SPDX-License-Identifier: MIT */
/* demo.h - what the demo scenes are made of. Each function builds props and returns the index of
 * the first.
 *
 * Metres; x is the way the car drives, y up, z to its right. */
#ifndef SMEAR_TOOLS_SCENES_DEMO_H
#define SMEAR_TOOLS_SCENES_DEMO_H

#include "tools/scenes/build.h"
#include "tools/scenes/stage.h"

/* What has been built, as a shadow that is so dense. */
struct scene_surface *demo_shadow(struct build *b, float opacity);

/* A racing car at the origin, on the ground y = 0. */
enum { CAR_BODY, CAR_WHEEL, CAR_SHADOW = CAR_WHEEL + 4, CAR_PROPS };
#define CAR_WHEEL_RADIUS 0.45
int demo_car(struct stage *stage);
/* `world` is on the ground below the car; `rolled` metres driven; `steer` radians, left is
 * positive. */
void demo_car_place(struct scene_instant *out, int first, struct xform world, double rolled,
                    double steer);

/* A drone about the origin, four rotors, nose to +x. */
enum { DRONE_BODY, DRONE_ROTOR, DRONE_SHADOW = DRONE_ROTOR + 4, DRONE_PROPS };
int demo_drone(struct stage *stage);
/* `spin` radians, neighbours turn against each other. The shadow falls on y = 0. */
void demo_drone_place(struct scene_instant *out, int first, struct xform world, double spin);

/* A straight of endless track: pieces of `length` metres, all alike, with scenery beside. */
enum { TRACK_PIECES = 4, TRACK_PARTS = 5 };
int demo_track(struct stage *stage, double length);
/* Lays the pieces from `behind` metres before x onwards. */
void demo_track_place(struct scene_instant *out, int first, double length, double x, double behind);

/* Far hills and haze around the eye; they move with it. */
int demo_backdrop(struct stage *stage);

#endif

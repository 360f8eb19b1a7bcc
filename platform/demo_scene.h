/* SPDX-License-Identifier: MIT */
/* demo_scene.h - the scene of the demo in fixed point: a racing car, a drone, a road. Where
 * everything is is a pure function of the frame number, so every machine shows the same frames.
 *
 * A unit is a metre, Q16.16; x is the way the car drives, y up, z to its right. */
#ifndef SMEAR_DEMO_SCENE_H
#define SMEAR_DEMO_SCENE_H

#include <smear.h>
#include <stdint.h>

/* What demo_props.c makes. */
enum demo_prop {
    PROP_HILLS, PROP_GRASS, PROP_ROAD, PROP_KERBS, PROP_TREES, PROP_BOARDS, PROP_CAR, PROP_WHEEL,
    PROP_SHADOW, PROP_DRONE, PROP_ROTOR, PROP_COUNT
};

enum {
    DEMO_LOOP = 72,                 /* frames, at 30 per second; then all starts again */
    DEMO_DRAWS = PROP_COUNT + 3 + 3     /* four wheels, four rotors */
};

struct demo_scene {
    smear_camera camera;
    uint8_t cut;                    /* the camera has jumped since the frame before */
    int draw_count;
    uint8_t prop[DEMO_DRAWS];       /* demo_prop of each draw */
    smear_transform pose[DEMO_DRAWS];
};

/* The scene in frame `frame`. */
void demo_scene_pose(struct demo_scene *out, uint32_t frame);

/* The same at a time between frames, in DEMO_TIME of a frame from 0 to DEMO_LOOP frames. */
enum { DEMO_TIME = 256 };
void demo_scene_pose_at(struct demo_scene *out, int32_t time);

/* Draw `i` of the scene, which must stay where it is until that is submitted. props: a draw with mesh and material for
 * each enum demo_prop. */
smear_draw demo_scene_draw(const struct demo_scene *scene, const smear_draw *props, int i);

#endif

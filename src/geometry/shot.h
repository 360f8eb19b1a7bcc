/* SPDX-License-Identifier: MIT */
/* shot.h - a frame's cameras, its exposure, and the instants in it.
 *
 * Of three poses, index 0 is now, 1 open (or a frame ago), 2 close. */
#ifndef SMEAR_SHOT_H
#define SMEAR_SHOT_H

#include "base/base.h"
#include "smear.h"

/* What a frame knows of its cameras and its exposure. */
struct smear_shot {
    smear_camera camera[3];
    bool camera_moves;              /* an earlier camera is known, and another */
    bool shutter_poses;             /* open and close are poses at the shutter's */
    bool cut;                       /* nothing has motion */
    uint8_t exposure;               /* smear_exposure */
    int32_t half_exposure;          /* q24 frames */
    uint32_t object_scale;          /* smear_frame.scale.object as it is used */
    int32_t height;                 /* of the frame, px */
};

/* Weights of the poses for an instant, q24; they add up to one. */
struct smear_instant {
    int32_t weight[3];
};

extern const struct smear_instant smear_instant_now;

/* Returns the instant at `u`, q16 from -1 at shutter open to 1 at shutter close. Through poses at shutter open, centre
 * and close it follows a parabola; a pose a frame ago gives a straight line through it and now, inside and beyond. */
struct smear_instant smear_instant_at(const struct smear_shot *shot, int32_t u);

/* Returns the middle of the exposure: the instant whose sharp picture is blurred both ways. */
struct smear_instant smear_instant_middle(const struct smear_shot *shot);

/* Fills in the exposure of a frame whose defaults are filled in, and brings its shutter.degrees up to date. */
void smear_shot_expose(struct smear_shot *shot, smear_frame *frame);

/* Whether there is a path from one camera to the other: both have a perspective, or none has. */
bool smear_camera_is_of_kind(const smear_camera *a, const smear_camera *b);

/* Fills in the cameras of a frame. `last`: the camera of the frame before, or null. */
void smear_shot_aim(struct smear_shot *shot, const smear_frame *frame, const smear_camera *last);

#endif

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
    bool has_older;                 /* without shutter_poses: camera[2] is that two frames ago */
    bool shutter_poses;             /* open and close are poses at the shutter's */
    bool curved;                    /* so they are since smear_shot_bend: poses of times in smear_shot_times */
    bool cut;                       /* nothing has motion */
    uint8_t exposure;               /* smear_exposure */
    uint8_t path;                   /* smear_path */
    int32_t half_exposure;          /* q24 frames */
    uint32_t object_scale;          /* smear_frame.scale.object as it is used */
    int32_t height;                 /* of the frame, px */
    uint32_t turn;                  /* smear_shot_find_turn */
    /* All vertices lie within 2^reach of their mesh's middle, in units / smear_mesh.scale. Those of coarser steps than 2^-15 of that are
     * taken for multiples of it: so meshes of few steps fill a projection, and corners that meshes share have the same bits. */
    int reach;
};

static inline bool shot_is_curved(const struct smear_shot *shot) { return SMEAR_WITH_CURVES && shot->curved; }

/* Whether velocities are measured over the whole exposure, else over a frame. */
static inline bool shot_spans_exposure(const struct smear_shot *shot)
{
    return shot->shutter_poses || shot_is_curved(shot);
}

/* Weights of the poses for an instant, q24; they add up to one. */
struct smear_instant {
    int32_t weight[3];
    int32_t time;                   /* q24 frames from now; without shutter_poses */
};

extern const struct smear_instant smear_instant_now;

/* Returns the instant at `u`, q16 from -1 at shutter open to 1 at shutter close. Through poses at shutter open, centre
 * and close it follows a parabola; a pose a frame ago gives a straight line through it and now, inside and beyond. */
struct smear_instant smear_instant_at(const struct smear_shot *shot, int32_t u);

/* Returns the middle of the exposure: the instant whose sharp picture is blurred both ways. */
struct smear_instant smear_instant_middle(const struct smear_shot *shot);

/* Which poses are at shutter open, in the middle and at close: where the exposure ends or begins now, that of now is no
 * longer in the middle of the curve. */
struct smear_shutter_order {
    uint8_t open, middle, close;
};

static inline struct smear_shutter_order smear_shot_order(const struct smear_shot *shot)
{
    static const struct smear_shutter_order order[] = { { 1, 0, 2 }, { 1, 2, 0 }, { 0, 1, 2 } };
    return order[shot_is_curved(shot) ? shot->exposure : (uint8_t)SMEAR_CENTRED];
}

/* Returns the time of a pose of a curved shot, q24 frames from now. */
int32_t smear_shot_time(const struct smear_shot *shot, int pose);

/* Fills in the exposure of a frame whose defaults are filled in, and brings its shutter.degrees up to date. */
void smear_shot_expose(struct smear_shot *shot, smear_frame *frame);

/* Finds how far the camera turns from shutter open to the middle of the exposure, and so from there to close, q32 turns: 0 where that
 * is little, no even turn, or more than an eighth. */
void smear_shot_find_turn(struct smear_shot *shot);

/* Whether there is a path from one camera to the other: both have a perspective, or none has. */
bool smear_camera_is_of_kind(const smear_camera *a, const smear_camera *b);

/* Fills in the cameras of a frame. `last` and `older`: the cameras of the frame before and of that before it, or null. */
void smear_shot_aim(struct smear_shot *shot, const smear_frame *frame, const smear_camera *last, const smear_camera *older);

/* Where something is now, a frame ago and, with has_older, two frames ago. */
struct smear_track {
    smear_transform *pose[3];
    bool has_older;
    uint8_t path;                   /* smear_path */
    uint32_t scale;                 /* of the motion, q8 */
};

/* Whether it moves along a curve. */
bool smear_track_is_curved(const struct smear_track *track);

/* Puts the poses at the times of the exposure in place of the past ones (smear_shot_order). */
void smear_track_bend(const struct smear_track *track, const struct smear_shot *shot);

/* The same for cameras, of which there are three. */
bool smear_cameras_are_curved(const struct smear_shot *shot, smear_camera *camera, bool has_older);
void smear_cameras_bend(const struct smear_shot *shot, smear_camera *camera, bool has_older);

#endif

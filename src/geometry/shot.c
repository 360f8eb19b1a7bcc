/* SPDX-License-Identifier: MIT */
/* shot.c - see shot.h. */
#include "geometry/shot.h"

#include "base/fixmath.h"
#include "geometry/arc.h"

/* ------------------------------------------------------------------ instants */

const struct smear_instant smear_instant_now = { { 1 << 24, 0, 0 } };

struct smear_instant smear_instant_at(const struct smear_shot *shot, int32_t u)
{
    struct smear_instant i;
    if (shot->shutter_poses) {
        const int64_t square = (int64_t)u * u >> 16;
        i.weight[1] = (int32_t)((square - u) * 128);
        i.weight[2] = (int32_t)((square + u) * 128);
    } else {
        /* Frames from now: the exposure's centre plus u half exposures. */
        const int64_t half = shot->half_exposure;
        const int64_t centre = shot->exposure == SMEAR_TRAILING ? -half : shot->exposure == SMEAR_LEADING ? half : 0;
        i.weight[1] = (int32_t)-(centre + (half * u >> 16));
        i.weight[2] = 0;
    }
    i.weight[0] = (1 << 24) - i.weight[1] - i.weight[2];
    return i;
}

struct smear_instant smear_instant_middle(const struct smear_shot *shot)
{
    return shot->shutter_poses ? smear_instant_now : smear_instant_at(shot, 0);
}

/* ------------------------------------------------------------------ exposure */

/* a / b in q24, at most 100 of them. */
static int32_t ratio_q24(uint32_t a, uint32_t b)
{
    int zeros = count_leading_zeros(b);
    uint64_t ratio = (uint64_t)a * recip_norm_precise(b << zeros) >> (37 - zeros);
    return (int32_t)(ratio < (uint64_t)100 << 24 ? ratio : (uint64_t)100 << 24);
}

/* Half the exposure in frames, q24; brings f->shutter.degrees up to date. */
static int32_t half_exposure(smear_frame *f)
{
    const int32_t whole = 1 << 24, longest = 10 << 24;
    int32_t exposure;
    if (SMEAR_WITH_SCALES && f->shutter.us != 0) {
        exposure = ratio_q24(f->shutter.us, f->shutter.frame_us);
        if (f->shutter.mode == SMEAR_SHUTTER_CAPPED)
            exposure = min_i32(exposure, whole);
    } else {
        /* Frames in which the shutter is to be as it is in one at the rate of reference. */
        int32_t frames = whole;
        if (SMEAR_WITH_SCALES && f->shutter.mode != SMEAR_SHUTTER_NATIVE)
            frames = ratio_q24(1000000, f->shutter.reference_hz * f->shutter.frame_us);
        if (SMEAR_WITH_SCALES && f->shutter.mode == SMEAR_SHUTTER_CAPPED)
            frames = min_i32(frames, whole);
        if (!SMEAR_WITH_SCALES || frames == whole)
            return (int32_t)(((uint32_t)f->shutter.degrees << 20) / 45u);
        /* 2^32 / 360 = 11930465 */
        uint64_t degrees = (uint64_t)f->shutter.degrees * (uint32_t)frames;
        degrees = (degrees >> 8) * 11930465u >> 24;
        exposure = (int32_t)(degrees < (uint64_t)longest ? degrees : (uint64_t)longest);
    }
    exposure = clamp_i32(exposure, 2, longest);
    f->shutter.degrees = (uint16_t)clamp_i32((int32_t)((int64_t)exposure * 360 >> 24), 1, 3600);
    return exposure / 2;
}

void smear_shot_expose(struct smear_shot *shot, smear_frame *f)
{
    if (!SMEAR_BLURS)
        return;
    shot->half_exposure = half_exposure(f);
    shot->exposure = f->shutter.exposure;
    shot->shutter_poses = f->shutter.poses;
    shot->cut = f->cut;
    shot->object_scale = f->scale.object;
}

/* ------------------------------------------------------------------ cameras */

/* Brings a camera's pose nearer to that of now, or farther: its rotation and its translation each by their scale. */
static void scale_camera(smear_camera *other, const smear_camera *now, const smear_frame *f)
{
    smear_transform turned;
    if (f->scale.rotation != 256) {
        smear_arc_between(&turned, &other->pose, &now->pose, -(int32_t)f->scale.rotation * (1 << 16));
        for (int i = 0; i < 9; i++)
            other->pose.basis[i] = f->scale.rotation == 0 ? now->pose.basis[i] : turned.basis[i];
        int64_t focal = now->focal + (((int64_t)other->focal - now->focal) * f->scale.rotation >> 8);
        int64_t half = now->half_height
                     + (((int64_t)other->half_height - now->half_height) * f->scale.rotation >> 8);
        other->focal = now->focal > 0 ? max_i32(narrow_sat(focal), 1) : 0;
        other->half_height = now->half_height > 0 ? max_i32(narrow_sat(half), 1) : 0;
    }
    for (int i = 0; i < 3 && f->scale.translation != 256; i++)
        other->pose.origin[i] = narrow_sat(now->pose.origin[i]
                                           + (((int64_t)other->pose.origin[i] - now->pose.origin[i])
                                              * f->scale.translation >> 8));
}

bool smear_camera_is_of_kind(const smear_camera *a, const smear_camera *b)
{
    return !SMEAR_WITH_ORTHOGRAPHIC || (a->half_height > 0) == (b->half_height > 0);
}

/* Finds the cameras of the three poses, of one kind: between a perspective and an orthographic view there is no path, as
 * after a cut. */
void smear_shot_aim(struct smear_shot *shot, const smear_frame *frame, const smear_camera *last)
{
    if (!SMEAR_BLURS) {
        shot->camera[0] = *frame->camera;
        return;
    }
    const smear_camera *now = frame->camera, *close = frame->close != NULL ? frame->close : now, *open = now;
    shot->camera_moves = true;
    if (frame->open != NULL)
        open = frame->open;
    else if (last != NULL && !frame->shutter.poses)
        open = last;
    else
        shot->camera_moves = frame->shutter.poses && frame->close != NULL;
    if (!smear_camera_is_of_kind(open, now) || !smear_camera_is_of_kind(close, now)) {
        shot->camera_moves = false;
        open = close = now;
    }
    shot->camera[0] = *now;
    shot->camera[1] = *open;
    shot->camera[2] = *close;
    if (SMEAR_WITH_SCALES) {
        scale_camera(&shot->camera[1], now, frame);
        scale_camera(&shot->camera[2], now, frame);
    }
}

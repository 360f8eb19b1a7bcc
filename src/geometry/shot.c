/* SPDX-License-Identifier: MIT */
/* shot.c - see shot.h. */
#include "geometry/shot.h"

#include "base/fixmath.h"
#include "geometry/arc.h"

/* ------------------------------------------------------------------ instants */

const struct smear_instant smear_instant_now = { { 1 << 24, 0, 0 }, 0 };

/* Returns when `u` of the exposure is, q24 frames from now: its centre plus u half exposures. */
static int32_t time_of(const struct smear_shot *shot, int32_t u)
{
    const int64_t half = shot->half_exposure;
    const int64_t centre = shot->exposure == SMEAR_TRAILING ? -half : shot->exposure == SMEAR_LEADING ? half : 0;
    return (int32_t)(centre + (half * u >> 16));
}

#if SMEAR_WITH_CURVES
int32_t smear_shot_time(const struct smear_shot *shot, int pose)
{
    const struct smear_shutter_order at = smear_shot_order(shot);
    return pose == 0 ? 0 : time_of(shot, pose == at.open ? -65536 : pose == at.close ? 65536 : 0);
}
#endif

struct smear_instant smear_instant_at(const struct smear_shot *shot, int32_t u)
{
    struct smear_instant i = { { 0, 0, 0 }, shot->shutter_poses ? 0 : time_of(shot, u) };
    if (shot_spans_exposure(shot)) {
        const int64_t square = mul_wide(u, u) >> 16;
        const struct smear_shutter_order at = smear_shot_order(shot);
        i.weight[at.open] = (int32_t)((square - u) * 128);
        i.weight[at.close] = (int32_t)((square + u) * 128);
        i.weight[at.middle] = (1 << 24) - i.weight[at.open] - i.weight[at.close];
    } else {
        i.weight[1] = -i.time;
        i.weight[0] = (1 << 24) - i.weight[1];
    }
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
    f->shutter.degrees = (uint16_t)clamp_i32(mul_shift((int32_t)exposure, 360, 24), 1, 3600);
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
    shot->path = f->shutter.path;
    shot->curved = false;
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
        const int32_t focal = smear_arc_scaled(now->focal, other->focal, f->scale.rotation),
                      half = smear_arc_scaled(now->half_height, other->half_height, f->scale.rotation);
        other->focal = now->focal > 0 ? max_i32(focal, 1) : 0;
        other->half_height = now->half_height > 0 ? max_i32(half, 1) : 0;
    }
    for (int i = 0; i < 3 && f->scale.translation != 256; i++)
        other->pose.origin[i] = smear_arc_scaled(now->pose.origin[i], other->pose.origin[i], f->scale.translation);
}

bool smear_camera_is_of_kind(const smear_camera *a, const smear_camera *b)
{
    return !SMEAR_WITH_VIEWS || (a->half_height > 0) == (b->half_height > 0);
}

/* Between a perspective and an orthographic view there is no path, as after a cut. */
void smear_shot_aim(struct smear_shot *shot, const smear_frame *frame, const smear_camera *last, const smear_camera *older)
{
    if (!SMEAR_BLURS) {
        shot->camera[0] = *frame->camera;
        return;
    }
    const smear_camera *now = frame->camera, *close = frame->close, *open = frame->open;
    const bool knows_past = open == NULL && !frame->shutter.poses;
    if (knows_past) {
        open = last;
        close = last != NULL ? older : NULL;
    }
    shot->camera_moves = open != NULL || (frame->shutter.poses && close != NULL);
    shot->has_older = !frame->shutter.poses && open != NULL && close != NULL && smear_camera_is_of_kind(close, now);
    if ((open != NULL && !smear_camera_is_of_kind(open, now))
        || (frame->shutter.poses && close != NULL && !smear_camera_is_of_kind(close, now))) {
        shot->camera_moves = shot->has_older = false;
        open = close = NULL;
    }
    shot->camera[0] = *now;
    shot->camera[1] = open != NULL ? *open : *now;
    shot->camera[2] = close != NULL && (frame->shutter.poses || shot->has_older) ? *close : *now;
    if (SMEAR_WITH_SCALES) {
        scale_camera(&shot->camera[1], now, frame);
        scale_camera(&shot->camera[2], now, frame);
    }
}

void smear_shot_find_turn(struct smear_shot *shot)
{
    enum { LEAST = 12 * 11930465, MOST = 45 * 11930465,      /* degrees */
           ALONG = (1 << 30) - (1 << 22) };                 /* the cosine of five degrees between axes */
    const struct smear_shutter_order order = smear_shot_order(shot);
    const uint8_t pose[3] = { order.open, order.middle, order.close };
    struct smear_axes axes[3];
    struct smear_turn turn[2];
    shot->turn = 0;
    if (!SMEAR_WITH_SUBFRAMES || !SMEAR_WITH_CURVES || !shot->camera_moves || !shot_spans_exposure(shot))
        return;
    for (int i = 0; i < 3; i++)
        smear_axes_find(&axes[i], &shot->camera[pose[i]].pose);
    for (int i = 0; i < 2; i++)
        smear_turn_between(&turn[i], &axes[i], &axes[i + 1]);
    if (!turn[0].turns || !turn[1].turns)
        return;
    const int64_t cosine = dot_wide(turn[0].axis, 1, turn[1].axis, 1);
    const uint32_t mean = (turn[0].angle >> 1) + (turn[1].angle >> 1);
    const int32_t faster = abs_i32((int32_t)(turn[0].angle - turn[1].angle));
    if (mean >= LEAST && mean <= MOST && (uint32_t)faster <= mean >> 5 && cosine >> 30 >= ALONG)
        shot->turn = mean;
}

/* SPDX-License-Identifier: MIT */
/* curve.c - see curve.h. It is done once per draw and pose, so 64-bit products are fine here. */
#include "curves/curve.h"

#include "base/fixmath.h"
#include "geometry/pose.h"

#if SMEAR_WITH_CURVES

/* Turns below this angle, q32 turns, bend the path as a parabola does: at 1.4 degrees, to a hundredth of the bend. */
enum { CURVE_SMALL = 1 << 24 };

/* ------------------------------------------------------------------ the axis */

static void cross_axis(int32_t out[3], const int32_t axis[3], const int32_t v[3])
{
    for (int i = 0; i < 3; i++) {
        const int i1 = i == 2 ? 0 : i + 1, i2 = i == 0 ? 2 : i - 1;
        out[i] = narrow_sat(cross_wide(axis[i1], axis[i2], v[i1], v[i2]) >> 30);
    }
}

/* Takes off a vector what lies along the axis. */
static void across_axis(int32_t out[3], const int32_t axis[3], const int32_t v[3])
{
    int64_t along = 0;
    for (int i = 0; i < 3; i++)
        along += mul_wide(axis[i], v[i]) >> 2;
    along >>= 28;
    for (int i = 0; i < 3; i++)
        out[i] = narrow_sat(v[i] - (along * axis[i] >> 30));
}

/* Finds the second difference of a screw: its first one, turned back by a frame, less itself. */
static void screw_second(int32_t out[3], const struct smear_turn *turn, const int32_t first[3])
{
    int32_t across[3], aside[3];
    across_axis(across, turn->axis, first);
    cross_axis(aside, turn->axis, across);
    for (int i = 0; i < 3; i++)
        out[i] = narrow_sat((((int64_t)turn->cosine - (1 << 30)) * across[i] - mul_wide(turn->sine, aside[i])) >> 30);
}

/* ------------------------------------------------------------------ choice */

/* The length of a vector, to within a sixteenth: the largest component, and parts of the others. */
static int64_t length_of(const int32_t v[3])
{
    const int64_t x = (int64_t)magnitude(v[0]), y = (int64_t)magnitude(v[1]), z = (int64_t)magnitude(v[2]);
    const int64_t most = x > y ? (x > z ? x : z) : y > z ? y : z;
    return most + ((x + y + z - most) * 3 >> 3);
}

/* Finds how much faster it turns than in the frame before, where it turned about the same axis, nearly as fast. It is
 * steady where the two turns hardly differ: keys of an animation, where speeds jump, are met in other frames. */
static void find_faster(struct smear_curve *c, const struct smear_axes *last, const smear_transform *older)
{
    struct smear_axes axes;
    struct smear_turn before;
    int64_t along = 0;
    c->is_steady = !c->turn.turns;
    if (older == NULL || !c->turn.turns)
        return;
    smear_axes_find(&axes, older);
    smear_turn_between(&before, &axes, last);
    if (!before.turns)
        return;
    for (int i = 0; i < 3; i++)
        along += mul_wide(c->turn.axis[i], before.axis[i]) >> 30;
    const int64_t faster = (int64_t)c->turn.angle - (before.angle * along >> 30);
    if (along > (1 << 30) - (1 << 26) && magnitude(faster) <= c->turn.angle / 4)
        c->faster = (int32_t)faster;
    c->is_steady = along > (1 << 30) - (1 << 22) && magnitude(faster) <= c->turn.angle / 16;
}

/* Chooses the second difference of the origin's places. Without a third pose the origin goes straight. With one it takes the curve that
 * leads through it, unless the motion was another in the last frame: then both a straight line and a screw foretell it badly, by more
 * than half of the displacement, or a quarter where it is not steady. It goes straight then, too, unless the screw is clearly better. */
static void choose_second(struct smear_curve *c, const int32_t first[3], const smear_transform *older)
{
    int32_t screw[3] = { 0, 0, 0 }, beside[3];
    if (older == NULL)
        return;
    if (c->turn.turns)
        screw_second(screw, &c->turn, first);
    for (int i = 0; i < 3; i++) {
        c->second[i] = narrow_sat((int64_t)older->origin[i] - 2 * (int64_t)c->last->origin[i] + c->now->origin[i]);
        beside[i] = narrow_sat((int64_t)c->second[i] - screw[i]);
    }
    const int64_t straight_error = length_of(c->second), screw_error = length_of(beside);
    const int64_t least = screw_error < straight_error ? screw_error : straight_error;
    if (least * (c->is_steady ? 2 : 4) > length_of(first))
        for (int i = 0; i < 3; i++)
            c->second[i] = screw_error * 2 < straight_error ? screw[i] : 0;
}

/* Finds the turn from last to now, and the axes of `last`, where there is one. */
static void curve_turn(struct smear_curve *c, struct smear_axes *last)
{
    struct smear_axes now;
    bool differs = false;
    for (int i = 0; i < 9; i++)
        differs = differs || c->last->basis[i] != c->now->basis[i];
    if (!differs)               /* between axes and themselves there is none */
        return;
    smear_axes_find(last, c->last);
    smear_axes_find(&now, c->now);
    smear_turn_between(&c->turn, last, &now);
}

bool smear_curve_find(struct smear_curve *c, const smear_transform *now, const smear_transform *last,
                      const smear_transform *older, uint8_t path)
{
    struct smear_axes axes;
    int32_t first[3];
    *c = (struct smear_curve){ .now = now, .last = last };
    if (path != SMEAR_PATH_LINE)
        curve_turn(c, &axes);
    smear_turn_whole(c->turned, &c->turn, last);
    if (path == SMEAR_PATH_LINE)
        return false;
    for (int i = 0; i < 3; i++)
        first[i] = narrow_sat((int64_t)last->origin[i] - now->origin[i]);
    if (path == SMEAR_PATH_SCREW && c->turn.turns)
        screw_second(c->second, &c->turn, first);
    else if (path != SMEAR_PATH_ORIGIN) {
        find_faster(c, &axes, older);
        choose_second(c, first, older);
    }
    /* Rounded poses of an even motion differ by as much. */
    const int64_t least = length_of(first) >> 6;
    if (!c->turn.turns && length_of(c->second) <= (least > 8 ? least : 8))
        c->second[0] = c->second[1] = c->second[2] = 0;
    return c->turn.turns || (c->second[0] | c->second[1] | c->second[2]) != 0;
}

/* ------------------------------------------------------------------ places */

/* Returns t (t + 1) / 2 of a time, q24. */
static int64_t parabola(int32_t time)
{
    return ((int64_t)time * time + (int64_t)time * (1 << 24)) >> 25;
}

/* Finds B(t) as a complex number, q24. With (w - 1)^2 = -4 sin^2(angle / 2) w it is -(w^-t - 1 + t (w - 1)) / w over 2 - 2 cos(angle). */
static void bend(int64_t b[2], const struct smear_turn *turn, int32_t time)
{
    int32_t cosine_t, sine_t;
    b[0] = parabola(time);
    b[1] = 0;
    if (!turn->turns || turn->angle < CURVE_SMALL)
        return;
    smear_turn_cosine_sine(turn_angle(turn, time), &cosine_t, &sine_t);
    const int32_t one = 1 << 30, cosine = turn->cosine, sine = turn->sine;
    /* q24: 130 at most */
    const int64_t x = (cosine_t - (int64_t)one + ((int64_t)time * ((int64_t)cosine - one) >> 24)) >> 6;
    const int64_t y = (sine_t - (mul_wide(time, sine) >> 24)) >> 6;
    /* 1 / w = cosine + i sine */
    const int64_t over_x = -(x * cosine - y * sine) >> 30, over_y = -(x * sine + y * cosine) >> 30;
    const uint32_t square = (uint32_t)((int64_t)one - cosine);      /* q30 */
    const int zeros = count_leading_zeros(square);
    const int64_t r = recip_norm_precise(square << zeros);          /* 1 / square = r 2^(zeros - 61) */
    b[0] = over_x * r >> (32 - zeros);          /* over 2 square / 2^30 */
    b[1] = over_y * r >> (32 - zeros);
}

static void origin_at(int32_t origin[3], const struct smear_curve *c, int32_t time)
{
    int64_t b[2];
    int32_t across[3] = { 0, 0, 0 }, aside[3] = { 0, 0, 0 };
    bend(b, &c->turn, time);
    if (c->turn.turns) {
        across_axis(across, c->turn.axis, c->second);
        cross_axis(aside, c->turn.axis, across);
    }
    const int64_t along = parabola(time);
    for (int i = 0; i < 3; i++) {
        const int64_t part = ((int64_t)c->second[i] - across[i]) * (along >> 6) + across[i] * (b[0] >> 6)
                           + aside[i] * (b[1] >> 6);
        origin[i] = narrow_sat(smear_arc_number(c->last->origin[i], c->now->origin[i], time) + ((part + (1 << 17)) >> 18));
    }
}

void smear_curve_at(smear_transform *out, const struct smear_curve *c, int32_t time)
{
    int32_t origin[3];
    if (time == 0 || time == -(1 << 24)) {
        *out = time == 0 ? *c->now : *c->last;
        return;
    }
    origin_at(origin, c, time);
    const uint32_t angle = turn_angle(&c->turn, time) + (uint32_t)((c->faster >> 2) * (parabola(time) >> 4) >> 18);
    smear_turn_part(out->basis, &c->turn, c->turned, c->now, time, angle);
    for (int i = 0; i < 3; i++)
        out->origin[i] = origin[i];
}

/* ------------------------------------------------------------------ cameras and draws */

static bool find_curve(struct smear_curve *curve, const struct smear_track *t)
{
    return smear_curve_find(curve, t->pose[0], t->pose[1], t->has_older ? t->pose[2] : NULL, t->path);
}

bool smear_track_is_curved(const struct smear_track *t)
{
    struct smear_curve curve;
    return find_curve(&curve, t);
}

void smear_track_bend(const struct smear_track *t, const struct smear_shot *shot)
{
    struct smear_curve curve;
    const smear_transform last = *t->pose[1];
    find_curve(&curve, t);
    curve.last = &last;
    for (int k = 1; k < 3; k++) {
        const int64_t time = mul_wide(smear_shot_time(shot, k), (int32_t)t->scale) >> 8, most = 1 << 30;
        smear_curve_at(t->pose[k], &curve, (int32_t)(time < -most ? -most : time > most ? most : time));
    }
}

static struct smear_track track_of(const struct smear_shot *shot, smear_camera *camera, bool has_older)
{
    return (struct smear_track){ { &camera[0].pose, &camera[1].pose, &camera[2].pose }, has_older, shot->path, 256 };
}

bool smear_cameras_are_curved(const struct smear_shot *shot, smear_camera *camera, bool has_older)
{
    const struct smear_track track = track_of(shot, camera, has_older);
    return smear_track_is_curved(&track);
}

void smear_cameras_bend(const struct smear_shot *shot, smear_camera *camera, bool has_older)
{
    const struct smear_track track = track_of(shot, camera, has_older);
    const smear_camera *now = &camera[0];
    const int32_t focal = camera[1].focal, half_height = camera[1].half_height;
    smear_track_bend(&track, shot);
    for (int k = 1; k < 3; k++) {
        const int32_t time = smear_shot_time(shot, k);
        camera[k].focal = now->focal > 0 ? max_i32(smear_arc_number(focal, now->focal, time), 1) : 0;
        camera[k].half_height = now->half_height > 0 ? max_i32(smear_arc_number(half_height, now->half_height, time), 1) : 0;
    }
}

#if SMEAR_WITH_DEFORM
bool smear_draw_bends(const smear_draw *d, const struct smear_shot *shot)
{
    enum { SAMPLES = 64 };
    const uint32_t count = d->mesh->vertex_count, step = 1u + count / SAMPLES;
    const uint8_t path = d->path != SMEAR_PATH_DEFAULT ? d->path : shot->path;
    uint32_t straight = 0, bent = 0;
    if (path != SMEAR_PATH_CURVE || d->open_position == NULL || d->close_position == NULL || d->cut
        || d->motion != SMEAR_MOTION_FULL || (d->open_count != 0 && d->open_count != count)
        || (d->close_count != 0 && d->close_count != count) || shot->half_exposure > 1 << 24)
        return false;
    for (uint32_t i = 0; i < 3 * count; i += i % 3 == 2 ? 3 * step - 2 : 1) {
        const int32_t first = d->open_position[i] - d->mesh->position[i];
        straight += (uint32_t)abs_i32(first);
        bent += (uint32_t)abs_i32(d->close_position[i] - d->open_position[i] - first);
    }
    return bent != 0 && bent * 5 <= 2 * straight;
}
#endif

#endif

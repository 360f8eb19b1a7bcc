/* SPDX-License-Identifier: MIT */
/* arc.h - where something that turns is between two poses: on the arc, not on the chord. */
#ifndef SMEAR_ARC_H
#define SMEAR_ARC_H

#include "smear.h"

#include "base/fixed.h"

/* The turn that takes one pose to another. */
struct smear_turn {
    bool turns;             /* else the axis means nothing, and everything is linear */
    int32_t axis[3];        /* q30, right-handed */
    uint32_t angle;         /* q32 turns, 0 .. half a turn */
    int32_t cosine, sine;   /* of the angle, q30, once turn_whole has found them */
};

/* The axes of a pose without their scales: axis[j] is where x, y or z points, q30. */
struct smear_axes {
    int32_t axis[3][3];
    bool are_square;        /* at right angles; else the others mean nothing */
    bool are_left_handed;
};

void smear_axes_find(struct smear_axes *axes, const smear_transform *t);

/* Finds the turn from one pose's axes to another's. */
void smear_turn_between(struct smear_turn *turn, const struct smear_axes *before, const struct smear_axes *now);

/* Finds cosine and sine, q30, of an angle in q32 turns, to 2^-24. */
void smear_turn_cosine_sine(uint32_t angle, int32_t *cosine, int32_t *sine);

/* Returns the angle of so much time, q24: whole turns are lost. */
static inline uint32_t turn_angle(const struct smear_turn *turn, int32_t time)
{
    return (uint32_t)((int64_t)turn->angle * time >> 24);
}

/* Finds the basis of a pose after the whole turn, and the turn's cosine and sine: what it and that of `now` differ by changes linearly. */
void smear_turn_whole(int32_t basis[9], struct smear_turn *turn, const smear_transform *before);

/* Finds the basis of the pose at a time, as smear_arc_between does, from that after the whole turn. `angle` is what it has
 * turned since now. */
void smear_turn_part(int32_t basis[9], const struct smear_turn *turn, const int32_t turned[9], const smear_transform *now, int32_t time,
                     uint32_t angle);

/* Returns now + (now - before) time, time in q24; saturates. */
int32_t smear_arc_number(int32_t before, int32_t now, int32_t time);

/* Returns now + (other - now) scale, scale in q8; saturates. */
int32_t smear_arc_scaled(int32_t now, int32_t other, uint32_t scale);

/* Finds the pose at a time, q24, -64 to 64: 0 is `now`, -1 is `before`; both are met exactly. In
 * between and beyond, the turn from one to the other goes on at an even rate about an axis
 * through the origin of the object, which itself moves along a straight line. Scales (along the
 * axes of the object, or all alike) change linearly.
 *
 * The turn is the shorter one of the two that lead from pose to pose, up to 180 degrees: an object that turns further
 * cannot be told from it. At 180 degrees it may be either.
 *
 * With three poses, at shutter open, centre and close, each half is such a pair: centre and open, centre and close.
 *
 * Where the axes of a pose are not at right angles (a shear), have no length, or where one pose
 * is mirrored and the other is not, everything is linear. Entries are within 2^-20 of the exact
 * pose, times the largest scale; over the smallest where that is below one, and times 1 + |time|
 * beyond the poses. `out` may be one of the poses. */
void smear_arc_between(smear_transform *out, const smear_transform *before, const smear_transform *now,
                       int32_t time);

#endif

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

/* The curve along which something moves, found from where it is, was a frame ago, and was two frames ago.
 *
 * Two poses tell the turn between them, and so its fraction at any moment, but not what it turns about: a wheel turns
 * about its own origin, which goes straight, a blade that hangs beside its pivot moves along a screw. Of all curves on
 * which a thing turns evenly about some point that goes straight, one leads through three poses:
 *
 *     origin(t) = now + (now - last) t + B(t) (now - 2 last + older)
 *
 * Across the axis, where vectors are complex numbers and w = exp(-i angle) is the turn of a frame back,
 * B(t) = (w^-t - 1 + t (w - 1)) / (w - 1)^2; along the axis, and where nothing turns, it is t (t + 1) / 2, which is
 * what it goes to for small angles: the parabola. So one formula has the wheel (whose second difference is zero), the
 * blade (whose is (w - 1) (last - now)), what turns about a point in motion, and what falls. */

struct smear_curve {
    const smear_transform *now, *last;
    struct smear_turn turn;     /* from last to now */
    int32_t turned[9];          /* basis of `last` after that turn */
    int32_t second[3];          /* difference of the origin's places, q16 world units */
    bool is_steady;             /* it turned alike in the two frames */
    int32_t faster;             /* what it turned in the last frame, less what in that before it, q32 turns */
};

/* Finds the curve through `now`, `last` (a frame ago) and, if it is not null, `older` (two frames ago), as smear_path
 * says. All must stay. Returns false where it is a straight line of vertices. */
bool smear_curve_find(struct smear_curve *curve, const smear_transform *now, const smear_transform *last,
                      const smear_transform *older, uint8_t path);

/* Finds the pose at a time in frames from now, q24, -64 to 64. At 0 and -1 it is `now` and `last`. `out` may be one of the poses. */
void smear_curve_at(smear_transform *out, const struct smear_curve *curve, int32_t time);

#endif

/* SPDX-License-Identifier: MIT */
/* curve.h - where something is that moves along no straight line; asked by geometry/shot.h and pose.h, and by draws_prepare.c. */
#ifndef SMEAR_CURVE_H
#define SMEAR_CURVE_H

#include "geometry/arc.h"

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

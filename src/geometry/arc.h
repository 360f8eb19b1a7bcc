/* SPDX-License-Identifier: MIT */
/* arc.h - where something that turns is between two poses: on the arc, not on the chord. */
#ifndef SMEAR_ARC_H
#define SMEAR_ARC_H

#include "smear.h"

#include "base/fixed.h"

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

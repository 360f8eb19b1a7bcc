/* SPDX-License-Identifier: MIT */
/* course.h - the circuit: where the middle of the road is, and the road, kerbs, grass and trees as meshes.
 *
 * Lengths are metres in Q16.16. A place on the circuit is a distance along it in segments, Q16.16, and a distance to the
 * right of its middle. */
#ifndef GAME_COURSE_H
#define GAME_COURSE_H

#include <smear.h>
#include <smear_math.h>

enum {
    COURSE_SEGMENTS = 96,           /* of about 7 metres */
    COURSE_SEEN = 26,               /* segments that one looks ahead */
    COURSE_LAP = COURSE_SEGMENTS << 16,
    COURSE_HALF_ROAD = 5 << 16
};

/* Makes the circuit, as fine as a picture so many pixels high shows it. */
void course_make(int height);

/* The road and what stands beside it, COURSE_SEEN segments from a place on; until the next call. */
const smear_mesh *course_ahead(int32_t along);

/* A place in the world, `up` above the ground. */
smear_vec3 course_place(int32_t along, int32_t right, int32_t up);

/* How much the road turns to the right from a segment to the next, as the sine of the angle, q16. */
int32_t course_bend(int32_t along);

#endif

/* SPDX-License-Identifier: MIT */
/* path.h - where a moving vertex is during the exposure.
 *
 * Methods that look at several instants keep three places of every moving vertex: at shutter open, in the
 * middle and at close. Between them it moves along the parabola through the three. */
#ifndef SMEAR_PATH_H
#define SMEAR_PATH_H

#include "geometry/bins.h"

/* Time in the exposure is q16: 0 is open, SHUTTER_CLOSE is close. */
#define SHUTTER_CLOSE 65536

/* How many time samples of equal weight the exposure has. */
#define SHUTTER_SAMPLES 32

/* When each time sample begins; time[SHUTTER_SAMPLES] is when the last one ends. A box shutter has even steps; where a
 * shutter lets through less light, samples are longer. */
struct smear_shutter_times {
    int32_t time[(SMEAR_WITH_SUBFRAMES ? SHUTTER_SAMPLES : 0) + 1];
};

/* The record of a vertex with a path (struct smear_segment.path) has the place in the middle of the exposure at VERTEX_X ..
 * VERTEX_DEPTH, and at segment->motion those at open and at close, in the same units: q8 px, q8 px, q11 depth units. */
enum { PATH_X, PATH_Y, PATH_DEPTH, PATH_POSE_WORDS, PATH_WORDS = 2 * PATH_POSE_WORDS };

/* Returns the phase of a time: -1 at open, 1 at close, q30. */
static inline int32_t path_phase(int32_t time)
{
    return (time - SHUTTER_CLOSE / 2) * 32768;
}

/* Returns floor(a u / 2^32) for a phase u, which has only its upper 17 bits set: two products of 16 bits do where there
 * are no wide ones. */
static inline int32_t phase_times(int32_t a, int32_t u)
{
    if (SMEAR_HAS_MUL64)
        return mulh_i32(a, u);
    const int32_t part = u >> 15;
    return ((a >> 16) * part + ((int32_t)((uint32_t)a & 0xffffu) * part >> 16)) >> 1;
}

/* Returns a coordinate on its path, middle + (close - open) u / 2 + (open + close - 2 middle) u^2 / 2, to nearest: a floor would move
 * all edges up and left by half a step. Places lie within the guard band, so differences have 21 bits; sums are in q6. */
static inline int32_t path_coordinate(int32_t open, int32_t middle, int32_t close, int32_t u)
{
    int32_t slope = close - open, curvature = open + close - 2 * middle;
    return middle + ((phase_times((slope * 64 + phase_times(curvature * 256, u)) * 8, u) + 128) >> 8);
}

/* Returns a depth on its path, in q11 units below 2^30.1, good to 8 steps. */
static inline int32_t path_depth(int32_t open, int32_t middle, int32_t close, int32_t u)
{
    int32_t curvature = (int32_t)(((uint32_t)open + (uint32_t)close) >> 1) - middle;         /* halved */
    return middle + phase_times((((close - open) >> 3) + phase_times(curvature, u)) * 4, u) * 4;
}

/* Finds x, y and depth of a vertex at a phase; `open`: its place at open, which that at close follows. */
static inline void path_place(int32_t out[3], const int32_t *record, const int32_t *open, int32_t u)
{
    const int32_t *close = open + PATH_POSE_WORDS;
    out[PATH_X] = path_coordinate(open[PATH_X], record[VERTEX_X], close[PATH_X], u);
    out[PATH_Y] = path_coordinate(open[PATH_Y], record[VERTEX_Y], close[PATH_Y], u);
    out[PATH_DEPTH] = path_depth(open[PATH_DEPTH], record[VERTEX_DEPTH], close[PATH_DEPTH], u);
}

/* Whether a vertex whose places at open and close are given is shifted along an axis from instant to instant, for smooth edges.
 * Along its way it moves by itself, and steps that were not even would show; a way below two pixels does not do for that. */
static inline bool path_is_shifted(const int32_t *open, int axis)
{
    const int32_t *close = open + PATH_POSE_WORDS;
    const int32_t along = abs_i32(close[axis] - open[axis]);
    return along < 512 || along < abs_i32(close[1 - axis] - open[1 - axis]);
}

/* A vertex at an instant: x, y and depth, and up to three words more. */
struct path_record {
    int32_t word[6];
};

/* Finds x, y and depth of three vertices at a phase, of which `vertex` has the first words from `base` on, and the box of them: the
 * least x and y, and the largest. */
static inline void path_triangle(int32_t box[4], struct path_record out[3], const int32_t *base, const uint16_t vertex[3], int motion,
                                 int32_t u)
{
    box[0] = box[1] = INT32_MAX;
    box[2] = box[3] = INT32_MIN;
    for (int i = 0; i < 3; i++) {
        const int32_t *v = base + vertex[i];
        int32_t *const at = out[i].word;
        path_place(at, v, v + motion, u);
        box[0] = min_i32(box[0], at[VERTEX_X]);
        box[1] = min_i32(box[1], at[VERTEX_Y]);
        box[2] = max_i32(box[2], at[VERTEX_X]);
        box[3] = max_i32(box[3], at[VERTEX_Y]);
    }
}

/* Makes the samples of a shutter whose openness is given at SMEAR_SHUTTER_POINTS even steps over the exposure, with
 * straight lines between; null is a box. Returns false where it is closed throughout. */
bool smear_shutter_make(struct smear_shutter_times *shutter, const uint8_t *openness);

/* Returns the middle of instant i of n of equal weight, q16 of the exposure. */
int32_t smear_shutter_instant(const struct smear_shutter_times *shutter, int32_t i, int32_t n);

/* Whether all samples have one length. */
bool smear_shutter_is_box(const struct smear_shutter_times *shutter);

#endif

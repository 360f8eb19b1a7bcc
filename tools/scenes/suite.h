/* SPDX-License-Identifier: MIT */
/* suite.h - shapes and sets shared by the scenes of the quality suite, and the tables of its
 * files. */
#ifndef SMEAR_TOOLS_SCENES_SUITE_H
#define SMEAR_TOOLS_SCENES_SUITE_H

#include "tools/scenes/build.h"
#include "tools/scenes/stage.h"

extern const struct stage_kind suite_object_kinds[], suite_camera_kinds[];
extern const int suite_object_count, suite_camera_count;

/* Numbers in 0..1 that look random; start with any seed. */
double suite_random(uint32_t *state);

/* Time since the middle of the current period, -period/2 .. period/2; *lap counts periods, so
 * that what starts over can be marked as cut. */
double suite_lap(double time, double period, int *lap);
void suite_cut(struct scene_instant *out, int draw, int lap);

/* A still yard of coloured slabs and solids around the origin, for a camera at z > 0 that looks at
 * it. Adds one draw. */
int suite_yard(struct stage *stage, uint32_t seed);

/* Ground slabs and `count` solids between `near` and 22 metres in all directions of the origin;
 * `bold` has finer slabs and more contrast. Adds one draw. */
int suite_round(struct stage *stage, uint32_t seed, int count, double near, bool bold);

/* Movers, about the origin. */
const struct scene_surface *suite_ball(struct stage *stage, double radius, uint32_t a, uint32_t b);
const struct scene_surface *suite_crate(struct stage *stage, double half,
                                        const struct image *image);
const struct scene_surface *suite_plane(struct stage *stage, uint32_t hull, uint32_t wings);
const struct scene_surface *suite_car(struct stage *stage, uint32_t paint);

/* A picture of tiles in two colours with a grain, `tiles` in each direction. */
const struct image *suite_tiles(struct stage *stage, int size, int tiles, uint32_t a, uint32_t b);

/* Sums of face normals, for surfaces that were bent out of shape. */
void suite_normals(const struct scene_surface *surface, const float *position, float *normal);

#endif

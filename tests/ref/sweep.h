/* SPDX-License-Identifier: MIT */
/* sweep.h - many scenes by chance, of each the mean of exact instants, and how far nine of ten pictures are from it: what the suites
 * rooms, noise, turns and alike share. Host only. */
#ifndef SMEAR_TESTS_SWEEP_H
#define SMEAR_TESTS_SWEEP_H

#include "tests/rig.h"

enum { SWEEP_MOST = 20000 };

/* SMEAR_CASES asks for another number of scenes than is usual, or thorough; SMEAR_FIRST begins with that one, and tells of each. */
struct sweep {
    uint32_t count, first;
    bool tells;
};

struct sweep sweep_of(uint32_t usual, uint32_t thorough);

/* Chance as it is for the scene of this number. */
void sweep_seed(uint32_t number);

/* Draws into the rig's picture. SMEAR_NONE draws what there is where `part` of the exposure's way is over: -0.5 at open, 0.5 at close. */
typedef bool (*sweep_draw)(struct rig *r, const void *scene, uint8_t method, uint16_t target, double part);

/* Finds the mean of exact instants in codes, four numbers a pixel; of linear light or of codes. */
bool sweep_mean(double *mean, struct rig *r, sweep_draw draw, const void *scene, int instants, bool linear);

/* Returns by how many codes the rig's picture is off. */
double sweep_error(const struct rig *r, const double *mean);

/* Sorts errors and checks how large nine of ten are, and all. */
void sweep_check(double *error, uint32_t count, const char *what, double most_of_nine, double most);

/* ------------------------------------------------------------------ what moves */

/* A thing of a size, turned by a basis of 1 / 2^24, that turns about an axis of length 1 by an angle in radians and goes a way in units,
 * both in the whole exposure. */
struct mover {
    double axis[3], angle, way[3], at[3], size[3];
    int32_t basis[9];
};

smear_transform mover_pose(const struct mover *m, double part);

/* A box of edge 2 whose sides have vertices of their own, andthe whole texture each. */
const smear_mesh *textured_box(void);

#endif

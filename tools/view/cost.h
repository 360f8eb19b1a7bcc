/* SPDX-License-Identifier: MIT */
/* cost.h - what a frame would take on another processor: an ESTIMATE from the work that the library
 * counted, never a measurement. */
#ifndef SMEAR_TOOLS_VIEW_COST_H
#define SMEAR_TOOLS_VIEW_COST_H

#include <smear.h>

/* Pieces of work that are counted. */
enum cost_work {
    COST_FRAME,                 /* one */
    COST_TRIANGLE_IN,           /* submitted, once per instant */
    COST_TRIANGLE_DRAWN,
    COST_PIXEL,                 /* of the frame */
    COST_WINDOW,                /* pixels of a frame that a filter has looked at */
    COST_TIMED_TRIANGLE,        /* drawn by a time-resolved method */
    /* samples, shared between methods by their tiles */
    COST_ACCUMULATE, COST_RECONSTRUCT, COST_CAMERA, COST_PINGPONG, COST_HALF, COST_OBJECT, COST_LAYERED, COST_SUBFRAMES,
    COST_TIMEMASK,
    COST_WORKS
};

struct cost_core {
    const char *name;
    double instructions[COST_WORKS];    /* per piece */
    double cycles_per_instruction;
};

extern const struct cost_core cost_cores[];     /* name null ends the list */

/* Null when there is none of this name. */
const struct cost_core *cost_find(const char *name);

void cost_count(const smear_stats *stats, double work[COST_WORKS]);
double cost_instructions(const struct cost_core *core, const smear_stats *stats);
double cost_us(const struct cost_core *core, double hz, const smear_stats *stats);

#endif

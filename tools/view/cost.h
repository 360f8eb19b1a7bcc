/* SPDX-License-Identifier: MIT */
/* cost.h - what a frame would take on another processor: an ESTIMATE from the work that the library
 * counted, never a measurement. */
#ifndef SMEAR_TOOLS_VIEW_COST_H
#define SMEAR_TOOLS_VIEW_COST_H

#include <smear.h>

struct cost_core {
    const char *name;
    /* instructions per counted piece of work */
    double frame, triangle_in, triangle_drawn, pixel, instant_pixel, sample;
    double cycles_per_instruction;
};

extern const struct cost_core cost_cores[];     /* name null ends the list */

/* Null when there is none of this name. */
const struct cost_core *cost_find(const char *name);

double cost_instructions(const struct cost_core *core, const smear_stats *stats);
double cost_us(const struct cost_core *core, double hz, const smear_stats *stats);

#endif

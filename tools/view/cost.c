/* SPDX-License-Identifier: MIT */
/* cost.c - see cost.h. */
#include "cost.h"

#include <string.h>

const struct cost_core cost_cores[] = {
    { "cortex-m0plus", 50000, 450, 500, 110, 110, 60, 1.5 },
    { "cortex-m3", 40000, 250, 300, 70, 70, 35, 1.4 },
    { "cortex-m7", 40000, 250, 300, 70, 70, 35, 0.9 },
    { "arm7tdmi", 40000, 300, 350, 80, 80, 45, 3.0 },
    { "arm926", 40000, 250, 300, 70, 70, 35, 1.6 },
    { NULL, 0, 0, 0, 0, 0, 0, 0 },
};

const struct cost_core *cost_find(const char *name)
{
    for (const struct cost_core *c = cost_cores; c->name != NULL; c++)
        if (strcmp(c->name, name) == 0)
            return c;
    return NULL;
}

double cost_instructions(const struct cost_core *core, const smear_stats *s)
{
    return core->frame + core->triangle_in * s->triangles_in +
           core->triangle_drawn * s->triangles_drawn + core->pixel * s->pixels +
           core->sample * s->samples;
}

double cost_us(const struct cost_core *core, double hz, const smear_stats *stats)
{
    return cost_instructions(core, stats) * core->cycles_per_instruction * 1e6 / hz;
}

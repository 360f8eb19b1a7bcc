/* SPDX-License-Identifier: MIT */
/* cost.c - see cost.h. */
#include "cost.h"

#include <stdbool.h>
#include <string.h>

const struct cost_core cost_cores[] = {
    { "cortex-m0plus", { 50000, 450, 500, 110, 60, 60, 60 }, 1.5 },
    { NULL, { 0 }, 0 },
};

const struct cost_core *cost_find(const char *name)
{
    for (const struct cost_core *c = cost_cores; c->name != NULL; c++)
        if (strcmp(c->name, name) == 0)
            return c;
    return NULL;
}

void cost_count(const smear_stats *s, double work[COST_WORKS])
{
    bool accumulates = s->tiles_accumulate > 0, is_timed = s->tiles_subframes + s->tiles_timemask > 0;
    double instants = accumulates && s->pixels > 0 ? (double)s->samples / s->pixels : 1.0;
    work[COST_FRAME] = 1.0;
    work[COST_TRIANGLE_IN] = s->triangles_in * instants;
    work[COST_TRIANGLE_DRAWN] = s->triangles_drawn;
    work[COST_PIXEL] = s->pixels;
    work[COST_TAP] = accumulates || is_timed ? 0.0 : s->samples;
    work[COST_TIMED] = is_timed ? s->samples : 0.0;
    work[COST_ACCUMULATED] = accumulates ? s->samples : 0.0;
}

double cost_us(const struct cost_core *core, double hz, const smear_stats *stats)
{
    double work[COST_WORKS], instructions = 0.0;
    cost_count(stats, work);
    for (int i = 0; i < COST_WORKS; i++)
        instructions += work[i] * core->instructions[i];
    return instructions * core->cycles_per_instruction * 1e6 / hz;
}

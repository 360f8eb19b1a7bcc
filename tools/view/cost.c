/* SPDX-License-Identifier: MIT */
/* cost.c - see cost.h.
 *
 * Instructions per piece of work are what `make TARGET=... cost-model` prints: fitted to frames
 * whose instructions were counted. They are a third off in the mean of squares and up to three
 * quarters in single frames: what is drawn over and over is not counted. Cycles per instruction
 * are assumptions about code that runs from cached flash or from RAM; on the ARM7TDMI, whose
 * data lies behind wait states, they weigh most. The M7 and the ARM7TDMI run the M4's and M3's
 * instructions. */
#include "cost.h"

#include <stdbool.h>
#include <string.h>

const struct cost_core cost_cores[] = {
    { "cortex-m0plus", { 0, 1437, 2180, 314, 483, 30565, 706, 1999, 250 }, 1.4 },
    { "cortex-m3", { 0, 564, 1516, 202, 257, 12652, 378, 938, 95 }, 1.3 },
    { "cortex-m4", { 0, 561, 1543, 202, 255, 12679, 375, 946, 95 }, 1.3 },
    { "cortex-m7", { 0, 561, 1543, 202, 255, 12679, 375, 946, 95 }, 0.8 },
    { "arm7tdmi", { 0, 564, 1516, 202, 257, 12652, 378, 938, 95 }, 3.0 },
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
    double timed_tiles = s->tiles_subframes + s->tiles_timemask, instants = 1.0;
    double samples[3] = { s->samples, 0.0, 0.0 };       /* taps, of subframes, of timemask */
    bool accumulates = s->tiles_accumulate > 0;
    if (accumulates && s->pixels > 0)
        instants = (double)s->samples / s->pixels;
    if (timed_tiles > 0.0) {
        samples[1] = s->samples * (s->tiles_subframes / timed_tiles);
        samples[2] = s->samples - samples[1];
    }
    work[COST_FRAME] = 1.0;
    work[COST_TRIANGLE_IN] = s->triangles_in * instants;
    work[COST_TRIANGLE_DRAWN] = s->triangles_drawn;
    work[COST_PIXEL] = s->pixels;
    work[COST_TAP] = accumulates || timed_tiles > 0.0 ? 0.0 : samples[0];
    work[COST_TIMED_TRIANGLE] = timed_tiles > 0.0 ? s->triangles_drawn : 0.0;
    work[COST_SUBFRAMES] = samples[1];
    work[COST_TIMEMASK] = samples[2];
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

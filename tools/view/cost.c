/* SPDX-License-Identifier: MIT */
/* cost.c - see cost.h.
 *
 * Instructions per piece of work are what `make TARGET=... cost-model` prints: fitted to frames
 * whose instructions were counted. They are a third off in the mean of squares and up to three
 * quarters in single frames: what is drawn over and over is not counted. Cycles per instruction
 * are assumptions about code that runs from cached flash or from RAM; on the ARM7TDMI, whose
 * data lies behind wait states, they weigh most. The M7 and the ARM7TDMI run the M4's and M3's
 * instructions. rv32imc and xtensa (that of an ESP8266, which has no high halves of products) were measured with 16 MB of
 * RAM in their linker scripts, as methods over time need more than their 512 kB for these frames. */
#include "tools/view/cost.h"

#include <stdbool.h>
#include <string.h>

const struct cost_core cost_cores[] = {
    { "cortex-m0plus", { 0, 1240, 3177, 114, 681, 20366, 180, 117, 418, 91, 0, 488, 691, 583, 744 }, 1.4 },
    { "cortex-m3", { 0, 413, 2247, 62, 343, 9110, 54, 69, 161, 48, 0, 274, 331, 290, 415 }, 1.3 },
    { "cortex-m4", { 0, 414, 2252, 62, 341, 9155, 53, 69, 160, 48, 0, 274, 330, 289, 421 }, 1.3 },
    { "cortex-m7", { 0, 414, 2252, 62, 341, 9155, 53, 69, 160, 48, 0, 274, 330, 289, 421 }, 0.8 },
    { "arm7tdmi", { 0, 413, 2247, 62, 343, 9110, 54, 69, 161, 48, 0, 274, 331, 290, 415 }, 3.0 },
    { "rv32imc", { 0, 365, 2657, 11, 460, 8947, 34, 96, 278, 58, 0, 450, 431, 119, 518 }, 1.3 },
    { "xtensa", { 0, 775, 4104, 0, 647, 14181, 114, 89, 583, 91, 0, 638, 652, 186, 824 }, 1.3 },
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
    const struct {
        enum cost_work work;
        uint32_t tiles;
    } method[] = {
        { COST_ACCUMULATE, s->tiles[SMEAR_ACCUMULATE] }, { COST_RECONSTRUCT, s->tiles[SMEAR_RECONSTRUCT] },
        { COST_CAMERA, s->tiles[SMEAR_CAMERA] },         { COST_PINGPONG, s->tiles[SMEAR_PINGPONG] },
        { COST_HALF, s->tiles[SMEAR_HALF] },             { COST_OBJECT, s->tiles[SMEAR_OBJECT] },
        { COST_LAYERED, s->tiles[SMEAR_LAYERED] },       { COST_SUBFRAMES, s->tiles[SMEAR_SUBFRAMES] },
        { COST_TIMEMASK, s->tiles[SMEAR_TIMEMASK] },
    };
    enum { METHODS = sizeof method / sizeof *method };
    bool is_timed = false, is_filtered = false;
    for (int m = 0; m < SMEAR_METHOD_COUNT; m++) {
        is_timed |= smear_method_is_temporal(m) && s->tiles[m] > 0;
        is_filtered |= smear_method_is_filter(m) && s->tiles[m] > 0;
    }
    const double all = (double)s->tiles_static + s->tiles_uniform + s->tiles_complex;
    double tiles = 0.0, instants = 1.0;
    if (s->tiles[SMEAR_ACCUMULATE] > 0 && s->pixels > 0)
        instants = (double)s->samples / s->pixels;
    memset(work, 0, COST_WORKS * sizeof *work);
    work[COST_FRAME] = 1.0;
    work[COST_TRIANGLE_IN] = s->triangles_in * instants;
    work[COST_TRIANGLE_DRAWN] = s->triangles_drawn;
    work[COST_PIXEL] = all > 0.0 ? s->pixels * (1.0 - s->tiles_kept / all) : s->pixels;     /* not those that the display has */
    work[COST_WINDOW] = is_filtered ? s->pixels : 0.0;
    work[COST_TIMED_TRIANGLE] = is_timed ? s->triangles_drawn : 0.0;
    for (int i = 0; i < METHODS; i++)
        tiles += method[i].tiles;
    for (int i = 0; i < METHODS && tiles > 0.0; i++)
        work[method[i].work] = s->samples * (method[i].tiles / tiles);
}

double cost_instructions(const struct cost_core *core, const smear_stats *stats)
{
    double work[COST_WORKS], instructions = 0.0;
    cost_count(stats, work);
    for (int i = 0; i < COST_WORKS; i++)
        instructions += work[i] * core->instructions[i];
    return instructions;
}

double cost_us(const struct cost_core *core, double hz, const smear_stats *stats)
{
    return cost_instructions(core, stats) * core->cycles_per_instruction * 1e6 / hz;
}

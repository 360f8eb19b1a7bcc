/* SPDX-License-Identifier: MIT */
/* tile_method.c - the rules by which a tile gets its method. */
#include "temporal/tile_method.h"

#include "smear.h"

#include "base/fixmath.h"

/* The instants of a tile: `least` and one more per `step` of travel, where gaps between them are closed. Where moving
 * triangles go apart, as many as keep a step of one within `spread` of that of another. In a frame too small for gaps to
 * be closed, one per `apart` of travel. Measured on the scenes of the quality suite (make chart): fewer instants cost a tenth less
 * and are seen as teeth at the ends of long streaks (failure rows 3 and 22). */
struct preset {
    int32_t target;                     /* from this error on, 1/64 codes */
    int32_t least, step, spread, apart; /* 1/16 px, but for `least` */
    int32_t intervals;                  /* instants at least, of what passes through the near plane */
};

enum {
    INSTANTS_MAX = 64,
    STEP_MAX = 256              /* wider gaps between instants are not closed, 1/16 px: subframe_gap.c */
};

static const struct preset presets[] = {
    { SMEAR_DRAFT, 2, 288, 512, 8, 6 },
    { 128, 3, 352, 448, 4, 6 },
    { SMEAR_BALANCED, 3, 320, 400, 4, 6 },
    { 64, 5, 192, 144, 4, 7 },
    { SMEAR_FINE, 9, 96, 56, 2, 12 },
    { 20, 15, 64, 36, 1, 16 },
    { 0, 20, 40, 20, 1, 16 }
};

static const struct preset *preset_of(int32_t target)
{
    const struct preset *p = presets;
    while (target < p->target)
        p++;
    return p;
}

static int32_t largest(int32_t low, int32_t high)
{
    return max_i32(high, -low);
}

static bool is_displaced(const struct smear_tile_travel *tile)
{
    return tile->x0 <= tile->x1;
}

/* Returns the longest travel, 1/16 px: the longer side of the displacements and half the shorter. */
static int32_t travel_of(const struct smear_tile_travel *tile)
{
    if (!is_displaced(tile))
        return tile->curvature;
    int32_t x = largest(tile->x0, tile->x1), y = largest(tile->y0, tile->y1);
    return max_i32(x, y) + (min_i32(x, y) >> 1) + tile->curvature;
}

/* Returns the longest travel along x or y, 1/16 px. */
static int32_t reach_of(const struct smear_tile_travel *tile)
{
    return is_displaced(tile) ? max_i32(largest(tile->x0, tile->x1), largest(tile->y0, tile->y1)) + tile->curvature
                              : tile->curvature;
}

/* Returns one instant per half pixel of travel, at least 2: even a motion of less than a pixel needs them, where edges
 * are hard. */
static int32_t instants_for(const struct smear_tile_travel *tile, int32_t most)
{
    if ((tile->flags & PATH_INTERVAL) != 0)        /* its displacement is not known */
        return most;
    return min_i32(max_i32((travel_of(tile) + 7) >> 3, 2), most);
}

/* Returns how unlike the displacements of a tile are, 1/16 px. */
static int32_t spread_of(const struct smear_tile_travel *tile)
{
    return is_displaced(tile) ? max_i32(tile->x1 - tile->x0, tile->y1 - tile->y0) + tile->curvature : 0;
}

static bool may_fill(const struct smear_chooser *chooser, const struct smear_tile_travel *tile)
{
    return chooser->fills && (tile->flags & (TILE_MOVES | TILE_BLENDED)) == TILE_MOVES;
}

void smear_tile_method_step(struct smear_step *step, const struct smear_chooser *chooser,
                            const struct smear_tile_travel *tile, int32_t instants)
{
    *step = (struct smear_step){ 0, 0 };
    if (chooser->method != SMEAR_AUTO || !is_displaced(tile) || !may_fill(chooser, tile))
        return;
    step->x = (int16_t)(tile->x / instants);
    step->y = (int16_t)(tile->y / instants);
}

/* Returns the instants that SMEAR_AUTO takes of a tile. */
static int32_t auto_instants(const struct preset *p, const struct smear_chooser *chooser,
                             const struct smear_tile_travel *tile)
{
    const int32_t travel = travel_of(tile);
    int32_t instants = chooser->fills ? travel / 16 + 1 : max_i32(travel / p->apart + 1, p->least);
    if (may_fill(chooser, tile)) {
        instants = max_i32(p->least + travel / p->step, reach_of(tile) / STEP_MAX + 1);
        if (p->least <= 3 && travel < 8)        /* half a pixel */
            instants = 2;
        instants = max_i32(instants, spread_of(tile) / p->spread + 1);
    }
    /* What passes through the near plane is in sub-intervals of the exposure, of which an instant draws one. How they go
     * is not known, as clipping moves their ends. */
    if ((tile->flags & PATH_INTERVAL) != 0)
        instants = clamp_i32(instants, p->intervals, PATH_INTERVALS);
    return instants;
}

void smear_tile_method_choose(struct smear_tile_choice *choice, const struct smear_chooser *chooser,
                              const struct smear_tile_travel *tile)
{
    if ((tile->flags & TILE_MOVES) == 0 && (tile->flags & PATH_SUBFRAMES) == 0) {
        choice->method = TILE_COPY;
    } else if (SMEAR_WITH_TIMEMASK && chooser->method == SMEAR_TIMEMASK && (tile->flags & PATH_WITHOUT_MASK) == 0) {
        choice->method = TILE_TIMEMASK;
        choice->timemask = (struct smear_timemask_settings){
            chooser->samples <= 8 ? 8 : chooser->samples <= 16 ? 16 : 32, 16, 6, 256
        };
    } else {
        choice->method = TILE_SUBFRAMES;
        choice->instants = chooser->method != SMEAR_AUTO
                             ? instants_for(tile, chooser->samples)
                             : min_i32(auto_instants(preset_of(chooser->target), chooser, tile), INSTANTS_MAX);
    }
}

/* Predicts the work of a preset, pixels x instants, saturated. Triangles whose displacements differ are not known to
 * share a tile. */
static uint32_t predicted(const struct preset *p, const struct smear_chooser *chooser,
                          const struct smear_travel_areas *areas)
{
    uint32_t sum = 0;
    for (int i = 0; i <= TRAVEL_CLASSES; i++) {
        const bool is_interval = i == TRAVEL_CLASSES;
        const int16_t x = is_interval ? 0 : (int16_t)((2 * i + 1) << (TRAVEL_CLASS_SHIFT - 1));
        const struct smear_tile_travel tile = {
            .x0 = x, .x1 = x, .x = x, .weight = 1, .flags = (uint16_t)(TILE_MOVES | (is_interval ? PATH_INTERVAL : 0))
        };
        const uint32_t area = is_interval ? areas->interval_area : areas->area[i];
        const uint32_t instants = (uint32_t)min_i32(auto_instants(p, chooser, &tile), INSTANTS_MAX);
        if (area > (UINT32_MAX - sum) / instants)
            return UINT32_MAX;
        sum += area * instants;
    }
    return sum;
}

int32_t smear_tile_method_target(const struct smear_chooser *chooser, const struct smear_travel_areas *areas,
                                 uint32_t budget, uint32_t *work)
{
    const struct preset *p = preset_of(chooser->target);
    int32_t target = chooser->target;
    *work = predicted(p, chooser, areas);
    while (*work > budget && p != presets) {
        target = (--p)->target;
        *work = predicted(p, chooser, areas);
    }
    return target;
}

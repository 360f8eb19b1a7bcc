/* SPDX-License-Identifier: MIT */
/* tile_method.c - the rules by which a tile gets its method. */
#include "temporal/tile_method.h"

#include "smear.h"

#include "base/fixmath.h"

enum {
    INSTANTS_MAX = 255,     /* within SMEAR_PACKED_INSTANTS */
    STEP_MAX = 16 * 16,     /* wider gaps between instants are not closed, 1/16 px: subframe_gap.c */
    SKETCH_STEP_MAX = 32 * 16 /* of a sketch */
};

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
    if ((tile->flags & PATH_SPACE) != 0) /* its displacement is not known */
        return most;
    return min_i32(max_i32((travel_of(tile) + 7) >> 3, 2), most);
}

/* Returns how unlike the displacements of a tile are, 1/16 px. */
static int32_t spread_of(const struct smear_tile_travel *tile)
{
    return is_displaced(tile) ? max_i32(tile->x1 - tile->x0, tile->y1 - tile->y0) + tile->curvature : 0;
}

/* ------------------------------------------------------------------ SMEAR_AUTO */

bool smear_tile_may_close(const struct smear_chooser *chooser, const struct smear_tile_travel *tile)
{
    return is_displaced(tile) && chooser->fills && (tile->flags & (TILE_MOVES | TILE_BLENDED)) == TILE_MOVES;
}

struct smear_closing smear_tile_closing(const struct smear_tile_travel *tile)
{
    return smear_closing_of(tile->x, tile->y, spread_of(tile) * 5 >> 3);
}

struct smear_step smear_tile_way(const struct smear_tile_travel *tile)
{
    if (!is_displaced(tile) || max_i32(abs_i32(tile->x), abs_i32(tile->y)) > 2 * spread_of(tile))
        return (struct smear_step){ tile->x, tile->y };
    return (struct smear_step){ tile->x1 > -tile->x0 ? tile->x1 : tile->x0, tile->y1 > -tile->y0 ? tile->y1 : tile->y0 };
}

int32_t smear_tile_widest_step(const struct smear_chooser *chooser, const struct smear_tile_travel *tile)
{
    const int32_t least = chooser->target >= 128 ? 3 : chooser->target >= 80 ? 5
                                                                             : 16;
    return chooser->method == SMEAR_AUTO && smear_tile_may_close(chooser, tile) ? tile->x / least : 0;
}

/* Returns the least instants of a tile: the first may show nothing of what passes later. Where targets are coarse, one may do. */
static int32_t least_instants(const struct smear_chooser *chooser, const struct smear_tile_travel *tile)
{
    const uint32_t root = sqrt_floor_64((uint32_t)min_i32(travel_of(tile), 65535) << 8); /* 1/16 */
    const int32_t target = max_i32(chooser->target, 1), n = 2 + (int32_t)(3 * root / (4 * (uint32_t)target));
    if (target >= SMEAR_DRAFT)
        return 1;
    return target < 64 ? max_i32(n, 288 / target) : n;      /* pictures of slow things jump where the number changes */
}

/* Returns the squared error that so many blocks may have together, in the unit of struct smear_contrast: codes^2, summed
 * over three channels, times the 12 of an edge that passes. In linear light dark codes differ by more than their light:
 * by 1.3 in the mean; of the finest targets less is left than is told. What stands still has no error, and others may have 7/8 of
 * that, up to 7/8 of their own; but with `alone`: where something passes the eye, of which little is known, for the finest targets, and
 * where each instant is another place within the pixel. */
static uint32_t allowed(const struct smear_tile_plan *plan, uint32_t blocks, bool alone)
{
    const struct smear_chooser *chooser = plan->chooser;
    const uint32_t still = alone ? 0 : plan->tiles[0], others = max_u32(plan->tiles[1], 1);
    const uint32_t share = 256 + (min_u32(still, others) * 224) / others;         /* q8 */
    const uint64_t target = (uint64_t)min_i32(chooser->target, 8191);
    const uint64_t parts = (transfer_is_linear(chooser->transfer) ? 7u : 9u) + (target < 64 ? 2u : 0u);
    const uint64_t sum = target * target * parts * blocks * share >> 18;
    return sum > UINT32_MAX ? UINT32_MAX : (uint32_t)sum;
}

/* a / b: most are 0, and need no division where that is a call. */
static inline uint32_t over(uint32_t a, uint32_t b) { return a < b ? 0 : a / b; }

/* Returns what is rounded where gaps are closed, of what is left where they are not. Instants about a pixel apart are at the same place
 * of all pixels: what the pixels beside it show is no news. */
static uint32_t rounded(uint32_t sum, uint32_t plain)
{
    const uint32_t all = plain - (plain >> 2), apart = 2 * sum;     /* plain, where instants are a pixel apart */
    return apart > all && apart < plain + (plain >> 2) ? all : min_u32(sum, (plain >> 2) + (plain >> 3));
}

/* Returns what `instants` leave of the squared error. At the ends of a run, `width` pixels, half a gap stays open: that counts where a
 * gap is wider than an eighth of the run. */
static uint32_t error_of(const struct smear_contrast *c, uint32_t unseen, int32_t instants, int32_t reach, int32_t widest, int32_t width)
{
    const bool may_close = instants > reach / widest;
    const uint32_t open = reach > 2 * width * instants ? min_u32((uint32_t)(8 * reach / (width * instants)), 256) : 0;   /* q8 of it */
    const uint32_t square = (uint32_t)(instants * instants);
    uint32_t sum = over(unseen, square);
    for (int k = 0; k < CLOSING_CLASSES; k++) {
        const uint32_t plain = over(c->plain[k], square), closed = c->closed[k], left_open = (c->plain[k] >> 8) * open;
        if (!may_close || (instants + 1) >> 1 > k)
            sum += plain;
        else
            sum += over(closed + min_u32(left_open, UINT32_MAX - closed), square) + rounded(c->rounded[k], plain) + c->floor[k];
    }
    return sum;
}

static int tiles_in(const struct smear_tile_run *t) { return (t->x1 - t->x0 + t->tile - 1) / t->tile; }

int32_t smear_tile_plan_instants(const struct smear_tile_plan *plan, const struct smear_tile_run *t, const struct smear_contrast *c,
                                 int32_t first)
{
    enum { COMMON = 300 };      /* what a block has that is not seen yet, in codes^2 for each pixel it goes */
    const struct smear_chooser *chooser = plan->chooser;
    const int tiles = tiles_in(t);
    const int32_t widest = target_is_sketch(chooser->target) ? SKETCH_STEP_MAX : STEP_MAX;
    int32_t least = first, reach = 0, instants;
    uint32_t unseen = c->unseen;
    bool alone = chooser->target < 64 || (SMEAR_EDGES && bins_margin(t->frame->bins) != 0);
    for (int i = 0; i < tiles; i++) {
        const struct smear_tile_travel *tile = &plan->travel[i];
        least = max_i32(least, least_instants(chooser, tile));
        reach = max_i32(reach, reach_of(tile));
        alone = alone || (tile->flags & PATH_SPACE) != 0;
        if (c->moving == 0)
            unseen += ((uint32_t)travel_of(tile) * COMMON >> 4) * (c->blocks / (uint32_t)tiles);
    }
    const uint32_t most = allowed(plan, c->blocks, alone);
    unseen += min_u32(c->changed, UINT32_MAX - unseen);
    for (instants = first; instants + 2 <= INSTANTS_MAX; instants += 2)
        if (instants >= least && error_of(c, unseen, instants, reach, widest, t->x1 - t->x0) <= most)
            break;
    for (int i = 0; i < tiles; i++)
        plan->travel[i].instants = (uint16_t)instants;
    return instants;
}

/* ------------------------------------------------------------------ all */

enum smear_tile_method smear_tile_method_choose(const struct smear_chooser *chooser, const struct smear_tile_travel *tile,
                                                int32_t *instants)
{
    if (((tile->flags & TILE_MOVES) | (tile->flags & PATH_SUBFRAMES)) == 0)
        return TILE_COPY;
    if (SMEAR_WITH_TIMEMASK && chooser->method == SMEAR_TIMEMASK && (tile->flags & PATH_WITHOUT_MASK) == 0)
        return TILE_TIMEMASK;
    *instants = chooser->method == SMEAR_AUTO ? INSTANTS_MAX : instants_for(tile, chooser->samples);
    return TILE_SUBFRAMES;
}

/* ------------------------------------------------------------------ budget */

/* Returns how many instants a triangle of common contrast takes that goes so far, 1/16 px. */
static uint32_t common_instants(int32_t target, int32_t travel)
{
    return min_u32(max_u32(sqrt_floor_64((uint32_t)travel << 15) / (uint32_t)max_i32(target, 1), 2), INSTANTS_MAX);
}

/* Predicts the work for a target, pixels x instants, saturated. */
static uint32_t predicted(int32_t target, const struct smear_travel_areas *areas)
{
    uint32_t sum = 0;
    for (int i = 0; i < TRAVEL_CLASSES; i++) {
        const uint32_t area = areas->area[i], instants = common_instants(target, (2 * i + 1) << (TRAVEL_CLASS_SHIFT - 1));
        if (area > (UINT32_MAX - sum) / instants)
            return UINT32_MAX;
        sum += area * instants;
    }
    return sum;
}

int32_t smear_tile_method_target(const struct smear_chooser *chooser, const struct smear_travel_areas *areas,
                                 uint32_t budget, uint32_t *work)
{
    static const uint16_t targets[] = { SMEAR_FINE, 64, SMEAR_BALANCED, 180, SMEAR_DRAFT };
    int32_t target = chooser->target;
    *work = predicted(target, areas);
    for (unsigned i = 0; i<sizeof targets / sizeof *targets && * work> budget; i++)
        if (targets[i] > target) {
            target = targets[i];
            *work = predicted(target, areas);
        }
    return target;
}

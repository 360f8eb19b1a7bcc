/* SPDX-License-Identifier: MIT */
/* tile_method.h - how a tile is blurred, from what is known of it before a pixel is drawn. */
#ifndef SMEAR_TILE_METHOD_H
#define SMEAR_TILE_METHOD_H

#include "temporal/subframes.h"
#include "temporal/timemask.h"

enum { STRIP_TILES_MAX = 64 };      /* tiles that may share instants (smear_desc.strip) */

/* The moving triangles of a tile: all that may be seen there during the exposure. */
struct smear_tile_load {
    int16_t x0, x1, y0, y1;     /* from open to close, least and most, 1/16 px, of those whose way is known: none where
                                 * x0 > x1 */
    int16_t x, y;               /* their mean, in which longer ways weigh more */
    uint16_t weight;            /* of the mean so far */
    uint16_t curvature;              /* largest, 1/16 px */
    uint16_t flags;             /* of smear_path_bounds, or-ed; TILE_MOVES, TILE_BLENDED; smear_tile_method
                                 * in the end, from TILE_METHOD on */
};

enum {
    TILE_METHOD = 10,               /* bit */
    TILE_MOVES = 0x200,             /* there are moving triangles */
    TILE_BLENDED = 0x100,           /* a blended draw is seen there, too */
    PATH_WITHOUT_MASK = (int)PATH_SUBFRAMES | TILE_BLENDED
};

enum smear_tile_method { TILE_COPY, TILE_SUBFRAMES, TILE_TIMEMASK };

static inline enum smear_tile_method load_method(const struct smear_tile_load *load)
{
    return (enum smear_tile_method)(load->flags >> TILE_METHOD);
}

/* Once. TILE_COPY is what it is without. */
static inline void load_set_method(struct smear_tile_load *load, enum smear_tile_method method)
{
    load->flags |= (uint16_t)((unsigned)method << TILE_METHOD);
}

struct smear_tile_choice {
    enum smear_tile_method method;
    int32_t instants;                           /* TILE_SUBFRAMES */
    struct smear_timemask_settings timemask;    /* TILE_TIMEMASK */
};

struct smear_chooser {
    uint8_t method;             /* smear_method: SMEAR_SUBFRAMES, SMEAR_TIMEMASK or SMEAR_AUTO */
    int32_t samples;
    int32_t target;             /* 1/64 codes */
    bool fills;                 /* gaps between instants may be closed: the frame is not all border */
};

/* How much moves how far: areas of triangles in pixels, saturated. */
enum { WAY_CLASSES = 32, WAY_CLASS_SHIFT = 6 };     /* of 4 px each, 1/16 px; the last: all longer ones */

struct smear_way_areas {
    uint32_t area[WAY_CLASSES], interval_area;     /* interval_area: of what passes through the near plane */
};

/* Of the chooser's target and coarser ones the first for which no more than `budget` pixels x instants are
 * expected, which is then *work; the coarsest in any case. */
int32_t smear_tile_method_target(const struct smear_chooser *chooser, const struct smear_way_areas *areas, uint32_t budget,
                            uint32_t *work);

/* The method of a tile: TILE_COPY, TILE_SUBFRAMES or TILE_TIMEMASK. */
void smear_tile_method_choose(struct smear_tile_choice *choice, const struct smear_chooser *chooser,
                  const struct smear_tile_load *load);

/* How a tile's moving triangles go on between `instants` that it shares: in the mean, but for those that hardly move, as
 * gaps between long streaks are seen more than slow things smeared a little. */
void smear_tile_method_step(struct smear_step *step, const struct smear_chooser *chooser, const struct smear_tile_load *load,
                       int32_t instants);

#endif

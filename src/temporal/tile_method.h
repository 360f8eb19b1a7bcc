/* SPDX-License-Identifier: MIT */
/* tile_method.h - how a tile is blurred, from what is known of it before a pixel is drawn. */
#ifndef SMEAR_TILE_METHOD_H
#define SMEAR_TILE_METHOD_H

#include "temporal/subframes.h"
#include "temporal/timemask.h"

enum { STRIP_TILES_MAX = 64 };      /* tiles that may share instants (smear_desc.strip) */

/* How the moving triangles that may be seen in a tile travel during the exposure, in 1/16 px. */
struct smear_tile_travel {
    int16_t x0, x1, y0, y1;     /* least and largest displacement from open to close of those whose displacement is
                                 * known: none where x0 > x1 */
    int16_t x, y;               /* their mean, in which longer ones weigh more */
    uint16_t weight;            /* of the mean so far */
    uint16_t curvature;         /* largest */
    uint16_t flags;             /* flags of smear_path_bounds; TILE_MOVES, TILE_BLENDED; the tile's method in the end,
                                 * from TILE_METHOD on */
};

enum {
    TILE_METHOD = 10,               /* bit */
    TILE_MOVES = 0x200,             /* there are moving triangles */
    TILE_BLENDED = 0x100,           /* a blended draw is seen there, too */
    PATH_WITHOUT_MASK = (int)PATH_SUBFRAMES | TILE_BLENDED
};

enum smear_tile_method { TILE_COPY, TILE_SUBFRAMES, TILE_TIMEMASK };

static inline enum smear_tile_method travel_method(const struct smear_tile_travel *tile)
{
    return (enum smear_tile_method)(tile->flags >> TILE_METHOD);
}

/* Notes the tile's method, once: before, it is TILE_COPY. */
static inline void travel_set_method(struct smear_tile_travel *tile, enum smear_tile_method method)
{
    tile->flags |= (uint16_t)((unsigned)method << TILE_METHOD);
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

/* How much moves how far: areas of moving triangles in pixels, saturated, by classes of travel of 4 px each. The last
 * class has all longer travels. */
enum { TRAVEL_CLASSES = 32, TRAVEL_CLASS_SHIFT = 6 };   /* log2 of a class, 1/16 px */

struct smear_travel_areas {
    uint32_t area[TRAVEL_CLASSES];
    uint32_t interval_area;     /* of what passes through the near plane, whose travel is not known */
};

/* Returns the finest target, from the chooser's own on, whose predicted work fits `budget`, else the coarsest; stores
 * the prediction, in pixels x instants, in *work. */
int32_t smear_tile_method_target(const struct smear_chooser *chooser, const struct smear_travel_areas *areas,
                                 uint32_t budget, uint32_t *work);

/* Chooses the method of a tile. */
void smear_tile_method_choose(struct smear_tile_choice *choice, const struct smear_chooser *chooser,
                              const struct smear_tile_travel *tile);

/* Finds the step of a tile's moving triangles from one of `instants` to the next: in the mean, in which those that
 * hardly move count little, as gaps between long streaks are seen more than slow things smeared a little. */
void smear_tile_method_step(struct smear_step *step, const struct smear_chooser *chooser,
                            const struct smear_tile_travel *tile, int32_t instants);

#endif

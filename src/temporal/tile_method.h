/* SPDX-License-Identifier: MIT */
/* tile_method.h - how a tile is blurred, from what is known of it before a pixel is drawn. */
#ifndef SMEAR_TILE_METHOD_H
#define SMEAR_TILE_METHOD_H

#include "temporal/lines.h"
#include "temporal/subframes.h"
#include "temporal/tile_contrast.h"

enum { STRIP_TILES_MAX = 64 };      /* tiles that may share instants (smear_desc.strip) */

/* How the moving triangles that may be seen in a tile travel during the exposure, in 1/16 px. */
struct smear_tile_travel {
    int16_t x0, x1, y0, y1;     /* least and largest displacement from open to close of those whose displacement is
                                 * known: none where x0 > x1 */
    int16_t x, y;               /* their mean, in which longer ones weigh more */
    uint16_t weight;            /* of the mean so far */
    uint16_t curvature;         /* largest */
    uint16_t instants;          /* that SMEAR_AUTO gave it */
    uint16_t flags;             /* flags of smear_path_bounds; TILE_MOVES, TILE_BLENDED; the tile's method in the end,
                                 * from TILE_METHOD on */
};

enum {
    TILE_METHOD = 10,               /* bit */
    TILE_MOVES = 0x200,             /* there are moving triangles */
    TILE_BLENDED = 0x100,           /* a blended draw is seen there, too */
    PATH_WITHOUT_MASK = (int)PATH_SUBFRAMES | (int)PATH_SPACE | TILE_BLENDED
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

struct smear_chooser {
    uint8_t method;             /* smear_method: SMEAR_SUBFRAMES, SMEAR_TIMEMASK or SMEAR_AUTO */
    int32_t samples;
    int32_t target;             /* 1/64 codes */
    smear_transfer transfer;
    bool fills;                 /* gaps between instants may be closed: the frame is not all border, the shutter a box */
};

/* What SMEAR_AUTO is asked for the tiles of a run, when their first instant is drawn. Without a chooser, instants and blocks
 * are as they are. */
struct smear_tile_plan {
    const struct smear_chooser *chooser;
    struct smear_tile_travel *travel;           /* of the first tile */
    const struct smear_row_blocks *blocks;
    const uint32_t *tiles;                      /* of the frame so far: that stand still, and others */
};

/* How much moves how far: areas of moving triangles in pixels, saturated, by classes of travel of 4 px each. The last
 * class has all longer travels. */
enum { TRAVEL_CLASSES = 32, TRAVEL_CLASS_SHIFT = 6 };   /* log2 of a class, 1/16 px */

struct smear_travel_areas {
    uint32_t area[TRAVEL_CLASSES];
};

/* Returns the finest target, from the chooser's own on, whose predicted work fits `budget`, else the coarsest; stores
 * the prediction, in pixels x instants, in *work. */
int32_t smear_tile_method_target(const struct smear_chooser *chooser, const struct smear_travel_areas *areas,
                                 uint32_t budget, uint32_t *work);

/* Chooses the method of a tile; stores how many instants TILE_SUBFRAMES has. */
enum smear_tile_method smear_tile_method_choose(const struct smear_chooser *chooser, const struct smear_tile_travel *tile,
                                                int32_t *instants);

/* Whether gaps between instants may be closed in a tile, and how they close where no moving surface is seen in the middle
 * of the exposure: along the mean displacement. */
bool smear_tile_may_close(const struct smear_chooser *chooser, const struct smear_tile_travel *tile);
struct smear_closing smear_tile_closing(const struct smear_tile_travel *tile);

/* Returns how far what is seen in a tile goes, 1/16 px, where it is not known what is: the mean displacement, or the longest one
 * where they are unlike. */
struct smear_step smear_tile_way(const struct smear_tile_travel *tile);

/* Returns how many instants the tiles of a run take: an odd number, `first`, which is odd, at least. */
int32_t smear_tile_plan_instants(const struct smear_tile_plan *plan, const struct smear_tile_run *t, const struct smear_contrast *contrast,
                                 int32_t first);

/* Returns the displacement of a tile from one instant to the next along x, 1/16 px, at most, before it is known how many
 * there will be. */
int32_t smear_tile_widest_step(const struct smear_chooser *chooser, const struct smear_tile_travel *tile);

#endif

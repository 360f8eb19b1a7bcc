/* SPDX-License-Identifier: MIT */
/* choose.h - how a tile is blurred, from what is known of it before a pixel is drawn. */
#ifndef SMEAR_CHOOSE_H
#define SMEAR_CHOOSE_H

#include "smooth.h"
#include "timemask.h"

/* The movers of a tile: all that may be seen there during the exposure. */
struct smear_tile_load {
    uint16_t travel, bend;      /* longest, 1/16 px */
    uint16_t flags;             /* of smear_path_bounds, or-ed; TILE_BLENDED */
    uint16_t count;             /* triangles */
    uint8_t method;             /* smear_tile_method it got in the end */
};

enum {
    TILE_BLENDED = 0x100,           /* a blended draw is seen there, too */
    PATH_WITHOUT_MASK = (int)PATH_SUBFRAMES | 0x100
};

enum smear_tile_method { TILE_COPY, TILE_SMOOTH, TILE_SUBFRAMES, TILE_TIMEMASK };

struct smear_tile_choice {
    enum smear_tile_method method;
    int32_t tolerance, taps;                    /* TILE_SMOOTH: if the field fits to this, q8 px */
    int32_t instants;                           /* TILE_SUBFRAMES */
    struct smear_timemask_settings timemask;    /* TILE_TIMEMASK */
};

struct smear_chooser {
    uint8_t method;             /* smear_method: SMEAR_SUBFRAMES, SMEAR_TIMEMASK or SMEAR_AUTO */
    int32_t samples;
    int32_t target;             /* 1/64 codes */
    bool has_window;            /* TILE_SMOOTH can be had */
};

static inline bool chooser_has_window(const struct smear_chooser *c) { return SMEAR_WITH_SMOOTH && c->has_window; }

/* The method of a tile. TILE_SMOOTH is a wish: where it cannot be had, ask again with a chooser without a window. */
void smear_choose(struct smear_tile_choice *choice, const struct smear_chooser *chooser,
                  const struct smear_tile_load *load);

#endif

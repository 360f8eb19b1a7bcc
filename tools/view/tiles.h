/* SPDX-License-Identifier: MIT */
/* tiles.h - what the library has done with each tile of a frame. */
#ifndef SMEAR_TOOLS_VIEW_TILES_H
#define SMEAR_TOOLS_VIEW_TILES_H

#include "tools/failure.h"

#include <smear.h>
#include <stdbool.h>
#include <stdint.h>

enum tile_kind { TILES_STILL, TILES_UNIFORM, TILES_COMPLEX, TILES_KINDS };

struct tile_note {
    uint8_t method;             /* smear_method, as in smear_stats.tiles */
    uint8_t kind;               /* enum tile_kind: how what it shows moves */
    uint16_t samples;           /* per pixel, at most: taps, instants or slots; 1: none but the frame itself */
};

struct tiles {
    int edge, columns, rows;
    int room;                   /* notes */
    struct tile_note *note;     /* row after row */
};

/* Room for a frame of this size; zeroed before first use. */
bool tiles_open(struct tiles *tiles, int width, int height, struct failure *f);
void tiles_close(struct tiles *tiles);

/* Before a frame: tiles that no band of it shows, as the display has them already, stand still. */
void tiles_begin(struct tiles *tiles);

/* The tiles of a band, while it is being flushed. */
void tiles_note(struct tiles *tiles, const smear_context *ctx, const smear_band *band);

#endif

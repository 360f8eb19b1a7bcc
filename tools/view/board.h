/* SPDX-License-Identifier: MIT */
/* board.h - devices that `--board` stands for: nothing but options of the command line. */
#ifndef SMEAR_TOOLS_VIEW_BOARD_H
#define SMEAR_TOOLS_VIEW_BOARD_H

#include <stdbool.h>
#include <stddef.h>

enum { BOARD_MAX_OPTIONS = 32 };

struct board {
    const char *name, *what;
    const char *option[BOARD_MAX_OPTIONS];      /* null ends them */
};

extern const struct board board_list[];         /* name null ends it */

/* Null when there is none of this name. */
const struct board *board_find(const char *name);

/* The value that a board gives an option; null when it gives none. All have a --size and an --arena. */
const char *board_option(const struct board *board, const char *option);

/* ------------------------------------------------------------------ the bus */

/* A panel at the end of a serial bus: how long a frame is on the wire, and what is seen of it while it is sent without regard to the
 * panel's own refresh. */

struct bus {
    double hz;                  /* bits per second; 0: the panel is memory, nothing is sent */
    double panel_hz;            /* the panel's own refresh; 0: it shows what it gets, no tearing */
    bool synced;                /* frames wait for the panel */
};

double bus_wire_us(const struct bus *bus, size_t bytes);

/* Frame number `index` is written from row 0 down to `height` within `write_us`, frames following
 * each other every frame_us, while the panel reads its rows at its own pace. Of the refresh that
 * meets the writing: the row at which it changes from one frame to the other, or `height` when it
 * sees one frame only. *old_above tells which part is still the frame before. */
int bus_tear(const struct bus *bus, long index, double frame_us, double write_us, int height,
             bool *old_above);

#endif

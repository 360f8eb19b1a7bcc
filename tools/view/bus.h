/* SPDX-License-Identifier: MIT */
/* bus.h - a panel at the end of a serial bus: how long a frame is on the wire, and what is seen of
 * it while it is sent without regard to the panel's own refresh. */
#ifndef SMEAR_TOOLS_VIEW_BUS_H
#define SMEAR_TOOLS_VIEW_BUS_H

#include <stdbool.h>
#include <stddef.h>

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

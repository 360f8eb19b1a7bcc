/* SPDX-License-Identifier: MIT */
/* bus.c - see bus.h.
 *
 * Row r is written at  start + write r / H  and read at  scan + refresh r / H. It shows the new
 * frame when it is read after it was written; both are straight lines, so they cross once. */
#include "tools/view/bus.h"

#include <math.h>

double bus_wire_us(const struct bus *bus, size_t bytes)
{
    return bus->hz > 0.0 ? (double)bytes * 8.0e6 / bus->hz : 0.0;
}

int bus_tear(const struct bus *bus, long index, double frame_us, double write_us, int height,
             bool *old_above)
{
    *old_above = false;
    if (bus->synced || !(bus->hz > 0.0) || !(bus->panel_hz > 0.0) || !(write_us > 0.0))
        return height;
    double refresh = 1e6 / bus->panel_hz, start = (double)index * frame_us, row;
    if (write_us > refresh) {
        /* slow: the first refresh that begins when half is written overtakes the writer */
        double scan = ceil((start + write_us / 2.0) / refresh) * refresh;
        row = (scan - start) / (write_us - refresh) * height;
    } else {
        /* fast: the refresh that is going on when writing starts is overtaken by the writer */
        double scan = floor(start / refresh) * refresh;
        row = write_us < refresh ? (start - scan) / (refresh - write_us) * height : height;
        *old_above = row < height;
    }
    return row < 0.0 ? 0 : row > height ? height : (int)row;
}

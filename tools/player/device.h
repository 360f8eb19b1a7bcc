/* SPDX-License-Identifier: MIT */
/* device.h - the library as a device would hold it: a block of memory, a context in it, a display
 * that takes bands, and other cores (threads) that help. */
#ifndef SMEAR_TOOLS_CLI_DEVICE_H
#define SMEAR_TOOLS_CLI_DEVICE_H

#include "tools/failure.h"
#include "tools/scenes/present.h"

#include <smear.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What stays the same from frame to frame. */
struct device_setup {
    int width, height, reach, tile;     /* reach and tile: 0 for the library's defaults */
    smear_format format;
    smear_dither dither;
    smear_doubled doubled;
    unsigned methods;                   /* SMEAR_SET(...) of what frames ask for */
    bool scatter, cache_static, keep_display;
    int threads;                        /* 1..8 */
    size_t arena;                       /* bytes there are; 0: as many as it takes */
    uint32_t max_triangles;             /* 0: enough for every frame */
    smear_inspect_fn *inspect;
    void *inspect_user;
    void (*band)(void *user, const smear_band *band);   /* sees each band; null: nobody does */
    void *band_user;
};

/* One frame in ticks of DEVICE_TICKS_PER_US. */
struct device_times {
    double submit, raster, reduce, blur, convert, total;
};
enum { DEVICE_TICKS_PER_US = 10 };

struct crew;

struct device {
    struct device_setup setup;
    smear_desc desc;
    smear_context *ctx;
    void *memory;
    size_t memory_bytes;
    struct crew *crew;                  /* the other threads; null for one thread */
    bool is_timed;                      /* bands are thrown away */
    uint32_t submit_ticks;              /* of the frame drawn last */
    int result;                         /* what the library made of it */
    int width, height;                  /* of the display: where it is doubled, not those of the setup */
    uint8_t *pixels;                    /* the frame in the display's format, row after row */
    size_t stride, size;                /* bytes; of a page of 8 rows with SMEAR_L1_PAGES */
    size_t sent;                        /* bytes of the last frame's bands: fewer where the display keeps tiles */
};

/* Smallest list of triangles a short arena is tried with. */
enum { DEVICE_MIN_TRIANGLES = 16 };

/* Allocates the display and starts the threads. device_close releases `device` in any case. */
bool device_open(struct device *device, const struct device_setup *setup, struct failure *f);
void device_close(struct device *device);

/* Makes sure that the context has room for this frame: memory grows, but not beyond the arena,
 * where the list of triangles is cut short instead. */
bool device_fit(struct device *device, const struct presented *presented, struct failure *f);

/* Of device->pixels, as smear_stats.crc32. */
uint32_t device_crc(const struct device *device);

/* Draws a frame into device->pixels. With neither an arena nor a limit of triangles, memory grows
 * until the frame is drawn in one part. */
bool device_draw(struct device *device, const struct presented *presented, struct failure *f);

/* Draws the same frame again for its times alone: nothing is copied and no CRC is taken. Where something is kept from
 * frame to frame, the times are those of the frame as it was drawn, its CRC among them. */
bool device_time(struct device *device, const struct presented *presented,
                 struct device_times *times, struct failure *f);

/* Runs a finished picture, 0x00RRGGBB, through the display's conversion into device->pixels. */
bool device_show(struct device *device, const uint32_t *picture, struct failure *f);

#endif

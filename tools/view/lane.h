/* SPDX-License-Identifier: MIT */
/* lane.h - one way of drawing the scene: options, the device that draws with them, its last
 * frame. A split screen has two. All drawing goes through what `render` uses: setup.h,
 * present.h, device.h; so equal options give equal bits. */
#ifndef SMEAR_TOOLS_VIEW_LANE_H
#define SMEAR_TOOLS_VIEW_LANE_H

#include "tools/options/setup.h"
#include "tools/view/panel.h"
#include "tools/view/tiles.h"

#include <smear.h>
#include <stdbool.h>
#include <stdint.h>

enum { LANE_MAX_BANDS = 1024 };     /* 256 rows of 8 pixels are 2048; parts of rows may be more */

struct lane_band {
    int x, y, width, height;
};

struct lane {
    struct render_options options;
    struct setup setup;
    struct device device;
    bool is_open;
    struct panel_codes codes;
    uint32_t *picture;              /* 0x00RRGGBB of the last frame, without gaps */
    smear_stats stats;              /* of the last frame */
    double wall_us;                 /* it took, posing and copying included */
    int band_count;
    struct lane_band band[LANE_MAX_BANDS];
    struct tiles tiles;
};

/* Opens the device for these options. On failure (an arena that is too small) the lane is as it was
 * before. lane_close releases it in any case; a zeroed lane is closed. A lane that has drawn must
 * stay where it is in memory. */
bool lane_open(struct lane *lane, const struct render_options *options, struct source *source,
               struct failure *f);
void lane_close(struct lane *lane);

/* When is a frame, and what belongs to it. */
struct instant {
    double time;
    long frame;                     /* -1 between frames */
    int frames_apart;               /* frames from the picture before: 1, or more on a slow board */
};

/* Draws into lane->picture. */
bool lane_draw(struct lane *lane, struct presenter *presenter, const struct instant *instant,
               struct failure *f);

/* What lane_draw presents. */
const struct presented *lane_present(const struct lane *lane, struct presenter *presenter,
                                     const struct instant *instant, struct failure *f);

#endif

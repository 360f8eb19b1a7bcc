/* SPDX-License-Identifier: MIT */
/* setup.h - from the command line to what the presenter and the library are told, frame by frame.
 * `render` and `view` both go through here, so that they draw the same bits. */
#ifndef SMEAR_TOOLS_CLI_SETUP_H
#define SMEAR_TOOLS_CLI_SETUP_H

#include "tools/player/device.h"
#include "tools/options/options.h"
#include "tools/options/source.h"

#include <stdint.h>

/* What stays the same from frame to frame. */
struct setup {
    int width, height, reach, tile;     /* pixels; tile 0: the library's default */
    struct present_options present;     /* of every frame, but for cuts */
    uint8_t *motion;                    /* per draw; or null */
    uint8_t *layers;                    /* likewise */
};

/* A status. setup_release frees `out` in any case. */
int setup_open(const struct render_options *options, struct source *source, struct setup *out);
void setup_release(struct setup *setup);

/* The same for other options (method, shutter, samples, light ...), but for --motion, which stays. */
int setup_change(const struct render_options *options, const struct source *source,
                 struct setup *setup);

/* The device that draws these frames. */
struct device_setup setup_device(const struct setup *setup, const struct render_options *options);

/* The options of frame `frame`: cuts. */
struct present_options setup_frame(const struct setup *setup, const struct render_options *options,
                                   long frame);

#endif

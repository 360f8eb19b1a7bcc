/* SPDX-License-Identifier: MIT */
/* exact.h - `--method accumulate --exact`: every instant of the exposure posed and lit by the file
 * itself, drawn sharp, and averaged in double precision. With many instants it is the truth. */
#ifndef SMEAR_TOOLS_CLI_EXACT_H
#define SMEAR_TOOLS_CLI_EXACT_H

#include "tools/player/device.h"

struct exact {
    struct device display;      /* turns the mean into the wanted format */
    int width, height, places;  /* pixels, and places within each along x and y */
    double *sum;                /* r g b of each pixel: linear light, or codes */
    uint32_t *mean;             /* 0x00RRGGBB */
};

/* `exact` is released by exact_close in any case. */
bool exact_open(struct exact *exact, int width, int height, int places, smear_format format,
                smear_dither dither, smear_doubled doubled, struct failure *f);
void exact_close(struct exact *exact);

/* The mean of `instants` (0: 8) frames at the midpoints of the exposure, in exact->display.pixels
 * afterwards. `device` draws them: sharp, XRGB8888, `places` times as wide and high. Counts add up over the instants, as in the
 * library's own accumulation. A frame that is cut has one instant. */
bool exact_draw(struct exact *exact, struct presenter *presenter, struct device *device,
                double time, const struct present_options *options, int instants,
                smear_stats *counts, struct failure *f);

/* What the library takes for the instants' drawing, posing excluded. */
bool exact_time(struct presenter *presenter, struct device *device, double time,
                const struct present_options *options, int instants, struct device_times *times,
                struct failure *f);

#endif

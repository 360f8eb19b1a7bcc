/* SPDX-License-Identifier: MIT */
/* exact.h - the mean of sharp frames, SMEAR_NONE, at the midpoints of the exposure, each posed and lit by the file itself, of linear
 * light or codes, as options->light says, in double precision: what `--method accumulate --exact` draws. With many instants it is the
 * truth. */
#ifndef SMEAR_TOOLS_CLI_EXACT_H
#define SMEAR_TOOLS_CLI_EXACT_H

#include "tools/player/device.h"

struct exact {
    struct device display;      /* turns the mean into the wanted format */
    int width, height, places;  /* pixels, and places within each along x and y */
    double *sum;                /* r g b of each pixel: linear light, or codes */
    uint32_t *mean;             /* 0x00RRGGBB */
};

/* Returns how many places within a pixel are looked at along x and y: with smooth edges 16, or as many as a frame can have;
 * else one. */
int exact_places(const struct present_options *options, int width, int height);

/* The mean of `instants` frames, not rounded: red, green and blue of each pixel, linear light or codes / 255. */
bool exact_mean(struct presenter *presenter, double time, const struct present_options *options, int width, int height, int instants,
                double *mean, struct failure *f);

/* The same, rounded. *out is allocated here, and empty on failure. */
bool exact_picture(struct presenter *presenter, double time, const struct present_options *options, int width, int height,
                   int instants, struct image *out, struct failure *f);

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

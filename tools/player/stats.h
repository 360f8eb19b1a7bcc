/* SPDX-License-Identifier: MIT */
/* stats.h - the statistics of `smear render --stats`, as JSON. */
#ifndef SMEAR_TOOLS_CLI_STATS_H
#define SMEAR_TOOLS_CLI_STATS_H

#include "tools/image/file.h"
#include "tools/player/device.h"

#include <smear.h>
#include <stdbool.h>
#include <stdio.h>

struct frame_report {
    long frame;
    double time;                /* seconds */
    smear_stats counts;
    struct device_times times;  /* ticks */
};

/* The middle value per stage (of an even number, the mean of the two in the middle). Sorts `times`
 * through the spare array of `count` doubles. */
struct device_times stats_median(const struct device_times *times, double *spare, int count);

struct stats_file {
    struct output file;         /* stream null: nobody wants statistics */
    long frames;
};

/* `-` is standard output. */
bool stats_open(struct stats_file *s, const char *path, struct failure *f);
void stats_add(struct stats_file *s, const struct frame_report *report);
bool stats_end(struct stats_file *s, struct failure *f);
/* Leaves no unfinished file; harmless after stats_end and on a zeroed struct. */
void stats_cancel(struct stats_file *s);

#endif

/* SPDX-License-Identifier: MIT */
/* options_filter.h - options of `smear render` that belong to filters and to the shutter: one function each, for the table
 * of options.c. */
#ifndef SMEAR_TOOLS_CLI_OPTIONS_FILTER_H
#define SMEAR_TOOLS_CLI_OPTIONS_FILTER_H

#include "tools/options/arguments.h"
#include "tools/options/options.h"

option_read_fn read_inside, read_camera_step, read_pingpong, read_weights, read_scatter, read_scale, read_shutter,
    read_shutter_mode;

/* The shutter in degrees of the frame time: what --shutter and --shutter-mode ask for at this rate. At least half a degree
 * (so that there is one) and at most 3600, unless it is 0. */
double shutter_degrees_at(const struct render_options *options, double fps);

/* What contradicts each other. A status. */
int check_filter(const struct render_options *options);

#endif

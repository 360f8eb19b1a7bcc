/* SPDX-License-Identifier: MIT */
/* options_filter.h - values of `smear render` that have a form of their own, and belong to filters and to the shutter: for
 * the table of options.c. */
#ifndef SMEAR_TOOLS_CLI_OPTIONS_FILTER_H
#define SMEAR_TOOLS_CLI_OPTIONS_FILTER_H

#include "tools/options/arguments.h"
#include "tools/options/options.h"

option_read_fn read_pingpong, read_scale, read_shutter, read_shutter_mode;

/* The shutter in degrees of the frame time: what --shutter and --shutter-mode ask for at this rate. At least half a degree
 * (so that there is one) and at most 3600, unless it is 0. */
double shutter_degrees_at(const struct render_options *options, double fps);

/* What contradicts each other. A status. */
int check_filter(const struct render_options *options);

#endif

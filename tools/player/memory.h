/* SPDX-License-Identifier: MIT */
/* memory.h - what a frame costs a device in bytes. */
#ifndef SMEAR_TOOLS_CLI_MEMORY_H
#define SMEAR_TOOLS_CLI_MEMORY_H

#include "tools/scenes/present.h"

#include <stddef.h>
#include <stdint.h>

/* How a device may be set up, in the order in which they are shown. */
enum memory_setup { MEMORY_AUTO, MEMORY_AUTO_SHARP, MEMORY_RECONSTRUCT, MEMORY_NONE, MEMORY_SETUPS };

struct memory_need {
    int reach, tile;            /* pixels */
    uint32_t draws, triangles;  /* room for them */
    uint32_t triangles_drawn;
    size_t total;               /* bytes, as smear_memory_size() */
    size_t window, bands, draw_bytes, triangle_bytes, rest;     /* parts of it */
};

/* For RGB565, one band, one core and the default reach: with the smallest list of triangles that
 * draws the frame in one part. `work`, 0 at first, adds up what is drawn for it: there is a limit to that of all
 * measurements of a command. */
bool memory_measure(const struct presented *presented, int width, int height,
                    enum memory_setup setup, struct memory_need *need, double *work, struct failure *f);

#endif

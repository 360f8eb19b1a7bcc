/* SPDX-License-Identifier: MIT */
/* memory.h - what a frame costs a device in bytes. */
#ifndef SMEAR_TOOLS_CLI_MEMORY_H
#define SMEAR_TOOLS_CLI_MEMORY_H

#include "../scenes/present.h"

#include <stddef.h>
#include <stdint.h>

struct memory_need {
    int reach, tile;            /* pixels */
    uint32_t draws, triangles;  /* room for them */
    uint32_t triangles_drawn;
    size_t total;               /* bytes, as smear_memory_size() */
    size_t window, band, draw_bytes, triangle_bytes, rest;  /* parts of it */
};

/* For RGB565, one band, one core and the default reach: with the smallest list of triangles that
 * draws the frame in one part. */
bool memory_measure(const struct presented *presented, int width, int height,
                    struct memory_need *need, struct failure *f);

#endif

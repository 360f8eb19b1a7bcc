/* SPDX-License-Identifier: MIT */
/* lines.h - the still scene of a frame whose camera moves: drawn once, in the middle of the exposure, or twice, a quarter from its
 * ends, and blurred along the line on which the camera's motion takes each block of pixels until the next picture.
 *
 * The plain form of [GPUGems3] chapter 27: what a block's depth and two cameras say holds for the whole block, and its taps
 * weigh alike. Nothing is done per vertex. The window keeps the rows that lines reach. */
#ifndef SMEAR_LINES_H
#define SMEAR_LINES_H

#include "geometry/reproject.h"
#include "geometry/shot.h"
#include "raster/window.h"

struct smear_lines {
    bool on;                        /* in this frame */
    bool linear;
    uint8_t pictures;               /* of what stands still, at even instants: 1 or 2, whose mean is blurred */
    uint8_t picture;                /* that is assembled, of those */
    struct smear_instant instant[2];
    struct smear_flow flow;         /* how what stands still moves on the screen */
    uint32_t *row;                  /* pixels of a tile row: of the second picture, then blurred ones */
    uint16_t *depth;                /* of the second picture, then of the blurred one: planes of a target are alike */
    uint32_t opaque;                /* its list of the row */
};

/* Begins a frame whose camera moves, of so many pictures. */
void smear_lines_begin(struct smear_lines *lines, const struct smear_shot *shot, const struct smear_window *w, int pictures, bool linear);

/* Makes columns [x0, x1) of row y of the window the mean of both pictures'. */
void smear_lines_mix(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y);

/* Copies the depth of columns [x0, x1) of row y of the window to lines->depth. */
void smear_lines_take_depth(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y);

/* Blurs columns [x0, x1) of pixel rows [y0, y1) of a tile row into lines->row; x0 and y0 are multiples of 8. `end`: rows of the
 * frame up to it have been drawn; those from its height on have no pixels. */
void smear_lines_blur(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1,
                      int32_t end);

#endif

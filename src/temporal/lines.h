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
    uint32_t opaque;                /* its list of the row; of one picture, that of movers (line_movers.h), of which there are: */
    uint16_t movers;
    bool takes_movers;
    uint8_t *kind;                  /* of each draw: enum smear_line_kind */
    struct smear_flow *own;         /* of each draw that has one */
    struct smear_line_block *block; /* of the tile row */
    uint32_t *over;                 /* its pixels, blurred ones with movers over them */
};

/* How a draw goes: with what stands still or drawn at instants, or it is a mover, which stays where it is on the screen or not. */
enum smear_line_kind { LINE_GOES_ALONG, LINE_IS_STILL, LINE_MOVES };

static inline bool line_is_mover(const struct smear_lines *lines, uint32_t draw) { return lines->kind[draw] != LINE_GOES_ALONG; }

/* Pixels that share a displacement are so many wide and high. */
enum { LINE_BLOCK_LOG2 = 3, LINE_BLOCK = 1 << LINE_BLOCK_LOG2 };

/* How movers pass a block. */
struct smear_line_block {
    int16_t x, y;                   /* displacement, px */
    uint16_t depth;                 /* the nearest of what they show there; 1: nothing, 0: it is not known */
    uint16_t mover;                 /* the number of the draw that goes so, from 1 on */
};

static inline int32_t line_blocks(int32_t pixels) { return (pixels + LINE_BLOCK - 1) >> LINE_BLOCK_LOG2; }

/* Begins a frame whose camera moves, of so many pictures. */
void smear_lines_begin(struct smear_lines *lines, const struct smear_shot *shot, const struct smear_window *w, int pictures, bool linear);

/* Makes the flow of what stands still before three cameras, those of the shot's poses. */
void smear_lines_make_flow(struct smear_flow *flow, const struct smear_shot *shot, const struct smear_window *w,
                           const smear_camera camera[3]);

/* Finds the displacement from picture to picture of what is seen at a pixel, in whole pixels (q8), so that blocks beside each other
 * often have the same, and no longer along y than lines reach. */
void smear_lines_displacement(int32_t out[2], const struct smear_lines *lines, const struct smear_flow *flow, const struct smear_window *w,
                              int32_t x, int32_t y, uint32_t depth);

/* Blurs the blocks of columns [x0, x1) of a row of them along a displacement. Where taps of a block would lie beside the frame, or
 * beyond its rows [first, end), it takes what is inside. */
void smear_lines_blur_blocks(const struct smear_lines *lines, const struct smear_window *w, const int32_t d[2], int32_t x0, int32_t x1,
                             int32_t y0, int32_t y1, int32_t first, int32_t end);

/* Makes columns [x0, x1) of row y of the window the mean of both pictures'. */
void smear_lines_mix(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y);

/* Copies the depth of columns [x0, x1) of row y of the window to lines->depth. */
void smear_lines_take_depth(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y);

/* Blurs columns [x0, x1) of pixel rows [y0, y1) of a tile row into lines->row; x0 and y0 are multiples of 8. `end`: rows of the
 * frame up to it have been drawn; those from its height on have no pixels. */
void smear_lines_blur(const struct smear_lines *lines, const struct smear_window *w, int32_t x0, int32_t x1, int32_t y0, int32_t y1,
                      int32_t end);

#endif

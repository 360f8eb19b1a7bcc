/* SPDX-License-Identifier: MIT */
/* line_movers.h - what moves by itself before a camera that moves: drawn once or twice over what lines have blurred, and blurred, with
 * what is around it, along the line on which its draw takes each block of pixels until the next picture. */
#ifndef SMEAR_LINE_MOVERS_H
#define SMEAR_LINE_MOVERS_H

#include "geometry/bins.h"
#include "geometry/pose.h"
#include "temporal/lines.h"

/* Looks how a draw goes that moves by itself, and finds its flow, as if its axes were at right angles. True where it goes along with
 * what stands still, or is one of the movers; false where it is to be drawn at several instants, as it turns or deforms. */
bool smear_movers_take(struct smear_lines *lines, struct smear_draw_poses *p, const struct smear_shot *shot, const struct smear_window *w,
                       const smear_mesh *mesh, uint32_t draw);

/* Begins a tile row, and its next picture. */
void smear_movers_begin(const struct smear_lines *lines, const struct smear_window *w);
void smear_movers_next(const struct smear_lines *lines, const struct smear_window *w);

/* Finds the blocks of pixel rows [y0, y1), a tile row, in which movers of a list go: they are what lines->depth has before what stands
 * still. */
void smear_movers_find(const struct smear_lines *lines, const struct smear_bins *g, const struct smear_window *w, uint32_t head, int32_t y0,
                       int32_t y1);

/* Blurs them, and those beside them as far as movers go, in lines->row; lines->over has what it was. */
void smear_movers_blur(const struct smear_lines *lines, const struct smear_window *w, int32_t y0, int32_t y1);

#endif

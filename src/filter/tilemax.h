/* SPDX-License-Identifier: MIT */
/* tilemax.h - the longest velocity of a tile, then of its neighbourhood, and what kind of tile that makes. */
#ifndef SMEAR_TILEMAX_H
#define SMEAR_TILEMAX_H

#include "raster/window.h"

/* Reduces the velocities of tile `column` of tile row `row`. */
void smear_tilemax(const struct smear_window *w, int32_t row, int32_t column);

/* Finds the 3 x 3 neighbourhood of every tile in `row`, where rows up to `known` have been reduced: the row being
 * finished knows all three, the one below it is looked at with two. With `corner`, a diagonal neighbour counts only if
 * its motion points along the diagonal [Guertin14]. Where the reach exceeds a tile, all tiles within it count whose
 * motion leads here. */
void smear_neighbormax_row(const struct smear_window *w, int32_t row, int32_t known, bool corner);

#endif

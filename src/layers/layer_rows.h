/* SPDX-License-Identifier: MIT */
/* layer_rows.h - tile rows with blurred layers over the still scene. */
#ifndef SMEAR_LAYER_ROWS_H
#define SMEAR_LAYER_ROWS_H

#include "display/band.h"

/* Before the draws of a frame are looked at. */
void smear_layers_begin(struct smear_context *c);

/* A draw of a blurred layer: finds its displacement from its places at shutter open and close. One that does
 * not move on the screen stays with the still scene, but for those of layers that lie over it. */
void smear_layers_add(struct smear_context *c, uint32_t draw, const struct smear_placement key[2],
                      const struct smear_placement *middle, bool moves);

/* After the last draw. */
void smear_layers_end(struct smear_context *c);

/* Assembles a draw of a group among the moving triangles. */
bool smear_layers_assemble(struct smear_context *c, const struct smear_assembly *a, bool drop);

/* Draws and finishes the tile rows [first, end), a part of the frame that has been assembled. Returns as
 * smear_band_flush. */
int smear_layers_rows(struct smear_context *c, int first, int end);

#endif

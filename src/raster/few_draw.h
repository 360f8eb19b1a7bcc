/* SPDX-License-Identifier: MIT */
/* few_draw.h - textured triangles of few pixels that perspective hardly bends: depth, coordinates and light are planes, which cost a
 * few products each. */
#ifndef SMEAR_FEW_DRAW_H
#define SMEAR_FEW_DRAW_H

#include "kernels/few_rows.h"
#include "raster/setup.h"

/* What such triangles of a segment have in common. With turns, coordinates are turns q32, and a texel is number
 * v >> from_v & mask_v | u >> from_u; else they are mesh units q15. */
struct few_look {
    const struct smear_raster_frame *frame;
    const struct smear_segment *segment;
    const struct smear_raster_draw *draw;
    const void *texels;
    enum few_kind kind;
    bool turns;
    uint8_t up;                     /* from mesh units q15 to coordinates */
    uint8_t from_u, from_v;
    uint32_t mask_v;
    uint32_t width, height;         /* of the texture */
    struct few_texels rows;         /* with turns, of kinds with a loop of their own */
};

/* False where a segment's triangles are others: blended, or with motions of their own. */
bool smear_few_take(struct few_look *l, const struct smear_raster_frame *frame, const struct smear_raster_target *t,
                    const struct smear_segment *segment, const struct smear_raster_draw *draw);

/* Finds out whether a triangle of this colour is such a one, and draws it: with `setup` (or null) in its fog, and with a velocity where it
 * writes some. False where it is not. */
bool smear_few_draw(const struct few_look *l, const struct smear_raster_target *t, const int32_t *const v[3], uint32_t color,
                    const struct setup *setup);

#endif

/* SPDX-License-Identifier: MIT */
/* fog.h - what is asked of fog/: how much of the fog's colour a surface takes at its depth, and the colours of triangles in fog.
 *
 * Fog grows evenly with the distance along the view. A depth tells the distance, so no vertex keeps anything for it: where
 * fog hardly changes within a triangle, the triangle has one part of it, which for one colour costs nothing per pixel; in
 * others the part is exact at the ends of blocks of pixels, and goes evenly between. */
#ifndef SMEAR_FOG_H
#define SMEAR_FOG_H

#include "raster/setup.h"

/* Makes what a frame's raster needs: `camera` has its far plane where fog ends, or nearer. Null: no fog. */
void smear_fog_make(struct smear_raster_frame *frame, const smear_fog *fog, const smear_camera *camera);

/* The part of fog at depth units q11, 0 .. 65536. */
int32_t smear_fog_part(const struct smear_fog_levels *fog, int32_t units);

/* A working pixel in so much of fog. */
static inline uint32_t fog_pixel(const struct smear_raster_frame *frame, uint32_t pixel, int32_t part)
{
    return frame_mix(frame, pixel, frame_fog(frame)->color, part);
}

/* Finds out what fog does to a triangle whose vertices and colour are known; a single colour becomes that in fog. */
void smear_fog_triangle(struct setup *s);

/* Chooses the length of its blocks, once its plane of depth is known. */
void smear_fog_blocks(struct setup *s);

/* The part of fog of a triangle with FOG_EVEN. */
static inline int32_t fog_even_part(const struct setup *s) { return (s->fog - FOG_EVEN) * 4; }

/* A channel, 0 .. 2, as channel_value has it, in so much of fog. */
static inline int32_t fog_channel(const struct smear_raster_frame *frame, int32_t value, int channel, int32_t part)
{
    const uint32_t code = frame_fog(frame)->color >> (16 - 8 * channel) & 255u;
    return value + (((channel_value_of_code(frame, code) - value) >> 9) * part >> 7);
}

/* The colour of an opaque triangle without a texture that is the same in a row from left to right of the frame. */
uint32_t smear_fog_row_color(const struct setup *s, int32_t left, int32_t right, int32_t y);

/* The steps of channels from one end of a block of n > 0 pixels to the other. In fog, where codes hardly change, they have none, and
 * `from` becomes the mean: one colour is drawn faster. */
void smear_fog_steps(int32_t step[3], int32_t from[3], const int32_t to[3], int32_t n, const struct smear_raster_frame *frame);

/* Whether a triangle that is textured or not opaque has one part of fog in each row. */
static inline bool fog_is_by_rows(const struct setup *s) { return s->fog - FOG_VARIES == FOG_LEVEL; }

/* Whether an opaque triangle without a texture has one colour in a row of the frame. */
static inline bool fog_row_is_even(const struct setup *s, int32_t left, int32_t right)
{
    return fog_varies(s) && (right - left <= s->fog - FOG_VARIES || s->fog - FOG_VARIES == FOG_LEVEL);
}

/* The part of fog of pixels that begin at `start` and end n later, of a row from left to right of the frame, of a triangle
 * that is textured or not opaque: in the middle of the row or, in longer ones, of the block. */
int32_t smear_fog_run_part(const struct setup *s, int32_t left, int32_t right, int32_t start, int32_t n, int32_t y);

#endif

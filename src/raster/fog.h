/* SPDX-License-Identifier: MIT */
/* fog.h - how much of the fog's colour a surface takes at its depth, and the colours of triangles in fog.
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

/* A working pixel in so much of fog; its alpha stays. Dark pixels in linear light show less than a 256th of it. */
static inline uint32_t fog_pixel(const struct smear_raster_frame *frame, uint32_t pixel, int32_t part)
{
    const uint32_t fog = frame_fog(frame)->color, a = (uint32_t)part, b = 65536u - a;
    if (!frame_is_linear(frame))
        return (pixel & 0xff000000u) | pixel_mix(pixel, fog, (a + 128u) >> 8);
    uint32_t out = pixel >> 24;
    for (int shift = 16; shift >= 0; shift -= 8)
        out = out << 8 | smear_srgb_encode[(smear_srgb_decode[fog >> shift & 255u] * a
                                            + smear_srgb_decode[pixel >> shift & 255u] * b) >> 20];
    return out;
}

/* The part of fog that is near enough for all depths from low to high, units q11, of a colour or, where that is null, of
 * any; -1: none is. */
int32_t smear_fog_between(const struct smear_raster_frame *frame, int32_t low, int32_t high, const uint32_t *color);

/* Finds out what fog does to a triangle whose vertices and colour are known; a single colour becomes that in fog. */
void smear_fog_triangle(struct setup *s);

/* Chooses the length of its blocks, once its plane of depth is known. */
void smear_fog_blocks(struct setup *s);

/* The part of fog of a triangle with FOG_EVEN, in steps of 4. */
static inline int32_t fog_even_part(const struct setup *s) { return (s->fog - FOG_EVEN) * 4; }

/* Red, green and blue (q16, as channel_value has them) of an opaque triangle without a texture at a pixel, in fog. */
void smear_fog_channels(int32_t c[3], const struct setup *s, int32_t x, int32_t y);

/* Changes n pixels from x on of a block [start, end] of row y to those in fog. */
void smear_fog_pixels(uint32_t *pixel, const struct setup *s, int32_t x, int32_t n, int32_t start, int32_t end, int32_t y);

#endif

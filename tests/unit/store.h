/* SPDX-License-Identifier: MIT */
/* store.h - a store of triangles made by hand, as geometry would leave it: what the suites of raster, sub-frames and the
 * time mask draw. Needs neither libc nor floating point. */
#ifndef SMEAR_TESTS_STORE_H
#define SMEAR_TESTS_STORE_H

#include "geometry/path.h"
#include "raster/raster.h"

enum { STORE_SEGMENTS = 10 };

extern uint32_t *pool;                                  /* the words that store_begin() was given */
extern struct smear_bins geometry;
extern struct smear_segment segment[STORE_SEGMENTS];
extern struct smear_raster_draw draw[STORE_SEGMENTS];
extern struct smear_raster_frame frame;
extern struct smear_shutter_times shutter;              /* open evenly */

/* Empties the store. Segment i belongs to draw i and is flat, opaque and without motion unless a test says otherwise
 * (set_layout). All share one base, so offsets mean the same in each. */
void store_begin(uint32_t *words, uint32_t count, int segments, int32_t width, int32_t height, bool linear);

/* Lays out the vertices of a segment: what they carry beside their place. `moves`: displacements of so many poses. */
void set_layout(int at, bool uv, bool color, int moves, enum smear_shade_mode shade);

/* As set_layout(), with the places of a path if `path`. */
void set_path_layout(int at, bool uv, bool color, bool path, enum smear_shade_mode shade);

/* A new vertex of a segment, zero; returns its offset in the pool. */
uint16_t store_vertex(int at);

/* Appends a triangle to a list that begins empty, with head and last SMEAR_NO_TRIANGLE. */
void link_in(uint32_t *head, uint32_t *last, uint32_t triangle);

/* Positive on the inner side of the edge a -> b of a triangle that is clockwise on the screen; q8 px, q16 result. */
int64_t edge_value(const int32_t *a, const int32_t *b, int32_t x, int32_t y);

#endif

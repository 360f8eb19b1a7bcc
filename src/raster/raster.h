/* SPDX-License-Identifier: MIT */
/* raster.h - a list of triangles into rows of colour, depth and velocity. */
#ifndef SMEAR_RASTER_H
#define SMEAR_RASTER_H

#include "kernels/tiny8.h"
#include "raster/target.h"

/* Cuts memory (8-byte aligned) into caches of one size for `count` targets beside each other, for triangles of the
 * geometry's segments; they are empty. Returns the first; and which is that of target i. */
struct smear_raster_cache smear_raster_cache_make(void *memory, size_t bytes, int count, const struct smear_bins *bins);
struct smear_raster_cache smear_raster_cache_of(const struct smear_raster_cache *first, int i);

/* Draws the list that starts with triangle `head`, in order. */
void smear_raster_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                       uint32_t head);

/* Draws these triangles of a list, which other rows' lists may have meanwhile. */
void smear_raster_numbers(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                          const uint32_t *number, uint32_t count);

/* Draws one triangle whose vertices are given, and their box: records laid out as in the segment, clockwise
 * on the screen, of positive area and within the guard band. No velocities. */
void smear_raster_triangle(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                           const struct smear_segment *segment, uint32_t color, const int32_t *const v[3],
                           const struct bounds *bounds);

#if SMEAR_AVX2
/* Moves a list on to a tile row like smear_bins_advance(), where targets are rows of the frame's finished pixels, drawn one after
 * the other with this cache (kept_list.c): triangles that are kept there may be taken out of the list, and are drawn with it all
 * the same. The other one puts them back, before other targets come. */
uint32_t smear_raster_advance(const struct smear_raster_frame *frame, const struct smear_raster_cache *cache, const uint32_t *last,
                              uint32_t head, int row);
uint32_t smear_raster_rejoin(const struct smear_raster_frame *frame, const struct smear_raster_cache *cache, uint32_t head);

/* Tells what triangles of a segment have in common, so that tiny ones are drawn eight at once; false where they are not. */
bool smear_raster_look(struct tiny8_look *look, const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                       const struct smear_segment *segment);
#endif

#endif

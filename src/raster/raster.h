/* SPDX-License-Identifier: MIT */
/* raster.h - a list of triangles into rows of colour, depth and velocity. */
#ifndef SMEAR_RASTER_H
#define SMEAR_RASTER_H

#include "raster/few_draw.h"
#include "raster/tiny_draw.h"

/* Cuts memory (8-byte aligned) into caches of one size for `count` targets beside each other, for triangles of the
 * geometry's segments; they are empty. Returns the first; and which is that of target i. */
struct smear_raster_cache smear_raster_cache_make(void *memory, size_t bytes, int count, const struct smear_bins *bins);
struct smear_raster_cache smear_raster_cache_of(const struct smear_raster_cache *first, int i);

/* Draws the list that starts with triangle `head`, in order. */
void smear_raster_list(const struct smear_raster_frame *frame, const struct smear_raster_target *target, uint32_t head);

/* What else is done meanwhile: before every sixteenth triangle. */
struct smear_between {
    void (*call)(void *argument);
    void *argument;
};

static inline void between_triangles(const struct smear_between *b, uint32_t i)
{
    if (SMEAR_POOL_PARTS && b != NULL && (i & 15u) == 0)
        b->call(b->argument);
}

/* Draws these triangles of a list, which other rows' lists may have meanwhile. */
void smear_raster_numbers(const struct smear_raster_frame *frame, const struct smear_raster_target *target,
                          const uint32_t *number, uint32_t count, const struct smear_between *between);

/* What draws triangles of a target one after the other, and what those of the last one's segment have in common. */
struct smear_raster_pass {
    const struct smear_raster_frame *frame;
    const struct smear_raster_target *target;
    const struct smear_segment *segment;    /* or null */
    bool boxed;             /* those of few pixels are drawn by smear_tiny_draw */
    bool plain;             /* their pixels say nothing but colour and depth, without fog */
    bool flat;              /* and the others by smear_flat_triangle */
    bool shadow;            /* all are drawn by smear_flat_shadow */
    bool tiny;              /* the last one had few pixels */
    bool textured;          /* those of few pixels are drawn by smear_few_draw, */
    bool few;               /* before anything else is looked at: without velocity, fog and levels */
    bool moved;             /* one that moves has been drawn */
    bool whole;             /* the target has all columns of the frame */
    bool keeps;             /* and not all of its rows: what goes on below is kept */
    bool goes_on;           /* what is kept of triangles of the segment may go on here */
    struct tiny_look box;
    struct few_look texels;
};

void smear_raster_begin(struct smear_raster_pass *p, const struct smear_raster_frame *frame, const struct smear_raster_target *target);

/* Draws a triangle whose vertices are given, and their box: records laid out as in the segment, clockwise on the screen, of positive
 * area and within the guard band. No velocities. */
void smear_raster_triangle(struct smear_raster_pass *p, const struct smear_segment *segment, uint32_t color, const int32_t *const v[3],
                           const struct bounds *bounds);

#endif

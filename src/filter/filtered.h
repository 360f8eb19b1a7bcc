/* SPDX-License-Identifier: MIT */
/* filtered.h - tile rows of methods that filter the rolling window.
 *
 * To add such a method: its tile function in filter/, a line in filter_tile (filtered.c), its name in smear.h. */
#ifndef SMEAR_FILTERED_H
#define SMEAR_FILTERED_H

#include "base/base.h"
#include "display/row.h"
#include "filter/filter.h"

struct smear_filtered {
    const struct smear_window *window;      /* the one that is read: the frame's, or that of half its size */
    struct smear_window *half;              /* null: there is none */
    uint32_t *half_scratch;                 /* finished pixels of its tile per worker */
    uint32_t *row_offset;                   /* of the window rows a filter may read */
    struct smear_blur_settings blur;
    uint8_t method;                         /* smear_method */
    uint8_t kind;                           /* smear_filter_kind */
    int32_t row;                            /* rows taken by smear_filter_row */
    /* Velocities of what does not move itself, from depth and two cameras, where raster.velocity_from_depth. */
    struct smear_reprojection reprojection;
    int32_t camera_step;                    /* smear_filter.camera_step */
    union {
        struct smear_flow flow;             /* of `lines` */
        struct smear_pass pass[PINGPONG_PASSES_MAX];
    } plan;
    int passes;
    uint32_t *pass_plane[PINGPONG_PASSES_MAX - 1];      /* what each but the last leaves: planes like the window's */
    int32_t pass_end[PINGPONG_PASSES_MAX - 1];          /* rows done of this frame */
};

/* Lays out velocities of `pixels` pixels, in as many bits as the reach takes. */
void smear_velocity_lay_out(int8_t **velocity8, int16_t **velocity16, struct smear_arena *a, size_t pixels, int32_t reach);

/* One step of the rolling window: tile row `row` has been drawn; row - 1 has a neighbour on both sides now.
 *
 *      row - 2    row - 1    row         the oldest is overwritten next
 *      drawn      drawn      drawn       colour, depth, velocity: the filter only reads them
 *                 filtered -> band -> flush
 *
 * Invariant: a filter reaches at most one tile, and the ring keeps `reach` rows of row - 2 (desc validation checks
 * it). Where it reaches farther, a row is finished as many rows later. Returns as smear_band_flush. */
int smear_filtered_roll(struct smear_filtered *f, struct smear_rows *rows, int row);

#endif

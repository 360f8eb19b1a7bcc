/* SPDX-License-Identifier: MIT */
/* filtered.h - tile rows of methods that filter the rolling window.
 *
 * To add such a method: its tile function in filter/, a line in filter_tile (filtered.c), its name in smear.h. */
#ifndef SMEAR_FILTERED_H
#define SMEAR_FILTERED_H

#include "methods/sharp.h"
#include "ports/pingpong.h"

/* What the filters of other systems need beyond the window. */
struct smear_ports {
    struct smear_depth_velocity by_depth;               /* where raster.velocity_from_depth */
    struct smear_pass pass[PINGPONG_PASSES_MAX];
    int passes;
    uint32_t *pass_plane[PINGPONG_PASSES_MAX - 1];      /* what each but the last leaves: planes like the window's */
    int32_t pass_end[PINGPONG_PASSES_MAX - 1];          /* rows done of this frame */
};

struct smear_filtered {
    const struct smear_window *window;      /* the one that is read: the frame's, or that of half its size */
    struct smear_window *half;              /* null: there is none */
    uint32_t *half_scratch;                 /* finished pixels of its tile per worker */
    uint32_t *row_offset;                   /* of the window rows a filter may read */
    struct smear_ports *ports;              /* null: there is no window */
    struct smear_blur_settings blur;
    uint8_t method;                         /* smear_method */
    uint8_t kind;                           /* smear_filter_kind */
};

/* Gets ready for a frame whose defaults are filled in. */
void smear_filtered_begin(struct smear_filtered *f, const struct smear_rows *rows, const smear_frame *frame,
                          const smear_camera *camera);

/* One step of the rolling window: tile row `row` has been drawn; row - 1 has a neighbour on both sides now.
 *
 *      row - 2    row - 1    row         the oldest is overwritten next
 *      drawn      drawn      drawn       colour, depth, velocity: the filter only reads them
 *                 filtered -> band -> flush
 *
 * Invariant: a filter reaches at most one tile, and the ring keeps `reach` rows of row - 2 (desc validation checks
 * it). Where it reaches farther, a row is finished as many rows later. Returns as smear_band_flush. */
int smear_filtered_roll(struct smear_filtered *f, struct smear_rows *rows, int row);

/* Draws the tile rows [first, end), a part of the frame that has been assembled, and rolls on. */
int smear_filtered_rows(struct smear_filtered *f, struct smear_rows *rows, int first, int end);

/* Takes a row of pixels that another renderer drew: row y of the frame, as smear_filter_row says. */
void smear_filtered_take_row(struct smear_rows *rows, int32_t y, const uint32_t *color, const uint32_t *depth,
                             const int16_t *velocity, int32_t near_plane);

#endif

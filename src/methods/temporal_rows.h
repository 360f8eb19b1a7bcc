/* SPDX-License-Identifier: MIT */
/* temporal_rows.h - what the rows of temporal methods share, drawn along lines or not. */
#ifndef SMEAR_TEMPORAL_ROWS_H
#define SMEAR_TEMPORAL_ROWS_H

#include "methods/temporal.h"

/* What the jobs of a run of tiles of a row share. */
struct smear_finish {
    struct row_job row;
    struct smear_temporal *self;
    struct smear_raster_target background;      /* what is static, drawn */
};

/* Draws the share of a job of what does not move. */
void smear_background_job(void *argument, int job, int worker);

/* Draws what does not move of tiles beside each other, and finds where it is. */
void smear_draw_run(struct smear_temporal *self, struct smear_finish *f);

/* Finishes and hands out tiles [first, last) beside each other whose background is known. */
int smear_finish_run(struct smear_temporal *self, struct smear_finish *f, const struct smear_damage_run *run);

/* Begin and end to finish a row. */
void smear_temporal_begin_row(struct smear_temporal *self, struct smear_rows *rows, int row);
void smear_temporal_end_row(struct smear_temporal *self, const struct smear_rows *rows);

/* Draws a row along lines and finishes the one above it, and the last itself. Where it takes more pictures than it has it becomes
 * *end, to be drawn again. */
int smear_draw_along_lines(struct smear_temporal *self, struct smear_rows *rows, int row, int *end);
#if !SMEAR_WITH_LINES
#define smear_draw_along_lines(self, rows, row, end) SMEAR_OK
#endif

#endif

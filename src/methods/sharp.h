/* SPDX-License-Identifier: MIT */
/* sharp.h - tile rows of the sharp instant, which other methods build on. */
#ifndef SMEAR_SHARP_H
#define SMEAR_SHARP_H

#include "display/damage.h"
#include "display/row.h"

/* A job that draws opaque triangles of a row, or of columns of it, into the window: colour and depth. */
void smear_sharp_draw_job(void *argument, int job, int worker);

/* Draws opaque triangles of the job's tile row into the window: colour and depth. */
void smear_sharp_draw_row(struct row_job *job);

/* What comes before it and after it, where another method draws a row: the lists move on, nothing in it moves; and
 * desc.debug.inspect looks at it. */
void smear_sharp_advance_lists(struct smear_rows *rows, int row);
void smear_sharp_inspect_row(const struct smear_rows *rows, int row);

/* Draws, converts and hands out the tile rows [first, end), a part of the frame that has been assembled. `direct`: as
 * the display's own pixels, straight into the band. Of frames that `damage` compares, tiles that the display lacks, by way of the
 * window. Returns as smear_band_flush. */
int smear_sharp_rows(struct smear_rows *rows, struct smear_damage *damage, bool direct, int first, int end);

/* Is asked of damage/: draws of tile rows [first, end) what the display lacks. */
int smear_damage_rows(struct smear_rows *rows, struct smear_damage *damage, int first, int end);

/* Are asked of workers/: return the bytes by which so many cores draw rows of so many pixels apart from each other; and draw, convert and
 * hand out the tile rows [first, end) so. False, and nothing is done, where that does not pay or finds no room. */
size_t smear_workers_rows_bytes(size_t workers, size_t pixels);
bool smear_workers_rows(struct smear_rows *rows, int first, int end, int *result);

/* Whether frames of the context can be drawn directly; draws may still forbid it. */
bool smear_sharp_may_be_direct(const smear_desc *desc, bool has_window);

#endif

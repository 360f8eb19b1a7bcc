/* SPDX-License-Identifier: MIT */
/* temporal.h - tile rows of methods that look at several instants. */
#ifndef SMEAR_TEMPORAL_H
#define SMEAR_TEMPORAL_H

#include "display/damage.h"
#include "geometry/path.h"
#include "temporal/line_movers.h"
#include "temporal/row_lists.h"

struct smear_temporal {
    struct smear_shutter_times shutter;
    struct smear_chooser chooser;
    struct smear_row_moving moving;     /* of the row being drawn */
    uint8_t *work;                      /* work_bytes per worker */
    uint32_t work_bytes;
    int32_t strip;                      /* tiles that share instants are so many pixels wide together, at most */
    int32_t target;                     /* smear_frame.target: the chooser's follows from it and the budget */
    uint32_t budget;                    /* smear_frame.budget */
    uint32_t tiles[2];                  /* of the frame's rows so far: that stand still, and others */
    struct smear_damage *damage;        /* null without desc.reuse */
    struct smear_lines *lines;          /* of the still scene of a frame whose camera moves; null: the desc has no room for them */
};

/* What stands still is blurred along lines in this frame, and what moves by itself is drawn over it. */
static inline bool temporal_has_lines(const struct smear_temporal *t) { return SMEAR_WITH_LINES && t->lines != NULL && t->lines->on; }

/* Whether one instant is all that a frame shows: nothing counts as moving. */
static inline bool temporal_is_sharp(const struct smear_temporal *t)
{
    return SMEAR_WITH_SUBFRAMES && t->chooser.method == SMEAR_SUBFRAMES && t->chooser.samples == 1 && smear_shutter_is_box(&t->shutter);
}

/* Moves one of the lists of its further pictures on to a row. */
static inline void temporal_advance(const struct smear_temporal *t, const struct smear_rows *rows, int list, int row)
{
    t->lines->list[list] = row_advance(rows, bins_more(&rows->bins, list), t->lines->list[list], row);
}

/* Returns the columns that a strip of a frame takes with what is drawn beyond its sides: nothing where it is as wide as
 * the frame. */
int32_t smear_strip_columns(int32_t strip, int32_t width);

/* Begins a frame: forgets what was learnt from the rows of the last one. */
void smear_temporal_begin(struct smear_temporal *self, const smear_frame *frame, const struct smear_rows *rows,
                          const struct smear_shot *shot);

/* Draws, finishes and hands out the tile rows [first, *end), a part of the frame that has been assembled; along lines each is
 * finished when the row below it is drawn. Fewer, and *end says so, where the next ones are to have more pictures, or instants. Returns
 * as smear_band_flush. */
int smear_temporal_rows(struct smear_temporal *self, struct smear_rows *rows, int first, int *end);

/* Smooths edges in a tile row that is drawn, before anything moves in it. Rows come from top to bottom. Takes the work memory
 * of the method and the scratch of the rows. */
void smear_smooth_static(struct smear_rows *rows, int row, const struct smear_temporal *temporal);

/* ------------------------------------------------------------------ rows of temporal methods, drawn along lines or not */

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

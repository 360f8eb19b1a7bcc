/* SPDX-License-Identifier: MIT */
/* points.h - what is asked of overlay/: points of smear_overlay.h, found on the screen once a frame, and what lies over it, drawn over
 * parts of rows on their way to the display. */
#ifndef SMEAR_DISPLAY_POINTS_H
#define SMEAR_DISPLAY_POINTS_H

#include "smear_overlay.h"

#include "base/base.h"
#include "display/row.h"
#include "geometry/shot.h"

/* Pixels of the frame that an item may touch: columns [x0, x1), rows [y0, y1). */
struct overlay_box {
    int32_t x0, y0, x1, y1;
};

/* Whether an item may touch pixels of a box. */
bool smear_overlay_touches(const smear_overlay *overlay, const struct overlay_box *box);

static inline bool rows_are_covered(const struct smear_rows *rows, const struct overlay_box *box)
{
    return rows_have_overlay(rows) && smear_overlay_touches(rows->overlay, box);
}

/* Draws all items over pixels of `area`, which is within the target. */
void smear_overlay_draw(const smear_overlay *overlay, const struct smear_raster_target *t, const struct overlay_box *area,
                        smear_transfer transfer);

static inline bool rows_have_points(const struct smear_rows *rows)
{
    return rows_have_overlay(rows) && rows->overlay->points != NULL;
}

/* Finds where all points are seen from one instant of the exposure to another. */
void smear_points_place(const struct smear_rows *rows, const struct smear_shot *shot, const struct smear_instant *from,
                        const struct smear_instant *to);

/* Lists the points that may touch pixel rows [y0, y1): rows->points. */
void smear_points_list(struct smear_rows *rows, int32_t y0, int32_t y1);

static inline void rows_list_points(struct smear_rows *rows, int32_t y0, int32_t y1)
{
    if (rows_have_points(rows))
        smear_points_list(rows, y0, y1);
}

/* Whether listed points may touch columns [x0, x1), which become those that they may. */
bool smear_points_listed(const struct smear_rows *rows, int32_t *x0, int32_t *x1);

static inline bool rows_list_has_points(const struct smear_rows *rows, int32_t x0, int32_t x1)
{
    return rows_have_points(rows) && smear_points_listed(rows, &x0, &x1);
}

/* Whether any point may touch pixel rows [y0, y1), listed or not. */
bool smear_points_touch(const struct smear_rows *rows, int32_t y0, int32_t y1);

/* Draws listed points over pixels of `area`, which is within the target; its depths are those of the scene. */
void smear_points_draw(const struct smear_rows *rows, const struct smear_raster_target *t, const struct overlay_box *area);

/* Where each instant has its part of the streaks: list points of a tile row and draw them into the window; have no point seen
 * any more until they are placed again. */
void smear_points_draw_window(struct smear_rows *rows, int row);
void smear_points_hide(const struct smear_rows *rows);

static inline void rows_draw_points(struct smear_rows *rows, int row)
{
    if (rows_have_points(rows))
        smear_points_draw_window(rows, row);
}

static inline void rows_hide_points(const struct smear_rows *rows)
{
    if (rows_have_points(rows))
        smear_points_hide(rows);
}

#endif

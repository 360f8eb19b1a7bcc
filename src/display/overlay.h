/* SPDX-License-Identifier: MIT */
/* overlay.h - boxes, sprites and text (smear_overlay.h), drawn over parts of rows on their way to the display.
 *
 * What is under them lies in a window that may be read again, so a part that is touched is copied first. */
#ifndef SMEAR_DISPLAY_OVERLAY_H
#define SMEAR_DISPLAY_OVERLAY_H

#include "smear_overlay.h"

#include "base/base.h"

/* Pixels of a row that are copied at once. A multiple of 8, which formats of less than a byte per pixel need. */
enum { OVERLAY_PART = SMEAR_FAST_STACK ? 32 : 128 };

/* Pixels of the frame that an item may touch: columns [x0, x1), rows [y0, y1). */
struct overlay_box {
    int32_t x0, y0, x1, y1;
};

struct overlay_box smear_overlay_box(const smear_overlay_item *item);

/* Return the pixels of a text's first letter, and the columns from one letter to the next. */
struct overlay_box smear_overlay_letter(const smear_overlay_item *item);
int32_t smear_overlay_advance(const smear_overlay_item *item);

/* Whether an item may touch pixels of a box. */
bool smear_overlay_touches(const smear_overlay *overlay, const struct overlay_box *box);

/* Returns the columns of row y that items may touch; x0 is above x1 where there are none. */
struct overlay_box smear_overlay_row(const smear_overlay *overlay, int32_t y);

/* Where an item touches pixels [x0, x1) of row y, at most OVERLAY_PART: copies them from `in` to `out`, unless they are
 * there, draws all items over them, and returns true. */
bool smear_overlay_draw(const smear_overlay *overlay, uint32_t *out, const uint32_t *in, int32_t x0, int32_t x1, int32_t y,
                        bool linear);

#endif

/* SPDX-License-Identifier: MIT */
/* overlay.h - what lies over a frame (smear_overlay.h): boxes, sprites, text, shapes, and points, drawn as streaks.
 *
 * A dot's light falls off as (1 - (r / a)^2)^2 up to its radius a. The light that a pixel gets while a dot passes at distance
 * d is the integral of that along a chord, a polynomial, from where the dot is at shutter open to where it is at close:
 * neither instants nor tables are needed, and streaks look alike in all directions. */
#ifndef SMEAR_OVERLAY_OVERLAY_H
#define SMEAR_OVERLAY_OVERLAY_H

#include "display/damage.h"
#include "display/points.h"

/* Returns the pixels that an item may touch. */
struct overlay_box smear_overlay_box(const smear_overlay_item *item);

/* Return an item's colour, the bytes of an image's row, and a pixel of one, straight alpha, where `argb` is the item's. */
uint32_t smear_overlay_color(const smear_overlay_item *item);
uint32_t smear_image_pitch(const smear_image *m);
uint32_t smear_image_pixel(const smear_image *m, const uint8_t *row, int32_t i, uint32_t argb);

/* Return the pixels of a text's first letter, and the columns from one letter to the next. */
struct overlay_box smear_overlay_letter(const smear_overlay_item *item);
int32_t smear_overlay_advance(const smear_overlay_item *item);

enum {
    SMEAR_NO_POINT = UINT16_MAX,
    SMEAR_POINT_RADIUS = 13, /* fraction bits of lengths in radii of a dot */
    /* A streak's `x`, `y` is its middle, and `length` is from there to its ends; of a short one, where it is less, to the two
     * places that weigh. */
    SMEAR_POINT_SHORT = 1 << (SMEAR_POINT_RADIUS - 2)
};

#endif

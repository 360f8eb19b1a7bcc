/* SPDX-License-Identifier: MIT */
/* span.h - the pixels of one triangle in one row. */
#ifndef SMEAR_SPAN_H
#define SMEAR_SPAN_H

#include "setup.h"

/* Pixels [a, b) of row y, a piece of the triangle's whole span [left, right). */
struct span {
    int32_t a, b, left, right, y;
    uint32_t *color;            /* of pixel a */
    uint16_t *depth;
    int32_t at;                 /* index of pixel a in the window's planes */
    uint32_t z;                 /* code 16.16 of pixel a */
    int32_t dz;
    uint32_t *mask;             /* cutout: a bit per pixel from a on, set where it was drawn; else null */
};

/* Writes colour and depth where the span passes the depth test (and cutout, blend). */
typedef void smear_span_fn(const struct setup *s, const struct span *p);

/* One colour, opaque; and everything. */
smear_span_fn smear_span_flat, smear_span_general;

/* Flat colours and plain texels in rows of their own: twice to four times as fast, of the same bits, and 3.4 kB larger. */
#ifndef SMEAR_SPAN_ROWS
#ifdef __OPTIMIZE_SIZE__
#define SMEAR_SPAN_ROWS 0
#else
#define SMEAR_SPAN_ROWS 1
#endif
#endif

/* Whole spans of rows one below the other, from row y on. */
enum { SPAN_ROWS = 16 };

struct span_rows {
    int32_t y, count;
    int32_t at;                 /* index of column 0 of the first row in the planes: colour and depth lie alike */
    struct {
        int32_t left, right;    /* as the frame shows them; there may be none */
        int32_t edge;           /* right, wherever that is */
    } side[SPAN_ROWS];
};

/* Draws rows at once, velocities included. Null where there is no such loop for a triangle. */
typedef void smear_rows_fn(const struct setup *s, const struct span_rows *r);
smear_rows_fn *smear_rows_choose(const struct setup *s);

/* How many of n pixels come before the first one beyond the break of the depth code, which lies among them. */
static inline int32_t pixels_to_bend(int32_t units, int32_t dx, int32_t n)
{
    int32_t before = dx > 0 ? (SLOPE_BREAK - units + dx - 1) / dx : (units - SLOPE_BREAK) / -dx + 1;
    return clamp_i32(before, 1, n - 1);
}

/* Writes velocities where the span will pass the depth test; comes before the colours, which write depth. With a mask it
 * comes after them and goes by the mask. */
void smear_span_velocity(const struct setup *s, const struct span *p);

/* One pixel without a motion of its own: its velocity is zero or, where the camera's is still to be told from depth,
 * unknown. */
void smear_velocity_still(const struct smear_raster_target *t, int32_t at, bool unknown);

#endif

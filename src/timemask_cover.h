/* SPDX-License-Identifier: MIT */
/* timemask_cover.h - when a moving triangle covers the centres of pixels.
 *
 * During a segment of the exposure an edge function goes from its value at the segment's start to that at its end, along
 * the parabola through its value in the middle: exact where vertices move along chords. Where it changes its sign the
 * pixel is entered or left; what three edges leave are runs of time slots, most often one. A slot is covered when its
 * middle is.
 *
 * An edge's numbers come from its two vertices in one order, whichever triangle asks: runs of the triangles on both
 * its sides add up to the whole segment, slot for slot. */
#ifndef SMEAR_TIMEMASK_COVER_H
#define SMEAR_TIMEMASK_COVER_H

#include "fixmath.h"

/* Pixels are looked at in blocks of at most this many columns and rows. */
enum { TIMEMASK_BLOCK = 16 };

/* A triangle at one end of a segment: q8 px from the centre of the block's first pixel; depth units q11. */
struct timemask_pose {
    int32_t x[3], y[3], depth[3];
};

/* What is stepped over pixels. */
struct timemask_plane {
    int32_t at, dx, dy;         /* at the block's first pixel */
};

static inline int32_t timemask_plane_at(const struct timemask_plane *p, int32_t x, int32_t y)
{
    return add_wrap(p->at, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
}

/* How an edge moves in this block. */
struct timemask_cover {
    int32_t x0, y0, x1, y1;     /* pixels of the block that may be covered */
    int32_t slots_log2;         /* of the segment */
    int32_t edge;               /* see struct smear_timemask_settings */
    uint8_t enters, leaves, stills, turns;      /* edges of each kind; those inside everywhere are in none */
    struct timemask_plane enter[3], leave[3];   /* slots q14, 1/2 added: the run starts, ends at its integer part */
    struct timemask_plane still[3];             /* inside is >= 0 */
    struct {
        struct timemask_plane start, end;       /* edge functions in their own order */
        struct timemask_plane bow;              /* twice what the middle lies off the mean of both */
        bool reversed;                          /* the triangle lies on the edge's other side */
    } turn[3];
};

/* Slots [from, to) of pixel x. */
struct timemask_run {
    uint8_t x, from, to;
};

/* False when no pixel of the block's width x height is covered in the segment of 2^slots_log2 slots that begins, is halfway
 * and ends at the poses. `edge` as in struct smear_timemask_settings. */
bool smear_timemask_cover(struct timemask_cover *c, const struct timemask_pose *const pose[3], int32_t width,
                          int32_t height, int32_t slots_log2, int32_t edge);

enum { TIMEMASK_RUNS = 4 * TIMEMASK_BLOCK };        /* three edges that bow in and out again */

/* Runs of a row, by x; how many. */
int32_t smear_timemask_row(const struct timemask_cover *c, int32_t y, struct timemask_run *out);

#endif

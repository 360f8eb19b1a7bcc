/* SPDX-License-Identifier: MIT */
/* timemask_cover.h - when a moving triangle covers the centres of pixels.
 *
 * During a segment of the exposure an edge function goes from its value at the segment's start to that at
 * its end, along the parabola through its value in the middle: exact where vertices move along chords. Where
 * it changes its sign the pixel is entered or left; what three edges leave are runs of time samples, most
 * often one. A sample is covered when its middle is.
 *
 * An edge's numbers come from its two vertices in one order, whichever triangle asks: runs of the triangles
 * on both its sides add up to the whole segment, sample for sample. */
#ifndef SMEAR_TIMEMASK_COVER_H
#define SMEAR_TIMEMASK_COVER_H

#include "base/fixmath.h"

/* Pixels are looked at in blocks of at most so many columns and rows, or, where few of them say all there is
 * (timemask.c), so many samples: then px are the distances between these. */
enum { TIMEMASK_WIDTH = 16, TIMEMASK_HEIGHT = 17 };

/* A triangle at one time: q8 px from the centre of the block's first pixel; depth units q11. */
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

/* An edge that crosses pixels one way: in which sample. */
struct timemask_crossing {
    struct timemask_plane mean;     /* samples q14 after the segment's middle, for the
                                     * difference in the block's middle */
    struct timemask_plane curvature;     /* q30: what that is to be multiplied with where
                                     * the difference is another one */
    int32_t bow;                    /* q14: how far the parabola leaves the chord */
};

/* An edge that may do anything. */
struct timemask_turning {
    struct timemask_plane start, end;       /* edge functions in their own order */
    struct timemask_plane bow;              /* twice what the middle lies off the mean of both */
    bool reversed;                          /* the triangle lies on the edge's other side */
};

enum timemask_form { COVER_EVEN, COVER_CURVED, COVER_BOWED };

/* How the edges move in this block. */
struct timemask_cover {
    int32_t x0, y0, x1, y1;     /* pixels of the block that may be covered */
    int32_t middle_x, middle_y; /* of the block */
    int32_t samples_log2;       /* of the segment */
    enum timemask_form form;    /* what crossings need: none bends or bows, some curvature, some bow */
    uint8_t enters, leaves, stays, turns;       /* edges of each kind; those inside everywhere are in none */
    struct timemask_crossing enter[3], leave[3];
    struct timemask_plane stay[3];              /* inside is >= 0 */
    struct timemask_turning turn[3];
};

/* Returns the samples [0, n). */
static inline uint32_t timemask_below(int32_t n)
{
    return n >= 32 ? UINT32_MAX : (1u << n) - 1u;
}

/* Runs of a row: samples [from, to) of pixel x, each in 8 bits. */
static inline uint32_t timemask_run(int32_t x, int32_t from, int32_t to)
{
    return (uint32_t)(x | from << 8 | to << 16);
}

static inline int32_t timemask_run_x(uint32_t run) { return (int32_t)(run & 255u); }
static inline int32_t timemask_run_from(uint32_t run) { return (int32_t)(run >> 8 & 255u); }
static inline int32_t timemask_run_to(uint32_t run) { return (int32_t)(run >> 16); }

/* False when no pixel of the block's width x height is covered in the segment of 2^samples_log2 samples that
 * begins, is halfway and ends at the poses. `edge` as in struct smear_timemask_settings. */
bool smear_timemask_cover(struct timemask_cover *c, const struct timemask_pose *const pose[3], int32_t width,
                          int32_t height, int32_t samples_log2, int32_t edge);

enum { TIMEMASK_RUNS = 4 * TIMEMASK_WIDTH };        /* three edges that bow in and out again */

/* Runs of a row, by x; how many. */
int32_t smear_timemask_row(const struct timemask_cover *c, int32_t y, uint32_t *out);

#endif

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
#include "base/pixel.h"
#include "raster/setup.h"

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

enum { TIMEMASK_ENTRIES = 5 };

/* Entries of a block: e of pixel p at e * pixels + p. */
struct timemask_samples {
    uint32_t *any;              /* samples held by some entry */
    uint32_t *held;             /* a bit per sample, never 0 in use */
    uint32_t *color;            /* 0xSSRRGGBB, S: the depth's slope */
    uint16_t *depth;            /* code in the middle of the exposure */
    uint8_t *count;             /* entries in use */
    int32_t pixels_log2;
    int32_t samples_log2;       /* of the whole exposure */
    smear_transfer transfer;
};

/* What may be seen of a moving triangle in a pixel. */
struct timemask_fragment {
    uint32_t mask;              /* samples, at least one */
    uint32_t color;             /* as it is kept */
    int32_t depth;              /* code in the middle of the exposure */
    int32_t slope;              /* timemask_slope_of(color) */
};

static inline size_t timemask_samples_bytes(uint32_t pixels)
{
    return pixels
         * (TIMEMASK_ENTRIES * (2 * sizeof(uint32_t) + sizeof(uint16_t)) + sizeof(uint32_t) + 1);
}

/* Over `memory` of that size, aligned for words. */
void smear_timemask_samples_place(struct timemask_samples *b, void *memory, int32_t pixels_log2,
                                  int32_t samples_log2, smear_transfer transfer);

/* Frees all entries. */
void smear_timemask_samples_clear(struct timemask_samples *b);

/* Slope of a depth code, in 1/16 per sample, in 8 bits: sign, exponent, 3 bits of mantissa. */
uint32_t smear_timemask_slope(int32_t slope);

static inline int32_t timemask_slope_of(uint32_t color)
{
    int32_t exponent = (int32_t)(color >> 27 & 15u), mantissa = (int32_t)(color >> 24 & 7u);
    int32_t size = exponent == 0 ? mantissa : (8 + mantissa) << (exponent - 1);
    return (int32_t)color < 0 ? -size : size;
}

/* Returns the samples of `both` in which a is nearer than b, where their courses may cross: `depth` is a's less b's in 1/32, in the sample
 * of which twice the number is given; `slope` is a's slope less b's. */
uint32_t smear_timemask_nearer(int32_t depth, int32_t slope, uint32_t both, int32_t twice_middle);

/* Adds what is seen. */
void smear_timemask_samples_add(struct timemask_samples *b, uint32_t pixel, struct timemask_fragment f);

/* The pixel over the background's colour. */
uint32_t smear_timemask_samples_mean(const struct timemask_samples *b, uint32_t pixel, uint32_t background);

/* Time in a segment is counted in 1/64, from its middle. */
enum { TIMEMASK_TIME_LOG2 = 6 };

/* An attribute over the screen and time: a plane, plus time times another, plus time^2 times a constant. */
struct timemask_timed {
    int32_t at, dx, dy;         /* in the segment's middle, at the block's first pixel */
    int32_t change, change_dx, change_dy;       /* over the segment */
    int32_t curve;              /* the same, times the whole segment again */
};

struct timemask_shade {
    const struct smear_raster_frame *frame;
    const struct smear_segment *segment;
    const struct smear_sampler *sampler;    /* null: no texture */
    bool gouraud;
    bool in_fog;                            /* more or less of it from pixel to pixel */
    bool over_w;                            /* channels, u and v are values over w, q is 1/w */
    int8_t turns_shift;                     /* u and v are turns in 2^(32 - shift); texels: 0 */
    uint32_t color;                         /* 0xRRGGBB, without texture and
                                             * gouraud; or light over a texture */
    struct timemask_timed depth;            /* units q4 */
    int32_t depth_low, depth_high;          /* what the vertices have, too */
    int32_t slope;                          /* of depth codes below 32768, 1/16 per sample */
    struct timemask_timed channel[3];       /* as setup.h has them, q16 */
    int32_t channel_low[3], channel_high[3];
    struct timemask_timed q, u, v;
    int32_t travel;                         /* during the segment, q8 px */
    int32_t tap;
    int32_t samples_log2;
};

/* Makes the planes of a triangle from its poses at a segment's start, middle and end, for the block and segment of
 * `cover`. `is_flat`: the triangle is of one colour, whatever its vertices have. `tap`: travel per texel, q8 px. */
void smear_timemask_shade(struct timemask_shade *s, const struct smear_raster_frame *frame,
                          const struct smear_segment *segment, uint32_t color, bool is_flat,
                          const int32_t *const record[3], const struct timemask_pose *const pose[3],
                          const struct timemask_cover *cover, int32_t tap);

/* Returns the colour of a pixel of the block over a run. */
uint32_t smear_timemask_color(const struct timemask_shade *s, int32_t y, uint32_t run);

/* Returns the value at pixel (x, y) of the block at a time. */
static inline int32_t timemask_value(const struct timemask_timed *p, int32_t x, int32_t y, int32_t time)
{
    const struct timemask_plane at = { p->at, p->dx, p->dy }, change = { p->change, p->change_dx, p->change_dy };
    return add_wrap(timemask_plane_at(&at, x, y),
                    mul_shift(add_wrap(timemask_plane_at(&change, x, y), mul_shift(p->curve, time, TIMEMASK_TIME_LOG2)), time,
                              TIMEMASK_TIME_LOG2));
}

static inline int32_t timemask_middle(const struct timemask_shade *s, uint32_t run)
{
    return ((timemask_run_from(run) + timemask_run_to(run)) << (TIMEMASK_TIME_LOG2 - 1 - s->samples_log2))
         - (1 << (TIMEMASK_TIME_LOG2 - 1));
}

#endif

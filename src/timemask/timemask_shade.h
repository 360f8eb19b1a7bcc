/* SPDX-License-Identifier: MIT */
/* timemask_shade.h - depth and colour of a moving triangle in the middle of a run, or along it.
 *
 * An attribute is a plane over the screen that goes with a point of the triangle: it has the
 * value of that point, and slopes around it. Where the triangle keeps its shape, slopes stay,
 * and a pixel's value goes evenly with time. */
#ifndef SMEAR_TIMEMASK_SHADE_H
#define SMEAR_TIMEMASK_SHADE_H

#include "raster/setup.h"
#include "timemask/timemask_cover.h"

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

/* floor(a time / 64) for any a. */
static inline int32_t timemask_part(int32_t a, int32_t time)
{
    if (SMEAR_HAS_MUL64)
        return (int32_t)((int64_t)a * time >> TIMEMASK_TIME_LOG2);
    const int32_t below = (1 << TIMEMASK_TIME_LOG2) - 1;
    return add_wrap(mul_wrap(a >> TIMEMASK_TIME_LOG2, time), (a & below) * time >> TIMEMASK_TIME_LOG2);
}

/* Returns the value at pixel (x, y) of the block at a time. */
static inline int32_t timemask_value(const struct timemask_timed *p, int32_t x, int32_t y, int32_t time)
{
    const struct timemask_plane at = { p->at, p->dx, p->dy }, change = { p->change, p->change_dx, p->change_dy };
    return add_wrap(timemask_plane_at(&at, x, y),
                    timemask_part(add_wrap(timemask_plane_at(&change, x, y), timemask_part(p->curve, time)), time));
}

static inline int32_t timemask_middle(const struct timemask_shade *s, uint32_t run)
{
    return ((timemask_run_from(run) + timemask_run_to(run)) << (TIMEMASK_TIME_LOG2 - 1 - s->samples_log2))
         - (1 << (TIMEMASK_TIME_LOG2 - 1));
}

#endif

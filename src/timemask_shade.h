/* SPDX-License-Identifier: MIT */
/* timemask_shade.h - depth and colour of a moving triangle in the middle of a run, or along it.
 *
 * An attribute is a plane over the screen that goes with a point of the triangle: it has the value of that point, and slopes
 * around it. Where the triangle keeps its shape, slopes stay, and a pixel's value goes evenly with time. */
#ifndef SMEAR_TIMEMASK_SHADE_H
#define SMEAR_TIMEMASK_SHADE_H

#include "setup.h"
#include "timemask_cover.h"

/* Time in a segment is counted in 1/64, from its middle. */
enum { TIMEMASK_TIME_LOG2 = 6 };

/* An attribute: at the block's first pixel where slopes stay, else at the moving point; and how it changes over the whole
 * segment. */
struct timemask_timed {
    int32_t at, change;
    int32_t dx, dy;             /* per pixel, in the middle */
    int32_t dx_change, dy_change;       /* over the segment; where slopes turn */
};

struct timemask_shade {
    const struct smear_raster_frame *frame;
    const struct smear_segment *segment;
    const struct smear_sampler *sampler;    /* null: no texture */
    bool gouraud;
    bool turns;                             /* slopes change, attributes are those of the moving point */
    int32_t x, y, x_change, y_change;       /* the point: q8 px from the block's first centre */
    bool over_w;                            /* channels, u and v are values over w, q is 1/w */
    int8_t turns_shift;                     /* u and v are turns in 2^(32 - shift); texels: 0 */
    uint32_t color;                         /* 0xRRGGBB, without texture and gouraud; or light over a texture */
    struct timemask_timed depth;            /* units q5 */
    int32_t depth_low, depth_high;          /* what the vertices have, too */
    int32_t slope[2];                       /* of depth codes below and from 32768, 1/16 per slot */
    struct timemask_timed channel[3];       /* as setup.h has them, q16 */
    int32_t channel_low[3], channel_high[3];
    struct timemask_timed q, u, v;
    int32_t travel;                         /* during the segment, q8 px */
    int32_t tap;
    int32_t slots_log2;
};

/* From the poses at a segment's start, middle and end. */
void smear_timemask_shade(struct timemask_shade *s, const struct smear_raster_frame *frame,
                          const struct smear_segment *segment, const struct smear_triangle *triangle,
                          const struct timemask_pose *const pose[3], int32_t slots_log2, int32_t tap);

/* Colour of a pixel of the block over a run. */
uint32_t smear_timemask_color(const struct timemask_shade *s, int32_t y, const struct timemask_run *run);

int32_t smear_timemask_turning_value(const struct timemask_shade *s, const struct timemask_timed *p, int32_t x, int32_t y,
                                     int32_t time);

/* Value at a time, where |change| is below 2^25. */
static inline int32_t timemask_value(const struct timemask_shade *s, const struct timemask_timed *p, int32_t x, int32_t y,
                                     int32_t time)
{
    if (s->turns)
        return smear_timemask_turning_value(s, p, x, y, time);
    int32_t here = add_wrap(p->at, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
    return add_wrap(here, p->change * time >> TIMEMASK_TIME_LOG2);
}

static inline int32_t timemask_middle(const struct timemask_shade *s, const struct timemask_run *run)
{
    return ((run->from + run->to) << (TIMEMASK_TIME_LOG2 - 1 - s->slots_log2)) - (1 << (TIMEMASK_TIME_LOG2 - 1));
}

/* Depth code of the pixel in the middle of its run. */
static inline uint32_t timemask_depth(const struct timemask_shade *s, int32_t y, const struct timemask_run *run)
{
    int32_t units = timemask_value(s, &s->depth, run->x, y, timemask_middle(s, run));
    units = clamp_i32(units, s->depth_low, s->depth_high);
    return units < 32768 << 5 ? (uint32_t)(units + 16) >> 5
                              : ((uint32_t)units + ((15u * 32768u) << 5) + 256u) >> 9;
}

#endif

/* SPDX-License-Identifier: MIT */
/* timemask_shade.h - depth and colour of a moving triangle in the middle of a run, or along it.
 *
 * Attributes are planes over the screen at both ends of a segment of the exposure; between them a pixel's value goes
 * evenly, which is exact where the triangle keeps its shape. */
#ifndef SMEAR_TIMEMASK_SHADE_H
#define SMEAR_TIMEMASK_SHADE_H

#include "setup.h"
#include "timemask_cover.h"

/* Time in a segment is counted in 1/64. */
enum { TIMEMASK_TIME_LOG2 = 6 };

/* A value at the segment's start, at the block's first pixel, and how it changes until the end. */
struct timemask_timed {
    int32_t at, dx, dy;
    int32_t change, change_dx, change_dy;
};

struct timemask_shade {
    const struct smear_raster_frame *frame;
    const struct smear_segment *segment;
    const struct smear_sampler *sampler;    /* null: no texture */
    bool gouraud;
    bool over_w;                            /* channels, u and v are values over w, q is 1/w */
    int8_t turns_shift;                     /* u and v are turns in 2^(32 - shift); texels: 0 */
    uint32_t color;                         /* 0xRRGGBB, without texture and gouraud; or light over a texture */
    struct timemask_timed depth;            /* units q5 */
    int32_t depth_low, depth_high;          /* what the vertices have, too */
    struct timemask_timed channel[3];       /* as setup.h has them, q16 */
    int32_t channel_low[3], channel_high[3];
    struct timemask_timed q, u, v;
    int32_t travel;                         /* during the segment, q8 px */
    int32_t tap;
    int32_t slots_log2;
};

void smear_timemask_shade(struct timemask_shade *s, const struct smear_raster_frame *frame,
                          const struct smear_segment *segment, const struct smear_triangle *triangle,
                          const struct timemask_pose *a, const struct timemask_pose *b, int32_t slots_log2, int32_t tap);

/* Colour of a pixel of the block over a run. */
uint32_t smear_timemask_color(const struct timemask_shade *s, int32_t y, const struct timemask_run *run);

/* Value at a time, where |change| is below 2^25 all over the block. */
static inline int32_t timemask_value(const struct timemask_timed *p, int32_t x, int32_t y, int32_t time)
{
    int32_t here = add_wrap(p->at, add_wrap(mul_wrap(p->dx, x), mul_wrap(p->dy, y)));
    int32_t change = add_wrap(p->change, add_wrap(mul_wrap(p->change_dx, x), mul_wrap(p->change_dy, y)));
    return add_wrap(here, mul_wrap(change, time) >> TIMEMASK_TIME_LOG2);
}

/* Depth code of the pixel in the middle of its run. */
static inline uint32_t timemask_depth(const struct timemask_shade *s, int32_t y, const struct timemask_run *run)
{
    int32_t time = (run->from + run->to) << (TIMEMASK_TIME_LOG2 - 1 - s->slots_log2);
    int32_t units = timemask_value(&s->depth, run->x, y, time);
    units = clamp_i32(units, s->depth_low, s->depth_high);
    return units < 32768 << 5 ? (uint32_t)(units + 16) >> 5
                              : ((uint32_t)units + ((15u * 32768u) << 5) + 256u) >> 9;
}

#endif

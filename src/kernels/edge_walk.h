/* SPDX-License-Identifier: MIT */
/* edge_walk.h - where an edge lies in each row of pixels, exactly. */
#ifndef SMEAR_KERNELS_EDGE_WALK_H
#define SMEAR_KERNELS_EDGE_WALK_H

#include "base/fixmath.h"
#include "kernels/kernels.h"

/* An edge from a down to b (b below a; x and y, q8 px; at most 2^20 apart), starting at pixel row y, whose centre lies at or
 * below a. Pixels are the first at or right of it: ceil((x - 1/2 px) / 1 px) of the exact fraction. */
struct edge_rest {
    int32_t x;              /* q8: the edge's place at this row's centres,
                             * rounded up; 127 more for edge_pixel */
    int32_t rest;           /* what was added by rounding, in 1/dy: -dy < rest <= 0 */
    int32_t step, step_rest;
    int32_t dy;
};

#if !SMEAR_HAS_DIVIDE && !SMEAR_ONE_COPY
/* divide_floor of what is known nearly. */
static inline int32_t divide_near(int32_t q, int32_t a, int32_t b, int32_t *remainder)
{
    int32_t r = sub_wrap(a, mul_wrap(q, b));
    for (; r < 0; r += b)
        q--;
    for (; r >= b; r -= b)
        q++;
    *remainder = r;
    return q;
}

/* Without divisions; false where an edge is flat or long. 1/dy = recip 2^(zeros - 46) is good to 2^-14: what it tells is off by less
 * than two, what steps tell of their parts by less than one. */
static inline bool edge_rest_near(struct edge_rest *e, int32_t dx, int32_t dy, int32_t down, int32_t rows)
{
    if (dy < 4 || dy >= 1 << 16 || (uint32_t)(dx + (1 << 15)) >= 1u << 16 || abs_i32(dx) >= dy * 32)
        return false;
    const int zeros = count_leading_zeros((uint32_t)dy);
    const int32_t recip = (int32_t)(recip_norm((uint32_t)dy << zeros) >> 15);
    int32_t step_rest, rest;
    const int32_t step = divide_near(dx * recip >> (38 - zeros), dx * 256, dy, &step_rest);
    e->x += divide_near(step * down >> 8, dx * down, dy, &rest);
    if (rows != 0) {        /* the rest of a step over dy, q16, times less than 2^12 */
        const int32_t part = step_rest * recip >> (30 - zeros);
        e->x += step * rows + divide_near(part * rows >> 16, add_wrap(rest, mul_wrap(rows, step_rest)), dy, &rest);
    }
    e->step = step;
    e->step_rest = step_rest;
    e->rest = rest;
    return true;
}
#endif

static inline void edge_rest_start(struct edge_rest *e, const int32_t *a, const int32_t *b, int32_t y)
{
    const int32_t dx = b[0] - a[0], dy = b[1] - a[1];       /* |dx| <= 2^20 */
    const int32_t first = (a[1] + 127) >> 8;        /* first row below a */
    const int32_t down = first * 256 + 128 - a[1];  /* 0 .. 255 */
    const uint32_t rows = (uint32_t)(y - first);
    e->dy = dy;
    e->x = a[0] + 127;
#if !SMEAR_HAS_DIVIDE && !SMEAR_ONE_COPY
    if (!edge_rest_near(e, dx, dy, down, (int32_t)rows))
#endif
    {
        e->step = divide_floor(dx * 256, dy, &e->step_rest);
        e->x += divide_floor(dx * down, dy, &e->rest);
        if (rows != 0) {        /* rows < 2^12 - 2^10, rests < 2^20: the sum fits */
            const uint32_t rest = (uint32_t)e->rest + rows * (uint32_t)e->step_rest;
            e->x += e->step * (int32_t)rows + (int32_t)(rest / (uint32_t)dy);
            e->rest = (int32_t)(rest % (uint32_t)dy);
        }
    }
    if (e->rest > 0) {
        e->rest -= dy;
        e->x++;
    }
}

SMEAR_INLINE_ALWAYS int32_t edge_rest_pixel(const struct edge_rest *e)
{
    return e->x >> 8;
}

SMEAR_INLINE_ALWAYS void edge_rest_step(struct edge_rest *e)
{
    e->x += e->step;
    e->rest += e->step_rest;
    if (e->rest > 0) {
        e->rest -= e->dy;
        e->x++;
    }
}

#if UINTPTR_MAX > 0xffffffffu
/* On cores of 64 bits no remainder is needed. Places are multiples of 1/dy, which is 2^-20 (q8) at least: what is less than
 * a place by anything up to that lies in the pixel of the next lower multiple, and that is the one asked for, half a pixel to the
 * right. The step lacks up to 2^-33 in each of 4096 rows, the start 2^-26. A third of the instructions of a row, and one
 * division where the remainder takes two or four. */
struct edge_walk {
    uint64_t x, step;       /* px q42, modulo 2^64: beyond b they may overflow */
};

static inline void edge_start(struct edge_walk *e, const int32_t *a, const int32_t *b, int32_t y)
{
    const int32_t dx = b[0] - a[0], first = (a[1] + 127) >> 8, down = first * 256 + 128 - a[1];
    const int64_t step = dx * ((int64_t)1 << 42) / (b[1] - a[1]) - (dx < 0);
    const int64_t at = (int64_t)(a[0] + 128) * ((int64_t)1 << 34) + (step >> 8) * down;
    e->x = (uint64_t)at + (uint64_t)step * (uint32_t)(y - first) - 1u;
    e->step = (uint64_t)step;
}

SMEAR_INLINE_ALWAYS int32_t edge_pixel(const struct edge_walk *e) { return (int32_t)((int64_t)e->x >> 42); }
SMEAR_INLINE_ALWAYS void edge_step(struct edge_walk *e) { e->x += e->step; }
#else
#define edge_walk edge_rest
#define edge_start edge_rest_start
#define edge_pixel edge_rest_pixel
#define edge_step edge_rest_step
#endif

#endif

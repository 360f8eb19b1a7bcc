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

/* Places are px q42 modulo 2^64, and lie before the exact ones, half a pixel to the right: those are multiples of 1/dy, which is 2^-20
 * (q8) at least, and what is less than one by less than that lies in the pixel asked for. */
struct edge_fine {
    uint32_t low;
    int32_t high;
    uint32_t step_low;
    int32_t step_high;
};

/* An edge's differences, and from its upper end down to the first row's centres: q8 px. */
struct edge_way {
    int32_t x;              /* of the upper end, half a pixel to the right */
    int32_t dx, dy, down;
};

/* floor(rest 2^32 / dy) for rest < dy < 2^31. */
static SMEAR_RARE uint32_t edge_fraction(uint32_t rest, uint32_t dy)
{
    uint32_t part = 0;
    for (int i = 0; i < 32; i++) {
        rest <<= 1;
        part <<= 1;
        if (rest >= dy) {
            rest -= dy;
            part++;
        }
    }
    return part;
}

/* Starts at the first row, `less` (2^-42 px) before its place. */
static inline void edge_fine_place(struct edge_fine *e, const struct edge_way *w, uint32_t less)
{
    const uint32_t at = (uint32_t)w->x << 2, whole = (uint32_t)mul_wrap(e->step_high, w->down);
    const uint32_t low = whole << 24, part = (e->step_low >> 8) * (uint32_t)w->down, sum = low + part;
    e->low = sum - less;
    e->high = (int32_t)(at + (uint32_t)((int32_t)whole >> 8) + (sum < low) - (sum < less));
}

/* Steps by divisions: they lack up to 2^-42 px, of short edges 2^-40. */
static inline void edge_fine_divided(struct edge_fine *e, const struct edge_way *w)
{
    const uint32_t dy = (uint32_t)w->dy;
    int32_t rest;
    e->step_high = divide_floor(w->dx * 1024, w->dy, &rest);
    if (dy >= 2 && dy < 1u << 16) {
        const uint32_t recip = UINT32_MAX / dy, lack = 0u - recip * dy;         /* of 2^32: dy at most */
        e->step_low = (uint32_t)rest * recip + mulh_u32((uint32_t)rest * lack, recip);
    } else {
        e->step_low = edge_fraction((uint32_t)rest, dy);
    }
    edge_fine_place(e, w, 1);
}

/* Steps without a division: 1/dy = recip 2^(zeros - 46) is good to 2^-14, so each of three parts of a step tells 14 bits more, and the
 * next one what it is off. They are off by 2^-32 px at most; places are compared with those of edges of 2^7 px, half of 2^-23 px less.
 * False where an edge is flat or long. */
static inline bool edge_fine_near(struct edge_fine *e, const struct edge_way *w)
{
    const int32_t dx = w->dx, dy = w->dy;
    if ((uint32_t)dy - 64u >= (1u << 15) - 64u || (uint32_t)(dx + (1 << 15)) >= 1u << 16 || abs_i32(dx) >= dy * 32)
        return false;
    const int zeros = count_leading_zeros((uint32_t)dy);
    const int32_t recip = (int32_t)(recip_norm((uint32_t)dy << zeros) >> 15);
    const int32_t whole = dx * recip >> (36 - zeros), rest = dx * 1024 - whole * dy;             /* 3 dy at most */
    const int32_t part = rest * recip >> (30 - zeros);
    const int32_t last = sub_wrap(shl_wrap(rest, 16), mul_wrap(part, dy));        /* 13 dy at most */
    const int32_t least = last * (recip >> 4) >> (26 - zeros);
    const uint32_t low = (uint32_t)part << 16;
    e->step_low = low + (uint32_t)least;
    e->step_high = whole + (part >> 16) + (least >> 31) + (e->step_low < low);
    edge_fine_place(e, w, 1u << 18);
    return true;
}

/* Goes on by some rows. */
static inline void edge_fine_pass(struct edge_fine *e, uint32_t rows)
{
    const uint32_t low = e->step_low * rows;
    e->low += low;
    e->high = add_wrap(e->high, (int32_t)((uint32_t)e->step_high * rows + mulh_u32(e->step_low, rows) + (e->low < low)));
}

/* The way from a down to b. */
static inline struct edge_way edge_way_of(const int32_t *a, const int32_t *b)
{
    return (struct edge_way){ a[0] + 128, b[0] - a[0], b[1] - a[1], (128 - a[1]) & 255 };
}

/* Starts an edge like edge_rest_start, so many rows below its first one. */
SMEAR_INLINE void edge_fine_start(struct edge_fine *e, const int32_t *a, const int32_t *b, int32_t rows)
{
    const struct edge_way w = edge_way_of(a, b);
#if SMEAR_HAS_DIVIDE
    edge_fine_divided(e, &w);
#else
    if (!edge_fine_near(e, &w))
        edge_fine_divided(e, &w);
#endif
    if (rows != 0)
        edge_fine_pass(e, (uint32_t)rows);
}

static inline int32_t edge_fine_pixel(const struct edge_fine *e) { return e->high >> 10; }

static inline void edge_fine_step(struct edge_fine *e)
{
    e->low += e->step_low;
    e->high = add_wrap(e->high, e->step_high + (e->low < e->step_low));
}

/* Left sides of n > 0 rows, 0 at least. The edge goes on by so many rows. */
SMEAR_INLINE void edge_left(struct span_side *side, struct edge_walk *edge, int32_t n)
{
    struct edge_walk e = *edge;
    struct span_side *const end = side + n;
    do {
        side->left = max_i32(edge_pixel(&e), 0);
        edge_step(&e);
    } while (++side != end);
    *edge = e;
}

/* Right sides, `width` at most, and where they are. */
SMEAR_INLINE void edge_right(struct span_side *side, struct edge_walk *edge, int32_t n, int32_t width)
{
    struct edge_walk e = *edge;
    struct span_side *const end = side + n;
    do {
        int32_t x = edge_pixel(&e);
        side->right = min_i32(x, width);
        side->edge = x;
        edge_step(&e);
    } while (++side != end);
    *edge = e;
}

#endif

/* SPDX-License-Identifier: MIT */
/* edge_walk.h - where an edge lies in each row of pixels, exactly. */
#ifndef SMEAR_KERNELS_EDGE_WALK_H
#define SMEAR_KERNELS_EDGE_WALK_H

#include "base/fixmath.h"
#include "kernels/kernels.h"

/* An edge from a down to b (b below a; x and y, q8 px; at most 2^20 apart), starting at pixel row y, whose centre lies at or
 * below a. Pixels are the first at or right of it: ceil((x - 1/2 px) / 1 px) of the exact fraction.
 *
 * Places are px q42 modulo 2^64, and lie before the exact ones, half a pixel to the right: those are multiples of 1/dy, which is 2^-20
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

/* Starts an edge so many rows below its first one. */
SMEAR_INLINE void edge_fine_start(struct edge_fine *e, const int32_t *a, const int32_t *b, int32_t rows)
{
    const struct edge_way w = edge_way_of(a, b);
    if (SMEAR_HAS_DIVIDE || SMEAR_ONE_COPY || !edge_fine_near(e, &w))
        edge_fine_divided(e, &w);
    if (rows != 0)
        edge_fine_pass(e, (uint32_t)rows);
}

SMEAR_INLINE_ALWAYS int32_t edge_fine_pixel(const struct edge_fine *e) { return e->high >> 10; }

SMEAR_INLINE_ALWAYS void edge_fine_step(struct edge_fine *e)
{
    e->low += e->step_low;
    e->high = add_wrap(e->high, e->step_high + (e->low < e->step_low));
}

#if UINTPTR_MAX > 0xffffffffu
/* In a word, where words have 64 bits. The step lacks up to 2^-33 in each of 4096 rows, the start 2^-26. */
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
#define edge_walk edge_fine
#define edge_pixel edge_fine_pixel
#define edge_step edge_fine_step

static inline void edge_start(struct edge_fine *e, const int32_t *a, const int32_t *b, int32_t y)
{
    edge_fine_start(e, a, b, y - ((a[1] + 127) >> 8));
}
#endif

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

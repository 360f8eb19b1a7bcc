/* SPDX-License-Identifier: MIT */
/* edge_fine.h - where an edge lies in each row of pixels, exactly, for assembly of cores of 32 bits: two words and their carry take half
 * of the instructions of a row that a remainder takes (edge_walk.h). */
#ifndef SMEAR_KERNELS_EDGE_FINE_H
#define SMEAR_KERNELS_EDGE_FINE_H

#include "kernels/edge_walk.h"

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

#endif

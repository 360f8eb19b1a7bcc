/* SPDX-License-Identifier: MIT */
/* object.c - sums that slide along the velocity of a group. */
#include "object.h"

#include "fixmath.h"
#include "layer.h"
#include "pixel.h"

/* ------------------------------------------------------------------ lines */

/* a / b in q16 for |a| <= b < 2^23. */
static int32_t slope_of(int32_t a, int32_t b)
{
    int32_t q = ratio_q30(abs_i32(a), b) >> 14;
    return a < 0 ? -q : q;
}

void smear_streak_make(struct smear_streak *s, int32_t vx, int32_t vy, int32_t reach)
{
    const int32_t longest = (2 * SMEAR_STREAK_HALF + 1) << 8, highest = (2 * reach - 1) << 8;
    vx = clamp_i32(vx, -(1 << 22), 1 << 22);
    vy = clamp_i32(vy, -(1 << 22), 1 << 22);
    int32_t x = abs_i32(vx), y = abs_i32(vy), by = 1 << 30;     /* q30 */
    if (x > longest)
        by = ratio_q30(longest, x);
    if (y > highest)
        by = min_i32(by, ratio_q30(highest, y));
    if (by != 1 << 30) {
        vx = (int32_t)((int64_t)vx * by >> 30);
        vy = (int32_t)((int64_t)vy * by >> 30);
        x = abs_i32(vx);
        y = abs_i32(vy);
    }
    s->upright = y > x;
    int32_t major = s->upright ? vy : vx, minor = s->upright ? vx : vy;
    int32_t length = max_i32(abs_i32(major), 256);
    s->slope = slope_of(major < 0 ? -minor : minor, length);
    s->half = (length - 256) >> 9;
    s->rest = (uint32_t)(length - 256 - (s->half << 9)) >> 1;
    s->length = 256u + ((uint32_t)s->half << 9) + 2u * s->rest;
    s->over = ((1u << 30) + s->length - 1u) / s->length;
    int32_t along = s->half + 1, across = (abs_i32(s->slope) * along + 0xffff) >> 16;
    s->reach_x = s->upright ? across : along;
    s->reach_y = s->upright ? along : across;
}

/* How far a line has strayed to the side after i steps. */
static inline int32_t stray(const struct smear_streak *s, int32_t i)
{
    return (s->slope * i + 0x8000) >> 16;
}

void smear_streak_tables(const struct smear_streak *s, const struct smear_streak_area *a, int32_t *offset,
                         int32_t *still_offset)
{
    int32_t n = s->upright ? a->rows : a->stride;
    for (int32_t i = 0; i < n; i++) {
        int32_t side = stray(s, i);
        offset[i] = s->upright ? i * a->stride + side : side * a->stride + i;
        still_offset[i] = s->upright ? i * a->still_stride + side : side * a->still_stride + i;
    }
}

/* First step at which the line has strayed to `side` or beyond it in its direction. */
static int32_t step_to(const struct smear_streak *s, int32_t side)
{
    int32_t rest;
    if (s->slope > 0)
        return divide_floor(side * 65536 - 0x8000 + s->slope - 1, s->slope, &rest);
    return divide_floor(0x8000 - (side + 1) * 65536, -s->slope, &rest) + 1;
}

/* ------------------------------------------------------------------ sums */

/* A line and what is wanted of it. */
struct line {
    const uint32_t *in;         /* its start: step i lies offset[i] further */
    const uint16_t *depth;
    uint32_t *still;            /* likewise, by still_offset */
    const uint16_t *still_depth;
    int32_t first, end;         /* steps to be finished */
    int32_t from, to;           /* steps at which something may have been drawn */
};

struct channels {
    uint32_t r, g, b;           /* codes, or linear light */
};

SMEAR_INLINE struct channels channels_of(uint32_t p, bool linear)
{
    if (linear)
        return (struct channels){ smear_srgb_decode[pixel_red(p)], smear_srgb_decode[pixel_green(p)],
                                  smear_srgb_decode[pixel_blue(p)] };
    return (struct channels){ pixel_red(p), pixel_green(p), pixel_blue(p) };
}

/* Whole pixels. Encoded: `a` is red and blue, `b` pixels not covered and green. */
struct sums {
    uint32_t a, b;
    struct channels c;
    uint32_t uncovered;
};

enum { LANES = 0xff00ff };

SMEAR_INLINE void sums_change(struct sums *s, uint32_t add, uint32_t drop, bool linear)
{
    if (!linear) {
        s->a += (add & LANES) - (drop & LANES);
        s->b += (add >> 8 & LANES) - (drop >> 8 & LANES);
        return;
    }
    if (add == drop)
        return;
    struct channels n = channels_of(add, true), o = channels_of(drop, true);
    s->c.r += n.r - o.r;
    s->c.g += n.g - o.g;
    s->c.b += n.b - o.b;
    s->uncovered += (add >> 24) - (drop >> 24);
}

SMEAR_INLINE uint32_t sums_uncovered(const struct sums *s, bool linear)
{
    return linear ? s->uncovered : s->b >> 16;
}

/* (256 sum + rest ends + uncovered still) / length, to nearest. */
SMEAR_INLINE uint32_t mean(const struct smear_streak *k, uint32_t sum, uint32_t ends, uint32_t still, uint32_t uncovered,
                           bool linear)
{
    if (linear) {       /* 24 bits in q7 */
        uint32_t q7 = sum * 128u + (ends * k->rest >> 1) + (still * uncovered >> 1);
        return smear_srgb_encode[min_u32(mulh_u32(q7, k->over) >> 1, 4095u)];
    }
    uint32_t q8 = sum * 256u + ends * k->rest + still * uncovered;
    return min_u32(mulh_u32((q8 << 2) + (k->length << 1), k->over), 255u);
}

/* Pixels left and right beyond the whole ones count in part. */
SMEAR_INLINE uint32_t sums_pixel(const struct smear_streak *k, const struct sums *s, uint32_t left, uint32_t right,
                                 uint32_t uncovered, uint32_t still, bool linear)
{
    struct channels c = s->c, ends, rest = channels_of(still, linear);
    if (linear) {
        struct channels l = channels_of(left, true), r = channels_of(right, true);
        ends = (struct channels){ l.r + r.r, l.g + r.g, l.b + r.b };
    } else {
        uint32_t red_blue = (left & LANES) + (right & LANES);
        c = (struct channels){ s->a >> 16, s->b & 0xffffu, s->a & 0xffffu };
        ends = (struct channels){ red_blue >> 16, pixel_green(left) + pixel_green(right), red_blue & 0xffffu };
    }
    return pixel_make(0, mean(k, c.r, ends.r, rest.r, uncovered, linear), mean(k, c.g, ends.g, rest.g, uncovered, linear),
                      mean(k, c.b, ends.b, rest.b, uncovered, linear));
}

/* Where a still surface lies within the group's depths: each pixel of the group against it. */
static SMEAR_NOINLINE uint32_t pixel_by_depth(const struct smear_streak *k, const struct smear_streak_area *a,
                                              const struct line *l, int32_t i, uint32_t still, uint32_t still_depth)
{
    struct sums s = { 0, (2u * (uint32_t)k->half + 1u) << 16, { 0, 0, 0 }, 2u * (uint32_t)k->half + 1u };
    uint32_t end[2] = { SMEAR_UNCOVERED, SMEAR_UNCOVERED };
    int32_t from = max_i32(i - k->half - 1, l->from), to = min_i32(i + k->half + 2, l->to);
    for (int32_t t = from; t < to; t++) {
        int32_t at = a->offset[t];
        if (l->depth[at] <= still_depth)
            continue;
        if (t == i - k->half - 1)
            end[0] = l->in[at];
        else if (t == i + k->half + 1)
            end[1] = l->in[at];
        else
            sums_change(&s, l->in[at], SMEAR_UNCOVERED, a->linear);
    }
    uint32_t uncovered = (sums_uncovered(&s, a->linear) << 8) + ((end[0] >> 24) + (end[1] >> 24)) * k->rest;
    return uncovered == k->length ? still : sums_pixel(k, &s, end[0], end[1], uncovered, still, a->linear);
}

/* Steps [first, end) of a line: `enters`, what comes into the sum may be drawn; `leaves`, what goes. */
SMEAR_INLINE void slide(const struct smear_streak *k, const struct smear_streak_area *a, const struct line *l,
                        struct sums *s, uint32_t *last, int32_t first, int32_t end, bool enters, bool leaves, bool linear)
{
    const int32_t *offset = a->offset;
    const uint32_t all = 2u * (uint32_t)k->half + 1u;
    uint32_t left = *last;
    for (int32_t i = first; i < end; i++) {
        uint32_t right = enters ? l->in[offset[i + k->half + 1]] : SMEAR_UNCOVERED;
        uint32_t uncovered = sums_uncovered(s, linear);
        if (uncovered != all || ((left & right) >> 24) == 0) {
            int32_t at = a->still_offset[i];
            uint32_t still_depth = l->still_depth[at];
            if (still_depth < a->farthest) {
                uncovered = (uncovered << 8) + ((left >> 24) + (right >> 24)) * k->rest;
                l->still[at] = sums_pixel(k, s, left, right, uncovered, l->still[at], linear);
            } else if (still_depth < a->nearest) {
                l->still[at] = pixel_by_depth(k, a, l, i, l->still[at], still_depth);
            }
        }
        left = leaves ? l->in[offset[i - k->half]] : SMEAR_UNCOVERED;
        sums_change(s, right, left, linear);
    }
    *last = left;
}

static inline uint32_t pixel_at(const struct smear_streak_area *a, const struct line *l, int32_t i)
{
    return i >= l->from && i < l->to ? l->in[a->offset[i]] : SMEAR_UNCOVERED;
}

SMEAR_INLINE void merge_line(const struct smear_streak *k, const struct smear_streak_area *a, const struct line *l,
                             bool linear)
{
    struct sums s = { 0, 0, { 0, 0, 0 }, 0 };
    for (int32_t i = l->first - k->half; i <= l->first + k->half; i++)
        sums_change(&s, pixel_at(a, l, i), 0, linear);
    uint32_t last = pixel_at(a, l, l->first - k->half - 1);
    /* What enters is drawn up to `in`, what leaves from `out` on. */
    int32_t in = clamp_i32(l->to - k->half - 1, l->first, l->end), out = clamp_i32(l->from + k->half, l->first, l->end);
    int32_t begin = clamp_i32(l->from - k->half - 1, l->first, l->end);
    slide(k, a, l, &s, &last, l->first, begin, false, false, linear);
    slide(k, a, l, &s, &last, begin, min_i32(in, out), true, false, linear);
    if (in > out)
        slide(k, a, l, &s, &last, out, in, true, true, linear);
    else
        slide(k, a, l, &s, &last, in, out, false, false, linear);
    int32_t empty = clamp_i32(l->to + k->half, max_i32(in, out), l->end);
    slide(k, a, l, &s, &last, max_i32(in, out), empty, false, true, linear);
    slide(k, a, l, &s, &last, empty, l->end, false, false, linear);
}

/* ------------------------------------------------------------------ the area */

uint32_t smear_streak_merge(const struct smear_streak *s, const struct smear_streak_area *a)
{
    /* Steps and places across that are finished; and drawn. */
    int32_t first = a->left + a->margin, end = a->right + a->margin, low = a->top, high = a->top + a->height;
    struct line l = { .from = a->x0, .to = a->x1 };
    if (s->upright) {
        int32_t swap = first;
        first = low;
        low = swap;
        swap = end;
        end = high;
        high = swap;
        l.from = 0;
        l.to = a->rows;
        low = max_i32(low, a->x0 - s->reach_x);
        high = min_i32(high, a->x1 + s->reach_x);
    } else {
        first = max_i32(first, a->x0 - s->reach_x);
        end = min_i32(end, a->x1 + s->reach_x);
    }
    if (first >= end || low >= high)
        return 0;
    int32_t stray0 = stray(s, first), stray1 = stray(s, end - 1);
    for (int32_t start = low - max_i32(stray0, stray1); start < high - min_i32(stray0, stray1); start++) {
        l.first = first;
        l.end = end;
        if (s->slope > 0) {
            l.first = max_i32(first, step_to(s, low - start));
            l.end = min_i32(end, step_to(s, high - start));
        } else if (s->slope < 0) {
            l.first = max_i32(first, step_to(s, high - 1 - start));
            l.end = min_i32(end, step_to(s, low - 1 - start));
        }
        if (l.first >= l.end)
            continue;
        int32_t in = s->upright ? start : start * a->stride;
        int32_t out = s->upright ? start - a->margin - a->top * a->still_stride
                                 : (start - a->top) * a->still_stride - a->margin;
        l.in = a->color + in;
        l.depth = a->depth + in;
        l.still = a->still + out;
        l.still_depth = a->still_depth + out;
        if (a->linear)
            merge_line(s, a, &l, true);
        else
            merge_line(s, a, &l, false);
    }
    return (uint32_t)((end - first) * (high - low));
}

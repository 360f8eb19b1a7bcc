/* SPDX-License-Identifier: MIT */
/* streak.c - means along the velocity of a group, by sums along lines.
 *
 * Sums grow along a line, so the mean around each of its pixels is a difference of two, however long it is. A
 * mean over many pixels changes little from step to step: it is taken at nodes, a few steps apart, and mixed
 * between them. Lines lie a pixel apart, and pixels between two of them: a node of the frame takes of both.
 *
 *     gather      sums what is drawn on a line
 *     means       takes the line's means at its nodes and shares them out to the rows it passes between
 *     finish      mixes pixels between nodes, over the background by coverage and depth (streak_finish.c) */
#include "layers/streak_part.h"

/* ------------------------------------------------------------------ lines */

/* Returns a / b in q16 for |a| <= b < 2^23. */
static int32_t slope_of(int32_t a, int32_t b)
{
    int32_t q = ratio_q30(abs_i32(a), b) >> 14;
    return a < 0 ? -q : q;
}

void smear_streak_make(struct smear_streak *s, int32_t vx, int32_t vy, int32_t half_max, int32_t reach)
{
    const int32_t longest = (2 * half_max + 1) << 8, highest = max_i32(2 * reach - 3, 1) << 8;
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
    /* A line that is off its axis by less than half a pixel at its ends is straightened. */
    s->slope = abs_i32(minor) < 256 ? 0 : slope_of(major < 0 ? -minor : minor, length);
    s->half = (length - 256) >> 9;
    int32_t beyond = (length - 256 - (s->half << 9)) >> 1, shift = 0;       /* q8 px, on either side */
    while (length << (shift + 1) <= 256 << 8)
        shift++;
    s->rest = ((uint32_t)beyond << shift) >> 8;
    s->inner = (1u << shift) - s->rest;
    s->length = ((2u * (uint32_t)s->half + 1u) << shift) + 2u * s->rest;
    s->over = (1u << 22) / s->length + 1u;
    s->node = s->upright || length < 8 << 8 ? 0 : length < 16 << 8 ? 1 : length < 32 << 8 ? 2 : 3;
    int32_t along = s->half + 1 + (1 << s->node);
    int32_t across = s->slope == 0 ? 0 : min_i32(1 + ((abs_i32(s->slope) * along + 0xffff) >> 16), reach);
    s->reach_x = s->upright ? across : s->half + 1;
    s->reach_y = s->upright ? s->half + 1 : across;
}

void smear_streak_edges(const struct smear_streak *s, int16_t *edge, int32_t steps)
{
    int32_t n = 0, last = 0;
    edge[n++] = 0;
    for (int32_t i = 0, at = 0x8000; i < steps; i++, at += s->slope)
        if (at >> 16 != last) {
            last = at >> 16;
            edge[n++] = (int16_t)i;
        }
    edge[n] = (int16_t)steps;
}

/* Returns the place across at which a line from 0 passes after i steps, q16. */
static inline int32_t passes(const struct smear_streak *s, int32_t i)
{
    return s->slope * i;
}

/* Returns the first step at which a line is at or beyond `side` in its direction; `bias` rounds its places. */
static int32_t step_to(const struct smear_streak *s, int32_t side, int32_t bias)
{
    int32_t rest;
    if (s->slope > 0)
        return divide_floor(side * 65536 - bias + s->slope - 1, s->slope, &rest);
    return divide_floor(bias - (side + 1) * 65536, -s->slope, &rest) + 1;
}

/* Narrows steps [*first, *end) to those at which a line from `start` is within [low, high) across. */
static void steps_within(const struct smear_streak *s, int32_t start, int32_t low, int32_t high, int32_t bias,
                         int32_t *first, int32_t *end)
{
    if (s->slope == 0) {
        if (start < low || start >= high)
            *end = *first;
        return;
    }
    *first = max_i32(*first, step_to(s, (s->slope > 0 ? low : high - 1) - start, bias));
    *end = min_i32(*end, step_to(s, (s->slope > 0 ? high : low - 1) - start, bias));
}

/* ------------------------------------------------------------------ sums along a line */

enum {
    NODES = 70,                 /* memory for nodes of each row of a tile; half as many of linear light */
    STEPS_MAX = 640             /* memory for steps of a line; likewise */
};

size_t smear_streak_work(int32_t tile)
{
    return (size_t)(NODES * tile + STEPS_MAX) * sizeof(lanes);
}

/* A line and the part of it on which something may be drawn. */
struct line {
    int32_t start;
    int32_t from, to;           /* steps */
    int32_t place, by, runs;    /* the first place across, what leads to the next one, how many there are */
    const int16_t *edge;        /* the step at which the line comes to each place, and one more */
    int32_t base;               /* sums begin at this step */
};

/* Finds the places across that a line passes from step l->from to step l->to. */
static void find_runs(const struct smear_streak_part *m, struct line *l)
{
    int32_t a = l->start + ((passes(m->s, l->from) + 0x8000) >> 16);
    int32_t b = l->start + ((passes(m->s, l->to - 1) + 0x8000) >> 16);
    int32_t most = m->s->upright ? m->a->stride : m->a->rows;
    int32_t low = clamp_i32(min_i32(a, b), 0, most), high = clamp_i32(max_i32(a, b) + 1, 0, most);
    l->by = m->s->slope < 0 ? -1 : 1;
    l->place = m->s->slope < 0 ? high - 1 : low;
    l->runs = high - low;
    l->edge = m->a->edge + abs_i32(l->place - l->start);
}

/* Finds the steps of run k; returns whether something may be drawn there. */
static inline bool run_of(const struct smear_streak_part *m, const struct line *l, int32_t k, int32_t *first,
                          int32_t *end)
{
    *first = max_i32(l->edge[k], l->from);
    *end = min_i32(l->edge[k + 1], l->to);
    if (!m->s->upright) {
        *first = max_i32(*first, m->a->row_first[l->place + l->by * k]);
        *end = min_i32(*end, m->a->row_end[l->place + l->by * k]);
    }
    return *first < *end;
}

static inline lanes *fill(lanes *out, const lanes *end, lanes value)
{
    for (; out + 4 <= end; out += 4)
        out[0] = out[1] = out[2] = out[3] = value;
    while (out < end)
        *out++ = value;
    return out;
}

/* Sums up steps [base, base + count) of a line. */
static void gather_codes(const struct smear_streak_part *m, const struct line *l, int32_t count)
{
    lanes sum = 0, *out = m->sums.codes, *const zero = out - l->base;
    const int32_t step = m->step, runs = l->runs, side = l->by * m->side;
    const uint32_t *place = m->a->color + l->place * m->side;
    for (int32_t k = 0, first, end; k < runs; k++, place += side) {
        if (!run_of(m, l, k, &first, &end))
            continue;
        out = fill(out, zero + first, sum);
        const uint32_t *in = place + first * step;
        for (lanes *const stop = zero + end; out < stop; in += step) {
            *out++ = sum;
            sum += lanes_of(*in) ^ (lanes)0xff << 48;
        }
    }
    fill(out, m->sums.codes + count, sum);
}

static void gather_light(const struct smear_streak_part *m, const struct line *l, int32_t count)
{
    struct light sum = { 0, 0, 0, 0 }, *out = m->sums.light;
    int32_t at = 0;
    for (int32_t k = 0, first, end; k < l->runs; k++) {
        if (!run_of(m, l, k, &first, &end))
            continue;
        for (; at < first - l->base; at++)
            out[at] = sum;
        const uint32_t *in = m->a->color + (l->place + l->by * k) * m->side + first * m->step;
        for (; at < end - l->base; at++, in += m->step) {
            out[at] = sum;
            if (*in >> 24 != 0)
                continue;
            struct light p = light_of_pixel(*in);
            sum = (struct light){ sum.r + p.r, sum.g + p.g, sum.b + p.b, sum.a + p.a };
        }
    }
    for (; at < count; at++)
        out[at] = sum;
}

/* ------------------------------------------------------------------ means */

/* Returns the mean around a node. *left is the sum of all before its first whole pixel, *right the sum up to its last
 * whole pixel. */
static inline lanes mean_around(const lanes *left, const lanes *right, uint32_t inner, uint32_t rest,
                                lanes half, uint32_t over)
{
    return lanes_mean(lanes_times(right[0] - left[0], inner) + lanes_times(right[1] - left[-1], rest) + half,
                      over);
}

/* Takes the line's means at steps first, first + n ... and shares them out to the places above and below it. */
static void means_codes(const struct smear_streak_part *m, const struct line *l, int32_t first, int32_t end)
{
    const struct smear_streak *s = m->s;
    const uint32_t inner = s->inner, rest = s->rest, over = s->over;
    const lanes half = (s->length >> 1) * 0x0001000100010001u;
    const int32_t n = 1 << s->node, to_right = 2 * s->half + 1, along = m->along, across = m->across;
    const int32_t last = (m->high - m->low - 1) * 65536, climb = s->slope * n;
    const lanes *left = m->sums.codes + (first - s->half - l->base), *const stop = left + (end - first);
    lanes *out = m->node.codes + ((first - m->first) >> s->node) * along;
    int32_t place = (l->start - m->low) * 65536 + passes(s, first);
    if (climb == 0) {           /* the line is a row */
        for (out += l->start * across - m->low * across; left < stop; left += n, out += along)
            *out += mean_around(left, left + to_right, inner, rest, half, over) << 8;
        return;
    }
    for (; left < stop; left += n, out += along, place += climb) {
        lanes mean = mean_around(left, left + to_right, inner, rest, half, over);
        if (mean >> 48 == 0)
            continue;
        lanes *to = out + (place >> 16) * across;
        uint32_t part = (uint32_t)place >> 8 & 255u;
        if (place >= 0)
            to[0] += lanes_times(mean, 256u - part);
        if (place < last)
            to[across] += lanes_times(mean, part);
    }
}

static inline uint32_t mean_light(const struct smear_streak *s, uint32_t a, uint32_t b, uint32_t a1,
                                  uint32_t b1)
{
    return mulh_u32((b - a) * s->inner + (b1 - a1) * s->rest, s->over << 10);
}

static void means_light(const struct smear_streak_part *m, const struct line *l, int32_t first, int32_t end)
{
    const struct smear_streak *s = m->s;
    const int32_t n = 1 << s->node;
    for (int32_t i = first; i < end; i += n) {
        const struct light *p = m->sums.light + (i - s->half - l->base), *q = p + 2 * s->half + 1;
        struct light mean = { mean_light(s, p[0].r, q[0].r, p[-1].r, q[1].r),
                              mean_light(s, p[0].g, q[0].g, p[-1].g, q[1].g),
                              mean_light(s, p[0].b, q[0].b, p[-1].b, q[1].b),
                              mean_light(s, p[0].a, q[0].a, p[-1].a, q[1].a) };
        int32_t place = (l->start - m->low) * 65536 + passes(s, i);
        struct light *out = m->node.light + (place >> 16) * m->across
                          + ((i - m->first) >> s->node) * m->along;
        uint32_t part = (uint32_t)place >> 8 & 255u;
        if (place >= 0)
            light_add(out, &mean, 256u - part);
        if (part != 0 && place >> 16 < m->high - m->low - 1)
            light_add(out + m->across, &mean, part);
    }
}

/* ------------------------------------------------------------------ all lines of a part */

/* Adds the means of the line that starts at place `start` to the part's nodes. */
static void add_line(const struct smear_streak_part *m, int32_t start)
{
    const struct smear_streak *s = m->s;
    const int32_t n = 1 << s->node;
    /* Only nodes within the part's places count. */
    int32_t first = m->first, end = m->first + ((m->nodes - 1) << s->node) + 1;
    steps_within(s, start, m->low - 1, m->high, 0, &first, &end);
    first = (first + n - 1) & -n;
    if (first >= end)
        return;
    struct line l = { .start = start, .from = max_i32(first - s->half - 1, s->upright ? 0 : m->a->x0),
                      .to = min_i32(end + s->half + 1, s->upright ? m->a->rows : m->a->x1) };
    if (l.from >= l.to)
        return;
    find_runs(m, &l);
    /* Something is drawn from the first of its runs to the last. */
    int32_t from, to, none, k = 0;
    while (k < l.runs && !run_of(m, &l, k, &from, &none))
        k++;
    if (k >= l.runs)
        return;
    while (!run_of(m, &l, l.runs - 1, &none, &to))
        l.runs--;
    l.place += l.by * k;
    l.edge += k;
    l.runs -= k;
    l.from = from;
    l.to = to;
    first = max_i32(first, (from - s->half - 1 + n - 1) & -n);
    end = min_i32(end, to + s->half + 1);
    if (first >= end)
        return;
    l.base = first - s->half - 1;
    int32_t count = end - first + 2 * s->half + 3;
    if (m->a->linear) {
        gather_light(m, &l, count);
        means_light(m, &l, first, end);
    } else {
        gather_codes(m, &l, count);
        means_codes(m, &l, first, end);
    }
}

/* ------------------------------------------------------------------ the area */

/* Merges steps [first, end) by places [low, high) across. */
static void merge_part(struct smear_streak_part *m, int32_t first, int32_t end, int32_t low, int32_t high)
{
    const struct smear_streak *s = m->s;
    m->first = first & -(1 << s->node);
    m->end = end;
    m->low = low;
    m->high = high;
    m->nodes = ((end - m->first + (1 << s->node) - 1) >> s->node) + (s->node != 0);
    for (int32_t i = 0; i < high - low && !s->upright; i++) {
        const int32_t more = s->half + (s->rest != 0);
        int32_t from = m->a->stride, to = 0;
        for (int32_t row = max_i32(low + i - s->reach_y, 0);
             row <= min_i32(low + i + s->reach_y, m->a->rows - 1); row++) {
            from = min_i32(from, m->a->row_first[row]);
            to = max_i32(to, m->a->row_first[row] < m->a->row_end[row] ? m->a->row_end[row] : 0);
        }
        m->first_of[i] = (int16_t)(from - more);
        m->end_of[i] = (int16_t)(to + more);
    }
    m->along = s->upright ? high - low : 1;
    m->across = s->upright ? 1 : m->nodes;
    fill(m->node.codes, m->node.codes + (m->a->linear ? 2 : 1) * m->nodes * (high - low), 0);
    int32_t last = m->first + ((m->nodes - 1) << s->node);
    int32_t place0 = passes(s, m->first) >> 16, place1 = passes(s, last) >> 16;
    for (int32_t start = low - (s->slope != 0) - max_i32(place0, place1);
         start < high - min_i32(place0, place1); start++)
        add_line(m, start);
    smear_streak_finish(m);
}

uint32_t smear_streak_merge(const struct smear_streak *s, const struct smear_streak_area *all)
{
    struct smear_streak_area area = *all, *a = &area;
    int32_t left = max_i32(a->left + a->margin, a->x0 - s->reach_x);
    int32_t right = min_i32(a->right + a->margin, a->x1 + s->reach_x), top = a->top,
            bottom = a->top + a->height;
    struct smear_streak_part m = { .s = s, .a = a, .nearest = a->nearest, .farthest = a->farthest,
                       .step = s->upright ? a->stride : 1, .side = s->upright ? 1 : a->stride };
    const int32_t nodes_max = NODES * a->tile, room = a->linear ? nodes_max / 2 : nodes_max;
    m.node.codes = (lanes *)a->work;
    m.sums.codes = m.node.codes + nodes_max;
    if (a->linear) {
        m.node.light = (struct light *)a->work;
        m.sums.light = m.node.light + nodes_max / 2;
    }
    if (left >= right)
        return 0;
    if (a->mixed0 < a->mixed1) {
        smear_streak_find_depths(&m);
    }
    a->marks = a->marks && m.nearest > a->marked_from;
    if (s->upright) {
        int32_t nodes = ((bottom - top) >> s->node) + 2, part = room / nodes;
        for (int32_t x = left; x < right; x += part)
            merge_part(&m, top, bottom, x, min_i32(x + part, right));
    } else {
        int32_t steps = (a->linear ? STEPS_MAX / 2 : STEPS_MAX) - 2 * s->half - 8;
        int32_t part = min_i32(((room / (bottom - top)) - 2) << s->node, steps) & -(1 << s->node);
        SMEAR_ASSERT(part > 0);
        for (int32_t x = left & -(1 << s->node); x < right; x += part)
            merge_part(&m, max_i32(x, left), min_i32(x + part, right), top, bottom);
    }
    return (uint32_t)((right - left) * (bottom - top));
}

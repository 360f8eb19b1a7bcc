/* SPDX-License-Identifier: MIT */
/* streak.c - means along the velocity of a group, by sums along lines.
 *
 * Sums grow along a line, so the mean around each of its pixels is a difference of two, however long it is. A
 * mean along a long way changes little from step to step: it is taken at nodes, a few steps apart, and mixed
 * between them. Lines lie a pixel apart, and pixels between two of them: a node of the frame takes of both.
 *
 *     gather      what is drawn on a line, as sums
 *     means       of the line at its nodes, shared out to the rows it passes between
 *     finish      pixels between nodes, over the still scene by coverage and depth */
#include "layers/streak.h"

#include "base/fixmath.h"
#include "base/pixel.h"

/* ------------------------------------------------------------------ lines */

/* a / b in q16 for |a| <= b < 2^23. */
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
    /* What is off by less than half a pixel at its ends goes straight. */
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

/* The place across at which a line from 0 passes after i steps, q16. */
static inline int32_t passes(const struct smear_streak *s, int32_t i)
{
    return s->slope * i;
}

/* First step at which a line is at or beyond `side` in its direction, places rounded by `bias`. */
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

/* ------------------------------------------------------------------ lanes */

/* Codes: blue, red, green and coverage (255 is one), 16 bits each. Sums wrap; their differences do not. */
typedef uint64_t lanes;

static const lanes all_codes = 0x00ff00ff00ff00ff, halves = 0x0080008000800080;

static inline lanes lanes_of(uint32_t p)
{
    return ((lanes)p << 24 | p) & all_codes;
}

static inline uint32_t lanes_pixel(lanes l)
{
    return (uint32_t)(l | l >> 24) & 0xffffffu;
}

/* No lane overflows. */
static inline lanes lanes_times(lanes l, uint32_t factor)
{
#if UINTPTR_MAX > 0xffffffffu
    return l * factor;
#else
    return (lanes)((uint32_t)(l >> 32) * factor) << 32 | (uint32_t)l * factor;
#endif
}

/* Linear light: 32 bits each, coverage 65535. */
struct light {
    uint32_t r, g, b, a;
};

static inline struct light light_of(uint32_t p)
{
    return (struct light){ smear_srgb_decode[pixel_red(p)], smear_srgb_decode[pixel_green(p)],
                           smear_srgb_decode[pixel_blue(p)], 65535u };
}

/* ------------------------------------------------------------------ what is worked on */

/* Loops of their own for nodes 4 and 8 steps apart, where size does not count. */
#ifdef __OPTIMIZE_SIZE__
#define EACH_NODE 0
#else
#define EACH_NODE 1
#endif

enum {
    NODES = 70,                 /* of each row of a tile, at a time; half as many of linear light */
    STEPS_MAX = 640,            /* along a line, at a time; likewise */
    NEAR = 5                    /* places where depth_near looks */
};

struct merge {
    const struct smear_streak *s;
    const struct smear_streak_area *a;
    int32_t low, high;          /* places across */
    int32_t first, end;         /* steps; the first is a node */
    int32_t nodes;              /* along */
    int32_t along, across;      /* from a node to the next along, and to the next place across */
    uint32_t nearest, farthest; /* depth codes that are drawn */
    bool has_range;             /* those; else what the group keeps to */
    int32_t step, side;         /* from a step or place across to the next in the group's planes */
    union {
        lanes *codes;
        struct light *light;
    } node;
    union {
        lanes *codes;           /* of all before step line.base + i */
        struct light *light;
    } sums;
    /* Of each row that lies along the lines: the steps that are
     * reached. Between nodes means would go on beyond. */
    int16_t first_of[64], end_of[64];
    int16_t near_x[NEAR], near_y[NEAR];         /* from a pixel */
};

size_t smear_streak_work(int32_t tile)
{
    return (size_t)(NODES * tile + STEPS_MAX) * sizeof(lanes);
}

/* A line, and what may be drawn on it. */
struct line {
    int32_t start;
    int32_t from, to;           /* steps */
    int32_t place, by, runs;    /* where across it runs first, what to add for the
                                 * next place, how many there are */
    const int16_t *edge;        /* at which step it comes there; one more */
    int32_t base;               /* sums begin at this step */
};

/* The places across that a line runs along from step from to step to. */
static void find_runs(const struct merge *m, struct line *l)
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

/* The steps of run k; whether something may be drawn there. */
static inline bool run_of(const struct merge *m, const struct line *l, int32_t k, int32_t *first,
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

/* Sums of steps [base, base + count) of a line. */
static void gather_codes(const struct merge *m, const struct line *l, int32_t count)
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

static void gather_light(const struct merge *m, const struct line *l, int32_t count)
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
            struct light p = light_of(*in);
            sum = (struct light){ sum.r + p.r, sum.g + p.g, sum.b + p.b, sum.a + p.a };
        }
    }
    for (; at < count; at++)
        out[at] = sum;
}

/* ------------------------------------------------------------------ means */

/* A weighed sum over all weights, to nearest when half of them was added; equal codes keep theirs. Two
 * lanes at a time: their products have 31 bits. */
static inline lanes mean_codes(lanes weighed, uint32_t over)
{
    const lanes every_other = 0x0000ffff0000ffff, code = 0x000000ff000000ff;
    return (lanes_times(weighed & every_other, over) >> 22 & code)
         | (lanes_times(weighed >> 16 & every_other, over) >> 22 & code) << 16;
}

/* The mean around a node: *right is the sum up to the pixel after its
 * last whole one, *left the sum up to the first. */
static inline lanes mean_around(const lanes *left, const lanes *right, uint32_t inner, uint32_t rest,
                                lanes half, uint32_t over)
{
    return mean_codes(lanes_times(right[0] - left[0], inner) + lanes_times(right[1] - left[-1], rest) + half,
                      over);
}

/* Nodes of the line at steps first, first + n ..., to the places across above and below it. */
static void means_codes(const struct merge *m, const struct line *l, int32_t first, int32_t end)
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

static inline void light_add(struct light *to, const struct light *l, uint32_t part)
{
    to->r += l->r * part;
    to->g += l->g * part;
    to->b += l->b * part;
    to->a += l->a * part;
}

static void means_light(const struct merge *m, const struct line *l, int32_t first, int32_t end)
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

/* ------------------------------------------------------------------ lines, all of them */

static void add_line(const struct merge *m, int32_t start)
{
    const struct smear_streak *s = m->s;
    const int32_t n = 1 << s->node;
    /* Nodes that pass by a place. */
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
    /* What is drawn there: from the first of its runs to the last. */
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

/* ------------------------------------------------------------------ finishing */

/* Over a still pixel, by coverage. */
static inline uint32_t codes_over(lanes m, uint32_t still)
{
    uint32_t rest = 255u - (uint32_t)(m >> 48);
    rest += rest >> 7;
    return lanes_pixel(m + ((lanes_times(lanes_of(still), rest) + halves) >> 8 & all_codes));
}

/* Channels and coverage q16. */
static inline uint32_t light_over(const struct light *m, uint32_t still)
{
    uint32_t rest = (65536u - m->a) >> 1;
    uint32_t r = m->r + (smear_srgb_decode[pixel_red(still)] * rest >> 15);
    uint32_t g = m->g + (smear_srgb_decode[pixel_green(still)] * rest >> 15);
    uint32_t b = m->b + (smear_srgb_decode[pixel_blue(still)] * rest >> 15);
    return pixel_make(0, smear_srgb_encode[min_u32(r >> 4, 4095u)], smear_srgb_encode[min_u32(g >> 4, 4095u)],
                      smear_srgb_encode[min_u32(b >> 4, 4095u)]);
}

/* A mean of codes or of light. */
struct mean {
    lanes codes;
    struct light light;
};

static inline bool mean_is_none(const struct mean *mean, bool linear)
{
    return linear ? mean->light.a == 0 : mean->codes >> 48 == 0;
}

/* Where a still surface lies within the group's depths: of the pixels of the group that
 * are before it. x, y: in the group's planes. */
static SMEAR_NOINLINE void mean_before(struct mean *out, const struct merge *m, int32_t x, int32_t y,
                                       uint32_t still_depth)
{
    const struct smear_streak *s = m->s;
    struct light light = { 0, 0, 0, 0 };
    lanes sum = (s->length >> 1) * 0x0001000100010001u;
    for (int32_t t = -s->half - 1; t <= s->half + 1; t++) {
        int32_t side = (s->slope * t + 0x8000) >> 16, px = x + (s->upright ? side : t),
                py = y + (s->upright ? t : side);
        if (px < m->a->x0 || px >= m->a->x1 || py < 0 || py >= m->a->rows)
            continue;
        int32_t at = py * m->a->stride + px;
        if (m->a->depth[at] <= still_depth)
            continue;
        uint32_t weight = abs_i32(t) > s->half ? s->rest : s->inner + s->rest;
        if (m->a->linear) {
            struct light p = light_of(m->a->color[at]);
            light_add(&light, &p, weight);
        } else {
            sum += lanes_times(lanes_of(m->a->color[at]) | (lanes)0xff << 48, weight);
        }
    }
    out->codes = mean_codes(sum, s->over);
    out->light = (struct light){ mulh_u32(light.r, s->over << 10), mulh_u32(light.g, s->over << 10),
                                 mulh_u32(light.b, s->over << 10),
                                 min_u32(mulh_u32(light.a, s->over << 10), 65536) };
}

/* Depth code of what the mean at a pixel is made of, about: of the
 * next to the middle that is drawn, of five. */
static SMEAR_NOINLINE uint32_t depth_near(const struct merge *m, int32_t x, int32_t y)
{
    const struct smear_streak_area *a = m->a;
    const uint32_t width = (uint32_t)(a->x1 - a->x0), rows = (uint32_t)a->rows;
    for (int k = 0; k < NEAR; k++) {
        int32_t px = x + m->near_x[k], py = y + m->near_y[k];
        if ((uint32_t)(px - a->x0) >= width || (uint32_t)py >= rows)
            continue;
        uint32_t depth = a->depth[py * a->stride + px];
        if (depth != 0)
            return depth;
    }
    return (a->nearest + a->farthest) >> 1;     /* not what find_range leaves: that may come later */
}

/* The middle, and half and all of the way to either side. */
static void find_near(struct merge *m)
{
    const struct smear_streak *s = m->s;
    const int32_t n = (s->half + 1) >> 1;
    for (int k = 0; k < NEAR; k++) {
        int32_t t = k & 1 ? n * ((k + 1) >> 1) : -n * (k >> 1), side = (s->slope * t + 0x8000) >> 16;
        m->near_x[k] = (int16_t)(s->upright ? side : t);
        m->near_y[k] = (int16_t)(s->upright ? t : side);
    }
}

/* Both have their coverage on top. */
static inline lanes over_each_other(lanes front, lanes back)
{
    uint32_t rest = 255u - (uint32_t)(front >> 48);
    return front + ((lanes_times(back, rest + (rest >> 7)) + halves) >> 8 & all_codes);
}

/* (1 - b) still + (1 - a) back + b front: `back`, of coverage b, between the still surface and `front`, of
 * coverage a, which have been merged. Codes. */
static inline uint32_t codes_between_two(lanes front, lanes back, uint32_t merged)
{
    uint32_t a = (uint32_t)(front >> 48), b = (uint32_t)(back >> 48);
    lanes sum = lanes_times(lanes_of(merged), 255u - b) + lanes_times(back, 255u - a) + lanes_times(front, b);
    return lanes_pixel(mean_codes(sum + halves, (1u << 22) / 255u + 1u));
}

static uint32_t light_between_two(lanes front, const struct light *back, uint32_t merged)
{
    uint32_t front_pixel = lanes_pixel(front), out[3];
    const uint32_t value[3] = { back->r, back->g, back->b };
    uint32_t a = (uint32_t)(front >> 48) * 257u >> 1, b = back->a >> 1;       /* q15 */
    for (int i = 0; i < 3; i++) {
        int shift = 16 - 8 * i;
        uint32_t sum = (smear_srgb_decode[merged >> shift & 255u] * (32768u - b) >> 15)
                     + (value[i] * (32768u - a) >> 15)
                     + (smear_srgb_decode[front_pixel >> shift & 255u] * b >> 15);
        out[i] = smear_srgb_encode[min_u32(sum >> 4, 4095u)];
    }
    return pixel_make(0, out[0], out[1], out[2]);
}

/* Over or behind what was merged before. */
static SMEAR_NOINLINE void merge_between(const struct merge *m, const struct mean *mean, lanes codes,
                                         uint32_t depth, int32_t at)
{
    const struct smear_streak_area *a = m->a;
    lanes before = lanes_of(a->over[at]);
    bool behind = depth < a->over_depth[at];
    if (!behind)
        a->still[at] = a->linear ? light_over(&mean->light, a->still[at]) : codes_over(codes, a->still[at]);
    else
        a->still[at] = a->linear ? light_between_two(before, &mean->light, a->still[at])
                                 : codes_between_two(before, codes, a->still[at]);
    if (!a->marks)
        return;
    codes = behind ? over_each_other(before, codes) : over_each_other(codes, before);
    a->over[at] = (uint32_t)(codes | codes >> 24);
    a->over_depth[at] = (uint16_t)max_u32(depth, a->over_depth[at]);
}

static inline void merge_mixed(const struct merge *m, const struct mean *mean, uint32_t depth, int32_t at)
{
    const struct smear_streak_area *a = m->a;
    lanes codes = mean->codes;
    if (a->linear)
        codes = lanes_of(pixel_make(min_u32(mean->light.a >> 8, 255u),
                                    smear_srgb_encode[min_u32(mean->light.r >> 4, 4095u)],
                                    smear_srgb_encode[min_u32(mean->light.g >> 4, 4095u)],
                                    smear_srgb_encode[min_u32(mean->light.b >> 4, 4095u)]));
    if (a->over[at] != 0) {
        merge_between(m, mean, codes, depth, at);
        return;
    }
    a->still[at] = a->linear ? light_over(&mean->light, a->still[at]) : codes_over(codes, a->still[at]);
    if (a->marks) {
        a->over[at] = (uint32_t)(codes | codes >> 24);
        a->over_depth[at] = (uint16_t)depth;
    }
}

/* What is drawn is nearer and thinner than all that the group has in the row. */
static SMEAR_NOINLINE void find_range(struct merge *m)
{
    const struct smear_streak_area *a = m->a;
    uint32_t low = UINT16_MAX, high = 0;
    for (int32_t y = 0; y < a->rows; y++) {
        const uint16_t *depth = a->depth + y * a->stride;
        for (int32_t x = a->row_first[y]; x < a->row_end[y]; x++) {
            uint32_t d = depth[x];
            high = max_u32(high, d);
            low = min_u32(low, d - 1u);         /* 0 is nothing */
        }
    }
    m->has_range = true;
    m->nearest = min_u32(m->nearest, high);
    m->farthest = max_u32(m->farthest, low + 1u);
}

/* A pixel: x, y in the group's planes, `at` in the frame's. */
static void finish_pixel(struct merge *m, struct mean *mean, int32_t x, int32_t y, int32_t at)
{
    const struct smear_streak_area *a = m->a;
    uint32_t depth = a->still_depth[at];
    if (depth >= m->farthest && !m->has_range)
        find_range(m);
    if (depth >= m->nearest)
        return;
    if (depth >= m->farthest) {
        mean_before(mean, m, x, y, depth);
        if (mean_is_none(mean, a->linear))
            return;
    }
    if (x >= a->mixed0 && x < a->mixed1)
        merge_mixed(m, mean, depth_near(m, x, y), at);
    else
        a->still[at] = a->linear ? light_over(&mean->light, a->still[at])
                                 : codes_over(mean->codes, a->still[at]);
}

static inline void finish_codes(struct merge *m, lanes codes, int32_t x, int32_t y, int32_t at)
{
    struct mean mean = { .codes = codes };
    if (codes >> 48 != 0)
        finish_pixel(m, &mean, x, y, at);
}

static inline lanes codes_between(lanes a, lanes b, uint32_t part, int32_t node)
{
    const uint32_t n = 1u << node;
    return (lanes_times(a, n - part) + lanes_times(b, part) + (n >> 1) * 0x0001000100010001u) >> node
         & all_codes;
}

static inline lanes node_codes(lanes node)
{
    return (node + halves) >> 8 & all_codes;
}

static void finish_light(struct merge *m, const struct light *p, const struct light *q, int32_t part,
                         int32_t x, int32_t y, int32_t at)
{
    const uint32_t n = 1u << m->s->node, b = (uint32_t)part, a = n - b;
    const int down = 8 + m->s->node;
    struct mean mean = { 0, { (p->r * a + q->r * b) >> down, (p->g * a + q->g * b) >> down,
                              (p->b * a + q->b * b) >> down, (p->a * a + q->a * b) >> down } };
    mean.light.a = min_u32(mean.light.a, 65536);        /* weights are rounded up */
    if (mean.light.a != 0)
        finish_pixel(m, &mean, x, y, at);
}

static void along_light(struct merge *m)
{
    const int32_t node = m->s->node;
    for (int32_t y = m->low; y < m->high; y++) {
        const int32_t row = (y - m->a->top) * m->a->still_stride - m->a->margin;
        const int32_t first = max_i32(max_i32(m->first, m->a->left + m->a->margin), m->first_of[y - m->low]);
        const struct light *l = m->node.light + (y - m->low) * m->nodes;
        for (int32_t x = first; x < min_i32(m->end, m->end_of[y - m->low]); x++) {
            int32_t k = (x - m->first) >> node;
            finish_light(m, &l[k], &l[min_i32(k + 1, m->nodes - 1)], (x - m->first) & ((1 << node) - 1), x, y,
                         row + x);
        }
    }
}

/* The pixels from one node to the next, straight over the still ones. */
SMEAR_INLINE void between_codes(struct merge *m, lanes here, lanes next, int32_t x, int32_t y, int32_t row,
                                int32_t node)
{
    const uint32_t farthest = m->farthest;
    uint32_t *still = m->a->still + row;
    const uint16_t *depth = m->a->still_depth + row;
    lanes sum = (here << node) + ((1u << node) >> 1) * 0x0001000100010001u;
    int32_t end = x + (1 << node);
    if ((here & next) >> 48 == 255) {
        for (; x < end && depth[x] < farthest; x++, sum += next - here)
            still[x] = lanes_pixel(sum >> node & all_codes);
    }
    for (; x < end; x++, sum += next - here) {
        lanes codes = sum >> node & all_codes;
        if (depth[x] < farthest)
            still[x] = codes_over(codes, still[x]);
        else
            finish_codes(m, codes, x, y, row + x);
    }
}

/* The same where groups pass through each other. */
SMEAR_INLINE void between_mixed_by(struct merge *m, lanes here, lanes next, int32_t x, int32_t y, int32_t row,
                                   int32_t node)
{
    const struct smear_streak_area *a = m->a;
    const bool marks = a->marks;
    const int32_t n = 1 << node, middle = x + (n >> 1);
    uint32_t *over = a->over + row + x, any = 0, nearest = 0;
    uint16_t *over_depth = a->over_depth + row + x;
    for (int32_t i = 0; i < n; i++)
        any |= over[i];
    if (any == 0 && !marks) {
        between_codes(m, here, next, x, y, row, node);
        return;
    }
    for (int32_t i = 0; i < n && any != 0; i++)
        nearest = max_u32(nearest, over[i] != 0 ? over_depth[i] : 0);
    uint32_t near = middle >= a->x0 && middle < a->x1 ? a->depth[y * a->stride + middle] : 0;
    if (near == 0)
        near = depth_near(m, middle, y);
    if (near >= nearest && !marks) {
        between_codes(m, here, next, x, y, row, node);
        return;
    }
    const uint32_t farthest = m->farthest;
    const lanes step = next - here;
    uint32_t *still = a->still + row + x;
    const uint16_t *still_depth = a->still_depth + row + x;
    lanes sum = (here << node) + ((1u << node) >> 1) * 0x0001000100010001u;
    for (int32_t i = 0; i < n; i++, sum += step) {
        lanes codes = sum >> node & all_codes;
        if (still_depth[i] >= farthest) {
            finish_codes(m, codes, x + i, y, row + x + i);
        } else if (any != 0 && codes >> 48 != 0) {
            struct mean mean = { .codes = codes };
            merge_mixed(m, &mean, near, row + x + i);
        } else {
            still[i] = codes_over(codes, still[i]);
            over[i] = (uint32_t)(codes | codes >> 24);
            over_depth[i] = (uint16_t)near;
        }
    }
}

/* Out of line: what it needs would not leave registers to the loops around it. */
static SMEAR_NOINLINE void between_mixed(struct merge *m, lanes here, lanes next, int32_t x, int32_t y,
                                         int32_t row)
{
    if (EACH_NODE && m->s->node == 3)
        between_mixed_by(m, here, next, x, y, row, 3);
    else if (EACH_NODE && m->s->node == 2)
        between_mixed_by(m, here, next, x, y, row, 2);
    else
        between_mixed_by(m, here, next, x, y, row, m->s->node);
}

SMEAR_INLINE void along_codes_by(struct merge *m, int32_t node)
{
    const struct smear_streak_area *a = m->a;
    const int32_t n = 1 << node, last = m->end, mixed0 = a->mixed0, mixed1 = a->mixed1;
    for (int32_t y = m->low; y < m->high; y++) {
        const int32_t row = (y - a->top) * a->still_stride - a->margin;
        const int32_t left = max_i32(a->left + a->margin, m->first_of[y - m->low]);
        const int32_t end = min_i32(last, m->end_of[y - m->low]);
        const lanes *c = m->node.codes + (y - m->low) * m->nodes;
        lanes here = node_codes(*c), next;
        for (int32_t x = m->first; x < end; x += n, here = next) {
            next = node == 0 && x + n >= last ? 0 : node_codes(*++c);
            if (((here | next) >> 48) == 0)
                continue;
            if (x < left || x + n > end)    /* the nodes before the frame's first
                                             * pixel and after its last, too */
                for (int32_t i = max_i32(x, left); i < min_i32(x + n, end); i++)
                    finish_codes(m, codes_between(here, next, (uint32_t)(i - x), node), i, y, row + i);
            else if (x >= mixed1 || x + n <= mixed0)
                between_codes(m, here, next, x, y, row, node);
            else
                between_mixed(m, here, next, x, y, row);
        }
    }
}

static SMEAR_NOINLINE void along_codes_8(struct merge *m) { along_codes_by(m, 3); }
static SMEAR_NOINLINE void along_codes_4(struct merge *m) { along_codes_by(m, 2); }
static SMEAR_NOINLINE void along_codes(struct merge *m) { along_codes_by(m, m->s->node); }

/* Rows whose nodes lie along them. */
static void finish_along(struct merge *m)
{
    if (m->a->linear)
        along_light(m);
    else if (EACH_NODE && m->s->node == 3)
        along_codes_8(m);
    else if (EACH_NODE && m->s->node == 2)
        along_codes_4(m);
    else
        along_codes(m);
}

/* Rows across the lines. */
static void finish_across(struct merge *m)
{
    const struct smear_streak_area *a = m->a;
    const int32_t node = m->s->node;
    for (int32_t y = a->top; y < a->top + a->height; y++) {
        int32_t row = (y - a->top) * a->still_stride - a->margin, k = (y - m->first) >> node;
        int32_t part = (y - m->first) & ((1 << node) - 1), here = k * m->along,
                next = min_i32(k + 1, m->nodes - 1) * m->along;
        for (int32_t x = m->low; x < m->high; x++, here++, next++) {
            if (a->linear)
                finish_light(m, &m->node.light[here], &m->node.light[next], part, x, y, row + x);
            else if (((m->node.codes[here] | m->node.codes[next]) >> 48) != 0)
                finish_codes(m,
                             codes_between(node_codes(m->node.codes[here]), node_codes(m->node.codes[next]),
                                           (uint32_t)part, node),
                             x, y, row + x);
        }
    }
}

/* ------------------------------------------------------------------ the area */

/* Steps [first, end) and places [low, high) across. */
static void merge_part(struct merge *m, int32_t first, int32_t end, int32_t low, int32_t high)
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
    if (s->upright)
        finish_across(m);
    else
        finish_along(m);
}

uint32_t smear_streak_merge(const struct smear_streak *s, const struct smear_streak_area *all)
{
    struct smear_streak_area area = *all, *a = &area;
    int32_t left = max_i32(a->left + a->margin, a->x0 - s->reach_x);
    int32_t right = min_i32(a->right + a->margin, a->x1 + s->reach_x), top = a->top,
            bottom = a->top + a->height;
    struct merge m = { .s = s, .a = a, .nearest = a->nearest, .farthest = a->farthest,
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
        find_near(&m);
        find_range(&m);                 /* at once: what is mixed must not depend on the pixels before */
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

/* SPDX-License-Identifier: MIT */
/* streak.c - means along the velocity of a group, by sums along lines.
 *
 * Sums grow along a line, so the mean around each of its pixels is a difference of two, however long it is. A
 * mean over many pixels changes little from step to step: it is taken at nodes, a few steps apart, and mixed
 * between them. Lines lie a pixel apart, and pixels between two of them: a node of the frame takes of both.
 *
 *     gather      sums what is drawn on a line
 *     means       takes the line's means at its nodes and shares them out to the rows it passes between
 *     finish      mixes pixels between nodes, over the background by coverage and depth. Where the background lies within the
 *                 group's depths, the mean is taken again of what is in front of it; where groups pass through each other, their
 *                 depths tell which is in front */
#include "layers/layer.h"

#include "base/fixmath.h"
#include "base/pixel.h"

enum {
    RED, GREEN, BLUE, COVER, CHANNELS,
    NODES = 35,                 /* memory for nodes of each row of a tile */
    STEPS_MAX = 320,            /* memory for steps of a line */
    NEAR = 5                    /* places where the depth of a mean is looked up */
};

/* A pixel, a sum or a mean: codes, of which coverage 255 is one, or linear light, of which 65535 is. Sums wrap; their differences do
 * not. */
struct sums {
    uint32_t c[CHANNELS];
};

/* The part of an area that is in work: steps [first, end) along the lines by places [low, high) across them. */
struct part {
    const struct smear_streak *s;
    const struct smear_layer_area *a;
    int32_t low, high;          /* places across */
    int32_t first, end;         /* steps; the first is a node */
    int32_t nodes;              /* along */
    int32_t along, across;      /* from a node to the next along, and to the next place across */
    uint32_t nearest, farthest; /* depth codes that are drawn */
    bool marks;                 /* groups are merged after this one: it leaves what they need to know */
    bool has_range;             /* they were found; else they are those that the group keeps to */
    struct sums *node;
    struct sums *sums;          /* of all pixels before a step */
    /* The steps of each row that a mean reaches, where rows lie along the lines: mixed between nodes, means would go on
     * beyond them. */
    int16_t first_of[64], end_of[64];
    int16_t near_x[NEAR], near_y[NEAR];         /* from a pixel */
};

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
        vx = mul_shift(vx, by, 30);
        vy = mul_shift(vy, by, 30);
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

/* Returns the place across at which a line from 0 passes after i steps, q16. */
static inline int32_t passes(const struct smear_streak *s, int32_t i)
{
    return s->slope * i;
}

/* Returns the first step at which a line is at or beyond `side` in its direction. */
static int32_t step_to(const struct smear_streak *s, int32_t side)
{
    int32_t rest;
    if (s->slope > 0)
        return divide_floor(side * 65536 + s->slope - 1, s->slope, &rest);
    return divide_floor(-(side + 1) * 65536, -s->slope, &rest) + 1;
}

/* Narrows steps [*first, *end) to those at which a line from `start` is within [low, high) across. */
static void steps_within(const struct smear_streak *s, int32_t start, int32_t low, int32_t high, int32_t *first, int32_t *end)
{
    if (s->slope == 0) {
        if (start < low || start >= high)
            *end = *first;
        return;
    }
    *first = max_i32(*first, step_to(s, (s->slope > 0 ? low : high - 1) - start));
    *end = min_i32(*end, step_to(s, (s->slope > 0 ? high : low - 1) - start));
}

/* ------------------------------------------------------------------ sums and means along a line */

size_t smear_streak_work(int32_t tile)
{
    return (size_t)(NODES * tile + STEPS_MAX) * sizeof(struct sums);
}

static struct sums sums_of_pixel(uint32_t p, smear_transfer transfer)
{
    return (struct sums){ { value_of_code(pixel_red(p), transfer), value_of_code(pixel_green(p), transfer),
                            value_of_code(pixel_blue(p), transfer), value_of_code(255u, transfer) } };
}

static void sums_add(struct sums *to, const struct sums *l, uint32_t times)
{
    for (int i = 0; i < CHANNELS; i++)
        to->c[i] += l->c[i] * times;
}

/* Divides a weighed sum by all weights. Codes are rounded to nearest: the mean of equal ones is exact. */
static uint32_t mean_of(const struct smear_streak *s, uint32_t weighed, smear_transfer transfer)
{
    return transfer_is_linear(transfer) ? mulh_u32(weighed, s->over << 10) : (weighed + (s->length >> 1)) * s->over >> 22;
}

/* Sums up steps [base, base + count) of the line from place `start`; pixels lie at steps [from, to). */
static void gather(const struct part *m, int32_t start, int32_t base, int32_t count, int32_t from, int32_t to)
{
    const struct smear_layer_area *a = m->a;
    const bool upright = m->s->upright;
    struct sums sum = { { 0, 0, 0, 0 } };
    for (int32_t i = base; i < base + count; i++) {
        const int32_t place = start + ((passes(m->s, i) + 0x8000) >> 16);
        m->sums[i - base] = sum;
        if (i < from || i >= to || place < 0 || place >= (upright ? a->layer->width : a->rows)
            || (!upright && (i < a->layer->row_first[place] || i >= a->layer->row_end[place])))
            continue;
        const uint32_t pixel = a->layer->color[upright ? i * a->layer->width + place : place * a->layer->width + i];
        if (pixel >> 24 != 0)
            continue;
        const struct sums one = sums_of_pixel(pixel, a->transfer);
        sums_add(&sum, &one, 1);
    }
}

/* Takes the line's means at steps first, first + n ... and shares them out to the places above and below it. */
static void means(const struct part *m, int32_t start, int32_t base, int32_t first, int32_t end)
{
    const struct smear_streak *s = m->s;
    for (int32_t i = first; i < end; i += 1 << s->node) {
        const struct sums *p = m->sums + (i - s->half - base), *q = p + 2 * s->half + 1;
        struct sums mean;
        for (int k = 0; k < CHANNELS; k++)
            mean.c[k] = mean_of(s, (q[0].c[k] - p[0].c[k]) * s->inner + (q[1].c[k] - p[-1].c[k]) * s->rest, m->a->transfer);
        const int32_t place = (start - m->low) * 65536 + passes(s, i);
        struct sums *out = m->node + (place >> 16) * m->across + ((i - m->first) >> s->node) * m->along;
        const uint32_t beyond = (uint32_t)place >> 8 & 255u;
        if (place >= 0)
            sums_add(out, &mean, 256u - beyond);
        if (beyond != 0 && place >> 16 < m->high - m->low - 1)
            sums_add(out + m->across, &mean, beyond);
    }
}

/* Adds the means of the line that starts at place `start` to the part's nodes. */
static void add_line(const struct part *m, int32_t start)
{
    const struct smear_streak *s = m->s;
    const int32_t n = 1 << s->node;
    /* Only nodes within the part's places count. */
    int32_t first = m->first, end = m->first + ((m->nodes - 1) << s->node) + 1;
    steps_within(s, start, m->low - 1, m->high, &first, &end);
    first = (first + n - 1) & -n;
    const int32_t from = max_i32(first - s->half - 1, s->upright ? 0 : m->a->group->x0);
    const int32_t to = min_i32(end + s->half + 1, s->upright ? m->a->rows : m->a->group->x1);
    if (first >= end || from >= to)
        return;
    const int32_t base = first - s->half - 1;
    gather(m, start, base, end - first + 2 * s->half + 3, from, to);
    means(m, start, base, first, end);
}

/* ------------------------------------------------------------------ a mean over the background */

/* Returns a pixel of light, coverage left out. */
static uint32_t light_pixel(uint32_t r, uint32_t g, uint32_t b)
{
    return pixel_make(0, code_of_sum(r, TRANSFER_LINEAR), code_of_sum(g, TRANSFER_LINEAR), code_of_sum(b, TRANSFER_LINEAR));
}

/* Returns a mean as a pixel, its colours times its coverage, which lies on top. */
static uint32_t pixel_of_mean(const struct sums *m, smear_transfer transfer)
{
    if (transfer_is_linear(transfer))
        return min_u32(m->c[COVER] >> 8, 255u) << 24 | light_pixel(m->c[RED], m->c[GREEN], m->c[BLUE]);
    return pixel_make(m->c[COVER], m->c[RED], m->c[GREEN], m->c[BLUE]);
}

/* Returns a pixel of colours times coverage over another one, of which coverage is kept, too. */
static uint32_t codes_over(uint32_t front, uint32_t back)
{
    uint32_t rest = 255u - (front >> 24), out = 0;
    rest += rest >> 7;
    for (int shift = 0; shift < 32; shift += 8)
        out |= min_u32((front >> shift & 255u) + (((back >> shift & 255u) * rest + 128u) >> 8), 255u) << shift;
    return out;
}

/* Returns a mean over a pixel of the background, by its coverage. */
static uint32_t mean_over(const struct sums *m, uint32_t background, smear_transfer transfer)
{
    if (!transfer_is_linear(transfer))
        return codes_over(pixel_of_mean(m, TRANSFER_CODES), background & 0xffffffu) & 0xffffffu;
    const uint32_t rest = (65536u - m->c[COVER]) >> 1;          /* q15 */
    return light_pixel(m->c[RED] + (smear_srgb_decode[pixel_red(background)] * rest >> 15),
                       m->c[GREEN] + (smear_srgb_decode[pixel_green(background)] * rest >> 15),
                       m->c[BLUE] + (smear_srgb_decode[pixel_blue(background)] * rest >> 15));
}

/* Takes the mean of those pixels of the group alone that lie in front of the background, which is within the group's
 * depths. x and y count in the group's planes. */
static void mean_before(struct sums *out, const struct part *m, int32_t x, int32_t y, uint32_t background_depth)
{
    const struct smear_streak *s = m->s;
    struct sums sum = { { 0, 0, 0, 0 } };
    for (int32_t t = -s->half - 1; t <= s->half + 1; t++) {
        const int32_t side = (s->slope * t + 0x8000) >> 16, px = x + (s->upright ? side : t), py = y + (s->upright ? t : side);
        if (px < m->a->group->x0 || px >= m->a->group->x1 || py < 0 || py >= m->a->rows)
            continue;
        const int32_t at = py * m->a->layer->width + px;
        if (m->a->layer->depth[at] <= background_depth)
            continue;
        const struct sums one = sums_of_pixel(m->a->layer->color[at], m->a->transfer);
        sums_add(&sum, &one, abs_i32(t) > s->half ? s->rest : s->inner + s->rest);
    }
    for (int i = 0; i < CHANNELS; i++)
        out->c[i] = mean_of(s, sum.c[i], m->a->transfer);
    out->c[COVER] = min_u32(out->c[COVER], 65536u);
}

/* Returns about the depth code of what the mean at a pixel is made of: that of the drawn pixel next to the middle, of
 * the five that find_near() gives. */
static uint32_t depth_near(const struct part *m, int32_t x, int32_t y)
{
    const struct smear_layer_area *a = m->a;
    const uint32_t width = (uint32_t)(a->group->x1 - a->group->x0), rows = (uint32_t)a->rows;
    for (int k = 0; k < NEAR; k++) {
        int32_t px = x + m->near_x[k], py = y + m->near_y[k];
        if ((uint32_t)(px - a->group->x0) >= width || (uint32_t)py >= rows)
            continue;
        uint32_t depth = a->layer->depth[py * a->layer->width + px];
        if (depth != 0)
            return depth;
    }
    return a->group->rank != 0 ? 65536u : (uint32_t)(a->group->nearest + a->group->farthest) >> 1;
}

/* Finds the places where depth_near() looks: the middle, and half and all of the streak's length to either side. */
static void find_near(struct part *m)
{
    const struct smear_streak *s = m->s;
    const int32_t n = (s->half + 1) >> 1;
    for (int k = 0; k < NEAR; k++) {
        int32_t t = k & 1 ? n * ((k + 1) >> 1) : -n * (k >> 1), side = (s->slope * t + 0x8000) >> 16;
        m->near_x[k] = (int16_t)(s->upright ? side : t);
        m->near_y[k] = (int16_t)(s->upright ? t : side);
    }
}

/* Returns `back`, of coverage b, between the background and `front`, of coverage a, which have been merged:
 * (1 - b) merged + (1 - a) back + b front. */
static uint32_t between_two(uint32_t front, const struct sums *back, uint32_t merged, smear_transfer transfer)
{
    uint32_t out[3];
    for (int i = 0; i < 3; i++) {
        const int shift = 16 - 8 * i;
        const uint32_t behind = merged >> shift & 255u, before = front >> shift & 255u;
        if (transfer_is_linear(transfer)) {
            const uint32_t a = (front >> 24) * 257u >> 1, b = back->c[COVER] >> 1;      /* q15 */
            const uint32_t sum = (smear_srgb_decode[behind] * (32768u - b) >> 15) + (back->c[i] * (32768u - a) >> 15)
                               + (smear_srgb_decode[before] * b >> 15);
            out[i] = code_of_sum(sum, TRANSFER_LINEAR);
        } else {
            const uint32_t a = front >> 24, b = back->c[COVER];
            const uint32_t sum = behind * (255u - b) + back->c[i] * (255u - a) + before * b;
            out[i] = (sum + 128u) * ((1u << 22) / 255u + 1u) >> 22;
        }
    }
    return pixel_make(0, out[0], out[1], out[2]);
}

/* Merges a mean over or behind those that were merged before; `depth` is about its depth code. */
static void merge_mixed(const struct part *m, const struct sums *mean, uint32_t depth, int32_t at)
{
    const struct smear_layer_area *a = m->a;
    const uint32_t before = a->layer->over[at], codes = pixel_of_mean(mean, a->transfer);
    const bool behind = before != 0 && depth < a->layer->over_depth[at];
    a->background[at] = behind ? between_two(before, mean, a->background[at], a->transfer)
                               : mean_over(mean, a->background[at], a->transfer);
    if (!m->marks)
        return;
    a->layer->over_depth[at] = (uint16_t)(before != 0 ? max_u32(depth, a->layer->over_depth[at]) : depth);
    a->layer->over[at] = before == 0 ? codes : behind ? codes_over(before, codes) : codes_over(codes, before);
}

/* Narrows the group's depth codes to those of the pixels that are drawn. */
static void find_range(struct part *m)
{
    const struct smear_layer_area *a = m->a;
    uint32_t low = UINT16_MAX, high = 0;
    for (int32_t y = 0; y < a->rows; y++) {
        const uint16_t *depth = a->layer->depth + y * a->layer->width;
        for (int32_t x = a->layer->row_first[y]; x < a->layer->row_end[y]; x++) {
            uint32_t d = depth[x];
            high = max_u32(high, d);
            low = min_u32(low, d - 1u);         /* 0 is nothing */
        }
    }
    m->has_range = true;
    m->nearest = min_u32(m->nearest, high);
    m->farthest = max_u32(m->farthest, low + 1u);
}

/* Merges the mean at a pixel: (x, y) in the group's planes, `at` in the frame's. Pixels of a whole node, which begins at column
 * `node_x`, ask together whether groups pass through each other there, and how far away the mean is; -1: it asks alone. */
static void finish_pixel(struct part *m, struct sums *mean, int32_t x, int32_t y, int32_t at, int32_t node_x)
{
    const struct smear_layer_area *a = m->a;
    const int32_t n = 1 << m->s->node;
    const uint32_t depth = a->background_depth[at];
    if (depth >= m->farthest && !m->has_range)
        find_range(m);
    if (mean->c[COVER] == 0 || depth >= m->nearest)
        return;
    if (depth >= m->farthest) {
        mean_before(mean, m, x, y, depth);
        node_x = -1;
        if (mean->c[COVER] == 0)
            return;
    }
    if (node_x >= 0 ? node_x < a->group->mixed1 && node_x + n > a->group->mixed0 : x >= a->group->mixed0 && x < a->group->mixed1)
        merge_mixed(m, mean, depth_near(m, node_x >= 0 ? node_x + (n >> 1) : x, y), at);
    else
        a->background[at] = mean_over(mean, a->background[at], a->transfer);
}

/* Returns the mean `step` steps behind node p and before node q. */
static struct sums mean_between(const struct part *m, const struct sums *p, const struct sums *q, uint32_t step)
{
    const int node = m->s->node;
    const uint32_t n = 1u << node;
    struct sums mean;
    for (int i = 0; i < CHANNELS; i++) {
        if (transfer_is_linear(m->a->transfer))
            mean.c[i] = (p->c[i] * (n - step) + q->c[i] * step) >> (8 + node);
        else
            mean.c[i] = (((p->c[i] + 128u) >> 8) * (n - step) + ((q->c[i] + 128u) >> 8) * step + (n >> 1)) >> node;
    }
    mean.c[COVER] = min_u32(mean.c[COVER], 65536u);     /* weights are rounded up */
    return mean;
}

/* Finishes rows whose nodes lie along them. A node may lie before the frame's first pixel or after its last. */
static void finish_along(struct part *m)
{
    const struct smear_layer_area *a = m->a;
    const int32_t node = m->s->node, n = 1 << node;
    for (int32_t y = m->low; y < m->high; y++) {
        const int32_t row = (y - a->top) * a->background_stride - a->layer->margin;
        const int32_t left = max_i32(a->left + a->layer->margin, m->first_of[y - m->low]), end = min_i32(m->end, m->end_of[y - m->low]);
        const struct sums *p = m->node + (y - m->low) * m->nodes;
        for (int32_t x = max_i32(m->first, left); x < end; x++) {
            const int32_t k = (x - m->first) >> node, from = m->first + (k << node);
            struct sums mean = mean_between(m, &p[k], &p[min_i32(k + 1, m->nodes - 1)], (uint32_t)(x - from));
            finish_pixel(m, &mean, x, y, row + x, !transfer_is_linear(a->transfer) && from >= left && from + n <= end ? from : -1);
        }
    }
}

/* Finishes rows across the lines. */
static void finish_across(struct part *m)
{
    const struct smear_layer_area *a = m->a;
    const int32_t node = m->s->node;
    for (int32_t y = a->top; y < a->top + a->height; y++) {
        const int32_t row = (y - a->top) * a->background_stride - a->layer->margin, k = (y - m->first) >> node;
        const struct sums *p = m->node + k * m->along, *q = m->node + min_i32(k + 1, m->nodes - 1) * m->along;
        for (int32_t x = m->low; x < m->high; x++, p++, q++) {
            struct sums mean = mean_between(m, p, q, (uint32_t)((y - m->first) & ((1 << node) - 1)));
            finish_pixel(m, &mean, x, y, row + x, -1);
        }
    }
}

/* ------------------------------------------------------------------ the area */

/* Merges steps [first, end) by places [low, high) across. */
static void merge_part(struct part *m, int32_t first, int32_t end, int32_t low, int32_t high)
{
    const struct smear_streak *s = m->s;
    m->first = first & -(1 << s->node);
    m->end = end;
    m->low = low;
    m->high = high;
    m->nodes = ((end - m->first + (1 << s->node) - 1) >> s->node) + (s->node != 0);
    for (int32_t i = 0; i < high - low && !s->upright; i++) {
        const int32_t more = s->half + (s->rest != 0);
        int32_t from = m->a->layer->width, to = 0;
        for (int32_t row = max_i32(low + i - s->reach_y, 0);
             row <= min_i32(low + i + s->reach_y, m->a->rows - 1); row++) {
            from = min_i32(from, m->a->layer->row_first[row]);
            to = max_i32(to, m->a->layer->row_first[row] < m->a->layer->row_end[row] ? m->a->layer->row_end[row] : 0);
        }
        m->first_of[i] = (int16_t)(from - more);
        m->end_of[i] = (int16_t)(to + more);
    }
    m->along = s->upright ? high - low : 1;
    m->across = s->upright ? 1 : m->nodes;
    __builtin_memset(m->node, 0, (size_t)(m->nodes * (high - low)) * sizeof *m->node);
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

uint32_t smear_streak_merge(const struct smear_streak *s, const struct smear_layer_area *a)
{
    const struct smear_group *group = a->group;
    const int32_t left = max_i32(a->left + a->layer->margin, group->x0 - s->reach_x);
    const int32_t right = min_i32(a->right + a->layer->margin, group->x1 + s->reach_x);
    const int32_t top = a->top, bottom = a->top + a->height, room = NODES << a->tile_shift;
    const bool over = group->rank != 0;         /* beyond all codes where it lies over all */
    struct part m = { .s = s, .a = a, .nearest = over ? 65536u : group->nearest, .farthest = over ? 65536u : group->farthest,
                      .node = (struct sums *)a->work };
    m.sums = m.node + room;
    if (left >= right)
        return 0;
    if (a->group->mixed0 < a->group->mixed1) {        /* what is mixed must not depend on the pixels before */
        find_near(&m);
        find_range(&m);
    }
    m.marks = group->marks && m.nearest > group->marked_from;
    if (s->upright) {
        const int32_t width = room / (((bottom - top) >> s->node) + 2);
        for (int32_t x = left; x < right; x += width)
            merge_part(&m, top, bottom, x, min_i32(x + width, right));
    } else {
        const int32_t steps = min_i32(((room / (bottom - top)) - 2) << s->node, STEPS_MAX - 2 * s->half - 8) & -(1 << s->node);
        SMEAR_ASSERT(steps > 0);
        for (int32_t x = left & -(1 << s->node); x < right; x += steps)
            merge_part(&m, max_i32(x, left), min_i32(x + steps, right), top, bottom);
    }
    return (uint32_t)((right - left) * (bottom - top));
}

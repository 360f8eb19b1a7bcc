/* SPDX-License-Identifier: MIT */
/* streak_finish.c - merges the means of a group over the background, by coverage and depth.
 *
 * Pixels between two nodes get a mix of their means. Where the background lies behind the whole group, a pixel costs a
 * blend; where it lies within the group's depths, the mean is taken again of what is in front of it; where groups
 * pass through each other, their depths tell which is in front. */
#include "layers/streak_part.h"

/* Speed wants loops of their own for nodes 4 and 8 steps apart. */
#ifdef __OPTIMIZE_SIZE__
#define EACH_NODE 0
#else
#define EACH_NODE 1
#endif

/* ------------------------------------------------------------------ a pixel over the background */

/* Puts a mean over a pixel of the background, by its coverage. */
static inline uint32_t codes_over(lanes m, uint32_t background)
{
    uint32_t rest = 255u - (uint32_t)(m >> 48);
    rest += rest >> 7;
    return lanes_pixel(m + ((lanes_times(lanes_of(background), rest) + lanes_halves) >> 8 & lanes_codes));
}

/* Puts a mean of light over a pixel; its channels and coverage are q16. */
static inline uint32_t light_over(const struct light *m, uint32_t background)
{
    uint32_t rest = (65536u - m->a) >> 1;
    uint32_t r = m->r + (smear_srgb_decode[pixel_red(background)] * rest >> 15);
    uint32_t g = m->g + (smear_srgb_decode[pixel_green(background)] * rest >> 15);
    uint32_t b = m->b + (smear_srgb_decode[pixel_blue(background)] * rest >> 15);
    return pixel_make(0, smear_srgb_encode[min_u32(r >> 4, 4095u)], smear_srgb_encode[min_u32(g >> 4, 4095u)],
                      smear_srgb_encode[min_u32(b >> 4, 4095u)]);
}

/* A mean, of codes or of light. */
struct mean {
    lanes codes;
    struct light light;
};

static inline bool mean_is_none(const struct mean *mean, bool linear)
{
    return linear ? mean->light.a == 0 : mean->codes >> 48 == 0;
}

/* Takes the mean of those pixels of the group alone that lie in front of the background, which is within the group's
 * depths. x and y count in the group's planes. */
static SMEAR_NOINLINE void mean_before(struct mean *out, const struct smear_streak_part *m, int32_t x, int32_t y,
                                       uint32_t background_depth)
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
        if (m->a->depth[at] <= background_depth)
            continue;
        uint32_t weight = abs_i32(t) > s->half ? s->rest : s->inner + s->rest;
        if (m->a->linear) {
            struct light p = light_of_pixel(m->a->color[at]);
            light_add(&light, &p, weight);
        } else {
            sum += lanes_times(lanes_of(m->a->color[at]) | (lanes)0xff << 48, weight);
        }
    }
    out->codes = lanes_mean(sum, s->over);
    out->light = (struct light){ mulh_u32(light.r, s->over << 10), mulh_u32(light.g, s->over << 10),
                                 mulh_u32(light.b, s->over << 10),
                                 min_u32(mulh_u32(light.a, s->over << 10), 65536) };
}

/* Returns about the depth code of what the mean at a pixel is made of: that of the drawn pixel next to the middle, of
 * the five that find_near() gives. */
static SMEAR_NOINLINE uint32_t depth_near(const struct smear_streak_part *m, int32_t x, int32_t y)
{
    const struct smear_streak_area *a = m->a;
    const uint32_t width = (uint32_t)(a->x1 - a->x0), rows = (uint32_t)a->rows;
    for (int k = 0; k < STREAK_NEAR; k++) {
        int32_t px = x + m->near_x[k], py = y + m->near_y[k];
        if ((uint32_t)(px - a->x0) >= width || (uint32_t)py >= rows)
            continue;
        uint32_t depth = a->depth[py * a->stride + px];
        if (depth != 0)
            return depth;
    }
    return (a->nearest + a->farthest) >> 1;     /* not those of find_range(), which may be called later */
}

/* Finds the places where depth_near() looks: the middle, and half and all of the streak's length to either side. */
static void find_near(struct smear_streak_part *m)
{
    const struct smear_streak *s = m->s;
    const int32_t n = (s->half + 1) >> 1;
    for (int k = 0; k < STREAK_NEAR; k++) {
        int32_t t = k & 1 ? n * ((k + 1) >> 1) : -n * (k >> 1), side = (s->slope * t + 0x8000) >> 16;
        m->near_x[k] = (int16_t)(s->upright ? side : t);
        m->near_y[k] = (int16_t)(s->upright ? t : side);
    }
}

/* Puts one mean over another; the top lane of both is coverage. */
static inline lanes over_each_other(lanes front, lanes back)
{
    uint32_t rest = 255u - (uint32_t)(front >> 48);
    return front + ((lanes_times(back, rest + (rest >> 7)) + lanes_halves) >> 8 & lanes_codes);
}

/* Puts `back`, of coverage b, between the background and `front`, of coverage a, which have been merged:
 * (1 - b) merged + (1 - a) back + b front. */
static inline uint32_t codes_between_two(lanes front, lanes back, uint32_t merged)
{
    uint32_t a = (uint32_t)(front >> 48), b = (uint32_t)(back >> 48);
    lanes sum = lanes_times(lanes_of(merged), 255u - b) + lanes_times(back, 255u - a) + lanes_times(front, b);
    return lanes_pixel(lanes_mean(sum + lanes_halves, (1u << 22) / 255u + 1u));
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

/* Merges a mean over or behind those that were merged before. */
static SMEAR_NOINLINE void merge_between(const struct smear_streak_part *m, const struct mean *mean, lanes codes,
                                         uint32_t depth, int32_t at)
{
    const struct smear_streak_area *a = m->a;
    lanes before = lanes_of(a->over[at]);
    bool behind = depth < a->over_depth[at];
    if (!behind)
        a->background[at] = a->linear ? light_over(&mean->light, a->background[at])
                                      : codes_over(codes, a->background[at]);
    else
        a->background[at] = a->linear ? light_between_two(before, &mean->light, a->background[at])
                                      : codes_between_two(before, codes, a->background[at]);
    if (!a->marks)
        return;
    codes = behind ? over_each_other(before, codes) : over_each_other(codes, before);
    a->over[at] = (uint32_t)(codes | codes >> 24);
    a->over_depth[at] = (uint16_t)max_u32(depth, a->over_depth[at]);
}

static inline void merge_mixed(const struct smear_streak_part *m, const struct mean *mean, uint32_t depth, int32_t at)
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
    a->background[at] = a->linear ? light_over(&mean->light, a->background[at]) : codes_over(codes, a->background[at]);
    if (a->marks) {
        a->over[at] = (uint32_t)(codes | codes >> 24);
        a->over_depth[at] = (uint16_t)depth;
    }
}

/* Narrows the group's depth codes to those of the pixels that are drawn. */
static SMEAR_NOINLINE void find_range(struct smear_streak_part *m)
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

/* Merges the mean at a pixel: (x, y) in the group's planes, `at` in the frame's. */
static void finish_pixel(struct smear_streak_part *m, struct mean *mean, int32_t x, int32_t y, int32_t at)
{
    const struct smear_streak_area *a = m->a;
    uint32_t depth = a->background_depth[at];
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
        a->background[at] = a->linear ? light_over(&mean->light, a->background[at])
                                      : codes_over(mean->codes, a->background[at]);
}

static inline void finish_codes(struct smear_streak_part *m, lanes codes, int32_t x, int32_t y, int32_t at)
{
    struct mean mean = { .codes = codes };
    if (codes >> 48 != 0)
        finish_pixel(m, &mean, x, y, at);
}

static inline lanes codes_between(lanes a, lanes b, uint32_t part, int32_t node)
{
    const uint32_t n = 1u << node;
    return (lanes_times(a, n - part) + lanes_times(b, part) + (n >> 1) * 0x0001000100010001u) >> node
         & lanes_codes;
}

static inline lanes node_codes(lanes node)
{
    return (node + lanes_halves) >> 8 & lanes_codes;
}

static void finish_light(struct smear_streak_part *m, const struct light *p, const struct light *q, int32_t part,
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

static void along_light(struct smear_streak_part *m)
{
    const int32_t node = m->s->node;
    for (int32_t y = m->low; y < m->high; y++) {
        const int32_t row = (y - m->a->top) * m->a->background_stride - m->a->margin;
        const int32_t first = max_i32(max_i32(m->first, m->a->left + m->a->margin), m->first_of[y - m->low]);
        const struct light *l = m->node.light + (y - m->low) * m->nodes;
        for (int32_t x = first; x < min_i32(m->end, m->end_of[y - m->low]); x++) {
            int32_t k = (x - m->first) >> node;
            finish_light(m, &l[k], &l[min_i32(k + 1, m->nodes - 1)], (x - m->first) & ((1 << node) - 1), x, y,
                         row + x);
        }
    }
}

/* Merges the pixels from one node to the next over the background alone. */
SMEAR_INLINE void between_codes(struct smear_streak_part *m, lanes here, lanes next, int32_t x, int32_t y, int32_t row,
                                int32_t node)
{
    const uint32_t farthest = m->farthest;
    uint32_t *background = m->a->background + row;
    const uint16_t *depth = m->a->background_depth + row;
    lanes sum = (here << node) + ((1u << node) >> 1) * 0x0001000100010001u;
    int32_t end = x + (1 << node);
    if ((here & next) >> 48 == 255) {
        for (; x < end && depth[x] < farthest; x++, sum += next - here)
            background[x] = lanes_pixel(sum >> node & lanes_codes);
    }
    for (; x < end; x++, sum += next - here) {
        lanes codes = sum >> node & lanes_codes;
        if (depth[x] < farthest)
            background[x] = codes_over(codes, background[x]);
        else
            finish_codes(m, codes, x, y, row + x);
    }
}

/* Merges the pixels from one node to the next where groups pass through each other. */
SMEAR_INLINE void between_mixed_by(struct smear_streak_part *m, lanes here, lanes next, int32_t x, int32_t y,
                                   int32_t row, int32_t node)
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
    uint32_t *background = a->background + row + x;
    const uint16_t *background_depth = a->background_depth + row + x;
    lanes sum = (here << node) + ((1u << node) >> 1) * 0x0001000100010001u;
    for (int32_t i = 0; i < n; i++, sum += step) {
        lanes codes = sum >> node & lanes_codes;
        if (background_depth[i] >= farthest) {
            finish_codes(m, codes, x + i, y, row + x + i);
        } else if (any != 0 && codes >> 48 != 0) {
            struct mean mean = { .codes = codes };
            merge_mixed(m, &mean, near, row + x + i);
        } else {
            background[i] = codes_over(codes, background[i]);
            over[i] = (uint32_t)(codes | codes >> 24);
            over_depth[i] = (uint16_t)near;
        }
    }
}

/* It stays out of line: inlined, it would leave no registers to the loops around it. */
static SMEAR_NOINLINE void between_mixed(struct smear_streak_part *m, lanes here, lanes next, int32_t x, int32_t y,
                                         int32_t row)
{
    if (EACH_NODE && m->s->node == 3)
        between_mixed_by(m, here, next, x, y, row, 3);
    else if (EACH_NODE && m->s->node == 2)
        between_mixed_by(m, here, next, x, y, row, 2);
    else
        between_mixed_by(m, here, next, x, y, row, m->s->node);
}

SMEAR_INLINE void along_codes_by(struct smear_streak_part *m, int32_t node)
{
    const struct smear_streak_area *a = m->a;
    const int32_t n = 1 << node, last = m->end, mixed0 = a->mixed0, mixed1 = a->mixed1;
    for (int32_t y = m->low; y < m->high; y++) {
        const int32_t row = (y - a->top) * a->background_stride - a->margin;
        const int32_t left = max_i32(a->left + a->margin, m->first_of[y - m->low]);
        const int32_t end = min_i32(last, m->end_of[y - m->low]);
        const lanes *c = m->node.codes + (y - m->low) * m->nodes;
        lanes here = node_codes(*c), next;
        for (int32_t x = m->first; x < end; x += n, here = next) {
            next = node == 0 && x + n >= last ? 0 : node_codes(*++c);
            if (((here | next) >> 48) == 0)
                continue;
            if (x < left || x + n > end)    /* a node may lie before the frame's first pixel or after its last */
                for (int32_t i = max_i32(x, left); i < min_i32(x + n, end); i++)
                    finish_codes(m, codes_between(here, next, (uint32_t)(i - x), node), i, y, row + i);
            else if (x >= mixed1 || x + n <= mixed0)
                between_codes(m, here, next, x, y, row, node);
            else
                between_mixed(m, here, next, x, y, row);
        }
    }
}

static SMEAR_NOINLINE void along_codes_8(struct smear_streak_part *m) { along_codes_by(m, 3); }
static SMEAR_NOINLINE void along_codes_4(struct smear_streak_part *m) { along_codes_by(m, 2); }
static SMEAR_NOINLINE void along_codes(struct smear_streak_part *m) { along_codes_by(m, m->s->node); }

/* Finishes rows whose nodes lie along them. */
static void finish_along(struct smear_streak_part *m)
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

/* Finishes rows across the lines. */
static void finish_across(struct smear_streak_part *m)
{
    const struct smear_streak_area *a = m->a;
    const int32_t node = m->s->node;
    for (int32_t y = a->top; y < a->top + a->height; y++) {
        int32_t row = (y - a->top) * a->background_stride - a->margin, k = (y - m->first) >> node;
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

void smear_streak_find_depths(struct smear_streak_part *m)
{
    find_near(m);
    find_range(m);
}

void smear_streak_finish(struct smear_streak_part *m)
{
    if (m->s->upright)
        finish_across(m);
    else
        finish_along(m);
}

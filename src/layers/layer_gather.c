/* SPDX-License-Identifier: MIT */
/* layer_gather.c - what a pixel sees of a moving layer: each tap is a place that the layer's surface may have come
 * from. A tap counts if its own velocity carries it here, and for the share of the exposure that it spends on the
 * stretch it stands for; what is left of the exposure shows the background. */
#include "layers/layer.h"

#include "filter/gather.h"

/* ------------------------------------------------------------------ velocities */

static inline struct smear_pixel_velocity velocity_at(const struct smear_layer_rows *l, int32_t at)
{
    return velocity_load(l->velocity8, l->velocity16, (uint32_t)at);
}

static inline int32_t square_of(struct smear_pixel_velocity v)
{
    return v.x * v.x + v.y * v.y;
}

void smear_gather_cells(const struct smear_layer_area *a)
{
    const struct smear_layer_rows *l = a->layer;
    const int32_t count = (l->width >> a->tile_shift) + 1;
    struct smear_layer_cell *own = l->cell, *around = l->cell + count;
    for (int32_t i = 0; i < count; i++) {
        struct smear_pixel_velocity longest = { 0, 0 };
        const int32_t x0 = max_i32(i << a->tile_shift, a->group->x0), x1 = min_i32((i + 1) << a->tile_shift, a->group->x1);
        uint32_t last = 0;                  /* of nothing that moves */
        for (int32_t y = 0; y < a->rows; y++)
            for (int32_t x = x0; x < x1; x++) {
                const uint32_t word = velocity_word(l->velocity8, l->velocity16, (uint32_t)(y * l->width + x));
                if (word == last)
                    continue;
                last = word;
                const struct smear_pixel_velocity v = velocity_at(l, y * l->width + x);
                if (square_of(v) > square_of(longest))
                    longest = v;
            }
        own[i] = (struct smear_layer_cell){ (int16_t)longest.x, (int16_t)longest.y };
    }
    for (int32_t i = 0; i < count; i++) {
        around[i] = own[i];
        for (int32_t k = max_i32(i - 1, 0); k <= min_i32(i + 1, count - 1); k++) {
            struct smear_pixel_velocity v = { own[k].x, own[k].y }, best = { around[i].x, around[i].y };
            if (square_of(v) > square_of(best))
                around[i] = own[k];
        }
    }
}

/* ------------------------------------------------------------------ a pixel */

enum { WHOLE = 4096 };          /* weight of the whole exposure */

/* Adds a pixel as codes, or as linear light of 12 bits. */
static inline void sum_add(struct weighed_sum *s, uint32_t p, uint32_t weight, smear_transfer transfer)
{
    weighed_add(s, p, weight, transfer, 4);
}

static uint32_t sum_mean(const struct weighed_sum *s, smear_transfer transfer)
{
    const int zeros = count_leading_zeros(s->weight);
    /* 2^(61 - zeros) / weight, which is that less one of most pixels. */
    const uint32_t r = s->weight == WHOLE ? (1u << 30) - 1u : recip_norm_precise(s->weight << zeros);
    uint32_t half = s->weight >> 1, c[3] = { s->r + half, s->g + half, s->b + half };
    for (int i = 0; i < 3; i++)
        c[i] = code_of_short(mulh_u32(c[i], r) >> (29 - zeros), transfer);
    return pixel_make(0, c[0], c[1], c[2]);
}

/* Returns the mean with the background for what is missing of the whole exposure; what is too much is shared. */
static uint32_t sum_pixel(struct weighed_sum *s, uint32_t background, smear_transfer transfer)
{
    if (s->weight < WHOLE)
        sum_add(s, background, WHOLE - s->weight, transfer);
    return sum_mean(s, transfer);
}

/* Taps along a direction, and the weight of those that meet the newest velocity. */
struct taps {
    struct smear_pixel_velocity d;
    int32_t length;             /* q6 px */
    int32_t count, over;        /* over: 16384 / count */
    struct {
        int32_t offset;         /* in the layer's rows */
        int32_t distance;       /* q6 px */
    } tap[SMEAR_GATHER_TAPS];
    uint32_t word;              /* the newest velocity */
    int32_t carries;            /* how far it carries a surface along the direction, q6 px; negative: elsewhere */
    uint32_t weight;            /* of a tap that meets it */
};

static void taps_start(struct taps *t, struct smear_pixel_velocity d, uint32_t word, int32_t width)
{
    const int32_t n = t->count;
    t->d = d;
    t->length = (int32_t)sqrt_q3((uint32_t)square_of(d));
    /* Taps lie from one end of the direction to the other, in q16 px. */
    int32_t step_x = d.x * t->over, step_y = d.y * t->over, step = t->length * t->over >> 13;
    int32_t x = 0x8000 - d.x * 8192 + (step_x >> 1), y = 0x8000 - d.y * 8192 + (step_y >> 1);
    int32_t distance = t->length - (step >> 1);
    for (int32_t k = 0; k < n; k++, x += step_x, y += step_y, distance -= step) {
        t->tap[k].offset = (y >> 16) * width + (x >> 16);
        t->tap[k].distance = abs_i32(distance);
    }
    t->word = word;
    t->carries = t->length + 32;
    t->weight = (uint32_t)((WHOLE + n - 1) / n);
}

static void taps_meet(struct taps *t, struct smear_pixel_velocity v, uint32_t word)
{
    int32_t dot = v.x * t->d.x + v.y * t->d.y, cross = abs_i32(v.x * t->d.y - v.y * t->d.x);
    int32_t speed = (int32_t)sqrt_q3((uint32_t)square_of(v));
    t->word = word;
    t->carries = -1;
    if (dot <= 0 || 2 * cross > dot)        /* more than 27 degrees off */
        return;
    t->carries = speed + 32;
    t->weight = min_u32((uint32_t)((WHOLE + t->count - 1) / t->count * t->length)
                            / (uint32_t)max_i32(speed, 32),
                        WHOLE);
}

enum { PROBES = 8 };

/* What the pixels of an area share. */
struct gathering {
    const struct smear_layer_area *a;
    const uint32_t *color;
    const uint16_t *depth;
    int32_t width;
    struct taps taps;
    /* Places that a surface may come from, along the longest velocity around in both senses, and how fast it must
     * be to do so. */
    struct smear_pixel_velocity top;
    struct {
        int32_t offset;
        int32_t least;          /* square of 1/8 px */
    } probe[PROBES];
};

static void probes_start(struct gathering *g, struct smear_pixel_velocity top)
{
    g->top = top;
    for (int32_t i = 0; i < PROBES; i++) {
        int32_t k = (i & 1 ? -1 : 1) * ((i >> 1) + 1);      /* quarters of `top` */
        g->probe[i].offset = ((top.y * k + 16) >> 5) * g->width + ((top.x * k + 16) >> 5);
        int32_t x = max_i32(abs_i32(top.x * k >> 2) - 6, 0), y = max_i32(abs_i32(top.y * k >> 2) - 6, 0);
        g->probe[i].least = max_i32(x * x + y * y, 16);
    }
}

/* Finds a surface of the layer that passes by a pixel where none is in the middle of the exposure. Returns the nearest
 * place whose velocity comes this far, or -1. */
static inline int32_t find_direction(const struct gathering *g, int32_t here, uint32_t background_depth)
{
    for (int32_t i = 0; i < PROBES; i++) {
        int32_t at = here + g->probe[i].offset;
        if (g->depth[at] > background_depth && square_of(velocity_at(g->a->layer, at)) >= g->probe[i].least)
            return at;
    }
    return -1;
}

/* Loads a velocity as one word that is only good for comparing. */
SMEAR_INLINE uint32_t word_at(const struct smear_layer_rows *l, int32_t at)
{
    return velocity_word(l->velocity8, l->velocity16, (uint32_t)at);
}

/* What a pixel sees of the layer: what lies in front of groups that were merged before, or all of it, and what lies
 * behind them. */
struct seen {
    struct weighed_sum sum, behind;
    uint32_t passed_depth;      /* of those groups; 0: there are none */
};

static struct weighed_sum *sum_of(struct seen *s, uint32_t depth)
{
    return depth < s->passed_depth ? &s->behind : &s->sum;
}

/* Sums up the taps of a pixel. Where its own surface moves (`own`) and a tap meets one that does not come here, that
 * one either is hidden by a nearer surface or has left a farther one uncovered. */
static void gather(struct gathering *g, struct seen *seen, int32_t here, bool own, uint32_t background_depth)
{
    struct taps *t = &g->taps;
    const struct smear_layer_rows *l = g->a->layer;
    const uint32_t even = (uint32_t)((WHOLE + t->count - 1) / t->count);
    for (int32_t k = 0; k < t->count; k++) {
        int32_t at = here + t->tap[k].offset;
        if (g->depth[at] <= background_depth)
            continue;
        uint32_t word = word_at(l, at);
        if (word != t->word)
            taps_meet(t, velocity_at(l, at), word);
        if (t->tap[k].distance <= t->carries)
            sum_add(sum_of(seen, g->depth[at]), g->color[at], t->weight, g->a->transfer);
        else if (own) {
            int32_t of = g->depth[at] > g->depth[here] ? here : at;
            sum_add(sum_of(seen, g->depth[of]), g->color[of], even, g->a->transfer);
        }
    }
}

/* Sums up what a pixel sees, `here` in the layer's rows. Returns the index there of the surface it sees, or -1. */
static int32_t look(struct gathering *g, struct seen *seen, int32_t here, uint32_t background_depth, uint32_t *taken)
{
    int32_t of = -1;
    const bool drawn = g->depth[here] > background_depth;
    struct smear_pixel_velocity d = { 0, 0 };
    if (drawn) {
        d = velocity_at(g->a->layer, here);
        if (square_of(d) >= 16)             /* half a pixel */
            of = here;
    }
    const bool stays = drawn && of < 0;
    if (of < 0)
        of = find_direction(g, here, background_depth);
    if (of >= 0) {
        uint32_t word = word_at(g->a->layer, of);
        d = velocity_at(g->a->layer, of);
        if (d.x != g->taps.d.x || d.y != g->taps.d.y)
            taps_start(&g->taps, d, word, g->width);
        gather(g, seen, here, of == here, background_depth);
        *taken += (uint32_t)g->taps.count;
    }
    const uint32_t weight = seen->sum.weight + seen->behind.weight;
    if (stays && weight < WHOLE)
        sum_add(sum_of(seen, g->depth[here]), g->color[here], WHOLE - weight, g->a->transfer);
    return drawn ? here : of;
}

/* ------------------------------------------------------------------ between other groups */

/* Returns a + (b - a) part / WHOLE, in codes or their light. */
static uint32_t mixed_channel(uint32_t a, uint32_t b, uint32_t part, smear_transfer transfer)
{
    return code_of_short((short_of_code(a, transfer) * (WHOLE - part) + short_of_code(b, transfer) * part + WHOLE / 2) >> 12, transfer);
}

static uint32_t mixed_pixel(uint32_t a, uint32_t b, uint32_t part, smear_transfer transfer)
{
    return pixel_make(0, mixed_channel(pixel_red(a), pixel_red(b), part, transfer),
                      mixed_channel(pixel_green(a), pixel_green(b), part, transfer),
                      mixed_channel(pixel_blue(a), pixel_blue(b), part, transfer));
}

/* Returns an opaque pixel as it is seen past `passed`: colours times coverage, coverage on top. */
static uint32_t behind_passed(uint32_t passed, uint32_t pixel, smear_transfer transfer)
{
    const uint32_t rest = ((255u - (passed >> 24)) * WHOLE + 127u) / 255u;
    uint32_t out = mixed_pixel(0, pixel, rest, transfer), sum[3];
    for (int i = 0; i < 3; i++) {
        uint32_t a = out >> 8 * i & 255u, b = passed >> 8 * i & 255u;
        sum[i] = code_of_sum(value_of_code(a, transfer) + value_of_code(b, transfer), transfer);
    }
    return pixel_make(0, sum[2], sum[1], sum[0]);
}

/* Puts `part` of a pixel over what has passed, coverage included. */
static uint32_t over_passed(uint32_t passed, uint32_t pixel, uint32_t part, smear_transfer transfer)
{
    uint32_t a = ((passed >> 24) * (WHOLE - part) + 255u * part + WHOLE / 2) >> 12;
    return a << 24 | mixed_pixel(passed & 0xffffffu, pixel, part, transfer);
}

/* Merges a pixel; `mixed`: where other groups were merged before this one, what lies behind them goes between them and what they
 * were merged over. */
static void merge_pixel(struct gathering *g, int32_t here, uint32_t background_depth, int32_t at, bool mixed, uint32_t *taken)
{
    const struct smear_layer_area *a = g->a;
    uint32_t passed = mixed ? a->layer->over[at] : 0;
    struct seen seen = { .passed_depth = passed != 0 ? (uint32_t)a->layer->over_depth[at] : 0u };
    const int32_t of = look(g, &seen, here, background_depth, taken);
    const uint32_t front = min_u32(seen.sum.weight, WHOLE);
    if (seen.behind.weight != 0 && front < WHOLE) {
        /* The share of the time in which nothing of the layer is in front. */
        const uint32_t part = seen.behind.weight >= WHOLE - front
                                ? (uint32_t)WHOLE
                                : (seen.behind.weight << 12) / (WHOLE - front);
        const uint32_t whole = behind_passed(passed, sum_mean(&seen.behind, a->transfer), a->transfer);
        a->background[at] = mixed_pixel(a->background[at], whole, part, a->transfer);
        const uint32_t coverage = passed >> 24;
        passed = (coverage + (((255u - coverage) * part + WHOLE / 2) >> 12)) << 24
               | mixed_pixel(passed & 0xffffffu, whole, part, a->transfer);
    }
    const struct weighed_sum sum = seen.sum;
    if (front != 0)
        a->background[at] = sum_pixel(&seen.sum, a->background[at], a->transfer);
    if (!mixed || !a->group->marks || (front | seen.behind.weight) == 0)
        return;
    if (front != 0)
        passed = over_passed(passed, sum_mean(&sum, a->transfer), front, a->transfer);
    const uint32_t depth = of >= 0 ? g->depth[of] : 0;
    a->layer->over_depth[at] = (uint16_t)max_u32(depth, seen.passed_depth);
    a->layer->over[at] = passed;
}

/* Finds the columns that taps may reach the group from. */
static void reached(const struct smear_layer_area *a, int32_t *left, int32_t *right)
{
    *left = max_i32(a->left, a->group->x0 - a->layer->margin - a->top);
    *right = min_i32(a->right, a->group->x1 - a->layer->margin + a->top);
}

uint32_t smear_gather_merge(const struct smear_layer_area *a)
{
    const struct smear_layer_rows *l = a->layer;
    const struct smear_layer_cell *around = l->cell + (l->width >> a->tile_shift) + 1;
    struct gathering g = { .a = a, .color = l->color, .depth = l->depth, .width = l->width };
    g.taps.count = a->samples;
    g.taps.over = 16384 / a->samples;
    probes_start(&g, g.top);
    uint32_t taken = 0;
    int32_t left, right;
    reached(a, &left, &right);
    for (int32_t y = 0; y < a->height; y++) {
        const uint16_t *depth = a->background_depth + y * a->background_stride;
        for (int32_t x = left; x < right; x++) {
            const struct smear_layer_cell *cell = &around[(x + l->margin) >> a->tile_shift];
            const struct smear_pixel_velocity top = { cell->x, cell->y };
            uint32_t background_depth = a->group->rank != 0 ? 0 : depth[x];
            if (top.x != g.top.x || top.y != g.top.y)
                probes_start(&g, top);
            int32_t here = (y + a->top) * l->width + x + l->margin;
            merge_pixel(&g, here, background_depth, y * a->background_stride + x,
                        x + l->margin >= a->group->mixed0 && x + l->margin < a->group->mixed1, &taken);
        }
    }
    return taken;
}

/* ------------------------------------------------------------------ one velocity, few taps */

uint32_t smear_two_camera_merge(const struct smear_layer_area *a, int32_t vx, int32_t vy)
{
    const struct smear_layer_rows *l = a->layer;
    const int32_t n = a->samples;
    const uint32_t weight = (uint32_t)((WHOLE + n - 1) / n);
    int32_t left, right;
    reached(a, &left, &right);
    for (int32_t y = 0; y < a->height; y++)
        for (int32_t x = left; x < right; x++) {
            uint32_t *background = a->background + y * a->background_stride + x;
            uint32_t background_depth = a->group->rank != 0 ? 0 : a->background_depth[y * a->background_stride + x];
            struct weighed_sum sum = { 0, 0, 0, 0 };
            for (int32_t k = 0; k < n; k++) {
                int32_t part = (2 * k + 1 - n) * 128 / n;           /* q8, -1/2 .. 1/2 */
                int32_t at = (y + a->top + ((vy * part + 0x8000) >> 16)) * l->width + x + l->margin
                           + ((vx * part + 0x8000) >> 16);
                if (l->depth[at] > background_depth)
                    sum_add(&sum, l->color[at], weight, a->transfer);
            }
            if (sum.weight != 0)
                *background = sum_pixel(&sum, *background, a->transfer);
        }
    return (uint32_t)(a->height * (a->right - a->left) * n);
}

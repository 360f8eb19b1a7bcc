/* SPDX-License-Identifier: MIT */
/* layered.c - what a pixel sees of a moving layer: each tap is a place the layer's surface may have come from. It counts if
 * its own velocity carries it here, and for the share of the exposure it spends on the stretch it stands for; what is left
 * of the exposure shows the still scene. */
#include "layered.h"

#include "fixmath.h"
#include "pixel.h"

/* ------------------------------------------------------------------ velocities */

struct vector {
    int32_t x, y;               /* half the displacement in the exposure, 1/8 px */
};

static inline struct vector velocity_at(const struct smear_layer_rows *l, int32_t at)
{
    if (l->velocity8 != NULL)
        return (struct vector){ l->velocity8[2 * at], l->velocity8[2 * at + 1] };
    return (struct vector){ l->velocity16[2 * at], l->velocity16[2 * at + 1] };
}

static inline int32_t square_of(struct vector v)
{
    return v.x * v.x + v.y * v.y;
}

void smear_gather_cells(const struct smear_gather_area *a)
{
    const struct smear_layer_rows *l = a->layer;
    const int32_t count = (l->width >> a->tile_shift) + 1;
    struct smear_layer_cell *own = l->cell, *around = l->cell + count;
    for (int32_t i = 0; i < count; i++) {
        struct vector longest = { 0, 0 };
        bool any = false;
        int32_t x0 = max_i32(i << a->tile_shift, a->x0), x1 = min_i32((i + 1) << a->tile_shift, a->x1);
        for (int32_t y = 0; x0 < x1 && y < a->rows; y++) {
            int32_t x = max_i32(x0, l->row_first[y]), end = min_i32(x1, l->row_end[y]);
            any = any || x < end;
            for (int32_t at = y * l->width + x; x < end; x++, at++) {
                struct vector v = velocity_at(l, at);
                if (square_of(v) > square_of(longest))
                    longest = v;
            }
        }
        own[i] = (struct smear_layer_cell){ (int16_t)longest.x, (int16_t)longest.y, any };
    }
    for (int32_t i = 0; i < count; i++) {
        around[i] = own[i];
        for (int32_t k = max_i32(i - 1, 0); k <= min_i32(i + 1, count - 1); k++) {
            struct vector v = { own[k].x, own[k].y }, best = { around[i].x, around[i].y };
            if (square_of(v) > square_of(best)) {
                around[i].x = own[k].x;
                around[i].y = own[k].y;
            }
            around[i].any = around[i].any || own[k].any;
        }
    }
}

/* ------------------------------------------------------------------ a pixel */

/* Sums of channels (codes, or light in 12 bits) by weight; 4096 is the whole exposure. */
struct sum {
    uint32_t r, g, b, weight;
};

static inline void sum_add(struct sum *s, uint32_t p, uint32_t weight, bool linear)
{
    if (linear) {
        s->r += (smear_srgb_decode[pixel_red(p)] >> 4) * weight;
        s->g += (smear_srgb_decode[pixel_green(p)] >> 4) * weight;
        s->b += (smear_srgb_decode[pixel_blue(p)] >> 4) * weight;
    } else {
        s->r += pixel_red(p) * weight;
        s->g += pixel_green(p) * weight;
        s->b += pixel_blue(p) * weight;
    }
    s->weight += weight;
}

enum { WHOLE = 4096 };

/* What is missing is still; what is too much is shared. */
static uint32_t sum_pixel(struct sum *s, uint32_t still, bool linear)
{
    if (s->weight < WHOLE)
        sum_add(s, still, WHOLE - s->weight, linear);
    int zeros = count_leading_zeros(s->weight);
    uint32_t r = recip_norm_precise(s->weight << zeros);            /* 2^(61 - zeros) / weight */
    uint32_t half = s->weight >> 1, c[3] = { s->r + half, s->g + half, s->b + half };
    for (int i = 0; i < 3; i++) {
        uint32_t value = mulh_u32(c[i], r) >> (29 - zeros);
        c[i] = linear ? smear_srgb_encode[min_u32(value, 4095u)] : min_u32(value, 255u);
    }
    return pixel_make(0, c[0], c[1], c[2]);
}

/* Taps along a direction, and what the velocities they meet are worth. */
struct taps {
    struct vector d;
    int32_t length;             /* q6 px */
    int32_t count;
    struct vector last;         /* the newest velocity */
    int32_t carries;            /* how far it carries a surface along the direction, q6 px; 0: elsewhere */
    uint32_t weight;            /* of a tap with it */
};

static void taps_start(struct taps *t, struct vector d, int32_t count)
{
    t->d = d;
    t->count = count;
    t->length = (int32_t)sqrt_q3((uint32_t)square_of(d));
    t->last = d;
    t->carries = t->length + 32;
    t->weight = (uint32_t)((WHOLE + count - 1) / count);
}

static SMEAR_NOINLINE void taps_meet(struct taps *t, struct vector v)
{
    int32_t dot = v.x * t->d.x + v.y * t->d.y, cross = abs_i32(v.x * t->d.y - v.y * t->d.x);
    int32_t speed = (int32_t)sqrt_q3((uint32_t)square_of(v));
    t->last = v;
    t->carries = 0;
    if (dot <= 0 || 2 * cross > dot)        /* more than 27 degrees off */
        return;
    t->carries = speed + 32;
    t->weight = min_u32((uint32_t)((WHOLE + t->count - 1) / t->count * t->length) / (uint32_t)max_i32(speed, 32), WHOLE);
}

struct pixel_job {
    const struct smear_gather_area *a;
    int32_t x, y;               /* in the layer's rows */
    uint32_t still, still_depth;
};

static inline bool is_drawn(const struct pixel_job *p, int32_t x, int32_t y, int32_t *at)
{
    if (x < p->a->x0 || x >= p->a->x1 || y < 0 || y >= p->a->rows)
        return false;
    *at = y * p->a->layer->width + x;
    return p->a->layer->depth[*at] > p->still_depth;
}

/* The velocity of the layer's surface that passes by a pixel where none is in the middle of the exposure: of the nearest tap
 * along the longest one around that comes this far. */
static bool find_direction(const struct pixel_job *p, struct vector top, struct vector *out)
{
    int32_t length = (int32_t)sqrt_q3((uint32_t)square_of(top));
    for (int32_t k = 1; k <= 8; k++)
        for (int32_t sign = -1; sign <= 1; sign += 2) {
            int32_t at, x = p->x + ((top.x * k * sign + 32) >> 6), y = p->y + ((top.y * k * sign + 32) >> 6);
            if (!is_drawn(p, x, y, &at))
                continue;
            struct vector v = velocity_at(p->a->layer, at);
            if ((int32_t)sqrt_q3((uint32_t)square_of(v)) + 64 >= length * k >> 3) {
                *out = v;
                return square_of(v) >= 16;
            }
        }
    return false;
}

static uint32_t gather(const struct pixel_job *p, struct taps *t, struct sum *sum)
{
    const struct smear_layer_rows *l = p->a->layer;
    const int32_t n = t->count;
    /* From one end to the other: q16 px. */
    int32_t step_x = t->d.x * 16384 / n, step_y = t->d.y * 16384 / n;
    int32_t x = (p->x << 16) + 0x8000 - t->d.x * 8192 + (step_x >> 1), y = (p->y << 16) + 0x8000 - t->d.y * 8192 + (step_y >> 1);
    for (int32_t k = 0; k < n; k++, x += step_x, y += step_y) {
        int32_t at;
        if (!is_drawn(p, x >> 16, y >> 16, &at))
            continue;
        struct vector v = velocity_at(l, at);
        if (v.x != t->last.x || v.y != t->last.y)
            taps_meet(t, v);
        int32_t distance = t->length * abs_i32(2 * k + 1 - n) / n;
        if (distance <= t->carries)
            sum_add(sum, l->color[at], t->weight, p->a->linear);
    }
    return (uint32_t)n;
}

static uint32_t merge_pixel(const struct pixel_job *p, struct vector top, uint32_t *out)
{
    const struct smear_layer_rows *l = p->a->layer;
    struct taps taps;
    struct sum sum = { 0, 0, 0, 0 };
    struct vector d = { 0, 0 };
    int32_t at;
    uint32_t taken = 0;
    bool here = is_drawn(p, p->x, p->y, &at);
    if (here)
        d = velocity_at(l, at);
    bool moves = square_of(d) >= 16;            /* half a pixel */
    if (!moves && square_of(top) >= 16)
        moves = find_direction(p, top, &d);
    if (moves) {
        taps_start(&taps, d, p->a->samples);
        taken = gather(p, &taps, &sum);
    }
    /* A surface that stays. */
    if (here && sum.weight < WHOLE && square_of(velocity_at(l, at)) < 16)
        sum_add(&sum, l->color[at], WHOLE - sum.weight, p->a->linear);
    if (sum.weight != 0)
        *out = sum_pixel(&sum, p->still, p->a->linear);
    return taken;
}

uint32_t smear_gather_merge(const struct smear_gather_area *a)
{
    const struct smear_layer_rows *l = a->layer;
    const struct smear_layer_cell *around = l->cell + (l->width >> a->tile_shift) + 1;
    uint32_t taken = 0;
    for (int32_t y = 0; y < a->height; y++) {
        uint32_t *still = a->still + y * a->still_stride;
        const uint16_t *depth = a->still_depth + y * a->still_stride;
        for (int32_t x = a->left; x < a->right; x++) {
            const struct smear_layer_cell *cell = &around[(x + l->margin) >> a->tile_shift];
            if (!cell->any)
                continue;
            struct pixel_job p = { a, x + l->margin, y + a->top, still[x], a->over ? 0 : depth[x] };
            taken += merge_pixel(&p, (struct vector){ cell->x, cell->y }, &still[x]);
        }
    }
    return taken;
}

/* ------------------------------------------------------------------ one velocity, few taps */

uint32_t smear_plain_merge(const struct smear_gather_area *a, int32_t vx, int32_t vy)
{
    const struct smear_layer_rows *l = a->layer;
    const int32_t n = a->samples, reach_x = (abs_i32(vx) >> 9) + 1;
    const int32_t left = max_i32(a->left, a->x0 - l->margin - reach_x), right = min_i32(a->right, a->x1 - l->margin + reach_x);
    for (int32_t y = 0; y < a->height; y++) {
        uint32_t *still = a->still + y * a->still_stride;
        for (int32_t x = left; x < right; x++) {
            struct pixel_job p = { a, x + l->margin, y + a->top, still[x], a->over ? 0 : a->still_depth[y * a->still_stride + x] };
            struct sum sum = { 0, 0, 0, 0 };
            uint32_t weight = (uint32_t)((WHOLE + n - 1) / n);
            for (int32_t k = 0; k < n; k++) {
                int32_t part = (2 * k + 1 - n) * 128 / n, at;       /* q8, -1/2 .. 1/2 */
                if (is_drawn(&p, p.x + ((vx * part + 0x8000) >> 16), p.y + ((vy * part + 0x8000) >> 16), &at))
                    sum_add(&sum, l->color[at], weight, a->linear);
            }
            if (sum.weight != 0)
                still[x] = sum_pixel(&sum, p.still, a->linear);
        }
    }
    return left < right ? (uint32_t)((right - left) * a->height * n) : 0;
}

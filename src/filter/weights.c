/* SPDX-License-Identifier: MIT */
/* weights.c - the gather with the weights of other published filters in place of those of
 * Post Processing Stack v2: [McGuire12], [Guertin14], and [Jimenez14] "Next Generation Post
 * Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014. All are integer: shares of
 * depth and cover in 1/256, directions in 1/256 px.
 *
 * Depths are compared by the nearer of the two: [Guertin14] as published, the others with a soft border of a
 * twentieth of the distance, where theirs is a length that each scene has to choose. */
#include "filter/filter.h"
#include "filter/gather.h"

/* ------------------------------------------------------------------ sums */

/* A struct weighed_sum for larger weights: q8, and up to 4 of each tap. Colours have 16 bits (linear light) or 8. */
struct wide_sum {
    uint64_t r, g, b;
    uint32_t weight;
};

static void wide_add(struct wide_sum *s, uint32_t pixel, uint32_t weight, const struct smear_blur_settings *settings)
{
    s->r += (uint64_t)value_of_code(pixel_red(pixel), settings->transfer) * weight;
    s->g += (uint64_t)value_of_code(pixel_green(pixel), settings->transfer) * weight;
    s->b += (uint64_t)value_of_code(pixel_blue(pixel), settings->transfer) * weight;
    s->weight += weight;
}

/* Returns a / weight to nearest; a is at most 65535 weights. */
static uint32_t quotient(uint64_t a, uint32_t weight)
{
    int zeros = count_leading_zeros(weight);
    uint32_t top = (uint32_t)(a << zeros >> 16);
    return (mulh_u32(top, recip_norm_precise(weight << zeros)) + (1u << 12)) >> 13;
}

static uint32_t wide_mean(const struct wide_sum *s, const struct smear_blur_settings *settings)
{
    const smear_transfer t = settings->transfer;
    return pixel_make(0, code_of_sum(quotient(s->r, s->weight), t), code_of_sum(quotient(s->g, s->weight), t),
                      code_of_sum(quotient(s->b, s->weight), t));
}

/* ------------------------------------------------------------------ vectors */

static int32_t length_of(struct vector v)
{
    return (int32_t)sqrt_floor_64((uint64_t)(mul_wide(v.x, v.x) + mul_wide(v.y, v.y)));
}

/* Returns 256 a / b for b > 0. */
static int32_t share_of(int32_t a, int32_t b)
{
    return a / b * 256 + (a % b * 256) / b;
}

/* Returns |cos| of the angle between two directions of known lengths, q8. */
static int32_t alike(struct vector a, int32_t a_length, struct vector b, int32_t b_length)
{
    int32_t dot = (a.x * b.x >> 8) + (a.y * b.y >> 8), lengths = a_length * b_length >> 8;
    return lengths <= 0 ? 0 : min_i32(share_of(abs_i32(dot), lengths), 256);
}

/* ------------------------------------------------------------------ a pixel's surroundings */

struct gathering {
    const struct smear_window *w;
    const uint32_t *row;        /* offsets of rows, from the table's first */
    const struct smear_blur_settings *settings;
    uint32_t far_units;         /* orthographic: from the eye to the far plane */
    int32_t taps;
};

/* What lies at a place: at a tap, or at the pixel itself. */
struct sample {
    uint32_t at;
    uint32_t units;
    struct vector v;
    int32_t speed;              /* q8 px */
};

static struct sample sample_at(const struct gathering *g, uint32_t at)
{
    struct smear_pixel_velocity v = window_velocity(g->w, at);
    struct sample s = { at, smear_depth_units(g->w->depth[at]), { v.x * 32, v.y * 32 }, 0 };
    s.speed = speed_of(v);
    return s;
}

/* Returns what lies t (q12) times `d` from the middle of the pixel at column x and row y of the table. */
static struct sample sample_along(const struct gathering *g, int32_t x, int32_t y, struct vector d, int32_t t)
{
    int32_t tx = (x << 8) + 128 + (d.x * t >> 12), ty = (y << 8) + 128 + (d.y * t >> 12);
    return sample_at(g, g->row[ty >> 8] + (uint32_t)clamp_i32(tx >> 8, 0, g->w->width - 1));
}

/* Returns how much farther a is than b, over the distance of the nearer: q8 times `sharpness`, at most 256. */
static int32_t farther(const struct gathering *g, const struct sample *a, const struct sample *b,
                       int32_t sharpness)
{
    uint32_t difference = b->units - a->units, nearer = a->units;
    if (a->units >= b->units)
        return 0;
    if (SMEAR_WITH_VIEWS && g->settings->orthographic)
        nearer = g->far_units - b->units;
    /* Perspective: 1/ua - 1/ub over 1/ub is (ub - ua) / ua. */
    if (nearer == 0 || difference >= nearer)
        return 256;
    return min_i32(share_of((int32_t)difference, (int32_t)nearer) * sharpness, 256);
}

/* Returns how much a streak of radius r covers at distance d, q8, if it is a cone; cylinder() if it is a cylinder with
 * a soft rim. */
static int32_t cone(int32_t d, int32_t r)
{
    return d >= r ? 0 : 256 - share_of(d, r);
}

static int32_t cylinder(int32_t d, int32_t r)
{
    int32_t inner = r * 243 >> 8, outer = r * 269 >> 8;
    if (d <= inner)
        return 256;
    if (d >= outer)
        return 0;
    int32_t t = share_of(d - inner, outer - inner);
    return 256 - (t * t * (768 - 2 * t) >> 16);
}

/* ------------------------------------------------------------------ the filters */

static uint32_t gather_mcguire(const struct gathering *g, uint32_t at, int32_t x, int32_t y,
                               struct vector top, int32_t length, int32_t noise)
{
    struct sample here = sample_at(g, at);
    struct wide_sum sum = { 0, 0, 0, 0 };
    int32_t taps = g->taps | 1;         /* one of them is the pixel itself */
    wide_add(&sum, g->w->color[at], (uint32_t)max_i32(65536 / max_i32(here.speed, 128), 1),
             g->settings);
    for (int32_t i = 0; i < taps; i++) {
        if (2 * i == taps - 1)
            continue;
        int32_t t = ((i + 1) * 8192 + (noise >> 3)) / (taps + 1) - 4096;        /* noise within half a tap */
        struct sample tap = sample_along(g, x, y, top, t);
        int32_t d = abs_i32(t) * length >> 12;
        int32_t front = 256 - farther(g, &tap, &here, 20), back = 256 - farther(g, &here, &tap, 20);
        int32_t weight = (front * cone(d, max_i32(tap.speed, 128)) + back * cone(d, max_i32(here.speed, 128))
                          + 2 * cylinder(d, max_i32(tap.speed, 128)) * cylinder(d, max_i32(here.speed, 128)))
                      >> 8;
        wide_add(&sum, g->w->color[tap.at], (uint32_t)weight, g->settings);
    }
    return wide_mean(&sum, g->settings);
}

/* Returns the second direction, as long as the first: from its perpendicular on the side of the pixel's own velocity
 * to that velocity, as the pixel gets faster than 1/2 px. */
static struct vector second_direction(const struct sample *here, struct vector top, int32_t length)
{
    struct vector side = { -top.y, top.x };
    if (here->v.x * side.x + here->v.y * side.y < 0)
        side = (struct vector){ top.y, -top.x };
    int32_t own = clamp_i32((here->speed - 128) * 2 / 3, 0, 256), speed = max_i32(length_of(here->v), 1);
    struct vector mixed = { (side.x * (256 - own) >> 8) + here->v.x * own / speed * length / 256,
                            (side.y * (256 - own) >> 8) + here->v.y * own / speed * length / 256 };
    int32_t mixed_length = max_i32(length_of(mixed), 1);
    return (struct vector){ mixed.x * length / mixed_length, mixed.y * length / mixed_length };
}

static uint32_t gather_guertin(const struct gathering *g, uint32_t at, int32_t x, int32_t y,
                               struct vector top, int32_t length, int32_t noise)
{
    struct sample here = sample_at(g, at);
    struct vector second = second_direction(&here, top, length);
    int32_t own_alike[2] = { 0, 256 }, speed = max_i32(here.speed, 128);
    struct wide_sum sum = { 0, 0, 0, 0 };
    own_alike[0] = alike(top, length, second, length);
    wide_add(&sum, g->w->color[at], (uint32_t)max_i32(g->taps * 65536 / (40 * speed), 1), g->settings);
    for (int32_t i = 0; i < g->taps; i++) {
        /* 0.95 of a tap to either side */
        int32_t t = ((i + 1) * 8192 + (noise * 243 >> 10)) / (g->taps + 1) - 4096;
        struct vector d = i & 1 ? second : top;
        struct sample tap = sample_along(g, x, y, d, t);
        int32_t distance = abs_i32(t) * length >> 12, tap_speed = max_i32(tap.speed, 128);
        int32_t front = 256 - farther(g, &tap, &here, 1), back = 256 - farther(g, &here, &tap, 1);
        int32_t tap_alike = alike(d, length, tap.v, tap.speed), here_alike = own_alike[i & 1];
        int32_t weight = ((front * cone(distance, tap_speed) >> 8) * tap_alike
                          + (back * cone(distance, speed) >> 8) * here_alike
                          + 2 * cylinder(distance, min_i32(tap_speed, speed))
                                * max_i32(tap_alike, here_alike))
                      >> 8;
        wide_add(&sum, g->w->color[tap.at], (uint32_t)weight, g->settings);
    }
    return wide_mean(&sum, g->settings);
}

/* Returns how much a tap counts by its depth and its streak or the pixel's, q8. */
static int32_t jimenez_weight(const struct gathering *g, const struct sample *here, const struct sample *tap,
                              int32_t d)
{
    int32_t beyond = max_i32(d - 256, 0);
    /* 1/2 where depths are equal; a twentieth of the distance decides. */
    int32_t behind = clamp_i32(128 + (farther(g, tap, here, 20) - farther(g, here, tap, 20)) / 2, 0, 256);
    int32_t of_tap = clamp_i32(tap->speed - beyond, 0, 256),
            of_here = clamp_i32(here->speed - beyond, 0, 256);
    return ((256 - behind) * of_tap + behind * of_here) >> 8;
}

static uint32_t gather_jimenez(const struct gathering *g, uint32_t at, int32_t x, int32_t y,
                               struct vector top, int32_t length, int32_t noise)
{
    struct sample here = sample_at(g, at);
    struct wide_sum sum = { 0, 0, 0, 0 };
    int32_t pairs = max_i32(g->taps / 2, 1);
    for (int32_t i = 0; i < pairs; i++) {
        int32_t t = ((2 * i + 1) * 2048 + (noise >> 4)) / pairs;
        struct sample one = sample_along(g, x, y, top, t), other = sample_along(g, x, y, top, -t);
        int32_t d = t * length >> 12;
        int32_t one_weight = jimenez_weight(g, &here, &one, d),
                other_weight = jimenez_weight(g, &here, &other, d);
        /* Behind a moving silhouette, what the one side hides is told by the other. */
        bool is_behind = one.units < other.units, is_slower = other.speed > one.speed;
        int32_t first = is_behind && is_slower ? other_weight : one_weight;
        int32_t second = is_behind || is_slower ? other_weight : one_weight;
        wide_add(&sum, g->w->color[one.at], (uint32_t)first, g->settings);
        wide_add(&sum, g->w->color[other.at], (uint32_t)second, g->settings);
    }
    /* The weights are an alpha: what they leave is the pixel's own. */
    int32_t rest = pairs * 512 - (int32_t)sum.weight;
    if (rest > 0)
        wide_add(&sum, g->w->color[at], (uint32_t)rest, g->settings);
    return wide_mean(&sum, g->settings);
}

uint32_t smear_blur_weights(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows,
                            int32_t row, int32_t column, const struct smear_blur_settings *settings)
{
    struct gathering g = { .w = w, .row = rows->offset, .settings = settings, .far_units = blur_far_units(settings),
                           .taps = clamp_i32(settings->samples, 2, 64) };
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    int32_t tile_top = row << w->tile_shift;
    uint32_t taken = 0;
    for (int32_t y = rows->y0; y < rows->y1; y++, out += w->tile) {
        uint32_t at = rows->offset[y - rows->first] + (uint32_t)x0;
        for (int32_t x = x0; x < x1; x++, at++) {
            uint32_t inner = (uint32_t)x * NOISE_X + (uint32_t)y * NOISE_Y;
            const struct smear_tile_neighborhood *around = tile_looked_up(w, row, column, x - x0,
                                                                          y - tile_top, inner);
            struct vector top = { around->x, around->y };
            int32_t length = length_of(top);
            if (length <= 128) {                                /* 1/2 px */
                out[x - x0] = w->color[at];
                continue;
            }
            int32_t noise = (int32_t)noise_of(inner) - 32768;
            taken += (uint32_t)g.taps;
            out[x - x0] = settings->weights == SMEAR_WEIGHTS_MCGUIRE
                            ? gather_mcguire(&g, at, x, y - rows->first, top, length, noise)
                        : settings->weights == SMEAR_WEIGHTS_GUERTIN
                            ? gather_guertin(&g, at, x, y - rows->first, top, length, noise)
                            : gather_jimenez(&g, at, x, y - rows->first, top, length, noise);
        }
    }
    return taken;
}

void smear_blur_copy(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows,
                     int32_t column)
{
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    for (int32_t y = rows->y0; y < rows->y1; y++, out += w->tile)
        __builtin_memcpy(out, w->color + window_ring_row(w, y) * w->width + x0, (size_t)(x1 - x0) * sizeof *out);
}

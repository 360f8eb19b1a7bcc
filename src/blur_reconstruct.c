/* SPDX-License-Identifier: MIT */
/* blur_reconstruct.c - the reconstruction filter, for tiles with different motions in reach.
 *
 * [McGuire12] "A Reconstruction Filter for Plausible Motion Blur", I3D 2012; [Guertin14] "A Fast and Stable
 * Feature-Aware Motion Blur Filter", HPG 2014; [Jimenez14] for the noise. The variant is that of Unity's Post
 * Processing Stack v2: taps outermost first, alternating between the neighbourhood's direction and the pixel's own; a
 * tap in front weighs by its own speed, any other by the greatest speed met so far.
 *
 * Ours differs: velocity has an exact zero (so a speed is at least 1/16 px where it divides); all is integer, weights
 * in 1/4096, positions in 1/256 px; whether a tap is in front is decided on depth codes, and its velocity is
 * only read if it is. */
#include "blur.h"

#include "fixmath.h"
#include "pixel.h"
#include "smear.h"

/* Interleaved gradient noise [Jimenez14] in q16: frac(52.9829189 frac(0.06711056 x + 0.00583715 y)).
 * 288237660 and 25070368 are the inner factors in q32, 3555623499 is the outer one in q26. */
static inline uint32_t gradient_noise(int32_t x, int32_t y)
{
    uint32_t inner = (uint32_t)x * 288237660u + (uint32_t)y * 25070368u;
    const uint32_t outer = 3555623499u;
    return (mulh_u32(inner, outer) << 6 | inner * outer >> 26) >> 16;
}

struct vector {
    int32_t x, y;               /* q8 px */
};

static inline int32_t length_q8(int32_t x, int32_t y)
{
    /* q8 vectors reach 2^14; their squares are brought to 20 bits. */
    uint32_t square = (uint32_t)(x * x + y * y);
    return square < 1u << 20 ? (int32_t)(sqrt_q3(square) >> 3)
                             : (int32_t)(sqrt_q3(square >> 10) << 2);
}

static inline struct vector velocity_at(const struct smear_window *w, uint32_t at)
{
    if (w->velocity8 != NULL)
        return (struct vector){ w->velocity8[2 * at] * 32, w->velocity8[2 * at + 1] * 32 };
    return (struct vector){ w->velocity16[2 * at] * 32, w->velocity16[2 * at + 1] * 32 };
}

/* |velocity| of a pixel, q8. */
static inline int32_t speed_at(const struct smear_window *w, uint32_t at)
{
    if (w->velocity8 != NULL) {
        int32_t x = w->velocity8[2 * at], y = w->velocity8[2 * at + 1];
        return (int32_t)sqrt_q3((uint32_t)(x * x + y * y)) << 2;
    }
    int32_t x = w->velocity16[2 * at], y = w->velocity16[2 * at + 1];
    return (int32_t)sqrt_q3((uint32_t)(x * x + y * y)) << 2;
}

/* Everything about the pixel that its taps need. */
struct center {
    int32_t x, y;
    struct vector top, second;
    int32_t length;             /* |top|, q8 */
    uint32_t units;             /* depth */
    uint32_t front_units;       /* from here on a tap is fully in front */
    uint32_t behind_units;      /* down to here a tap is fully behind (fence) */
    bool fence;
};

/* Running sums; weights q12. The taps of a pixel weigh less than 8 in all (spaced 2 px, each at most 1.2 / its
 * distance), so sums of 16-bit values fit 32 bits. */
struct sum {
    uint32_t r, g, b, weight;
};

static inline void sum_add(struct sum *s, uint32_t pixel, uint32_t weight, bool linear)
{
    if (linear) {
        s->r += smear_srgb_decode[pixel_red(pixel)] * weight;
        s->g += smear_srgb_decode[pixel_green(pixel)] * weight;
        s->b += smear_srgb_decode[pixel_blue(pixel)] * weight;
    } else {
        s->r += (pixel >> 8 & 0xff00u) * weight;
        s->g += (pixel & 0xff00u) * weight;
        s->b += (pixel << 8 & 0xff00u) * weight;
    }
    s->weight += weight;
}

static uint32_t sum_pixel(const struct sum *s, bool linear)
{
    /* Sums of few and light taps are small: scaled up, so that the quotient keeps its bits. */
    int up = s->weight < 16u ? 3 : 0;
    uint32_t weight = s->weight << up;
    int zeros = count_leading_zeros(weight);
    uint32_t r = recip_norm(weight << zeros);           /* 2^(61 - zeros) / weight */
    int down = 29 - zeros;
    uint32_t red = mulh_u32(s->r << up, r) >> down, green = mulh_u32(s->g << up, r) >> down;
    uint32_t blue = mulh_u32(s->b << up, r) >> down;
    if (linear)
        return pixel_make(0, smear_srgb_encode[min_u32(red, 65535u) >> 4],
                          smear_srgb_encode[min_u32(green, 65535u) >> 4],
                          smear_srgb_encode[min_u32(blue, 65535u) >> 4]);
    return pixel_make(0, min_u32((red + 128u) >> 8, 255u), min_u32((green + 128u) >> 8, 255u),
                      min_u32((blue + 128u) >> 8, 255u));
}

/* Depth units 5 % nearer than `units`: z_q = 0.95 z_p. Perspective: units are 1/z. Orthographic: z is far - range x
 * units / NEAR. */
static uint32_t units_in_front(uint32_t units, const struct smear_blur_settings *s)
{
    if (units == 0)
        return 1;
    if (s->orthographic) {
        uint32_t away = (uint32_t)((uint64_t)s->far_over_range * SMEAR_DEPTH_NEAR >> 16) - units;
        return units + max_u32(away / 20u, 1);
    }
    return units + max_u32(units / 19u, 1);
}

static uint32_t units_behind(uint32_t units, const struct smear_blur_settings *s)
{
    uint32_t step;
    if (s->orthographic)
        step = ((uint32_t)((uint64_t)s->far_over_range * SMEAR_DEPTH_NEAR >> 16) - units) / 19u;
    else
        step = units / 20u;
    step = max_u32(step, 1);
    return units > step ? units - step : 0;
}

/* part / whole in q8, part < whole < 2^20. */
static uint32_t share_q8(uint32_t part, uint32_t whole)
{
    int zeros = count_leading_zeros(whole);
    return mulh_u32(part << 8, recip_norm(whole << zeros)) >> (29 - zeros);
}

/* 1 / speed in q20 for a speed in q8. */
static inline uint32_t inverse_speed(int32_t speed)
{
    int zeros = count_leading_zeros((uint32_t)speed);
    return recip_norm((uint32_t)speed << zeros) >> (33 - zeros);
}

SMEAR_INLINE void gather(struct sum *sum, const struct smear_window *w,
                         const struct smear_row_table *rows, const struct center *c,
                         int32_t background, int32_t pairs, uint32_t noise, bool box, bool linear)
{
    static const uint16_t inverse[33] = {       /* 2^12 / pairs */
        0, 4096, 2048, 1365, 1024, 819, 683, 585, 512, 455, 410, 372, 341, 315, 293, 273, 256, 241,
        228, 216, 205, 195, 186, 178, 171, 164, 158, 152, 146, 141, 137, 132, 128
    };
    int32_t spacing = inverse[pairs];
    int32_t offset = ((int32_t)noise - 32768) * spacing >> 16;          /* q12 */
    uint32_t over = inverse_speed(background);
    const uint16_t *depth = w->depth;
    int32_t right = w->width - 1;

    for (int32_t i = 0; i < pairs; i++) {
        int32_t t = 4096 - (2 * i + 1) * spacing / 2;
        const struct vector d = i & 1 ? c->second : c->top;
        uint32_t shape = box ? 1024u : (uint32_t)(4915 - t) >> 2;       /* 1 or 1.2 - t, q10 */
        for (int side = 0; side < 2; side++) {
            int32_t s = (side == 0 ? t : -t) + offset;
            int32_t distance = c->length * abs_i32(s) >> 12;            /* q8 */
            int32_t x = c->x + ((d.x * s + (1 << 19)) >> 20);
            int32_t y = c->y + ((d.y * s + (1 << 19)) >> 20);
            x = clamp_i32(x, 0, right);
            uint32_t at = rows->offset[y - rows->first] + (uint32_t)x;
            uint32_t units = smear_depth_units(depth[at]);

            if (units > c->units) {
                /* In front, at least in part: its own speed decides, and from now on the background's. */
                uint32_t front = units >= c->front_units ? 256u
                               : share_q8(units - c->units, c->front_units - c->units);
                int32_t own = speed_at(w, at);
                int32_t speed = background + ((own - background) * (int32_t)front >> 8);
                speed = max_i32(speed, 16);
                uint32_t cover = (uint32_t)clamp_i32(speed - distance, 0, 256);
                if (cover != 0) {
                    uint32_t weight = (inverse_speed(speed) * cover >> 8) * shape >> 18;
                    sum_add(sum, w->color[at], weight, linear);
                }
                if (speed > background) {
                    background = speed;
                    over = inverse_speed(speed);
                }
            } else {
                uint32_t cover = (uint32_t)clamp_i32(background - distance, 0, 256);
                if (c->fence && units < c->units)
                    cover = units <= c->behind_units ? 0
                          : cover * (256u - share_q8(c->units - units,
                                                     c->units - c->behind_units)) >> 8;
                if (cover != 0) {
                    uint32_t weight = (over * cover >> 8) * shape >> 18;
                    sum_add(sum, w->color[at], weight, linear);
                }
            }
        }
    }
    /* The centre last: 1.2 / (2 B pairs), at least one step so that the sum is never zero. */
    uint32_t at = rows->offset[c->y - rows->first] + (uint32_t)c->x;
    uint32_t weight = (over >> 8) * (box ? 4096u : 4915u) / (uint32_t)(2 * pairs) >> 12;
    sum_add(sum, w->color[at], max_u32(weight, 1), linear);
}

/* v scaled to `length` from its own `speed`. */
static struct vector stretch(struct vector v, int32_t length, int32_t speed)
{
    int zeros = count_leading_zeros((uint32_t)speed);
    uint32_t r = recip_norm((uint32_t)speed << zeros);                      /* 2^(61 - zeros) / speed */
    int32_t factor = (int32_t)(mulh_u32((uint32_t)length << 14, r) >> (31 - zeros));    /* q12 */
    return (struct vector){ v.x * factor >> 12, v.y * factor >> 12 };
}

static struct vector second_direction(struct vector own, int32_t speed, struct vector top, int32_t length,
                                      bool guertin)
{
    if (!guertin) {
        int32_t at_least = max_i32(speed, 128);
        return 2 * at_least > length ? stretch(own, length, at_least) : top;
    }
    /* From the perpendicular of `top` on the own velocity's side to the own direction, as the pixel gets faster. */
    struct vector normal = { -top.y, top.x };
    if (normal.x * own.x + normal.y * own.y < 0)
        normal = (struct vector){ top.y, -top.x };
    int32_t share = clamp_i32((speed - 128) * 2 / 3, 0, 256);
    struct vector along = speed > 0 ? stretch(own, length, speed) : (struct vector){ 0, 0 };
    struct vector mixed = { (normal.x * (256 - share) + along.x * share) >> 8,
                            (normal.y * (256 - share) + along.y * share) >> 8 };
    return stretch(mixed, length, max_i32(length_q8(mixed.x, mixed.y), 1));
}

/* The neighbourhood whose direction the pixel takes: looked up a quarter tile away in a random direction, which hides the
 * tiles' borders [Guertin14]. The centre of pixel x is at x + 1/2. Of the row below, the window knows
 * only what the rows drawn so far tell (smear_neighbormax_row). */
static const struct smear_tile_neighborhood *neighborhood_for(const struct smear_window *w,
                                                              int32_t x, int32_t y)
{
    uint32_t angle = gradient_noise(x + 2 * w->width, y) >> 8;
    int32_t jump = w->tile >> 2;
    int32_t u = (x << 8) + 128 + smear_sine[(angle + 64u) & 255u] * jump * 256 / 127;
    int32_t v = (y << 8) + 128 + smear_sine[angle] * jump * 256 / 127;
    int32_t column = clamp_i32(u >> (8 + w->tile_shift), 0, w->columns - 1);
    int32_t line = clamp_i32(v >> (8 + w->tile_shift), 0, w->rows - 1);
    return &window_around(w, line)[column];
}

uint32_t smear_blur_reconstruct(uint32_t *out, const struct smear_window *w,
                                const struct smear_row_table *rows, int32_t row, int32_t column,
                                const struct smear_blur_settings *settings)
{
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    int32_t y0 = row << w->tile_shift, y1 = min_i32(y0 + w->tile, w->height);
    int32_t wanted = clamp_i32(settings->samples / 2, 1, 64);
    bool box = settings->flags & SMEAR_BOX;
    bool guertin = settings->flags & SMEAR_DIRECTION;
    uint32_t taps = 0;

    for (int32_t y = y0; y < y1; y++, out += w->tile) {
        for (int32_t x = x0; x < x1; x++) {
            uint32_t at = rows->offset[y - rows->first] + (uint32_t)x;
            const struct smear_tile_neighborhood *around = neighborhood_for(w, x, y);
            struct center c = { .x = x, .y = y, .top = { around->x, around->y } };
            c.length = length_q8(c.top.x, c.top.y);
            if (c.length < 512) {               /* 2 px */
                out[x - x0] = w->color[at];
                continue;
            }
            struct vector own = velocity_at(w, at);
            int32_t speed = speed_at(w, at);
            c.second = second_direction(own, speed, c.top, c.length, guertin);
            c.units = smear_depth_units(w->depth[at]);
            c.front_units = units_in_front(c.units, settings);
            c.fence = (settings->flags & SMEAR_FENCE) && speed <= 128;
            if (c.fence)
                c.behind_units = units_behind(c.units, settings);

            int32_t pairs = min_i32(wanted, c.length >> 9);
            int32_t background = max_i32(speed, 256);
            uint32_t noise = gradient_noise(x, y);
            struct sum sum = { 0, 0, 0, 0 };
            if (settings->linear)
                gather(&sum, w, rows, &c, background, pairs, noise, box, true);
            else
                gather(&sum, w, rows, &c, background, pairs, noise, box, false);
            out[x - x0] = sum_pixel(&sum, settings->linear);
            taps += (uint32_t)(2 * pairs + 1);
        }
    }
    return taps;
}

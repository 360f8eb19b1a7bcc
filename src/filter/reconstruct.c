/* SPDX-License-Identifier: MIT */
/* reconstruct.c - the reconstruction filter, for tiles with different motions in reach.
 *
 * [McGuire12] "A Reconstruction Filter for Plausible Motion Blur", I3D 2012; [Guertin14] "A Fast and Stable
 * Feature-Aware Motion Blur Filter", HPG 2014; [Jimenez14] for the noise. The variant is that of Unity's
 * Post Processing Stack v2: taps outermost first, alternating between the neighbourhood's direction and the
 * pixel's own; a tap in front weighs by its own speed, any other by the greatest speed met so far.
 *
 * Ours differs: velocity has an exact zero (so a speed is at least 1/16 px where it divides); all is integer,
 * weights in 1/4096, directions in 1/256 px; whether a tap is in front is decided on depth codes, and its
 * velocity is only read if it is. A pixel that stands still and has nothing moving in front stays, but for SMEAR_PUBLISHED.
 *
 * What neighbours share is kept from pixel to pixel: whatever follows from the neighbourhood's direction,
 * from the pixel's velocity, from its depth and from the velocity of the last tap in front. */
#include "filter/filter.h"

#include "filter/gather.h"

/* What follows from a pixel's velocity in a neighbourhood. */
struct own_motion {
    bool known;
    uint32_t word;              /* that velocity */
    struct vector second;       /* the second direction, as long as the first */
    int32_t background;         /* speed that taps not in front start with, q8 */
    uint32_t over;              /* its inverse_speed */
    bool slow;                  /* at most 1/2 px */
};

/* The direction of a neighbourhood. */
struct direction {
    struct vector v;
    int32_t length;             /* |v|, q8 */
    int32_t pairs;              /* 0: shorter than 2 px, nothing is gathered */
    int32_t spacing;            /* 2^12 / pairs: distance of pairs in units of v */
    uint32_t center;            /* the centre's weight times its speed: 1.2 / (2 pairs), q12 */
    struct own_motion own;      /* of the last pixel that took it */
};

/* What follows from a pixel's depth: where taps are fully in front and fully behind. */
struct own_depth {
    uint32_t units;
    uint32_t front, front_scale;        /* from here on; 2^30 / (front - units) */
    uint32_t behind, behind_scale;      /* down to here; 2^30 / (units - behind) */
    uint16_t code;
};

struct gathering {
    const struct smear_window *w;
    const struct smear_row_table *rows;
    smear_transfer transfer;
    bool box, fence, guertin, orthographic, published;
    bool met;                   /* of the pixel: what moves in front of it counts */
    int32_t wanted;             /* pairs */
    uint32_t far_units;         /* orthographic: depth units from the eye to the far plane */
    const uint32_t *color;      /* the window's planes from the tile's first column on */
    const uint16_t *depth_code;
    int32_t x0;                 /* that column */
    struct own_depth depth;
    uint32_t front_word;        /* velocity of the last tap in front */
    int32_t front_speed;        /* q8 */
    int32_t background;         /* of the pixel: greatest speed so far, q8 */
    uint32_t over;              /* its inverse_speed */
};

/* 1/20 and 1/19 of units up to 2^20, in products of 32 bits. */
static const uint32_t share_20 = 52429, share_19 = 55188;      /* q20 */

/* ------------------------------------------------------------------ lengths */

/* Returns |(x, y)| for lengths below 2^15, to nearest from 2^6 on: the table's root, good to 2^-8, and a Newton
 * step. */
static int32_t length_of(int32_t x, int32_t y)
{
    uint32_t square = (uint32_t)(x * x + y * y);
    if (square < 1u << 12)
        return (int32_t)((sqrt_q3(square) + 4u) >> 3);
    uint32_t root = square < 1u << 20 ? sqrt_q3(square) >> 3 : sqrt_q3(square >> 10) << 2;
    int zeros = count_leading_zeros(root);
    uint32_t quotient = mulh_u32(square, recip_norm(root << zeros)) >> (29 - zeros);
    return (int32_t)((root + quotient + 1u) >> 1);
}

/* Returns 2^28 / speed, for a speed in q8 of 16 .. 2^15. The seed of a reciprocal is good to 2^-9.4, enough for a
 * weight. */
static inline uint32_t inverse_speed(int32_t speed)
{
    int zeros = count_leading_zeros((uint32_t)speed);
    return (uint32_t)smear_recip_seed[(uint32_t)speed << zeros >> 22 & 511u] << (zeros - 14);
}

/* Scales v from its own length, `speed`, to `length`; lengths are below 2^15, `speed` is at least 32. */
static struct vector stretch(struct vector v, int32_t length, int32_t speed)
{
    int zeros = count_leading_zeros((uint32_t)speed);
    uint32_t r = recip_norm((uint32_t)speed << zeros);                      /* 2^(61 - zeros) / speed */
    int32_t factor = (int32_t)(mulh_u32((uint32_t)length << 16, r) >> (29 - zeros));    /* q16 */
    return (struct vector){ (v.x * factor + 0x8000) >> 16, (v.y * factor + 0x8000) >> 16 };
}

/* ------------------------------------------------------------------ what is shared */

static void direction_make(struct direction *d, const struct gathering *g,
                           const struct smear_tile_neighborhood *around)
{
    d->v = (struct vector){ around->x, around->y };
    d->own.known = false;
    d->length = length_of(around->x, around->y);
    /* All taps lie in the table of rows: the reach is passed by less than the half pixel from a centre to the
     * border. */
    SMEAR_ASSERT(d->length <= (g->w->reach << 8) + 64);
    /* There is a pair per 2 px; the exact square decides whether the direction is that long. */
    int32_t pairs = (d->length + 1) >> 9;
    if (around->x * around->x + around->y * around->y < pairs * pairs << 18)
        pairs--;
    d->pairs = min_i32(g->wanted, pairs);
    d->spacing = d->pairs != 0 ? (4096 + (d->pairs >> 1)) / d->pairs : 0;
    d->center = (g->box ? 2048u : 2458u) * (uint32_t)d->spacing >> 12;
}

static struct vector second_direction(struct vector own, int32_t speed, const struct direction *top,
                                      bool guertin)
{
    if (!guertin) {
        int32_t at_least = max_i32(speed, 128);
        if (2 * at_least <= top->length)
            return top->v;
        return stretch(own, top->length, max_i32(length_of(own.x, own.y), 128));
    }
    /* From the perpendicular of `top` on the own velocity's side to the own direction, as the pixel gets
     * faster. */
    struct vector normal = { -top->v.y, top->v.x };
    if (normal.x * own.x + normal.y * own.y < 0)
        normal = (struct vector){ top->v.y, -top->v.x };
    int32_t share = clamp_i32((speed - 128) * 2 / 3, 0, 256);
    struct vector along = speed > 0 ? stretch(own, top->length, speed) : (struct vector){ 0, 0 };
    struct vector mixed = { (normal.x * (256 - share) + along.x * share) >> 8,
                            (normal.y * (256 - share) + along.y * share) >> 8 };
    return stretch(mixed, top->length, max_i32(length_of(mixed.x, mixed.y), 32));
}

static SMEAR_RARE void own_motion_make(struct direction *d, const struct gathering *g, uint32_t at, uint32_t word)
{
    struct own_motion *m = &d->own;
    struct smear_pixel_velocity v = window_velocity(g->w, at);
    int32_t speed = speed_of(v);
    m->known = true;
    m->word = word;
    m->second = second_direction((struct vector){ v.x * 32, v.y * 32 }, speed, d, g->guertin);
    m->background = max_i32(speed, 256);
    m->over = inverse_speed(m->background);
    m->slow = speed <= 128;
}

/* Returns what follows from the velocity of pixel `at` of the window. */
static inline const struct own_motion *own_motion_of(struct direction *d, const struct gathering *g, uint32_t at)
{
    const uint32_t word = window_velocity_word(g->w, at);
    if (!d->own.known || word != d->own.word)
        own_motion_make(d, g, at, word);
    return &d->own;
}

/* Returns 2^30 / x for 0 < x < 2^20. */
static uint32_t inverse_q30(uint32_t x)
{
    int zeros = count_leading_zeros(x);
    return recip_norm(x << zeros) >> (31 - zeros);
}

static inline uint32_t part_of(uint32_t units, uint32_t share_q20)
{
    return units < 1u << 16 ? units * share_q20 >> 20 : (units >> 4) * share_q20 >> 16;
}

/* Finds where taps are fully in front: 5 % nearer, z_q = 0.95 z_p; and likewise behind. For a perspective, units are 1 / z; for an
 * orthographic view, z is far_units - units. */
static SMEAR_RARE void own_depth_make(struct gathering *g, uint16_t code)
{
    struct own_depth *d = &g->depth;
    const uint32_t units = smear_depth_units(code);
    const bool even = SMEAR_WITH_VIEWS && g->orthographic;
    uint32_t front = even ? part_of(g->far_units - units, share_20) : part_of(units, share_19);
    const uint32_t behind = max_u32(even ? part_of(g->far_units - units, share_19) : part_of(units, share_20), 1);
    front = units != 0 ? max_u32(front, 1) : 1;
    *d = (struct own_depth){ units, units + front, inverse_q30(front), units > behind ? units - behind : 0, 0, code };
    d->behind_scale = units != 0 ? inverse_q30(units - d->behind) : 0;
}

/* ------------------------------------------------------------------ the gather */

/* Returns how far in front the tap is, 0 .. 256. */
static uint32_t front_share(struct gathering *g, uint32_t code)
{
    uint32_t units = smear_depth_units((uint16_t)code);
    if (units >= g->depth.front)
        return 256u;
    return (units - g->depth.units) * g->depth.front_scale >> 22;
}

static uint32_t behind_share(struct gathering *g, uint32_t code)
{
    uint32_t units = smear_depth_units((uint16_t)code);
    if (units <= g->depth.behind)
        return 256u;
    return (g->depth.units - units) * g->depth.behind_scale >> 22;
}

/* Returns the weight of a tap from the inverse of its speed, its shape (q12) and its cover (q8). */
static inline uint32_t weight_of(uint32_t inverse, uint32_t shape, int32_t cover)
{
    return ((inverse >> 6) * shape >> 10) * (uint32_t)min_i32(cover, 256) >> 12;
}

/* Returns the speed of a tap that is in front, q8. `at` counts from the window's first column. */
static inline int32_t front_speed(struct gathering *g, uint32_t at)
{
    const uint32_t word = window_velocity_word(g->w, at);
    if (word != g->front_word) {
        g->front_word = word;
        g->front_speed = speed_of(window_velocity(g->w, at));
    }
    return g->front_speed;
}

/* Returns the weight of a tap that is in front, at least in part: its own speed decides, and raises the background's. One that
 * goes as fast as that weighs like any other. */
static SMEAR_RARE uint32_t front_weight(struct gathering *g, int32_t speed, uint32_t code, uint32_t shape, int32_t distance)
{
    int32_t cover = g->background - (distance >> 12);
    if (cover <= 0 && speed <= g->background)
        return 0;
    if (speed == g->background)
        return weight_of(g->over, shape, cover);
    uint32_t front = front_share(g, code);
    if (front != 256u)
        speed = g->background + ((speed - g->background) * (int32_t)front >> 8);
    speed = max_i32(speed, 16);
    cover = speed - (distance >> 12);
    if (speed <= g->background)
        return cover > 0 ? weight_of(inverse_speed(speed), shape, cover) : 0;
    g->background = speed;
    g->over = inverse_speed(speed);
    return cover > 0 ? weight_of(g->over, shape, cover) : 0;
}

/* What the taps of a pixel share. Columns count from the tile's first one, rows from the table's. */
struct tap_frame {
    const uint32_t *row;        /* offsets of rows */
    uint32_t own_code;
    bool fence;
    int32_t left, right;        /* columns of the frame */
};

/* Adds a tap; x, y and distance are in q20 px. */
SMEAR_INLINE void tap(struct gathering *g, struct weighed_sum *sum, const struct tap_frame *f, int32_t x, int32_t y,
                      int32_t distance, uint32_t shape)
{
    const int32_t column = clamp_i32(x >> 20, f->left, f->right);
    int32_t at = (int32_t)f->row[y >> 20] + column;
    uint32_t code = g->depth_code[at], weight;
    int32_t cover = g->background - (distance >> 12);           /* q8 */
    if (code > f->own_code) {
        const int32_t speed = front_speed(g, (uint32_t)(g->x0 + at));
        weight = front_weight(g, speed, code, shape, distance);
        if (weight == 0)
            return;
        g->met = g->met || speed != 0;
    } else {
        if (cover <= 0)
            return;
        weight = weight_of(g->over, shape, cover);
        if (f->fence && code < f->own_code)
            weight = weight * (256u - behind_share(g, code)) >> 8;
    }
    weighed_add(sum, g->color[at], weight, g->transfer, 0);
}

/* Filters the pixel in column x of the tile and row y of the table. */
static uint32_t gather(struct gathering *g, struct direction *top, int32_t here, int32_t x, int32_t y, uint32_t noise)
{
    const struct own_motion *m = own_motion_of(top, g, (uint32_t)(g->x0 + here));
    const struct tap_frame f = { g->rows->offset, g->depth.code, g->fence && m->slow, -g->x0,
                                 g->w->width - 1 - g->x0 };
    struct weighed_sum sum = { 0, 0, 0, 0 };
    g->background = m->background;
    g->over = m->over;
    g->met = false;

    int32_t offset = ((int32_t)noise - 32768) * top->spacing >> 16;         /* q12, within half a spacing */
    int32_t shift = top->length * offset;                                   /* q20 px */
    x = (x << 20) + (1 << 19);
    y = (y << 20) + (1 << 19);
    const struct vector d[2] = { top->v, m->second };
    const struct vector base[2] = { { x + d[0].x * offset, y + d[0].y * offset },
                                    { x + d[1].x * offset, y + d[1].y * offset } };
    int32_t t = 4096 - top->spacing / 2, length = top->length;
    uint32_t shape = g->box ? 4096u : (uint32_t)(4915 - t);                 /* 1 or 1.2 - t, q12 */
    uint32_t wider = g->box ? 0 : (uint32_t)top->spacing;
    for (int k = 0; t > 0; t -= top->spacing, shape += wider, k ^= 1) {
        int32_t dx = d[k].x * t, dy = d[k].y * t, distance = length * t;
        tap(g, &sum, &f, base[k].x + dx, base[k].y + dy, distance + shift, shape);
        tap(g, &sum, &f, base[k].x - dx, base[k].y - dy, distance - shift, shape);
    }
    uint32_t pixel = g->color[here];
    if (sum.weight == 0 || (!g->met && m->word == 0 && !g->published))       /* what stands still before what moves stays sharp */
        return pixel;
    /* The centre last: 1.2 / (2 B pairs). */
    weighed_add(&sum, pixel, max_u32((g->over >> 8) * top->center >> 12, 1), g->transfer, 0);
    return weighed_mean(&sum, g->transfer);
}

/* ------------------------------------------------------------------ the tile */

/* Makes the directions of the 3 x 3 neighbourhoods that the tile's pixels may take, as tile_looked_up() has them; beyond the frame:
 * the nearest inside it. Returns whether one is long enough. */
static bool directions_make(struct direction direction[9], const struct gathering *g, int32_t row, int32_t column)
{
    const struct smear_window *w = g->w;
    bool any = false;
    for (int i = 0; i < 9; i++) {
        const int32_t line = clamp_i32(row + i / 3 - 1, 0, w->rows - 1);
        direction_make(&direction[i], g, &window_around(w, line)[clamp_i32(column + i % 3 - 1, 0, w->columns - 1)]);
        any = any || direction[i].pairs != 0;
    }
    return any;
}

/* Finds the direction of a pixel of the tile. */
static struct direction *choose(struct direction direction[9], const struct smear_window *w, int32_t x, int32_t y,
                                uint32_t inner)
{
    const uint32_t angle = (noise_of(inner + 2u * (uint32_t)w->width * NOISE_X) + 128u) >> 8;
    return &direction[4 + tile_jump(x, smear_sine[(angle + 64u) & 255u], w->tile_shift)
                      + 3 * tile_jump(y, smear_sine[angle & 255u], w->tile_shift)];
}

uint32_t smear_blur_reconstruct(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows, int32_t row,
                                int32_t column, const struct smear_blur_settings *settings)
{
    const int32_t x0 = column << w->tile_shift, y0 = row << w->tile_shift, n = min_i32(w->tile, w->width - x0);
    struct gathering g = {
        .w = w, .rows = rows, .transfer = settings->transfer,
        .box = (settings->flags & SMEAR_BOX) != 0, .fence = (settings->flags & SMEAR_FENCE) != 0,
        .guertin = (settings->flags & SMEAR_DIRECTION) != 0, .orthographic = settings->orthographic,
        .published = (settings->flags & SMEAR_PUBLISHED) != 0, .wanted = clamp_i32(settings->samples / 2, 1, 64),
        .far_units = blur_far_units(settings),
        .color = w->color + x0, .depth_code = w->depth + x0, .x0 = x0
    };
    struct direction direction[9];
    uint32_t taps = 0;
    if (!directions_make(direction, &g, row, column)) {
        smear_blur_copy(out, w, rows, column);
        return 0;
    }
    own_depth_make(&g, 0);
    for (int32_t y = rows->y0; y < rows->y1; y++, out += w->tile) {
        uint32_t at = rows->offset[y - rows->first] + (uint32_t)x0, inner = (uint32_t)x0 * NOISE_X + (uint32_t)y * NOISE_Y;
        for (int32_t x = 0; x < n; x++, at++, inner += NOISE_X) {
            struct direction *top = choose(direction, w, x, y - y0, inner);
            if (top->pairs == 0) {
                out[x] = w->color[at];
                continue;
            }
            if (w->depth[at] != g.depth.code)
                own_depth_make(&g, w->depth[at]);
            out[x] = gather(&g, top, (int32_t)at - x0, x, y - rows->first, noise_of(inner));
            taps += 2u * (uint32_t)top->pairs + 1u;
        }
    }
    return taps;
}

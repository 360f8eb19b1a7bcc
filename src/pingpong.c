/* SPDX-License-Identifier: MIT */
/* pingpong.c - see pingpong.h. */
#include "pingpong.h"

#include "fixmath.h"
#include "noise.h"
#include "pixel.h"

/* ------------------------------------------------------------------ passes */

bool smear_pingpong_resolve(smear_pingpong *p)
{
    if (p->passes == 0)
        p->passes = 2;
    if (p->taps == 0)
        p->taps = 8;
    if (p->base == 0)
        p->base = p->taps;
    if (p->bias == 0)
        p->bias = 4;
    return p->passes <= PINGPONG_PASSES_MAX && p->taps >= 2 && p->taps <= 64 && p->base >= 2 && p->base <= 64
        && p->jitter <= 128 && p->spread <= 1;
}

int smear_pingpong_plan(struct smear_pass pass[PINGPONG_PASSES_MAX], const smear_pingpong *p, int32_t reach)
{
    /* Taps lie at odd multiples (even ones for odd numbers) of half a spacing, base^k / whole in the k-th pass from the last:
     * `whole` brings the outermost tap of all passes together, and half a spacing of the last beyond it, to the end of the
     * streak. */
    int32_t power = 1, sum = 0;
    for (int k = 0; k < p->passes; k++, power *= p->base)
        sum += power;
    int32_t whole = (p->taps - 1) * sum + 1;
    power = power / p->base;
    for (int k = 0; k < p->passes; k++, power /= p->base) {
        /* power is below whole; 2^20 power / whole in two digits of 2^10. */
        int32_t high = (power << 10) / whole, low = (((power << 10) - high * whole) << 10) / whole;
        int32_t spacing = (high << 10) + low;
        int32_t farthest = (p->taps - 1) * spacing + (spacing * p->jitter >> 7);
        pass[k] = (struct smear_pass){
            .taps = p->taps, .direct_up_to = p->passes > 1 ? min_i32(p->taps * p->passes, 64) / 2 : -1,
            .all_taps = min_i32(p->taps * p->passes, 64), .direct_spacing = (1 << 20) / min_i32(p->taps * p->passes, 64),
            .is_last = k == p->passes - 1, .spacing = spacing,
            .reach = min_i32(((farthest >> 4) * reach + (1 << 15)) >> 16, reach),
            .jitter = p->jitter * 2, .bias = p->bias, .spread = p->spread != 0
        };
    }
    return p->passes;
}

/* ------------------------------------------------------------------ a pixel */

/* Where the taps of a pixel lie, from its middle: q16 px. */
struct taps {
    int32_t first_x, first_y, step_x, step_y;
};

/* `count` taps, half of what lies between two `spacing` (q20 of v). */
static struct taps taps_along(struct smear_pixel_velocity v, int32_t count, int32_t spacing)
{
    /* |v| < 2^9 in q3, spacing at most 2^20: q23. */
    int32_t x = v.x * spacing >> 7, y = v.y * spacing >> 7;
    return (struct taps){ -(count - 1) * x, -(count - 1) * y, 2 * x, 2 * y };
}

/* 2^24 / n, rounded up: equal values keep their mean (blur_uniform.c). */
static const uint32_t share[65] = {
    0, 16777216, 8388608, 5592406, 4194304, 3355444, 2796203, 2396746, 2097152, 1864136, 1677722, 1525202, 1398102,
    1290556, 1198373, 1118482, 1048576, 986896, 932068, 883012, 838861, 798916, 762601, 729445, 699051, 671089, 645278,
    621379, 599187, 578525, 559241, 541201, 524288, 508401, 493448, 479350, 466034, 453439, 441506, 430186, 419431,
    409201, 399458, 390168, 381301, 372828, 364723, 356963, 349526, 342393, 335545, 328966, 322639, 316552, 310690,
    305041, 299594, 294338, 289263, 284360, 279621, 275037, 270601, 266306, 262144
};

struct sums {
    uint32_t r, g, b;           /* linear */
    uint32_t all, red_blue;     /* encoded: red and blue side by side; the difference is green, 256 times */
    uint32_t count;
};

SMEAR_INLINE void sums_add(struct sums *s, uint32_t p, bool linear)
{
    if (linear) {
        s->r += smear_srgb_decode[pixel_red(p)];
        s->g += smear_srgb_decode[pixel_green(p)];
        s->b += smear_srgb_decode[pixel_blue(p)];
    } else {
        s->all += p;
        s->red_blue += p & 0xff00ffu;
    }
    s->count++;
}

SMEAR_INLINE uint32_t sums_mean(const struct sums *s, bool linear)
{
    uint32_t over = share[s->count];
    if (linear)
        return pixel_make(0, smear_srgb_encode[mulh_u32(s->r << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32(s->g << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32(s->b << 8, over) >> 4]);
    over >>= 8;
    uint32_t g = (s->all - s->red_blue) >> 8 & 0xffffu;
    return pixel_make(0, ((s->red_blue >> 16) * over + 0x8000u) >> 16, (g * over + 0x8000u) >> 16,
                      ((s->red_blue & 0xffffu) * over + 0x8000u) >> 16);
}

/* ------------------------------------------------------------------ a tile */

struct passing {
    const struct smear_window *w;
    const struct smear_pass *pass;
    const struct smear_blur_settings *settings;
    const uint32_t *in;
    const uint16_t *depth;
    const uint32_t *row;        /* offsets of rows, from the table's first */
    uint32_t far_units;         /* orthographic: from the eye to the far plane */
    /* kept from pixel to pixel: what follows from velocity and from depth */
    uint32_t word, code;
    struct taps taps;
    int32_t count;              /* of them; 0: the pixel stays as it is */
    uint32_t limit;             /* the nearest that is not too near: a code */
};

/* The taps of a pixel in this pass. */
static void taps_choose(struct passing *p, struct smear_pixel_velocity v)
{
    const struct smear_pass *pass = p->pass;
    int32_t streak = (max_i32(abs_i32(v.x), abs_i32(v.y)) + 3) >> 2;        /* px */
    int32_t spacing = pass->spacing;
    p->count = pass->taps;
    if (streak <= pass->direct_up_to) {
        p->count = pass->is_last ? pass->all_taps : 0;
        spacing = pass->direct_spacing;
    }
    p->taps = taps_along(v, p->count, spacing);
}

/* The code of the nearest depth that a tap may have. */
static uint16_t nearest_allowed(const struct passing *p, uint16_t code)
{
    if (p->pass->bias == 255)
        return 65535;
    uint32_t units = smear_depth_units(code);
    uint32_t part = p->settings->orthographic ? (p->far_units - units) >> 4 : units >> 4;     /* 16 bits and a few */
    units += (part * (uint32_t)p->pass->bias >> 4) + 1u;
    return (uint16_t)(units < 32768u ? units : min_u32(32768u + ((units - 32768u) >> 4), 65535u));
}

/* The mean of a pixel's taps, those in front of it left out. tx, ty: the first, q16, in the frame and in
 * the table. */
SMEAR_INLINE uint32_t gather(const struct passing *p, uint32_t at, int32_t tx, int32_t ty, bool linear, bool edge)
{
    const uint32_t *in = p->in, *row = p->row;
    const uint16_t *depth = p->depth;
    const int32_t right = p->w->width - 1, step_x = p->taps.step_x, step_y = p->taps.step_y;
    const uint32_t limit = p->limit;
    struct sums s = { 0, 0, 0, 0, 0, 0 };
    for (int32_t i = p->count; i > 0; i--, tx += step_x, ty += step_y) {
        int32_t column = tx >> 16;
        if (edge)
            column = clamp_i32(column, 0, right);
        uint32_t tap = row[ty >> 16] + (uint32_t)column;
        if (depth[tap] <= limit)
            sums_add(&s, in[tap], linear);
    }
    return s.count != 0 ? sums_mean(&s, linear) : in[at];
}

/* What may come over a pixel: taps lie along the neighbourhood's motion. At each, either something as near as the pixel
 * moves far enough to be here at that time; or the pixel's own motion brings what lies there; or the pixel shows itself. */
static SMEAR_NOINLINE uint32_t gather_spread(const struct passing *p, uint32_t at, int32_t x, int32_t y,
                                             struct smear_pixel_velocity own, struct smear_pixel_velocity top)
{
    const struct smear_window *w = p->w;
    const int32_t right = w->width - 1, half = p->pass->taps - 1;
    struct taps t = taps_along(top, p->pass->taps, p->pass->spacing);
    bool linear = p->settings->linear;
    int32_t code = w->depth[at], behind = max_i32(2 * code - (int32_t)p->limit, 0);
    int32_t own_square = own.x * own.x + own.y * own.y;
    int32_t tx = (x << 16) + 0x8000 + t.first_x, ty = (y << 16) + 0x8000 + t.first_y;
    struct sums s = { 0, 0, 0, 0, 0, 0 };
    for (int32_t i = -half; i <= half; i += 2, tx += t.step_x, ty += t.step_y) {
        uint32_t tap = p->row[ty >> 16] + (uint32_t)clamp_i32(tx >> 16, 0, right);
        struct smear_pixel_velocity v = window_velocity(w, tap);
        /* How far away it is, 1/8 px along each axis. */
        int32_t dx = i * (top.x * p->pass->spacing >> 10) >> 10, dy = i * (top.y * p->pass->spacing >> 10) >> 10;
        int32_t square = dx * dx + dy * dy;
        bool comes = w->depth[tap] >= behind && v.x * v.x + v.y * v.y >= square;
        bool goes = w->depth[tap] <= p->limit && own_square >= square;
        sums_add(&s, p->in[comes || goes ? tap : at], linear);
    }
    return sums_mean(&s, linear);
}

SMEAR_INLINE uint32_t pass_tile(struct passing *p, uint32_t *out, int32_t stride, const struct smear_row_table *rows,
                                int32_t row, int32_t column, int32_t y0, int32_t y1, bool linear, bool edge)
{
    const struct smear_window *w = p->w;
    const struct smear_tile_neighborhood *around = &window_around(w, row)[column];
    const struct smear_pixel_velocity top = { around->x >> 5, around->y >> 5 };
    int32_t top_square = top.x * top.x + top.y * top.y;
    bool spreads = p->pass->spread && top_square >= 64;         /* 1 px */
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    const int32_t jitter = p->pass->jitter;
    uint32_t taken = 0;
    p->limit = nearest_allowed(p, 0);
    for (int32_t y = y0; y < y1; y++) {
        uint32_t at = rows->offset[y - rows->first] + (uint32_t)x0;
        uint32_t *to = stride != 0 ? out + (y - y0) * stride : out + at;
        const int32_t middle_y = ((y - rows->first) << 16) + 0x8000;
        int32_t middle_x = (x0 << 16) + 0x8000;
        for (int32_t x = x0; x < x1; x++, at++, to++, middle_x += 1 << 16) {
            uint32_t word = window_velocity_word(w, at);
            if (word == 0 && !spreads) {
                *to = p->in[at];
                continue;
            }
            if (p->depth[at] != p->code) {
                p->code = p->depth[at];
                p->limit = nearest_allowed(p, (uint16_t)p->code);
            }
            if (spreads) {
                struct smear_pixel_velocity v = window_velocity(w, at);
                if ((v.x * v.x + v.y * v.y) * 2 < top_square) {
                    *to = gather_spread(p, at, x, y - rows->first, v, top);
                    taken += (uint32_t)p->pass->taps;
                    continue;
                }
            }
            if (word != p->word) {
                p->word = word;
                taps_choose(p, window_velocity(w, at));
            }
            if (p->count == 0) {
                *to = p->in[at];
                continue;
            }
            taken += (uint32_t)p->count;
            int32_t tx = middle_x + p->taps.first_x, ty = middle_y + p->taps.first_y;
            if (jitter != 0) {
                int32_t noise = (int32_t)noise_of((uint32_t)x * NOISE_X + (uint32_t)y * NOISE_Y) - 32768;
                noise = noise * jitter >> 8;                                        /* q16 of half a spacing */
                tx += (p->taps.step_x >> 6) * (noise >> 6) >> 4;
                ty += (p->taps.step_y >> 6) * (noise >> 6) >> 4;
            }
            *to = gather(p, at, tx, ty, linear, edge);
        }
    }
    return taken;
}

uint32_t smear_pingpong_pass(uint32_t *out, int32_t stride, const uint32_t *in, const struct smear_window *w,
                             const struct smear_row_table *rows, const struct smear_pass *pass, int32_t row,
                             int32_t column, int32_t y0, int32_t y1, const struct smear_blur_settings *settings)
{
    struct passing p = { .w = w, .pass = pass, .settings = settings, .in = in, .depth = w->depth,
                         .row = rows->offset };
    if (settings->orthographic)
        p.far_units = (uint32_t)((uint64_t)settings->far_over_range * SMEAR_DEPTH_NEAR >> 16);
    int32_t x0 = column << w->tile_shift;
    bool edge = x0 < pass->reach + 1 || x0 + w->tile + pass->reach + 1 > w->width;
    if (settings->linear)
        return pass_tile(&p, out, stride, rows, row, column, y0, y1, true, true);
    return edge ? pass_tile(&p, out, stride, rows, row, column, y0, y1, false, true)
                : pass_tile(&p, out, stride, rows, row, column, y0, y1, false, false);
}

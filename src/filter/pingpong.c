/* SPDX-License-Identifier: MIT */
/* pingpong.c - plans the passes, and gathers a tile's pixels in one of them. */
#include "filter/pingpong.h"

#include "filter/gather.h"

/* ------------------------------------------------------------------ passes */

int smear_pingpong_plan(struct smear_pass pass[PINGPONG_PASSES_MAX], const smear_pingpong *p, int32_t reach)
{
    /* Taps lie at odd multiples (even ones for odd numbers) of half a spacing, base^k / whole in the k-th
     * pass from the last: `whole` brings the outermost tap of all passes together, and half a spacing of the
     * last beyond it, to the end of the streak. */
    int32_t power = 1, sum = 0;
    for (int k = 0; k < p->passes; k++, power *= p->base)
        sum += power;
    int32_t whole = (p->taps - 1) * sum + 1;
    power = power / p->base;
    for (int k = 0; k < p->passes; k++, power /= p->base) {
        /* power is below whole; 2^20 power / whole in two digits of 2^10. */
        int32_t high = (power << 10) / whole, low = (((power << 10) - high * whole) << 10) / whole;
        int32_t spacing = (high << 10) + low;
        /* Where passes overlap, as `base` is above `taps`, jitter would take the outermost tap beyond the reach: there it
         * moves no farther than to the end of the streak. */
        const int32_t outermost = (p->taps - 1) * spacing, beyond = (1 << 20) - outermost;
        const int32_t jitter = spacing * p->jitter >> 7 <= beyond ? p->jitter : (beyond << 7) / spacing;
        const int32_t farthest = outermost + (spacing * jitter >> 7);
        pass[k] = (struct smear_pass){
            .taps = p->taps, .direct_up_to = p->passes > 1 ? min_i32(p->taps * p->passes, 64) / 2 : -1,
            .all_taps = min_i32(p->taps * p->passes, 64),
            .direct_spacing = (1 << 20) / min_i32(p->taps * p->passes, 64),
            .is_last = k == p->passes - 1, .spacing = spacing,
            .reach = min_i32(((farthest >> 4) * reach + (1 << 15)) >> 16, reach),
            .jitter = jitter * 2, .bias = p->bias, .spread = p->spread != 0
        };
    }
    return p->passes;
}

/* ------------------------------------------------------------------ means */

/* 2^24 / n, rounded up. */
static const uint32_t share[65] = {
    0, 16777216, 8388608, 5592406, 4194304, 3355444, 2796203, 2396746, 2097152, 1864136, 1677722, 1525202,
    1398102, 1290556, 1198373, 1118482, 1048576, 986896, 932068, 883012, 838861, 798916, 762601, 729445,
    699051, 671089, 645278, 621379, 599187, 578525, 559241, 541201, 524288, 508401, 493448, 479350, 466034,
    453439, 441506, 430186, 419431, 409201, 399458, 390168, 381301, 372828, 364723, 356963, 349526, 342393,
    335545, 328966, 322639, 316552, 310690, 305041, 299594, 294338, 289263, 284360, 279621, 275037, 270601,
    266306, 262144
};

/* Columns before the frame where positions are not negative: more than any reach. */
enum { EDGE = 256 };

/* Returns the mean of 2^shift taps, where `all` began with 0x010101 halves of that, `red_blue` with 0x010001. */
SMEAR_INLINE uint32_t mean_shift(const struct even_sum *s, int shift, bool linear)
{
    if (linear)
        return pixel_make(0, smear_srgb_encode[s->r >> (shift + 4)], smear_srgb_encode[s->g >> (shift + 4)],
                          smear_srgb_encode[s->b >> (shift + 4)]);
    return (s->red_blue >> shift & 0xff00ffu) | ((s->all - s->red_blue) >> shift & 0xff00u);
}

/* ------------------------------------------------------------------ taps */

/* Where the taps of a pixel lie, from its middle: q16 px, x below and y above in one word each: positions
 * are not negative, a sum carries as it should. */
struct taps {
    uint64_t first, step;
    uint32_t all;               /* what sums begin with: halves, if there is a shift */
    int32_t count;              /* 0: the pixel stays as it is */
    uint32_t red_blue;          /* as `all` */
    int shift;                  /* log2 of the count, or -1 */
};

static inline uint64_t both_of(int32_t x, int32_t y)
{
    return ((uint64_t)(uint32_t)y << 32) + (uint64_t)(int64_t)x;
}

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
    uint32_t limit;             /* the nearest that is not too near: a code */
};

/* Chooses the taps of a pixel in this pass. */
static SMEAR_NOINLINE void taps_choose(struct passing *p, struct smear_pixel_velocity v)
{
    const struct smear_pass *pass = p->pass;
    struct taps *t = &p->taps;
    int32_t streak = (max_i32(abs_i32(v.x), abs_i32(v.y)) + 3) >> 2;        /* px */
    int32_t spacing = pass->spacing, count = pass->taps;
    if (streak <= pass->direct_up_to) {
        spacing = pass->direct_spacing;
        count = pass->is_last && streak != 0 ? pass->all_taps : 0;
    }
    t->count = count;
    if (count == 0)
        return;
    /* |v| < 2^9 in q3, spacing at most 2^20: q23. */
    int32_t x = v.x * spacing >> 7, y = v.y * spacing >> 7;
    bool even = (count & (count - 1)) == 0;
    uint32_t half = even ? (uint32_t)count >> 1 : 0;
    t->first = both_of(-(count - 1) * x, -(count - 1) * y);
    t->step = both_of(2 * x, 2 * y);
    t->shift = even ? 31 - count_leading_zeros((uint32_t)count) : -1;
    t->all = half * 0x010101u;
    t->red_blue = half * 0x010001u;
}

/* Returns the code of the nearest depth that a tap may have. */
static uint16_t nearest_allowed(const struct passing *p, uint16_t code)
{
    if (p->pass->bias == 255)
        return 65535;
    uint32_t units = smear_depth_units(code);
    /* 16 bits and a few */
    uint32_t part = p->settings->orthographic ? (p->far_units - units) >> 4 : units >> 4;
    units += (part * (uint32_t)p->pass->bias >> 4) + 1u;
    return (uint16_t)(units < 32768u ? units : min_u32(32768u + ((units - 32768u) >> 4), 65535u));
}

static SMEAR_NOINLINE void limit_choose(struct passing *p, uint32_t code)
{
    p->code = code;
    p->limit = nearest_allowed(p, (uint16_t)code);
}

/* Returns the mean where not all taps count, or not 2^n of them. */
static SMEAR_NOINLINE uint32_t mean_of_some(struct even_sum *s, uint32_t count, const struct taps *t, uint32_t own,
                                            bool linear)
{
    s->all -= t->all;
    s->red_blue -= t->red_blue;
    return count != 0 ? even_mean(s, share[count], linear) : own;
}

/* Returns the mean of a pixel's taps without those in front of it. `place` is the first one: its column in the frame
 * and its row in the table. */
SMEAR_INLINE uint32_t gather(const struct passing *p, const struct taps *t, uint32_t at, uint64_t place,
                             uint32_t limit, bool linear, bool edge)
{
    const uint32_t *in = p->in, *row = p->row;
    const uint16_t *depth = p->depth;
    const int32_t right = p->w->width - 1;
    const uint64_t step = t->step;
    struct even_sum s = { 0, 0, 0, t->all, t->red_blue };
    uint32_t count = 0;
    int32_t i = t->count;
    do {
        uint32_t column = (uint32_t)place >> 16;
        if (edge)
            column = (uint32_t)clamp_i32((int32_t)column - EDGE, 0, right);
        SMEAR_ASSERT(column < (uint32_t)p->w->width);
        uint32_t tap = row[place >> 48] + column;
        if (depth[tap] <= limit) {
            even_add(&s, in[tap], linear);
            count++;
        }
        place += step;
    } while (--i != 0);
    if (count == (uint32_t)t->count && t->shift >= 0)
        return mean_shift(&s, t->shift, linear);
    struct even_sum some = s;
    return mean_of_some(&some, count, t, in[at], linear);
}

/* Gathers what may come over a pixel, by taps along the neighbourhood's motion. At each, either something as near as
 * the pixel moves far enough to be here at that time, or the pixel's own motion brings what lies there, or the pixel
 * shows itself. */
static SMEAR_NOINLINE uint32_t gather_spread(const struct passing *p, uint32_t at, int32_t x, int32_t y,
                                             struct smear_pixel_velocity own, struct smear_pixel_velocity top)
{
    const struct smear_window *w = p->w;
    const int32_t right = w->width - 1, half = p->pass->taps - 1;
    /* half of it */
    const int32_t step_x = top.x * p->pass->spacing >> 7, step_y = top.y * p->pass->spacing >> 7;
    bool linear = p->settings->linear;
    int32_t code = w->depth[at], limit = (int32_t)p->limit, behind = max_i32(2 * code - limit, 0);
    int32_t own_square = own.x * own.x + own.y * own.y;
    int32_t tx = (x << 16) + 0x8000 - half * step_x, ty = (y << 16) + 0x8000 - half * step_y;
    struct even_sum s = { 0, 0, 0, 0, 0 };
    for (int32_t i = -half; i <= half; i += 2, tx += 2 * step_x, ty += 2 * step_y) {
        uint32_t tap = p->row[ty >> 16] + (uint32_t)clamp_i32(tx >> 16, 0, right);
        struct smear_pixel_velocity v = window_velocity(w, tap);
        /* How far away it is, 1/8 px along each axis. */
        int32_t dx = i * (top.x * p->pass->spacing >> 10) >> 10,
                dy = i * (top.y * p->pass->spacing >> 10) >> 10;
        int32_t square = dx * dx + dy * dy;
        bool comes = w->depth[tap] >= behind && v.x * v.x + v.y * v.y >= square;
        bool goes = w->depth[tap] <= limit && own_square >= square;
        even_add(&s, p->in[comes || goes ? tap : at], linear);
    }
    return even_mean(&s, share[p->pass->taps], linear);
}

/* ------------------------------------------------------------------ a tile */

/* Returns how far jitter moves the first tap, q16 px; `jitter` is q8 of half a spacing. */
static SMEAR_NOINLINE uint64_t shake(const struct taps *t, int32_t jitter, int32_t x, int32_t y)
{
    int32_t step_x = (int32_t)(uint32_t)t->step;
    int32_t step_y = (int32_t)(uint32_t)((t->step - (uint64_t)(int64_t)step_x) >> 32);
    int32_t noise = (int32_t)noise_of((uint32_t)x * NOISE_X + (uint32_t)y * NOISE_Y) - 32768;
    noise = noise * jitter >> 8;                                        /* q16 of half a spacing */
    return both_of((step_x >> 6) * (noise >> 6) >> 4, (step_y >> 6) * (noise >> 6) >> 4);
}

/* Speed wants loops of their own for rows whose taps need no check: 0.8 kB of code. */
#ifdef __OPTIMIZE_SIZE__
#define PLAIN_ROWS 0
#else
#define PLAIN_ROWS 1
#endif

typedef uint32_t pass_row_fn(struct passing *p, uint32_t *to, uint32_t at, int32_t x, int32_t x1,
                             int32_t table_y);

/* Filters pixels [x, x1) of a row: the first is at `at` and goes to *to, table_y is its row in the table. Returns the
 * taps taken. */
SMEAR_INLINE uint32_t pass_row(struct passing *p, uint32_t *to, uint32_t at, int32_t x, int32_t x1,
                               int32_t table_y, bool linear, bool wide)
{
    const struct smear_window *w = p->w;
    const uint32_t *in = p->in;
    const uint16_t *depth = p->depth;
    const int8_t *velocity = wide ? (const int8_t *)w->velocity16 : w->velocity8;
    const bool masks = p->pass->bias != 255;
    struct taps t = p->taps;
    uint32_t taken = 0, limit = p->limit, last = p->word;
    uint64_t middle = both_of((x << 16) + 0x8000, (table_y << 16) + 0x8000);
    for (uint32_t *const end = to + (x1 - x); to != end; middle += 1 << 16, at++, to++) {
        uint32_t word;
        uint16_t narrow;
        if (wide) {
            __builtin_memcpy(&word, __builtin_assume_aligned(velocity + 4 * at, 4), 4);
        } else {
            __builtin_memcpy(&narrow, __builtin_assume_aligned(velocity + 2 * at, 2), 2);
            word = narrow;
        }
        if (word != last) {
            taps_choose(p, window_velocity(w, at));
            t = p->taps;
            last = word;
        }
        if (t.count == 0) {
            *to = in[at];
            continue;
        }
        if (masks && depth[at] != p->code) {
            limit_choose(p, depth[at]);
            limit = p->limit;
        }
        taken += (uint32_t)t.count;
        *to = gather(p, &t, at, middle + t.first, limit, linear, false);
    }
    p->word = last;
    return taken;
}

/* There is a function for linear light and for codes, with velocities of either size. */
#define PASS_ROW(NAME, LINEAR, WIDE) \
    static SMEAR_NOINLINE uint32_t NAME(struct passing *p, uint32_t *to, uint32_t at, int32_t x, int32_t x1, \
                                        int32_t table_y) \
    { \
        return pass_row(p, to, at, x, x1, table_y, LINEAR, WIDE); \
    }
PASS_ROW(row_light, true, false)
PASS_ROW(row_codes, false, false)
PASS_ROW(row_light_wide, true, true)
PASS_ROW(row_codes_wide, false, true)
#undef PASS_ROW

static pass_row_fn *row_of(const struct passing *p)
{
    if (p->w->velocity8 == NULL)
        return p->settings->linear ? row_light_wide : row_codes_wide;
    return p->settings->linear ? row_light : row_codes;
}

/* Filters pixels of a row at the frame's sides, with jitter, or where moving things spread. `top` is the longest motion
 * around, y the row in the frame. */
static uint32_t pass_row_any(struct passing *p, uint32_t *to, uint32_t at, int32_t x, int32_t x1,
                             int32_t table_y, int32_t y, struct smear_pixel_velocity top)
{
    const int32_t top_square = top.x * top.x + top.y * top.y, jitter = p->pass->jitter;
    const bool spreads = p->pass->spread && top_square >= 64, linear = p->settings->linear;        /* 1 px */
    uint32_t taken = 0;
    for (; x < x1; x++, at++, to++) {
        struct smear_pixel_velocity v = window_velocity(p->w, at);
        if (p->pass->bias != 255 && p->depth[at] != p->code)
            limit_choose(p, p->depth[at]);
        if (spreads && (v.x * v.x + v.y * v.y) * 2 < top_square) {
            *to = gather_spread(p, at, x, table_y, v, top);
            taken += (uint32_t)p->pass->taps;
            continue;
        }
        if (window_velocity_word(p->w, at) != p->word) {
            p->word = window_velocity_word(p->w, at);
            taps_choose(p, v);
        }
        const struct taps *t = &p->taps;
        taken += (uint32_t)t->count;
        if (t->count == 0) {
            *to = p->in[at];
            continue;
        }
        uint64_t place = both_of(((x + EDGE) << 16) + 0x8000, (table_y << 16) + 0x8000) + t->first;
        if (jitter != 0)
            place += shake(t, jitter, x, y);
        *to = linear ? gather(p, t, at, place, p->limit, true, true)
                     : gather(p, t, at, place, p->limit, false, true);
    }
    return taken;
}

uint32_t smear_pingpong_pass(uint32_t *out, int32_t stride, const uint32_t *in, const struct smear_window *w,
                             const struct smear_row_table *rows, const struct smear_pass *pass, int32_t row,
                             int32_t column, int32_t y0, int32_t y1,
                             const struct smear_blur_settings *settings)
{
    struct passing p = { .w = w, .pass = pass, .settings = settings, .in = in, .depth = w->depth,
                         .row = rows->offset, .far_units = blur_far_units(settings) };
    const struct smear_tile_neighborhood *around = &window_around(w, row)[column];
    const struct smear_pixel_velocity top = { around->x >> 5, around->y >> 5 };
    const int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    /* Short streaks are taken whole by the last pass, and go to both sides: they may be longer than what it reaches. */
    const int32_t beyond = max_i32(pass->reach, (pass->direct_up_to + 1) >> 1) + 1;
    const bool any = !PLAIN_ROWS || pass->spread || pass->jitter != 0 || x0 < beyond || x1 + beyond > w->width;
    uint32_t taken = 0;
    p.limit = nearest_allowed(&p, 0);
    for (int32_t y = y0; y < y1; y++) {
        const int32_t table_y = y - rows->first;
        uint32_t at = rows->offset[table_y] + (uint32_t)x0;
        uint32_t *to = stride != 0 ? out + (y - y0) * stride : out + at;
        if (any)
            taken += pass_row_any(&p, to, at, x0, x1, table_y, y, top);
        else
            taken += row_of(&p)(&p, to, at, x0, x1, table_y);
    }
    return taken;
}

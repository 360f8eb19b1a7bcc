/* SPDX-License-Identifier: MIT */
/* pingpong.c - a blur in passes of few taps each, spaced closer from pass to pass: 8 and 8 taps gather like 64. Plans the passes, and
 * gathers a tile's pixels in one of them.
 *
 * After Sousa's directional blurs (GDC 2008, 2013) and their use for motion: velocity and depth are looked
 * up where the result goes, taps that are nearer than that are left out, so that what is in front does not
 * bleed over what is behind. Taps lie at even steps to both sides, and a pass covers just one step of the
 * one before it: then no position counts twice, and the passes are a box. Wide steps come first: the
 * narrow ones even out what falls between pixels. */
#include "filter/filter.h"

#include "filter/gather.h"
#include "kernels/kernels.h"

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

/* ------------------------------------------------------------------ taps */

struct passing {
    const struct smear_window *w;
    const struct smear_pass *pass;
    const struct smear_blur_settings *settings;
    const uint32_t *in;
    const uint32_t *row;        /* offsets of rows, from the table's first */
    uint32_t far_units;         /* orthographic: from the eye to the far plane */
};

/* A pixel on its way through a pass. */
struct place {
    uint32_t at;                /* index in the planes */
    int32_t x, y, table_y;      /* y: in the frame; table_y: in the table of rows */
};

/* Returns 2^24 / n, rounded up. */
static uint32_t share_of(int32_t n) { return ((1u << 24) + (uint32_t)n - 1u) / (uint32_t)n; }

/* Returns the code of the nearest depth that a tap may have. */
static uint32_t nearest_allowed(const struct passing *p, uint16_t code)
{
    if (p->pass->bias == 255)
        return 65535;
    uint32_t units = smear_depth_units(code);
    /* 16 bits and a few */
    uint32_t part = p->settings->orthographic ? (p->far_units - units) >> 4 : units >> 4;
    units += (part * (uint32_t)p->pass->bias >> 4) + 1u;
    return depth_code_of(units);
}

/* Returns how far jitter moves the first tap along an axis, q16 px; `step` is that from tap to tap. */
static int32_t shaken(const struct passing *p, const struct place *at, int32_t step)
{
    int32_t noise = (int32_t)noise_of((uint32_t)at->x * NOISE_X + (uint32_t)at->y * NOISE_Y) - 32768;
    noise = noise * p->pass->jitter >> 8;       /* q16 of half a spacing */
    return (step >> 6) * (noise >> 6) >> 4;
}

/* Stores the mean of a pixel's taps without those in front of it. Returns the taps taken: 0, where the pixel stays as it is. */
static int32_t gather(const struct passing *p, const struct place *at, uint32_t *out)
{
    const struct smear_window *w = p->w;
    const struct smear_pass *pass = p->pass;
    const struct smear_pixel_velocity v = window_velocity(w, at->at);
    const int32_t streak = (max_i32(abs_i32(v.x), abs_i32(v.y)) + 3) >> 2;      /* px */
    int32_t spacing = pass->spacing, n = pass->taps;
    if (streak <= pass->direct_up_to) {
        spacing = pass->direct_spacing;
        n = pass->is_last && streak != 0 ? pass->all_taps : 0;
    }
    *out = p->in[at->at];
    if (n == 0)
        return 0;
    /* |v| < 2^9 in q3, spacing at most 2^20: q23. */
    const int32_t dx = v.x * spacing >> 7, dy = v.y * spacing >> 7;
    const uint32_t limit = nearest_allowed(p, w->depth[at->at]);
    int32_t x = (at->x << 16) + 0x8000 - (n - 1) * dx, y = (at->table_y << 16) + 0x8000 - (n - 1) * dy, count = 0;
    struct even_sum s = { 0, 0, 0, 0, 0 };
    if (pass->jitter != 0) {
        x += shaken(p, at, 2 * dx);
        y += shaken(p, at, 2 * dy);
    }
    for (int32_t i = 0; i < n; i++, x += 2 * dx, y += 2 * dy) {
        const uint32_t tap = p->row[y >> 16] + (uint32_t)clamp_i32(x >> 16, 0, w->width - 1);
        if (w->depth[tap] <= limit) {
            even_add(&s, p->in[tap], p->settings);
            count++;
        }
    }
    if (count != 0)
        *out = even_mean(&s, share_of(count), false, p->settings);
    return n;
}

/* Gathers what may come over a pixel, by taps along the neighbourhood's motion. At each, either something as near as
 * the pixel moves far enough to be here at that time, or the pixel's own motion brings what lies there, or the pixel
 * shows itself. */
static uint32_t gather_spread(const struct passing *p, const struct place *here, struct smear_pixel_velocity top)
{
    const struct smear_window *w = p->w;
    const int32_t right = w->width - 1, half = p->pass->taps - 1;
    /* half of it */
    const int32_t step_x = top.x * p->pass->spacing >> 7, step_y = top.y * p->pass->spacing >> 7;
    const struct smear_pixel_velocity own = window_velocity(w, here->at);
    const int32_t code = w->depth[here->at], limit = (int32_t)nearest_allowed(p, w->depth[here->at]), behind = max_i32(2 * code - limit, 0);
    int32_t own_square = own.x * own.x + own.y * own.y;
    int32_t tx = (here->x << 16) + 0x8000 - half * step_x, ty = (here->table_y << 16) + 0x8000 - half * step_y;
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
        even_add(&s, p->in[comes || goes ? tap : here->at], p->settings);
    }
    return even_mean(&s, share_of(p->pass->taps), false, p->settings);
}

/* ------------------------------------------------------------------ a tile */

uint32_t smear_pingpong_pass(uint32_t *out, int32_t stride, const uint32_t *in, const struct smear_window *w,
                             const struct smear_row_table *rows, const struct smear_pass *pass, int32_t row,
                             int32_t column, int32_t y0, int32_t y1,
                             const struct smear_blur_settings *settings)
{
    const struct passing p = { w, pass, settings, in, rows->offset, blur_far_units(settings) };
    const struct smear_tile_neighborhood *around = &window_around(w, row)[column];
    const struct smear_pixel_velocity top = { around->x >> 5, around->y >> 5 };
    const int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    const int32_t top_square = top.x * top.x + top.y * top.y;
    const bool spreads = pass->spread && top_square >= 64;      /* 1 px */
    int32_t taken = 0;
    for (int32_t y = y0; y < y1; y++) {
        struct place at = { rows->offset[y - rows->first] + (uint32_t)x0, x0, y, y - rows->first };
        uint32_t *to = stride != 0 ? out + (y - y0) * stride : out + at.at;
        for (; at.x < x1; at.x++, at.at++, to++) {
            const struct smear_pixel_velocity v = window_velocity(w, at.at);
            if (!spreads || (v.x * v.x + v.y * v.y) * 2 >= top_square) {
                taken += gather(&p, &at, to);
                continue;
            }
            *to = gather_spread(&p, &at, top);
            taken += pass->taps;
        }
    }
    return (uint32_t)taken;
}

/* SPDX-License-Identifier: MIT */
/* uniform.c - tiles in whose reach all motion is alike or changes without a step get an unweighted mean along each
 * pixel's own velocity, without a look at depths; tiles that nothing moves in are copied. */
#include "filter/filter.h"

#include "filter/gather.h"

void smear_blur_copy(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows,
                     int32_t column)
{
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    for (int32_t y = rows->y0; y < rows->y1; y++, out += w->tile) {
        const uint32_t *in = w->color + window_ring_row(w, y) * w->width + x0;
        for (int32_t i = 0; i < x1 - x0; i++)
            out[i] = in[i];
    }
}

/* The taps of a pixel: n / 2 pairs at the midpoints of n equal parts of [-v, v], all in q16 px. */
struct uniform_taps {
    int32_t first_x, first_y;   /* of the innermost pair: v / n */
    int32_t step_x, step_y;     /* from pair to pair: 2 v / n */
};

/* Takes the mean of n taps. Where things that move with the camera may be in front (`held`), a tap that meets one, static and nearer,
 * counts as the pixel itself. */
static uint32_t mean_along(const struct smear_window *w, const uint32_t *row_offset, uint32_t at, int32_t x, int32_t y,
                           const struct uniform_taps *taps, int32_t n, uint32_t over, const struct smear_blur_settings *settings)
{
    int32_t dx = -taps->first_x - (n / 2 - 1) * taps->step_x,
            dy = -taps->first_y - (n / 2 - 1) * taps->step_y;
    const bool held = SMEAR_WITH_FILTERS && settings->held;
    struct even_sum sum = { 0, 0, 0, 0, 0 };
    for (int32_t i = n; i > 0; i--, dx += taps->step_x, dy += taps->step_y) {
        const int32_t column = clamp_i32(((x << 16) + 0x8000 + dx) >> 16, 0, w->width - 1);
        uint32_t tap = row_offset[((y << 16) + 0x8000 + dy) >> 16] + (uint32_t)column;
        if (held && w->depth[tap] > w->depth[at] && window_velocity_word(w, tap) == 0)
            tap = at;
        even_add(&sum, w->color[tap], settings);
    }
    if (!held || settings->linear)
        return even_mean(&sum, over, settings);
    const uint32_t red = sum.red_blue >> 16, green = (sum.all - sum.red_blue) >> 8 & 0xffffu, blue = sum.red_blue & 0xffffu;
    return pixel_make(0, (mulh_u32(red << 16, over) + 128u) >> 8, (mulh_u32(green << 16, over) + 128u) >> 8,
                      (mulh_u32(blue << 16, over) + 128u) >> 8);
}

uint32_t smear_blur_uniform(uint32_t *out, const struct smear_window *w, const struct smear_row_table *rows, int32_t row,
                            int32_t column, const struct smear_blur_settings *settings)
{
    const struct smear_tile_motion *m = &window_motion(w, row)[column];
    /* Below 1 px the only pair, halfway along, would not leave the pixel. */
    if (max_i32(m->max_x, -m->min_x) < 8 && max_i32(m->max_y, -m->min_y) < 8) {
        smear_blur_copy(out, w, rows, column);
        return 0;
    }
    /* A tap per two pixels of the longest travel says all there is to say; `samples` is the most. They are pairs. */
    const int32_t travel = max_i32(abs_i32(m->x), abs_i32(m->y)) >> (settings->dense ? 1 : 2);   /* px */
    const int32_t n = max_i32(min_i32(travel + 3, clamp_i32(settings->samples, 2, 128) * 2) >> 2 << 1, 2);
    const int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    const uint32_t over = ((1u << 24) + (uint32_t)n - 1u) / (uint32_t)n;
    uint32_t taken = 0;
    for (int32_t y = rows->y0; y < rows->y1; y++, out += w->tile) {
        uint32_t at = rows->offset[y - rows->first] + (uint32_t)x0;
        for (int32_t x = x0; x < x1; x++, at++) {
            const struct smear_pixel_velocity v = window_velocity(w, at);       /* q3 */
            if ((v.x | v.y) == 0) {
                out[x - x0] = w->color[at];
                continue;
            }
            struct uniform_taps taps = { .step_x = v.x * (int32_t)(over >> 8) >> 2, .step_y = v.y * (int32_t)(over >> 8) >> 2 };
            taps.first_x = taps.step_x >> 1;
            taps.first_y = taps.step_y >> 1;
            out[x - x0] = mean_along(w, rows->offset, at, x, y - rows->first, &taps, n, over, settings);
            taken += (uint32_t)n;
        }
    }
    return taken;
}

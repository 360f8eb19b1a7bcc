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

SMEAR_INLINE uint32_t mean_along(const uint32_t *color, const uint32_t *row_offset, int32_t x, int32_t y,
                                 const struct uniform_taps *taps, int32_t n, uint32_t over,
                                 int32_t right, bool linear, bool edge)
{
    int32_t dx = taps->first_x, dy = taps->first_y;
    x = (x << 16) + 0x8000;
    y = (y << 16) + 0x8000;
    struct even_sum sum = { 0, 0, 0, 0, 0 };
    for (int32_t i = n; i > 0; i -= 2, dx += taps->step_x, dy += taps->step_y) {
        int32_t left = (x - dx) >> 16, other = (x + dx) >> 16;
        if (edge) {
            left = clamp_i32(left, 0, right);
            other = clamp_i32(other, 0, right);
        }
        even_add(&sum, color[row_offset[(y - dy) >> 16] + (uint32_t)left], linear);
        even_add(&sum, color[row_offset[(y + dy) >> 16] + (uint32_t)other], linear);
    }
    return even_mean(&sum, over, linear);
}

/* Takes the mean where things that move with the camera may be in front: a tap that meets one, static and nearer,
 * counts as the pixel itself. */
static SMEAR_NOINLINE uint32_t mean_behind(const struct smear_window *w, const uint32_t *row_offset,
                                           uint32_t at, int32_t x, int32_t y, const struct uniform_taps *taps,
                                           int32_t n, uint32_t over, bool linear)
{
    int32_t dx = -taps->first_x - (n / 2 - 1) * taps->step_x,
            dy = -taps->first_y - (n / 2 - 1) * taps->step_y;
    uint32_t sum[3] = { 0, 0, 0 };
    for (int32_t i = n; i > 0; i--, dx += taps->step_x, dy += taps->step_y) {
        int32_t column = clamp_i32(((x << 16) + 0x8000 + dx) >> 16, 0, w->width - 1);
        uint32_t tap = row_offset[((y << 16) + 0x8000 + dy) >> 16] + (uint32_t)column;
        if (w->depth[tap] > w->depth[at] && window_velocity_word(w, tap) == 0)
            tap = at;
        for (int c = 0; c < 3; c++) {
            uint32_t code = w->color[tap] >> (16 - 8 * c) & 255u;
            sum[c] += linear ? smear_srgb_decode[code] : code << 8;
        }
    }
    for (int c = 0; c < 3; c++) {
        uint32_t mean = mulh_u32(sum[c] << 8, over);
        sum[c] = linear ? smear_srgb_encode[mean >> 4] : (mean + 128u) >> 8;
    }
    return pixel_make(0, sum[0], sum[1], sum[2]);
}

SMEAR_INLINE uint32_t mean_tile(uint32_t *out, const struct smear_window *w,
                                const struct smear_row_table *rows, int32_t column,
                                int32_t n, bool linear, bool held, bool edge)
{
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    uint32_t over = ((1u << 24) + (uint32_t)n - 1u) / (uint32_t)n, copied = 0, last_word = 0;
    struct uniform_taps taps = { 0, 0, 0, 0 };
    for (int32_t y = rows->y0; y < rows->y1; y++, out += w->tile) {
        uint32_t at = rows->offset[y - rows->first] + (uint32_t)x0;
        for (int32_t x = x0; x < x1; x++, at++) {
            uint32_t word = window_velocity_word(w, at);
            if (word != last_word) {
                struct smear_pixel_velocity v = window_velocity(w, at);     /* q3 */
                last_word = word;
                taps.step_x = v.x * (int32_t)(over >> 8) >> 2;
                taps.step_y = v.y * (int32_t)(over >> 8) >> 2;
                taps.first_x = taps.step_x >> 1;
                taps.first_y = taps.step_y >> 1;
            }
            if (word == 0) {
                out[x - x0] = w->color[at];
                copied++;
            } else if (SMEAR_WITH_FILTERS && held) {
                out[x - x0] = mean_behind(w, rows->offset, at, x, y - rows->first, &taps, n, over, linear);
            } else {
                out[x - x0] = mean_along(w->color, rows->offset, x, y - rows->first, &taps, n,
                                         over, w->width - 1, linear, edge);
            }
        }
    }
    return (uint32_t)n * ((uint32_t)((x1 - x0) * (rows->y1 - rows->y0)) - copied);
}

uint32_t smear_blur_uniform(uint32_t *out, const struct smear_window *w,
                            const struct smear_row_table *rows, int32_t row, int32_t column,
                            const struct smear_blur_settings *settings)
{
    const struct smear_tile_motion *m = &window_motion(w, row)[column];
    /* Below 1 px the only pair, halfway along, would not leave the pixel. */
    if (max_i32(m->max_x, -m->min_x) < 8 && max_i32(m->max_y, -m->min_y) < 8) {
        smear_blur_copy(out, w, rows, column);
        return 0;
    }
    /* A tap per two pixels of the longest travel says all there is to say; `samples` is the most. They are pairs. */
    int32_t travel = max_i32(abs_i32(m->x), abs_i32(m->y)) >> (settings->dense ? 1 : 2);   /* px */
    int32_t n = min_i32(travel + 3, clamp_i32(settings->samples, 2, 128) * 2) >> 2 << 1;
    n = max_i32(n, 2);
    int32_t x0 = column << w->tile_shift;
    bool edge = x0 < w->reach || x0 + w->tile + w->reach > w->width;
    const bool held = SMEAR_WITH_FILTERS && settings->held;
    if (SMEAR_WITH_LINEAR && settings->linear)
        return mean_tile(out, w, rows, column, n, true, held, true);
    return edge || held ? mean_tile(out, w, rows, column, n, false, held, true)
                        : mean_tile(out, w, rows, column, n, false, false, false);
}

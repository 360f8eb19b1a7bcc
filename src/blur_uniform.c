/* SPDX-License-Identifier: MIT */
/* blur_uniform.c - tiles in whose reach everything moves alike: an unweighted mean along each pixel's own velocity,
 * no depth, no weights; and tiles that nothing moves in: a copy. */
#include "blur.h"

#include "fixmath.h"
#include "pixel.h"

void smear_blur_copy(uint32_t *out, const struct smear_window *w, int32_t row, int32_t column)
{
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    int32_t y0 = row << w->tile_shift, y1 = min_i32(y0 + w->tile, w->height);
    for (int32_t y = y0; y < y1; y++, out += w->tile) {
        const uint32_t *in = w->color + window_slot(w, y) * w->width + x0;
        for (int32_t i = 0; i < x1 - x0; i++)
            out[i] = in[i];
    }
}

/* Means over n taps at the midpoints of n equal parts of [-v, v]. */
SMEAR_INLINE uint32_t mean_along(const struct smear_window *w, const struct smear_row_table *rows,
                                 int32_t x, int32_t y, int32_t vx, int32_t vy, int32_t n, uint32_t over,
                                 bool linear)
{
    /* Positions in q16, velocities in q3: the first tap lies half a part inside -v. */
    int32_t step_x = vx * 16384 / n, step_y = vy * 16384 / n;
    int32_t px = (x << 16) + 0x8000 - vx * 8192 + (step_x >> 1);
    int32_t py = (y << 16) + 0x8000 - vy * 8192 + (step_y >> 1);
    uint32_t r = 0, g = 0, b = 0;
    int32_t right = w->width - 1;
    for (int32_t i = 0; i < n; i++, px += step_x, py += step_y) {
        uint32_t p = w->color[rows->offset[(py >> 16) - rows->first]
                              + (uint32_t)clamp_i32(px >> 16, 0, right)];
        if (linear) {
            r += smear_srgb_decode[pixel_red(p)];
            g += smear_srgb_decode[pixel_green(p)];
            b += smear_srgb_decode[pixel_blue(p)];
        } else {
            r += p & 0xff00ffu;
            g += pixel_green(p);
        }
    }
    /* `over` is 2^24 / n, rounded up: sums stay below 2^24 x n. */
    if (linear)
        return pixel_make(0, smear_srgb_encode[mulh_u32(r << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32(g << 8, over) >> 4],
                          smear_srgb_encode[mulh_u32(b << 8, over) >> 4]);
    return pixel_make(0, mulh_u32((r >> 16 << 8) + ((uint32_t)n << 7), over),
                      mulh_u32((g << 8) + ((uint32_t)n << 7), over),
                      mulh_u32(((r & 0xffffu) << 8) + ((uint32_t)n << 7), over));
}

uint32_t smear_blur_uniform(uint32_t *out, const struct smear_window *w,
                            const struct smear_row_table *rows, int32_t row, int32_t column,
                            const struct smear_blur_settings *settings)
{
    int32_t x0 = column << w->tile_shift, x1 = min_i32(x0 + w->tile, w->width);
    int32_t y0 = row << w->tile_shift, y1 = min_i32(y0 + w->tile, w->height);
    /* A tap per two pixels of travel says all there is to say; `samples` is the most. */
    const struct smear_tile_neighborhood *around = &window_around(w, row)[column];
    int32_t travel = (max_i32(abs_i32(around->x), abs_i32(around->y)) >> 7) + 1;     /* px */
    int32_t n = clamp_i32((travel + 1) / 2, 2, clamp_i32(settings->samples, 2, 128));
    uint32_t over = (uint32_t)(((1u << 24) + (uint32_t)n - 1u) / (uint32_t)n);
    uint32_t taps = 0;
    for (int32_t y = y0; y < y1; y++, out += w->tile) {
        uint32_t at = rows->offset[y - rows->first] + (uint32_t)x0;
        for (int32_t x = x0; x < x1; x++, at++) {
            int32_t vx, vy;
            if (w->velocity8 != NULL) {
                vx = w->velocity8[2 * at];
                vy = w->velocity8[2 * at + 1];
            } else {
                vx = w->velocity16[2 * at];
                vy = w->velocity16[2 * at + 1];
            }
            if ((vx | vy) == 0) {
                out[x - x0] = w->color[at];
                continue;
            }
            out[x - x0] = settings->linear ? mean_along(w, rows, x, y, vx, vy, n, over, true)
                                           : mean_along(w, rows, x, y, vx, vy, n, over, false);
            taps += (uint32_t)n;
        }
    }
    return taps;
}

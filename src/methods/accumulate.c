/* SPDX-License-Identifier: MIT */
/* accumulate.c - see accumulate.h. */
#include "methods/accumulate.h"

#include "base/pixel.h"
#include "base/tables.h"

#if SMEAR_WITH_ACCUMULATE

/* Returns the sums of pixel row y. */
static smear_sum *sums_at(const struct smear_sums *s, const struct smear_rows *rows, int32_t y)
{
    return s->sum + 3 * (size_t)(y - s->top) * (size_t)rows->window.width;
}

void smear_sums_clear(struct smear_sums *s, const struct smear_rows *rows, int first, int end)
{
    s->top = row_top(rows, first);
    const size_t height = (size_t)(row_bottom(rows, end - 1) - s->top);
    __builtin_memset(s->sum, 0, 3 * height * (size_t)rows->window.width * sizeof *s->sum);
}

void smear_sums_add_row(struct smear_sums *s, const struct smear_rows *rows, int row)
{
    const struct smear_window *w = &rows->window;
    const bool linear = frame_is_linear(&rows->raster);
    for (int32_t y = row_top(rows, row); y < row_bottom(rows, row); y++) {
        const uint32_t *in = w->color + window_ring_row(w, y) * w->width;
        smear_sum *sum = sums_at(s, rows, y);
        for (int32_t x = 0; x < w->width; x++, sum += 3) {
            uint32_t p = in[x];
            sum[0] = (smear_sum)(sum[0] + (linear ? smear_srgb_decode[pixel_red(p)] : pixel_red(p)));
            sum[1] = (smear_sum)(sum[1] + (linear ? smear_srgb_decode[pixel_green(p)] : pixel_green(p)));
            sum[2] = (smear_sum)(sum[2] + (linear ? smear_srgb_decode[pixel_blue(p)] : pixel_blue(p)));
        }
    }
}

/* Returns sum / n to nearest. */
static uint32_t mean_of(uint32_t sum, uint32_t n)
{
    return (sum + n / 2) / n;
}

void smear_sums_average_row(const struct smear_sums *s, const struct smear_rows *rows, int row, uint32_t n)
{
    const struct smear_window *w = &rows->window;
    const bool linear = frame_is_linear(&rows->raster);
    for (int32_t y = row_top(rows, row); y < row_bottom(rows, row); y++) {
        uint32_t *out = w->color + window_ring_row(w, y) * w->width;
        const smear_sum *sum = sums_at(s, rows, y);
        for (int32_t x = 0; x < w->width; x++, sum += 3) {
            uint32_t r = mean_of(sum[0], n), g = mean_of(sum[1], n), b = mean_of(sum[2], n);
            out[x] = linear ? pixel_make(0, smear_srgb_encode[r >> 4], smear_srgb_encode[g >> 4],
                                         smear_srgb_encode[b >> 4])
                            : pixel_make(0, r, g, b);
        }
    }
}

#endif

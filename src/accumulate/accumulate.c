/* SPDX-License-Identifier: MIT */
/* accumulate.c - SMEAR_ACCUMULATE: the mean of sharp frames at several instants, from sums of whole rows. */
#include "draws.h"

#include "display/band.h"
#include "methods/sharp.h"
#include "base/compiled.h"
#include "smear_memory.h"

#if SMEAR_WITH_ACCUMULATE

/* Sums of linear light or of codes; 16 bits are enough for codes alone. */
#if SMEAR_WITH_LINEAR
typedef uint32_t smear_sum;
#else
typedef uint16_t smear_sum;
#endif

struct smear_sums {
    smear_sum *sum;             /* r g b per pixel of the frame, or of a tile row */
    bool whole;                 /* of the frame */
    int32_t top;                /* the first pixel row that they hold */
};

void smear_accumulate_lay_out(struct smear_context *c, struct smear_arena *a, const smear_desc *d)
{
    struct smear_sums measured, *s = arena_take(a, 1, sizeof *s);
    c->sums = s;
    if (s == NULL)          /* only measured */
        s = &measured;
    s->whole = wants(d, SMEAR_SET(SMEAR_ACCUMULATE));
    s->sum = arena_take(a, (size_t)d->width * (size_t)(s->whole ? d->height : row_px(d)), 3 * sizeof *s->sum);
}

/* Returns the sums of pixel row y. */
static smear_sum *sums_at(const struct smear_sums *s, const struct smear_rows *rows, int32_t y)
{
    return s->sum + 3 * (size_t)(y - s->top) * (size_t)rows->window.width;
}

/* Empties the sums of tile rows [first, end). */
static void sums_clear(struct smear_sums *s, const struct smear_rows *rows, int first, int end)
{
    s->top = row_top(rows, first);
    const size_t height = (size_t)(row_bottom(rows, end - 1) - s->top);
    __builtin_memset(s->sum, 0, 3 * height * (size_t)rows->window.width * sizeof *s->sum);
}

/* Adds a row of the window, drawn and blended. */
static void sums_add_row(struct smear_sums *s, const struct smear_rows *rows, int row)
{
    const struct smear_window *w = &rows->window;
    const smear_transfer transfer = frame_transfer(&rows->raster);
    for (int32_t y = row_top(rows, row); y < row_bottom(rows, row); y++) {
        const uint32_t *in = w->color + window_ring_row(w, y) * w->width;
        smear_sum *sum = sums_at(s, rows, y);
        for (int32_t x = 0; x < w->width; x++, sum += 3) {
            uint32_t p = in[x];
            sum[0] = (smear_sum)(sum[0] + value_of_code(pixel_red(p), transfer));
            sum[1] = (smear_sum)(sum[1] + value_of_code(pixel_green(p), transfer));
            sum[2] = (smear_sum)(sum[2] + value_of_code(pixel_blue(p), transfer));
        }
    }
}

/* Returns sum / n to nearest. */
static uint32_t mean_of(uint32_t sum, uint32_t n)
{
    return (sum + n / 2) / n;
}

/* Writes the means of n instants back into the window's row. */
static void sums_average_row(const struct smear_sums *s, const struct smear_rows *rows, int row, uint32_t n)
{
    const struct smear_window *w = &rows->window;
    const smear_transfer transfer = frame_transfer(&rows->raster);
    for (int32_t y = row_top(rows, row); y < row_bottom(rows, row); y++) {
        uint32_t *out = w->color + window_ring_row(w, y) * w->width;
        const smear_sum *sum = sums_at(s, rows, y);
        for (int32_t x = 0; x < w->width; x++, sum += 3)
            out[x] = pixel_of_values(mean_of(sum[0], n), mean_of(sum[1], n), mean_of(sum[2], n), transfer);
    }
}

/* Draws tile rows [first, end) at every instant and adds them up. */
static void accumulate_rows(struct smear_context *c, int first, int end)
{
    const uint32_t n = c->frame.samples;
    sums_clear(c->sums, &c->rows, first, end);
    for (uint32_t k = 0; k < n; k++) {
        const struct smear_instant instant = smear_instant_at(&c->shot, (int32_t)((2 * k + 1) * 65536u / n) - 65536);
        if (rows_have_sky(&c->rows))
            c->rows.sky->kind->aim(c->rows.sky, &c->shot, c->shot.camera_moves ? &instant : &smear_instant_now, c->rows.window.width,
                                   c->rows.raster.transfer);
        draws_begin_exposure(c, (int32_t)(2 * k * 65536u / n) - 65536, (int32_t)(2 * (k + 1) * 65536u / n) - 65536);
        for (int row = first; row < end;) {
            struct smear_refill refill;
            const int part = smear_draws_assemble(c, row, row, end, &instant, &refill);
            for (; row < part; row++) {
                struct row_job job = { .rows = &c->rows, .row = row };
                smear_sharp_draw_row(&job);
                smear_row_blend(&c->rows, row);
                rows_draw_points(&c->rows, row);
                sums_add_row(c->sums, &c->rows, row);
            }
        }
    }
    rows_hide_points(&c->rows);
}

int smear_accumulate_render(struct smear_context *c)
{
    int result = SMEAR_OK;
    c->stats.samples = c->frame.samples * c->stats.pixels;
    if (c->sums->whole)
        accumulate_rows(c, 0, c->rows.window.rows);
    for (int row = 0; row < c->rows.window.rows && result == SMEAR_OK; row++) {
        if (!c->sums->whole)
            accumulate_rows(c, row, row + 1);
        sums_average_row(c->sums, &c->rows, row, c->frame.samples);
        struct row_job job = { .rows = &c->rows, .row = row };
        result = smear_band_finish(&job);
    }
    return result;
}

#endif

/* SPDX-License-Identifier: MIT */
/* band.c - see band.h. */
#include "display/band.h"

#include "base/base.h"
#include "display/pixel_format.h"
#include "display/points.h"
#include "kernels/fill.h"

uint8_t *smear_band_begin(struct smear_rows *rows)
{
    const smear_desc *d = rows->desc;
    struct smear_bands *b = &rows->bands;
    /* With two buffers, the one from two bands ago must have been sent. */
    while (d->bands == 2 && b->handed - word_read(&b->sent) >= 2u)
        if (d->idle != NULL)
            d->idle(d->user);
    uint8_t *band = b->buffer[d->bands == 2 ? b->handed & 1u : 0];
    if (drawn_format(d) == SMEAR_L1_PAGES)
        __builtin_memset(band, 0, b->bytes);
    return band;
}

bool smear_band_next(struct row_job *job)
{
    struct smear_rows *rows = job->rows;
    job->y0 = job->y1 != 0 ? job->y1 : row_top(rows, job->row);
    job->y1 = min_i32(job->y0 + rows->desc->band_rows, row_bottom(rows, job->row));
    if (job->y0 >= job->y1)
        return false;
    job->band = smear_band_begin(rows);
    rows_list_points(rows, job->y0, job->y1);
    return true;
}

/* The CRC is over what goes to the display; of 32-bit pixels, over their bytes R, G, B. */
static void add_crc(struct smear_rows *rows, const uint8_t *band, uint32_t size)
{
    if (rows->desc->format != SMEAR_XRGB8888) {
        rows->stats->crc32 = smear_crc32(rows->stats->crc32, band, size);
        return;
    }
    const uint32_t *pixel = (const uint32_t *)(const void *)band;
    for (uint32_t i = 0; i < size / 4; i++) {
        const uint8_t rgb[3] = { (uint8_t)(pixel[i] >> 16), (uint8_t)(pixel[i] >> 8), (uint8_t)pixel[i] };
        rows->stats->crc32 = smear_crc32(rows->stats->crc32, rgb, 3);
    }
}

int smear_band_flush(const struct row_job *r)
{
    struct smear_rows *rows = r->rows;
    const smear_desc *d = rows->desc;
    smear_format format = (smear_format)d->format;
    int32_t y = job_top(r), height = job_bottom(r) - y, x = job_left(r), width = job_right(r) - x;
    uint8_t *pixels = r->band + (x != 0 ? smear_format_size(x, height, format) : 0);
    if (SMEAR_WITH_DISPLAY && (format_diffuses(d) || is_doubled(d)))
        smear_screen_finish(rows, pixels, width, y, height);
    width = doubled_x(d, width);
    height = doubled_y(d, height);
    smear_band b = {
        .pixels = pixels, .x = (int16_t)doubled_x(d, x), .y = (int16_t)doubled_y(d, y),
        .width = (int16_t)width, .height = (int16_t)height,
        .stride = smear_format_stride(width, format), .size = smear_format_size(width, height, format)
    };
    if (d->debug.crc)
        add_crc(rows, pixels, b.size);
    rows->bands.handed++;
    int result = d->flush(d->user, &b);
    if (result >= 0)
        return SMEAR_OK;
    rows->bands.handed--;          /* refused: nobody will report it as sent */
    return result;
}

/* Returns where column 0 would be of a band's first row: within the buffer. */
static inline uint8_t *band_column_0(const struct row_job *r, smear_format format)
{
    const int32_t left = job_left(r);
    if (left == 0)
        return r->band;
    return r->band + smear_format_size(left, job_bottom(r) - job_top(r), format) - smear_format_stride(left, format);
}

/* Converts columns [x0, x1) of row y of the frame. */
static void convert(const struct row_job *r, const uint32_t *in, int32_t x0, int32_t x1, int32_t y)
{
    const struct smear_rows *rows = r->rows;
    smear_format format = drawn_format(rows->desc);
    const int32_t left = job_left(r), top = job_top(r);
    uint8_t *band = band_column_0(r, format);
    smear_format_row(band, smear_format_stride(job_right(r) - left, format), in, x1 - x0, x0, y, top, format,
                     (smear_dither)rows->desc->display.dither);
}

/* Converts as many rows at once as lie one behind the other in their ring. False where rows are
 * converted one by one. */
static bool convert_at_once(const struct row_job *r, const struct smear_raster_target *t, const struct overlay_box *box)
{
    const smear_format format = drawn_format(r->rows->desc);
    const int32_t left = job_left(r), top = job_top(r);
    const uint32_t stride = smear_format_stride(job_right(r) - left, format);
    uint8_t *band = band_column_0(r, format);
    for (int32_t y = box->y0, n; y < box->y1; y += n) {
        const int32_t at = target_row(&t->color_rows, t, y), left_over = t->color_rows.ring - t->color_rows.ring_row - (y - t->y0);
        n = min_i32(box->y1 - y, left_over > 0 ? left_over : left_over + t->color_rows.ring);
        if (!smear_format_rows(band + (uint32_t)(y - top) * stride, stride, t->color + at + box->x0, t->color_rows.stride, n,
                               box->x1 - box->x0, box->x0, y, format, (smear_dither)r->rows->desc->display.dither))
            return false;
    }
    return true;
}

/* Whether anything was drawn in eight columns. */
static inline bool is_drawn(const uint16_t *depth)
{
    const pixel_word *const pair = (const pixel_word *)(const void *)depth;
    uint64_t four[2] = { pair[0] | pair[1], pair[2] | pair[3] };
    if (SMEAR_ON_64)
        __builtin_memcpy(four, depth, sizeof four);
    return four[0] != 0 || four[1] != 0;
}

/* Makes eights of columns from x on, to `end`, look like others as long as nothing was drawn in them. Returns where something was. */
SMEAR_INLINE int32_t fill_undrawn(uint16_t *out, const uint16_t *depth, int32_t x, int32_t end, int32_t step, const uint16_t *look)
{
    const pixel_word *const from = (const pixel_word *)(const void *)look;
    const uint32_t a = from[0], b = from[1], c = from[2], d = from[3];
    for (; x != end && !is_drawn(depth + x); x += step) {
        pixel_word *const to = (pixel_word *)(void *)(out + x);
        to[0] = a;
        to[1] = b;
        to[2] = c;
        to[3] = d;
    }
    return x;
}

static void convert_eights(const smear_desc *d, uint16_t *out, const uint32_t *in, int32_t n, int32_t x, int32_t y)
{
    const smear_format format = drawn_format(d);
    const smear_dither dither = (smear_dither)d->display.dither;
    if (!smear_format_rows((uint8_t *)(out + x), 0, in, 0, 1, n, 0, y, format, dither))
        smear_format_row((uint8_t *)out, 0, in, n, x, y, y, format, dither);
}

/* Converts columns [x0, x1) of a row, and clears what was drawn. `looks`: of rows with the same thresholds, undrawn columns; or null. */
static void convert_drawn(const struct row_job *r, const struct smear_raster_target *t, int32_t x0, int32_t x1, int32_t y,
                          const uint16_t *looks[8])
{
    const struct smear_rows *const rows = r->rows;
    const int32_t at = target_row(&t->color_rows, t, y);
    uint32_t *const color = t->color + at;
    uint16_t *const depth = t->depth + at, *const out = (uint16_t *)(void *)r->band + (y - job_top(r)) * rows->window.width;
    const uint16_t **const look = &looks[y & 7];
    int32_t left = x0, right = x1;
    if (*look == NULL && !is_drawn(depth + x0)) {
        convert_eights(rows->desc, out, color + x0, 8, x0, y);
        *look = out + x0;
    }
    if (*look != NULL) {
        left = fill_undrawn(out, depth, x0, x1, 8, *look);
        right = fill_undrawn(out, depth, x1 - 8, left - 8, -8, *look) + 8;
    }
    if (left == right)
        return;
    convert_eights(rows->desc, out, color + left, right - left, left, y);
    pixels_fill(color + left, rows->clear, right - left);
    pixels_clear_narrow(depth + left, right - left);
}

void smear_band_convert_rows(const struct row_job *r, const struct smear_raster_target *t, int32_t x0, int32_t x1)
{
    const struct overlay_box box = { x0, job_top(r), x1, job_bottom(r) };
    if (rows_have_points(r->rows))
        smear_points_draw(r->rows, t, &box);
    if (rows_have_overlay(r->rows))
        smear_overlay_draw(r->rows->overlay, t, &box, frame_transfer(&r->rows->raster));
    if (SMEAR_STAYS_CLEAR && r->stays_clear) {
        const uint16_t *looks[8] = { NULL };
        for (int32_t y = box.y0; x0 < x1 && y < box.y1; y++)
            convert_drawn(r, t, x0, x1, y, looks);
        return;
    }
    if (SMEAR_ROWS_AT_ONCE && x0 < x1 && convert_at_once(r, t, &box))
        return;
    for (int32_t y = box.y0; x0 < x1 && y < box.y1; y++)
        convert(r, t->color + target_row(&t->color_rows, t, y) + x0, x0, x1, y);
}

/* Points `t` at rows of a tile apart from the window, which shares its depths. */
static void tile_target(const struct row_job *r, int column, uint32_t *tile, struct smear_raster_target *t)
{
    const struct smear_rows *rows = r->rows;
    smear_window_target(rows, job_top(r), job_bottom(r), t);
    t->x0 = tile_left(rows, column);
    t->x1 = tile_right(rows, column);
    t->color = tile;
    t->color_rows = (struct smear_plane_rows){ rows->window.tile, 0, rows->window.tile, t->x0 };
}

void smear_band_convert_tile(const struct row_job *r, int column, uint32_t *tile)
{
    struct smear_raster_target t;
    tile_target(r, column, tile, &t);
    smear_band_convert_rows(r, &t, t.x0, t.x1);
}

void smear_band_blend_tile(const struct row_job *r, int column, uint32_t *tile)
{
    struct smear_raster_target t;
    tile_target(r, column, tile, &t);
    smear_raster_list(&r->rows->raster, &t, r->rows->blend);
}

static void convert_job(void *argument, int job, int worker)
{
    const struct row_job *r = (const struct row_job *)argument;
    struct smear_raster_target t;
    int32_t x0, x1;
    (void)worker;
    smear_job_columns(r->rows, job, &x0, &x1);
    smear_window_target(r->rows, job_top(r), job_bottom(r), &t);
    smear_band_convert_rows(r, &t, max_i32(x0, job_left(r)), min_i32(x1, job_right(r)));
}

int smear_band_finish(struct row_job *job)
{
    struct smear_rows *rows = job->rows;
    int result = SMEAR_OK;
    while (result == SMEAR_OK && smear_band_next(job)) {
        uint32_t start = stage_start(rows);
        smear_jobs_run(&rows->jobs, convert_job, job, rows->jobs.workers);
        stage_end(rows, &rows->stats->time.convert, start);
        result = smear_band_flush(job);
    }
    return result;
}

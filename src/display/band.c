/* SPDX-License-Identifier: MIT */
/* band.c - see band.h. */
#include "display/band.h"

#include "display/pixel_format.h"

/* The window's rows [y0, y1). */
static void window_target(const struct smear_context *c, int32_t y0, int32_t y1,
                          struct smear_raster_target *t)
{
    const struct smear_window *w = &c->window;
    struct smear_plane_rows rows = { w->width, window_ring_row(w, y0), w->ring, 0 };
    *t = (struct smear_raster_target){
        .x0 = 0, .y0 = y0, .x1 = w->width, .y1 = y1,
        .color = w->color, .color_rows = rows, .depth = w->depth, .window_rows = rows,
        .moving = w->moving, .tile_shift = (uint8_t)w->tile_shift
    };
}

void smear_row_target(const struct smear_context *c, int row, struct smear_raster_target *t)
{
    window_target(c, row_top(c, row), row_bottom(c, row), t);
}

void smear_job_columns(const struct smear_context *c, int job, int32_t *x0, int32_t *x1)
{
    int32_t unit = max_i32(c->window.tile, 16), n = c->jobs.workers;
    int32_t units = (c->window.width + unit - 1) / unit;
    *x0 = min_i32(units * job / n * unit, c->window.width);
    *x1 = min_i32(units * (job + 1) / n * unit, c->window.width);
}

uint8_t *smear_band_begin(struct smear_context *c)
{
    /* With two buffers, the one from two bands ago must have been sent. */
    while (c->desc.bands == 2
           && c->bands_handed - word_read(&c->bands_sent) >= 2u)
        if (c->desc.idle != NULL)
            c->desc.idle(c->desc.user);
    uint8_t *band = c->band[c->desc.bands == 2 ? c->bands_handed & 1u : 0];
    if (c->desc.format == SMEAR_L1_PAGES)
        __builtin_memset(band, 0, c->band_bytes);
    return band;
}

/* The CRC is over what goes to the display; of 32-bit pixels, over their bytes R, G, B. */
static void add_crc(struct smear_context *c, const uint8_t *band, uint32_t size)
{
    if (c->desc.format != SMEAR_XRGB8888) {
        c->stats.crc32 = smear_crc32(c->stats.crc32, band, size);
        return;
    }
    const uint32_t *pixel = (const uint32_t *)(const void *)band;
    for (uint32_t i = 0; i < size / 4; i++) {
        const uint8_t rgb[3] = { (uint8_t)(pixel[i] >> 16), (uint8_t)(pixel[i] >> 8), (uint8_t)pixel[i] };
        c->stats.crc32 = smear_crc32(c->stats.crc32, rgb, 3);
    }
}

int smear_band_flush(struct smear_context *c, int row, uint8_t *band)
{
    const struct row_job job = { .c = c, .row = row, .band = band };
    return smear_band_flush_part(&job);
}

int smear_band_flush_part(const struct row_job *r)
{
    struct smear_context *c = r->c;
    smear_format format = (smear_format)c->desc.format;
    int32_t y = job_top(r), height = job_bottom(r) - y, x = job_left(r), width = job_right(r) - x;
    const uint8_t *pixels = r->band + (x != 0 ? smear_format_size(x, height, format) : 0);
    smear_band b = {
        .pixels = pixels, .x = (int16_t)x, .y = (int16_t)y, .width = (int16_t)width, .height = (int16_t)height,
        .stride = smear_format_stride(width, format), .size = smear_format_size(width, height, format)
    };
    if (c->desc.crc)
        add_crc(c, pixels, b.size);
    c->bands_handed++;
    int result = c->desc.flush(c->desc.user, &b);
    if (result >= 0)
        return SMEAR_OK;
    c->bands_handed--;          /* refused: nobody will report it as sent */
    return result;
}

/* Row y of the frame: pixels of columns [x0, x1). */
static void convert(const struct row_job *r, const uint32_t *in, int32_t x0, int32_t x1, int32_t y)
{
    const struct smear_context *c = r->c;
    smear_format format = (smear_format)c->desc.format;
    const int32_t left = job_left(r), top = job_top(r);
    uint8_t *band = r->band;
    if (left != 0)      /* where column 0 would be: within the buffer */
        band += smear_format_size(left, job_bottom(r) - top, format) - smear_format_stride(left, format);
    smear_format_row(band, smear_format_stride(job_right(r) - left, format), in, x1 - x0, x0, y, top, format,
                      (smear_dither)c->desc.dither);
}

void smear_band_convert_rows(const struct row_job *r, const struct smear_raster_target *t, int32_t x0,
                             int32_t x1)
{
    for (int32_t y = job_top(r); x0 < x1 && y < job_bottom(r); y++)
        convert(r, t->color + target_row(&t->color_rows, t, y) + x0, x0, x1, y);
}

void smear_band_convert_window(const struct row_job *r, int32_t x0, int32_t x1)
{
    struct smear_raster_target t;
    window_target(r->c, job_top(r), job_bottom(r), &t);
    smear_band_convert_rows(r, &t, x0, x1);
}

void smear_band_convert_tile(const struct row_job *r, int column, const uint32_t *tile)
{
    for (int32_t y = job_top(r); y < job_bottom(r); y++, tile += r->c->window.tile)
        convert(r, tile, tile_left(r->c, column), tile_right(r->c, column), y);
}

void smear_band_blend_tile(const struct row_job *r, int column, uint32_t *tile)
{
    const struct smear_context *c = r->c;
    struct smear_raster_target t;
    window_target(c, job_top(r), job_bottom(r), &t);
    t.x0 = tile_left(c, column);
    t.x1 = tile_right(c, column);
    t.color = tile;
    t.color_rows = (struct smear_plane_rows){ c->window.tile, 0, c->window.tile, t.x0 };
    smear_raster_list(&c->raster, &t, c->blend);
}

/* SPDX-License-Identifier: MIT */
/* picture.c - see picture.h. */
#include "tools/player/picture.h"

#include <math.h>
#include <string.h>

size_t picture_row_bytes(int width, smear_format format)
{
    size_t w = (size_t)width;
    switch (format) {
    case SMEAR_XRGB8888: return w * 4;
    case SMEAR_RGB565:
    case SMEAR_RGB565_SWAPPED:
    case SMEAR_RGB555: return w * 2;
    case SMEAR_L4: return (w + 1) / 2;
    case SMEAR_L1: return (w + 7) / 8;
    default: return w;
    }
}

void picture_put_band(uint8_t *pixels, size_t stride, smear_format format, const smear_band *band)
{
    /* Bands of whole tiles, so that pages of 8 rows never straddle two, nor bytes of several pixels. */
    size_t row = (size_t)band->y / (format == SMEAR_L1_PAGES ? 8 : 1);
    uint8_t *to = pixels + row * stride + picture_row_bytes(band->x, format);
    const uint8_t *from = band->pixels;
    for (uint32_t done = 0; done < band->size; done += band->stride, to += stride)
        memcpy(to, from + done, band->stride);
}

uint32_t picture_crc(const uint8_t *pixels, size_t size, smear_format format)
{
    uint32_t crc = 0;
    if (format != SMEAR_XRGB8888)
        return crc32_update(crc, pixels, size);
    for (size_t i = 0; i < size; i += 4) {
        uint32_t pixel;
        memcpy(&pixel, pixels + i, sizeof pixel);
        const uint8_t rgb[3] = { (uint8_t)(pixel >> 16), (uint8_t)(pixel >> 8), (uint8_t)pixel };
        crc = crc32_update(crc, rgb, sizeof rgb);
    }
    return crc;
}

static uint8_t expand(unsigned level, unsigned levels)
{
    return (uint8_t)((level * 510u + levels) / (2u * levels));
}

static void put(uint8_t *rgba, unsigned red, unsigned green, unsigned blue, const unsigned top[3])
{
    rgba[0] = expand(red, top[0]);
    rgba[1] = expand(green, top[1]);
    rgba[2] = expand(blue, top[2]);
    rgba[3] = 255;
}

static void put_grey(uint8_t *rgba, unsigned level, unsigned top)
{
    put(rgba, level, level, level, (const unsigned[3]){ top, top, top });
}

static void expand_row(uint8_t *rgba, const uint8_t *row, int width, smear_format format)
{
    for (int x = 0; x < width; x++, rgba += 4) {
        const uint8_t *two = row + 2 * x;
        unsigned v;
        switch (format) {
        case SMEAR_XRGB8888:
            v = ((const uint32_t *)(const void *)row)[x];
            put(rgba, v >> 16 & 255, v >> 8 & 255, v & 255, (const unsigned[3]){ 255, 255, 255 });
            break;
        case SMEAR_RGB565:
        case SMEAR_RGB565_SWAPPED:
            v = format == SMEAR_RGB565 ? two[0] | (unsigned)two[1] << 8
                                       : two[1] | (unsigned)two[0] << 8;
            put(rgba, v >> 11, v >> 5 & 63, v & 31, (const unsigned[3]){ 31, 63, 31 });
            break;
        case SMEAR_RGB555:              /* blue on top */
            v = two[0] | (unsigned)two[1] << 8;
            put(rgba, v & 31, v >> 5 & 31, v >> 10 & 31, (const unsigned[3]){ 31, 31, 31 });
            break;
        case SMEAR_RGB332:
            put(rgba, row[x] >> 5, row[x] >> 2 & 7, row[x] & 3, (const unsigned[3]){ 7, 7, 3 });
            break;
        case SMEAR_L8:
            put_grey(rgba, row[x], 255);
            break;
        case SMEAR_L4:
            put_grey(rgba, x & 1 ? row[x / 2] & 15 : row[x / 2] >> 4, 15);
            break;
        case SMEAR_L1:
            put_grey(rgba, row[x / 8] >> (7 - x % 8) & 1, 1);
            break;
        case SMEAR_L1_PAGES:            /* told apart by the caller */
            break;
        }
    }
}

static void expand_page_row(uint8_t *rgba, const uint8_t *page, int bit, int width)
{
    for (int x = 0; x < width; x++)
        put_grey(rgba + 4 * x, page[x] >> bit & 1, 1);
}

void picture_expand(struct image *out, const uint8_t *pixels, size_t stride, smear_format format)
{
    for (int y = 0; y < out->height; y++) {
        uint8_t *rgba = out->rgba + (size_t)y * (size_t)out->width * 4;
        if (format == SMEAR_L1_PAGES)
            expand_page_row(rgba, pixels + (size_t)(y / 8) * stride, y % 8, out->width);
        else
            expand_row(rgba, pixels + (size_t)y * stride, out->width, format);
    }
}

bool picture_to_floats(const struct image *picture, struct float_image *out, struct failure *f)
{
    if (!float_image_alloc(out, picture->width, picture->height, 3, f))
        return false;
    size_t pixels = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < pixels * 3; i++)
        out->value[i] = (float)(picture->rgba[i / 3 * 4 + i % 3] / 255.0);
    return true;
}

bool picture_from_floats(const struct float_image *floats, struct image *out, struct failure *f)
{
    size_t pixels = (size_t)floats->width * (size_t)floats->height;
    if (!image_alloc(out, floats->width, floats->height, f))
        return false;
    for (size_t i = 0; i < pixels * 3; i++) {
        float value = floats->value[floats->channels == 3 ? i : i / 3];
        if (!isfinite(value)) {
            image_free(out);
            return fail(f, "is no picture (a value is not finite at %zu,%zu)",
                        i / 3 % (size_t)floats->width, i / 3 / (size_t)floats->width);
        }
        double code = value <= 0.0f ? 0.0 : value >= 1.0f ? 255.0 : floor(value * 255.0 + 0.5);
        out->rgba[i / 3 * 4 + i % 3] = (uint8_t)code;
    }
    return true;
}

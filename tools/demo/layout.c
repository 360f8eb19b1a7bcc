/* SPDX-License-Identifier: MIT */
/* layout.c - see layout.h. */
#include "tools/demo/layout.h"

#include <string.h>

static uint8_t *pixel_at(const struct image *image, int x, int y)
{
    return image->rgba + 4 * ((size_t)y * (size_t)image->width + (size_t)x);
}

static void fill(struct image *image, uint8_t red, uint8_t green, uint8_t blue)
{
    for (int y = 0; y < image->height; y++)
        for (int x = 0; x < image->width; x++)
            memcpy(pixel_at(image, x, y), (const uint8_t[4]){ red, green, blue, 255 }, 4);
}

bool layout_row(const struct image *pictures, int count, int gap, struct image *out,
                struct failure *f)
{
    int width = pictures[0].width, height = pictures[0].height;
    *out = (struct image){ .rgba = NULL };
    for (int i = 1; i < count; i++)
        if (!image_check_same_size(&pictures[0], &pictures[i], f))
            return false;
    if (!image_alloc(out, count * width + (count - 1) * gap, height, f))
        return false;
    fill(out, 255, 255, 255);
    for (int i = 0; i < count; i++)
        for (int y = 0; y < height; y++)
            memcpy(pixel_at(out, i * (width + gap), y), pixel_at(&pictures[i], 0, y),
                   4 * (size_t)width);
    return true;
}

bool layout_column(const struct image *pictures, int count, int gap, struct image *out,
                   struct failure *f)
{
    int width = pictures[0].width, height = pictures[0].height;
    *out = (struct image){ .rgba = NULL };
    for (int i = 1; i < count; i++)
        if (!image_check_same_size(&pictures[0], &pictures[i], f))
            return false;
    if (!image_alloc(out, width, count * height + (count - 1) * gap, f))
        return false;
    for (int i = 0; i < count; i++)
        memcpy(pixel_at(out, 0, i * (height + gap)), pictures[i].rgba,
               4 * (size_t)width * (size_t)height);
    return true;
}

bool layout_zoom(const struct image *picture, int scale, struct image *out, struct failure *f)
{
    if (!image_alloc(out, picture->width * scale, picture->height * scale, f))
        return false;
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++)
            memcpy(pixel_at(out, x, y), pixel_at(picture, x / scale, y / scale), 4);
    return true;
}

bool layout_lamps(const struct image *picture, int scale, unsigned color, struct image *out,
                  struct failure *f)
{
    static const uint8_t glass[4] = { 8, 9, 11, 255 };
    if (!image_alloc(out, picture->width * scale, picture->height * scale, f))
        return false;
    for (int y = 0; y < out->height; y++)
        for (int x = 0; x < out->width; x++) {
            uint8_t *to = pixel_at(out, x, y);
            bool is_seam = x % scale == scale - 1 || y % scale == scale - 1;
            const unsigned grey = pixel_at(picture, x / scale, y / scale)[0];
            for (int k = 0; k < 3; k++) {
                unsigned full = color >> (16 - 8 * k) & 255u;
                unsigned lit = (full - glass[k]) * grey / 255u;
                to[k] = (uint8_t)(glass[k] + (is_seam ? lit / 4u : lit));
            }
            to[3] = 255;
        }
    return true;
}

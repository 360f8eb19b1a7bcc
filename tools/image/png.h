/* SPDX-License-Identifier: MIT */
/* png.h - the pieces of a PNG file that stills and animations share. */
#ifndef SMEAR_TOOLS_IMAGE_PNG_H
#define SMEAR_TOOLS_IMAGE_PNG_H

#include "tools/image/buffer.h"
#include "tools/image/image.h"

extern const uint8_t png_signature[8];

/* A rectangle of a picture, in pixels. */
struct png_area {
    int x, y, width, height;
};

/* Appends a chunk: its length, its four-letter name, the data and the checksum. */
void png_chunk(struct buffer *out, const char *name, const void *data, size_t size);

/* Appends the IHDR chunk of an 8-bit RGB or RGBA picture. */
void png_header_chunk(struct buffer *out, int width, int height, bool has_alpha);

/* Appends the filtered and compressed pixels of an area, a zlib stream; false without memory. */
bool png_compress(struct buffer *out, const struct image *image, struct png_area area,
                  bool has_alpha);

bool png_is_opaque(const struct image *image);

/* The filter of the standard that predicts from left, up and upper left. */
static inline uint8_t png_paeth(int left, int up, int corner)
{
    int p = left + up - corner;
    int to_left = abs(p - left), to_up = abs(p - up), to_corner = abs(p - corner);
    if (to_left <= to_up && to_left <= to_corner)
        return (uint8_t)left;
    return (uint8_t)(to_up <= to_corner ? up : corner);
}

#endif

/* SPDX-License-Identifier: MIT */
/* pfm.c - float pictures: depth, velocity and unclamped colour.
 *
 * A header of three lines, "Pf" (1 channel) or "PF" (3), the size, and a scale whose sign tells the
 * byte order (negative: little-endian); then the floats of IEEE 754, bottom row first. The size of
 * the scale has no agreed meaning and is ignored. Values may be infinite or NaN. */
#include "tools/image/buffer.h"
#include "tools/image/image.h"

#include <stdio.h>

_Static_assert(sizeof(float) == 4, "float is the 32-bit format of IEEE 754");

static bool is_space(uint8_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* The next word as a string; false when there is none or it is too long to be a number. */
static bool read_word(const uint8_t **next, const uint8_t *end, char word[32])
{
    size_t length = 0;
    while (*next < end && is_space(**next))
        (*next)++;
    while (*next < end && !is_space(**next)) {
        if (length == 31 || **next == 0)
            return false;
        word[length++] = (char)*(*next)++;
    }
    word[length] = '\0';
    return length > 0;
}

static bool read_edge(const uint8_t **next, const uint8_t *end, int *edge)
{
    char word[32];
    if (!read_word(next, end, word) || strspn(word, "0123456789") != strlen(word) ||
        strlen(word) > 9)
        return false;
    *edge = (int)strtol(word, NULL, 10);
    return true;
}

bool pfm_decode(const uint8_t *bytes, size_t size, struct float_image *out, struct failure *f)
{
    const uint8_t *next = bytes, *end = bytes + size;
    *out = (struct float_image){0};
    if (size < 3 || bytes[0] != 'P' || (bytes[1] != 'f' && bytes[1] != 'F') || !is_space(bytes[2]))
        return fail(f, "not a PFM file (first bytes)");
    int channels = bytes[1] == 'F' ? 3 : 1, width, height;
    char word[32], *rest;
    next += 2;
    if (!read_edge(&next, end, &width) || !read_edge(&next, end, &height) ||
        !read_word(&next, end, word))
        return fail(f, "file is damaged or ends early (header)");
    if (!image_check_size(width, height, f))
        return false;
    double scale = strtod(word, &rest);
    if (*rest != '\0' || !(scale < 0 || scale > 0))
        return fail(f, "scale is not a number other than zero (%s)", word);
    if (next == end)
        return fail(f, "file ends early (after the header)");
    next++;
    size_t row_values = (size_t)width * (size_t)channels;
    if ((size_t)(end - next) / 4 / row_values < (size_t)height)
        return fail(f, "file ends early (picture of %d x %d)", width, height);
    if (!float_image_alloc(out, width, height, channels, f))
        return false;
    for (int y = height - 1; y >= 0; y--) {
        float *row = out->value + (size_t)y * row_values;
        for (size_t i = 0; i < row_values; i++, next += 4) {
            uint32_t big = (uint32_t)next[0] << 24 | (uint32_t)next[1] << 16 |
                           (uint32_t)next[2] << 8 | next[3];
            uint32_t little = (uint32_t)next[3] << 24 | (uint32_t)next[2] << 16 |
                              (uint32_t)next[1] << 8 | next[0];
            memcpy(row + i, scale < 0 ? &little : &big, 4);
        }
    }
    return true;
}

bool pfm_encode(const struct float_image *image, uint8_t **bytes, size_t *size, struct failure *f)
{
    struct buffer out = {0};
    char header[48];
    *bytes = NULL;
    *size = 0;
    if (image->value == NULL)
        return fail(f, "picture is empty");
    int length = snprintf(header, sizeof header, "P%c\n%d %d\n-1.0\n",
                          image->channels == 3 ? 'F' : 'f', image->width, image->height);
    size_t row_values = (size_t)image->width * (size_t)image->channels;
    buffer_append(&out, header, (size_t)length);
    if (!buffer_reserve(&out, row_values * (size_t)image->height * 4)) {
        buffer_free(&out);
        return fail(f, "out of memory (picture of %d x %d)", image->width, image->height);
    }
    for (int y = image->height - 1; y >= 0; y--) {
        const float *row = image->value + (size_t)y * row_values;
        for (size_t i = 0; i < row_values; i++) {
            uint32_t value;
            memcpy(&value, row + i, 4);
            for (int shift = 0; shift < 32; shift += 8)
                buffer_byte(&out, value >> shift & 255);
        }
    }
    *bytes = out.data;
    *size = out.size;
    return true;
}

bool pfm_save(const char *path, const struct float_image *image, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    bool ok = pfm_encode(image, &bytes, &size, f) && file_write(path, bytes, size, f);
    free(bytes);
    return ok;
}

/* SPDX-License-Identifier: MIT */
/* netpbm.c - the Netpbm formats: P2, P3, P5 and P6 to pictures, and pictures to P6; and float pictures, of depth, velocity and
 * unclamped colour, from and to PFM.
 *
 * PFM has a header of three lines, "Pf" (1 channel) or "PF" (3), the size, and a scale whose sign tells the
 * byte order (negative: little-endian); then the floats of IEEE 754, bottom row first. The size of
 * the scale has no agreed meaning and is ignored. Values may be infinite or NaN. */
#include "tools/image/buffer.h"
#include "tools/image/image.h"

#include <stdio.h>

_Static_assert(sizeof(float) == 4, "float is the 32-bit format of IEEE 754");

struct text {
    const uint8_t *next, *end;
};

static bool is_space(uint8_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Past blanks and comments, which run from # to the end of the line. */
static void skip_blanks(struct text *t)
{
    while (t->next < t->end) {
        if (*t->next == '#') {
            while (t->next < t->end && *t->next != '\n' && *t->next != '\r')
                t->next++;
        } else if (is_space(*t->next)) {
            t->next++;
        } else {
            return;
        }
    }
}

/* A decimal number up to 999999, which is more than any field may hold; false when there is none.
 * The character after it must not belong to a word. */
static bool read_number(struct text *t, unsigned *value)
{
    skip_blanks(t);
    const uint8_t *start = t->next;
    *value = 0;
    while (t->next < t->end && *t->next >= '0' && *t->next <= '9' && t->next - start < 6)
        *value = *value * 10 + (unsigned)(*t->next++ - '0');
    return t->next > start && (t->next == t->end || is_space(*t->next) || *t->next == '#');
}

/* ------------------------------------------------------------------ pictures */

/* 0..largest to 0..255, rounded to nearest. */
static uint8_t to_8_bits(unsigned value, unsigned largest)
{
    return (uint8_t)((value * 255 + largest / 2) / largest);
}

static bool read_sample(struct text *t, bool is_text, unsigned largest, unsigned *value)
{
    if (is_text)
        return read_number(t, value) && *value <= largest;
    *value = *t->next++;
    if (largest > 255)
        *value = *value << 8 | *t->next++;
    return *value <= largest;
}

bool ppm_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f)
{
    struct text t = {bytes, bytes + size};
    *out = (struct image){0};
    if (size < 3 || bytes[0] != 'P' || bytes[1] < '2' || bytes[1] > '6' || bytes[1] == '4' ||
        !(is_space(bytes[2]) || bytes[2] == '#'))
        return fail(f, "not a PPM or PGM file (first bytes)");
    bool is_text = bytes[1] < '4', is_grey = bytes[1] == '2' || bytes[1] == '5';
    unsigned width, height, largest;
    t.next += 2;
    if (!read_number(&t, &width) || !read_number(&t, &height) || !read_number(&t, &largest))
        return fail(f, "file is damaged or ends early (header)");
    if (!image_check_size((long)width, (long)height, f))
        return false;
    if (largest < 1 || largest > 65535)
        return fail(f, "largest value is outside 1..65535 (%u)", largest);
    if (t.next == t.end || !is_space(*t.next))
        return fail(f, "file is damaged or ends early (after the header)");
    t.next++;

    /* A sample of text takes at least a digit and a blank; the last one needs no blank. */
    size_t pixels = (size_t)width * height, samples = pixels * (is_grey ? 1 : 3);
    size_t left = (size_t)(t.end - t.next);
    size_t most = is_text ? left / 2 + left % 2 : largest > 255 ? left / 2 : left;
    if (samples > most)
        return fail(f, "file ends early (picture of %u x %u)", width, height);
    if (!image_alloc(out, (int)width, (int)height, f))
        return false;
    uint8_t *to = out->rgba;
    for (size_t i = 0; i < pixels; i++, to += 4) {
        unsigned value = 0;
        for (int k = 0; k < 3; k++) {
            if ((k == 0 || !is_grey) && !read_sample(&t, is_text, largest, &value)) {
                image_free(out);
                return fail(f, "sample is missing or above %u (row %zu)", largest, i / width);
            }
            to[k] = to_8_bits(value, largest);
        }
    }
    return true;
}

bool ppm_encode(const struct image *image, uint8_t **bytes, size_t *size, struct failure *f)
{
    struct buffer out = {0};
    *bytes = NULL;
    *size = 0;
    if (image->rgba == NULL)
        return fail(f, "picture is empty");
    buffer_print(&out, "P6\n%d %d\n255\n", image->width, image->height);
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels && buffer_reserve(&out, 3); i++, out.size += 3)
        memcpy(out.data + out.size, image->rgba + i * 4, 3);
    return buffer_give(&out, bytes, size) || fail(f, "out of memory (picture of %d x %d)", image->width, image->height);
}

bool ppm_save(const char *path, const struct image *image, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    bool ok = ppm_encode(image, &bytes, &size, f) && file_write(path, bytes, size, f);
    free(bytes);
    return ok;
}

/* ------------------------------------------------------------------ float pictures */

/* The next word as a string; false when there is none or it is too long to be a number. */
static bool read_word(struct text *t, char word[32])
{
    size_t length = 0;
    skip_blanks(t);
    while (t->next < t->end && !is_space(*t->next)) {
        if (length == 31 || *t->next == 0)
            return false;
        word[length++] = (char)*t->next++;
    }
    word[length] = '\0';
    return length > 0;
}

bool pfm_decode(const uint8_t *bytes, size_t size, struct float_image *out, struct failure *f)
{
    struct text t = {bytes, bytes + size};
    *out = (struct float_image){0};
    if (size < 3 || bytes[0] != 'P' || (bytes[1] != 'f' && bytes[1] != 'F') || !is_space(bytes[2]))
        return fail(f, "not a PFM file (first bytes)");
    unsigned width, height;
    char word[32], *rest;
    t.next += 2;
    if (!read_number(&t, &width) || !read_number(&t, &height) || !read_word(&t, word))
        return fail(f, "file is damaged or ends early (header)");
    if (!image_check_size((long)width, (long)height, f))
        return false;
    double scale = strtod(word, &rest);
    if (*rest != '\0' || !(scale < 0 || scale > 0))
        return fail(f, "scale is not a number other than zero (%s)", word);
    if (t.next == t.end)
        return fail(f, "file ends early (after the header)");
    const uint8_t *next = t.next + 1;
    const int channels = bytes[1] == 'F' ? 3 : 1;
    size_t row_values = (size_t)width * (size_t)channels;
    if ((size_t)(t.end - next) / 4 / row_values < (size_t)height)
        return fail(f, "file ends early (picture of %u x %u)", width, height);
    if (!float_image_alloc(out, (int)width, (int)height, channels, f))
        return false;
    for (int y = out->height - 1; y >= 0; y--) {
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
    *bytes = NULL;
    *size = 0;
    if (image->value == NULL)
        return fail(f, "picture is empty");
    buffer_print(&out, "P%c\n%d %d\n-1.0\n", image->channels == 3 ? 'F' : 'f', image->width, image->height);
    size_t row_values = (size_t)image->width * (size_t)image->channels;
    for (int y = image->height - 1; y >= 0; y--)
        for (size_t i = 0; i < row_values; i++) {
            uint32_t value;
            memcpy(&value, image->value + (size_t)y * row_values + i, 4);
            buffer_le32(&out, value);
        }
    return buffer_give(&out, bytes, size) || fail(f, "out of memory (picture of %d x %d)", image->width, image->height);
}

bool pfm_save(const char *path, const struct float_image *image, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    bool ok = pfm_encode(image, &bytes, &size, f) && file_write(path, bytes, size, f);
    free(bytes);
    return ok;
}

/* SPDX-License-Identifier: MIT */
/* ppm.c - the Netpbm formats P2, P3, P5 and P6 to pictures, and pictures to P6. */
#include "tools/image/buffer.h"
#include "tools/image/image.h"

#include <stdio.h>

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
    char header[40];
    *bytes = NULL;
    *size = 0;
    if (image->rgba == NULL)
        return fail(f, "picture is empty");
    int length = snprintf(header, sizeof header, "P6\n%d %d\n255\n", image->width, image->height);
    size_t pixels = (size_t)image->width * (size_t)image->height;
    buffer_append(&out, header, (size_t)length);
    if (!buffer_reserve(&out, pixels * 3)) {
        buffer_free(&out);
        return fail(f, "out of memory (picture of %d x %d)", image->width, image->height);
    }
    for (size_t i = 0; i < pixels; i++, out.size += 3)
        memcpy(out.data + out.size, image->rgba + i * 4, 3);
    *bytes = out.data;
    *size = out.size;
    return true;
}

bool ppm_save(const char *path, const struct image *image, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    bool ok = ppm_encode(image, &bytes, &size, f) && file_write(path, bytes, size, f);
    free(bytes);
    return ok;
}

/* SPDX-License-Identifier: MIT */
/* image.c - pictures in memory, and loading whichever format a file has. */
#include "tools/image/image.h"

#include "tools/image/file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

bool image_check_size(long width, long height, struct failure *f)
{
    bool has_edges = width >= 1 && width <= IMAGE_MAX_EDGE && height >= 1 && height <= IMAGE_MAX_EDGE;
    if (has_edges && width * height <= IMAGE_MAX_PIXELS)
        return true;
    if (has_edges)
        return fail(f, "picture has more than %d pixels (%ld x %ld)", (int)IMAGE_MAX_PIXELS, width, height);
    return fail(f, "picture size is outside 1..%d (%ld x %ld)", (int)IMAGE_MAX_EDGE, width, height);
}

bool image_check_same_size(const struct image *a, const struct image *b, struct failure *f)
{
    if (a->rgba == NULL || b->rgba == NULL)
        return fail(f, "picture is empty");
    if (a->width == b->width && a->height == b->height)
        return true;
    return fail(f, "pictures differ in size (%d x %d and %d x %d)", a->width, a->height, b->width,
                b->height);
}

bool image_alloc(struct image *image, int width, int height, struct failure *f)
{
    *image = (struct image){0};
    if (!image_check_size(width, height, f))
        return false;
    size_t pixels = (size_t)width * (size_t)height;
    image->rgba = malloc(pixels * 4);
    if (image->rgba == NULL)
        return fail(f, "out of memory (picture of %d x %d)", width, height);
    image->width = width;
    image->height = height;
    memset(image->rgba, 0, pixels * 4);
    for (size_t i = 0; i < pixels; i++)
        image->rgba[i * 4 + 3] = 255;
    return true;
}

void image_free(struct image *image)
{
    free(image->rgba);
    *image = (struct image){0};
}

bool float_image_alloc(struct float_image *image, int width, int height, int channels,
                       struct failure *f)
{
    *image = (struct float_image){0};
    if (!image_check_size(width, height, f))
        return false;
    if (channels != 1 && channels != 3)
        return fail(f, "a float picture has 1 or 3 channels (%d asked for)", channels);
    image->value = calloc((size_t)width * (size_t)height * (size_t)channels, sizeof *image->value);
    if (image->value == NULL)
        return fail(f, "out of memory (picture of %d x %d)", width, height);
    image->width = width;
    image->height = height;
    image->channels = channels;
    return true;
}

void float_image_free(struct float_image *image)
{
    free(image->value);
    *image = (struct float_image){0};
}

static bool look_at_head(const void *unused, const uint8_t *head, size_t size, struct failure *f)
{
    (void)unused;
    bool is_pnm = size >= 2 && head[0] == 'P' && strchr("123456Ff", head[1]) != NULL && head[1] != 0;
    return is_pnm || (size >= 1 && head[0] == 0x89) || fail(f, "neither PNG nor PPM nor PFM (first bytes)");
}

bool image_read(const char *path, uint8_t **bytes, size_t *size, struct failure *f)
{
    FILE *stream = fopen(path, "rb");
    *bytes = NULL;
    *size = 0;
    if (stream == NULL)
        return fail(f, "cannot be opened (%s)", strerror(errno));
    return file_read_stream(stream, IMAGE_MAX_BYTES, look_at_head, NULL, bytes, size, f);
}

bool image_load(const char *path, struct image *out, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    *out = (struct image){0};
    if (!image_read(path, &bytes, &size, f))
        return false;
    bool ok;
    if (size >= 2 && bytes[0] == 'P' && strchr("2356", bytes[1]) != NULL && bytes[1] != 0)
        ok = ppm_decode(bytes, size, out, f);
    else if (size >= 1 && bytes[0] == 0x89)
        ok = png_decode(bytes, size, out, f);
    else
        ok = fail(f, "neither PNG nor PPM (first bytes)");
    free(bytes);
    return ok;
}

bool image_difference(const struct image *a, const struct image *b, int gain, struct image *out,
                      struct failure *f)
{
    *out = (struct image){0};
    if (!image_check_same_size(a, b, f))
        return false;
    if (gain < 0)
        return fail(f, "gain is negative (%d)", gain);
    if (!image_alloc(out, a->width, a->height, f))
        return false;
    uint8_t scaled[256];
    for (int i = 0; i < 256; i++)
        scaled[i] = (uint8_t)((int64_t)i * gain > 255 ? 255 : i * gain);
    size_t bytes = (size_t)a->width * (size_t)a->height * 4;
    for (size_t i = 0; i < bytes; i += 4)
        for (size_t k = i; k < i + 3; k++)
            out->rgba[k] = scaled[abs(a->rgba[k] - b->rgba[k])];
    return true;
}

/* SPDX-License-Identifier: MIT */
/* png_write.c - pictures to PNG files: 8-bit RGB, or RGBA when anything is transparent. */
#include "tools/image/inflate.h"
#include "tools/image/palette.h"
#include "tools/image/png.h"

const uint8_t png_signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

void png_chunk(struct buffer *out, const char *name, const void *data, size_t size)
{
    uint32_t crc = crc32_update(crc32_update(0, name, 4), data, size);
    buffer_be32(out, (uint32_t)size);
    buffer_append(out, name, 4);
    buffer_append(out, data, size);
    buffer_be32(out, crc);
}

void png_header_chunk(struct buffer *out, int width, int height, bool has_alpha)
{
    uint8_t header[13] = {
        (uint8_t)(width >> 24), (uint8_t)(width >> 16), (uint8_t)(width >> 8), (uint8_t)width,
        (uint8_t)(height >> 24), (uint8_t)(height >> 16), (uint8_t)(height >> 8), (uint8_t)height,
        8, has_alpha ? 6 : 2, 0, 0, 0,
    };
    png_chunk(out, "IHDR", header, sizeof header);
}

bool png_is_opaque(const struct image *image)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < pixels; i++)
        if (image->rgba[i * 4 + 3] != 255)
            return false;
    return true;
}

/* Row `filter` (0 none, 1 left, 2 up, 3 mean, 4 Paeth) of `size` bytes after its `type` byte. */
static void filter_row(unsigned filter, uint8_t *to, const uint8_t *row, const uint8_t *up,
                       size_t size, size_t step)
{
    *to++ = (uint8_t)filter;
    switch (filter) {
    case 0:
        memcpy(to, row, size);
        break;
    case 1:
        memcpy(to, row, step);
        for (size_t i = step; i < size; i++)
            to[i] = (uint8_t)(row[i] - row[i - step]);
        break;
    case 2:
        for (size_t i = 0; i < size; i++)
            to[i] = (uint8_t)(row[i] - up[i]);
        break;
    case 3:
        for (size_t i = 0; i < step; i++)
            to[i] = (uint8_t)(row[i] - up[i] / 2);
        for (size_t i = step; i < size; i++)
            to[i] = (uint8_t)(row[i] - (row[i - step] + up[i]) / 2);
        break;
    default:
        for (size_t i = 0; i < step; i++)
            to[i] = (uint8_t)(row[i] - up[i]);
        for (size_t i = step; i < size; i++)
            to[i] = (uint8_t)(row[i] - png_paeth(row[i - step], up[i], up[i - step]));
        break;
    }
}

/* How hard a filtered row looks to compress: the sum of its bytes as signed distances from zero. */
static uint64_t row_cost(const uint8_t *row, size_t size)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < size; i++)
        sum += row[i] < 128 ? row[i] : 256u - row[i];
    return sum;
}

/* Copies the area's row y as RGB or RGBA bytes. */
static void copy_row(uint8_t *to, const struct image *image, struct png_area area, int y,
                     size_t step)
{
    const uint8_t *from = image->rgba +
        ((size_t)(area.y + y) * (size_t)image->width + (size_t)area.x) * 4;
    for (int x = 0; x < area.width; x++, from += 4, to += step)
        memcpy(to, from, step);
}

bool png_compress(struct buffer *out, const struct image *image, struct png_area area,
                  bool has_alpha)
{
    size_t step = has_alpha ? 4 : 3;
    size_t size = (size_t)area.width * step, total = (size + 1) * (size_t)area.height;
    /* Two candidates: rows as they are, which may be best for flat colours and text, and each row
     * with the filter of the least cost, best for everything smooth. The smaller one is kept;
     * pictures of many colours are spared the first, which is the slow one for them, and so are
     * those whose rows are all best as they are. */
    struct palette palette;
    bool try_plain = palette_exact(&(struct marked_image){image, NULL}, 256, &palette);
    uint8_t *plain = malloc(total), *filtered = malloc(total);
    uint8_t *trial = malloc(size + 1), *zeros = calloc(size, 1);
    struct buffer a = {0}, b = {0};
    bool ok = plain != NULL && filtered != NULL && trial != NULL && zeros != NULL;
    for (int y = 0; ok && y < area.height; y++) {
        uint8_t *row = plain + (size_t)y * (size + 1), *best = filtered + (size_t)y * (size + 1);
        const uint8_t *up = y == 0 ? zeros : row - size;
        *row++ = 0;
        copy_row(row, image, area, y, step);
        filter_row(0, best, row, up, size, step);
        uint64_t least = row_cost(best + 1, size);
        for (unsigned filter = 1; filter <= 4 && least > 0; filter++) {
            filter_row(filter, trial, row, up, size, step);
            uint64_t cost = row_cost(trial + 1, size);
            if (cost < least) {
                least = cost;
                memcpy(best, trial, size + 1);
            }
        }
    }
    try_plain = try_plain && ok && memcmp(plain, filtered, total) != 0;
    ok = ok && deflate_zlib(filtered, total, &a) && (!try_plain || deflate_zlib(plain, total, &b));
    if (ok) {
        const struct buffer *smaller = try_plain && b.size < a.size ? &b : &a;
        buffer_append(out, smaller->data, smaller->size);
        ok = !out->failed;
    }
    buffer_free(&a);
    buffer_free(&b);
    free(plain);
    free(filtered);
    free(trial);
    free(zeros);
    return ok;
}

bool png_encode(const struct image *image, uint8_t **bytes, size_t *size, struct failure *f)
{
    struct buffer out = {0}, packed = {0};
    struct png_area whole = {0, 0, image->width, image->height};
    *bytes = NULL;
    *size = 0;
    if (image->rgba == NULL)
        return fail(f, "picture is empty");
    bool has_alpha = !png_is_opaque(image);
    bool ok = png_compress(&packed, image, whole, has_alpha);
    if (ok) {
        buffer_append(&out, png_signature, sizeof png_signature);
        png_header_chunk(&out, image->width, image->height, has_alpha);
        png_chunk(&out, "IDAT", packed.data, packed.size);
        png_chunk(&out, "IEND", NULL, 0);
    }
    buffer_free(&packed);
    return (ok && buffer_give(&out, bytes, size)) || fail(f, "out of memory (picture of %d x %d)", image->width, image->height);
}

bool png_save(const char *path, const struct image *image, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    bool ok = png_encode(image, &bytes, &size, f) && file_write(path, bytes, size, f);
    free(bytes);
    return ok;
}

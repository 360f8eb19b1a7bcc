/* SPDX-License-Identifier: MIT */
/* fuzz_image.c - libFuzzer target for everything in tools/image that reads bytes from outside.
 *
 * The first byte chooses what the rest is given to. Besides not crashing, every target must keep
 * its promises: a failure has a text and leaves nothing behind, a picture has pixels, and what the
 * encoders write is read back the same.
 *
 *     clang -std=c11 -g -O1 -fsanitize=fuzzer,address,undefined -o fuzz tests/fuzz/fuzz_image.c \
 *         $(ls tools/image/[a-z]*.c) -lm
 *     ./fuzz -max_len=2048 tests/fuzz/corpus/image */
#include "tests/fuzz/require.h"
#include "tools/image/image.h"
#include "tools/image/inflate.h"
#include "tools/image/palette.h"
#include "tools/image/png.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_image(bool ok, struct image *image, const struct failure *f)
{
    require(ok == (f->text[0] == '\0') && ok == (image->rgba != NULL));
    if (ok)
        require(image->width >= 1 && image->width <= IMAGE_MAX_EDGE && image->height >= 1 &&
                image->height <= IMAGE_MAX_EDGE);
}

/* Small pictures are encoded and must come back. */
static void check_round_trip(const struct image *image)
{
    uint8_t *bytes;
    size_t size;
    struct image back;
    struct failure f = {""};
    if (image->rgba == NULL || image->width * image->height > 4096)
        return;
    require(png_encode(image, &bytes, &size, &f) && png_decode(bytes, size, &back, &f));
    require(memcmp(image->rgba, back.rgba, (size_t)image->width * (size_t)image->height * 4) == 0);
    image_free(&back);
    free(bytes);
}

static void fuzz_png(const uint8_t *data, size_t size)
{
    struct image image;
    struct failure f = {""};
    check_image(png_decode(data, size, &image, &f), &image, &f);
    check_round_trip(&image);
    image_free(&image);
}

/* The checksums of the chunks are made right, so that damage gets behind them. */
static void fuzz_mended_png(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size + 1);
    size_t at = 8;
    memcpy(copy, data, size);
    while (at < size && size - at >= 12) {
        uint8_t *p = copy + at;
        size_t length = (size_t)p[0] << 24 | (size_t)p[1] << 16 | (size_t)p[2] << 8 | p[3];
        if (length > size - at - 12)
            break;
        uint32_t crc = crc32_update(0, p + 4, length + 4);
        for (size_t i = 0; i < 4; i++)
            p[8 + length + i] = (uint8_t)(crc >> (24 - i * 8));
        at += length + 12;
    }
    fuzz_png(copy, size);
    free(copy);
}

/* A file that is right but for its pixels: width, height, kind, palette size, then filtered rows. */
static void fuzz_png_rows(const uint8_t *data, size_t size)
{
    static const uint8_t kinds[15][2] = {
        {0, 1}, {0, 2}, {0, 4}, {0, 8}, {0, 16}, {2, 8}, {2, 16}, {3, 1}, {3, 2}, {3, 4}, {3, 8},
        {4, 8}, {4, 16}, {6, 8}, {6, 16},
    };
    struct buffer file = {0}, packed = {0};
    if (size < 4)
        return;
    const uint8_t *kind = kinds[data[2] % 15];
    uint8_t header[13] = {0, 0, 0, data[0], 0, 0, 0, data[1], kind[1], kind[0], 0, 0, data[2] >> 7};
    size_t palette = data[3] % 86 * 3u, transparent = data[3] / 86 * 2u;
    data += 4;
    size -= 4;
    buffer_append(&file, "\x89PNG\r\n\x1a\n", 8);
    png_chunk(&file, "IHDR", header, sizeof header);
    if (palette > 0 && palette <= size)
        png_chunk(&file, "PLTE", data, palette);
    if (transparent > 0 && transparent <= size)
        png_chunk(&file, "tRNS", data, transparent);
    require(deflate_zlib(data, size, &packed));
    png_chunk(&file, "IDAT", packed.data, packed.size);
    png_chunk(&file, "IEND", NULL, 0);
    fuzz_png(file.data, file.size);
    buffer_free(&packed);
    buffer_free(&file);
}

static void fuzz_ppm(const uint8_t *data, size_t size)
{
    struct image image, back;
    struct failure f = {""};
    check_image(ppm_decode(data, size, &image, &f), &image, &f);
    if (image.rgba != NULL && image.width * image.height <= 4096) {
        uint8_t *bytes;
        size_t length;
        require(ppm_encode(&image, &bytes, &length, &f) && ppm_decode(bytes, length, &back, &f));
        require(memcmp(image.rgba, back.rgba, (size_t)(image.width * image.height) * 4) == 0);
        image_free(&back);
        free(bytes);
    }
    image_free(&image);
}

static void fuzz_pfm(const uint8_t *data, size_t size)
{
    struct float_image image, back;
    struct failure f = {""};
    bool ok = pfm_decode(data, size, &image, &f);
    require(ok == (f.text[0] == '\0') && ok == (image.value != NULL));
    if (ok) {
        uint8_t *bytes;
        size_t length, values = (size_t)image.width * (size_t)image.height * (size_t)image.channels;
        require(pfm_encode(&image, &bytes, &length, &f) && pfm_decode(bytes, length, &back, &f));
        require(memcmp(image.value, back.value, values * sizeof *image.value) == 0);
        float_image_free(&back);
        free(bytes);
    }
    float_image_free(&image);
}

/* Both kinds of streams, into rooms of every size. */
static void fuzz_inflate(const uint8_t *data, size_t size)
{
    struct failure f = {""};
    size_t produced = 0, consumed = 0, room = size > 0 ? (size_t)data[0] * data[0] : 0;
    uint8_t *out = malloc(room + 1);
    bool ok = inflate_raw(data, size, out, room, &produced, &consumed, &f);
    require(ok == (f.text[0] == '\0'));
    if (ok)
        require(produced <= room && consumed <= size);
    struct failure g = {""};
    ok = inflate_zlib(data, size, out, room, &produced, &consumed, &g);
    require(ok == (g.text[0] == '\0'));
    if (ok)
        require(produced <= room && consumed <= size);
    free(out);
}

static void fuzz_deflate(const uint8_t *data, size_t size)
{
    struct buffer packed = {0};
    struct failure f = {""};
    size_t produced = 0, consumed = 0;
    uint8_t *out = malloc(size + 1);
    require(deflate_zlib(data, size, &packed));
    require(inflate_zlib(packed.data, packed.size, out, size, &produced, &consumed, &f));
    require(produced == size && consumed == packed.size && memcmp(out, data, size) == 0);
    free(out);
    buffer_free(&packed);
}

/* A picture of 16 columns, its marks and the size of the palette from the data. */
static void fuzz_palette(const uint8_t *data, size_t size)
{
    struct image image;
    struct palette palette;
    struct failure f = {""};
    uint8_t mark[16 * 32], index[16 * 32];
    size_t rows = size / 80 < 32 ? size / 80 : 32;
    if (rows == 0 || !image_alloc(&image, 16, (int)rows, &f))
        return;
    memcpy(image.rgba, data, rows * 64);
    memcpy(mark, data + rows * 64, rows * 16);
    memset(index, 255, sizeof index);
    int limit = 2 + data[0] % 255;
    struct marked_image marked = {&image, mark};
    bool exact = palette_exact(&marked, limit, &palette);
    if (!exact)
        require(palette_choose(&marked, limit, &palette));
    require(palette.count <= limit && palette_map(&marked, &palette, index));
    for (size_t i = 0; i < rows * 16; i++) {
        if (mark[i] == 0)
            continue;
        require(index[i] < palette.count);
        if (exact)
            require(memcmp(palette.rgb[index[i]], image.rgba + i * 4, 3) == 0);
    }
    image_free(&image);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static void (*const target[8])(const uint8_t *, size_t) = {
        fuzz_png, fuzz_mended_png, fuzz_png_rows, fuzz_ppm, fuzz_pfm, fuzz_inflate, fuzz_deflate,
        fuzz_palette,
    };
    if (size > 0)
        target[data[0] % 8](data + 1, size - 1);
    return 0;
}

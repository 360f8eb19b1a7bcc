/* SPDX-License-Identifier: MIT */
/* png_read.c - PNG files to pictures (ISO/IEC 15948): every colour type, depth and interlace.
 *
 * Strict where the file is damaged (checksums, order of chunks, pixels missing), silent about what
 * a picture does not need: ancillary chunks, among them gamma and profiles, are checked and
 * skipped, so codes come out as they are in the file. Of an APNG the default picture is read. */
#include "tools/image/inflate.h"
#include "tools/image/png.h"

enum colour_type { GREY = 0, RGB = 2, INDEXED = 3, GREY_ALPHA = 4, RGB_ALPHA = 6 };

struct reader {
    const uint8_t *next, *end;  /* chunks not yet read */
    int width, height, depth;
    enum colour_type type;
    bool interlaced;
    uint8_t palette[256][4];
    unsigned palette_count;
    bool has_key;               /* one colour is transparent; its samples, in the file's depth: */
    unsigned key[3];
    struct buffer packed;       /* all IDAT data */
};

struct chunk {
    const uint8_t *data;
    size_t size;
    char name[5];
};

static uint32_t be32(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

static unsigned be16(const uint8_t *p)
{
    return (unsigned)p[0] << 8 | p[1];
}

static bool is_letter(uint8_t c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

static bool is_chunk(const struct chunk *c, const char *name)
{
    return memcmp(c->name, name, 4) == 0;
}

static bool next_chunk(struct reader *r, struct chunk *c, struct failure *f)
{
    size_t left = (size_t)(r->end - r->next);
    if (left < 12)
        return fail(f, "file ends early (no IEND chunk)");
    for (int i = 0; i < 4; i++) {
        if (!is_letter(r->next[4 + i]))
            return fail(f, "file is damaged (name of a chunk)");
        c->name[i] = (char)r->next[4 + i];
    }
    c->name[4] = '\0';
    c->size = be32(r->next);
    if (c->size > left - 12)
        return fail(f, "file ends early (in chunk %s)", c->name);
    c->data = r->next + 8;
    if (crc32_update(0, r->next + 4, c->size + 4) != be32(c->data + c->size))
        return fail(f, "checksum mismatch (chunk %s)", c->name);
    r->next = c->data + c->size + 4;
    return true;
}

static bool read_header(struct reader *r, struct failure *f)
{
    struct chunk c;
    if (!next_chunk(r, &c, f))
        return false;
    if (!is_chunk(&c, "IHDR") || c.size != 13)
        return fail(f, "file is damaged (no IHDR chunk)");
    uint32_t width = be32(c.data), height = be32(c.data + 4);
    if (width > INT32_MAX || height > INT32_MAX)
        return fail(f, "file is damaged (picture size)");
    if (!image_check_size((long)width, (long)height, f))
        return false;
    r->width = (int)width;
    r->height = (int)height;
    r->depth = c.data[8];
    r->type = c.data[9];
    bool power_of_two = r->depth >= 1 && r->depth <= 16 && (r->depth & (r->depth - 1)) == 0;
    bool known;
    switch (c.data[9]) {
    case GREY:
        known = power_of_two;
        break;
    case INDEXED:
        known = power_of_two && r->depth <= 8;
        break;
    case RGB:
    case GREY_ALPHA:
    case RGB_ALPHA:
        known = r->depth == 8 || r->depth == 16;
        break;
    default:
        known = false;
        break;
    }
    if (!known)
        return fail(f, "colour type %d of depth %d does not exist (IHDR)", c.data[9], r->depth);
    if (c.data[10] != 0 || c.data[11] != 0 || c.data[12] > 1)
        return fail(f, "unknown compression, filter or interlace method (IHDR)");
    r->interlaced = c.data[12] == 1;
    return true;
}

static bool read_palette(struct reader *r, const struct chunk *c, struct failure *f)
{
    if (r->type == GREY || r->type == GREY_ALPHA)
        return fail(f, "a grey picture has a palette (PLTE)");
    if (r->palette_count != 0)
        return fail(f, "file is damaged (two PLTE chunks)");
    if (c->size == 0 || c->size % 3 != 0 || c->size > sizeof r->palette / 4 * 3)
        return fail(f, "palette has a wrong size (%zu bytes)", c->size);
    r->palette_count = (unsigned)(c->size / 3);
    for (unsigned i = 0; i < r->palette_count; i++) {
        memcpy(r->palette[i], c->data + i * 3, 3);
        r->palette[i][3] = 255;
    }
    return true;
}

static bool read_transparency(struct reader *r, const struct chunk *c, struct failure *f)
{
    if (r->type == INDEXED) {
        if (c->size > r->palette_count)
            return fail(f, "transparency has more entries than the palette (%zu)", c->size);
        for (size_t i = 0; i < c->size; i++)
            r->palette[i][3] = c->data[i];
        return true;
    }
    unsigned samples = r->type == GREY ? 1 : r->type == RGB ? 3 : 0;
    if (samples == 0)
        return fail(f, "a picture with alpha has a transparent colour too (tRNS)");
    if (c->size != samples * 2)
        return fail(f, "transparency has a wrong size (%zu bytes)", c->size);
    r->has_key = true;
    for (unsigned i = 0; i < samples; i++)
        r->key[i] = be16(c->data + i * 2) & ((1u << r->depth) - 1);
    return true;
}

/* All chunks after IHDR; the compressed pixels end up in r->packed. */
static bool read_chunks(struct reader *r, struct failure *f)
{
    bool data_begun = false, data_ended = false, has_transparency = false;
    for (;;) {
        struct chunk c;
        if (!next_chunk(r, &c, f))
            return false;
        if (is_chunk(&c, "IDAT")) {
            if (data_ended)
                return fail(f, "file is damaged (IDAT chunks are not consecutive)");
            if (r->type == INDEXED && r->palette_count == 0)
                return fail(f, "palette is missing (no PLTE chunk)");
            data_begun = true;
            buffer_append(&r->packed, c.data, c.size);
            if (r->packed.failed)
                return fail(f, "out of memory (compressed data)");
            continue;
        }
        data_ended = data_begun;
        if (is_chunk(&c, "IEND")) {
            if (!data_begun)
                return fail(f, "file has no pixels (no IDAT chunk)");
            return true;
        }
        if (is_chunk(&c, "PLTE")) {
            if (data_begun)
                return fail(f, "file is damaged (PLTE after IDAT)");
            if (!read_palette(r, &c, f))
                return false;
        } else if (is_chunk(&c, "tRNS")) {
            if (data_begun || has_transparency)
                return fail(f, "file is damaged (misplaced tRNS)");
            has_transparency = true;
            if (!read_transparency(r, &c, f))
                return false;
        } else if ((c.name[0] & 0x20) == 0) {
            return fail(f, "unknown critical chunk (%s)", c.name);
        }
    }
}

/* The passes of a file: pixel (x0 + i dx, y0 + j dy) is pixel (i, j) of the pass. */
struct pass {
    int x0, y0, dx, dy;
};

static const struct pass whole_picture[1] = {{0, 0, 1, 1}};
static const struct pass adam7[7] = {
    {0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
    {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2},
};

static size_t bits_per_pixel(const struct reader *r)
{
    size_t samples = r->type == RGB ? 3 : r->type == RGB_ALPHA ? 4 : r->type == GREY_ALPHA ? 2 : 1;
    return samples * (size_t)r->depth;
}

static int pass_columns(const struct reader *r, struct pass p)
{
    return (r->width - p.x0 + p.dx - 1) / p.dx;
}

static int pass_rows(const struct reader *r, struct pass p)
{
    return (r->height - p.y0 + p.dy - 1) / p.dy;
}

/* Bytes of a row of the pass without its filter byte. */
static size_t pass_stride(const struct reader *r, struct pass p)
{
    return ((size_t)pass_columns(r, p) * bits_per_pixel(r) + 7) / 8;
}

/* Bytes of the pass; one without pixels has none, not even filter bytes. */
static size_t pass_size(const struct reader *r, struct pass p)
{
    if (pass_columns(r, p) <= 0 || pass_rows(r, p) <= 0)
        return 0;
    return (size_t)pass_rows(r, p) * (pass_stride(r, p) + 1);
}

/* Undoes a row's filter in place; `up` is the finished row above, zeros for the first. `step` is
 * the distance in bytes to the pixel on the left. */
static bool unfilter(unsigned filter, uint8_t *row, const uint8_t *up, size_t size, size_t step)
{
    size_t first = step < size ? step : size;
    switch (filter) {
    case 0:
        return true;
    case 1:
        for (size_t i = step; i < size; i++)
            row[i] = (uint8_t)(row[i] + row[i - step]);
        return true;
    case 2:
        for (size_t i = 0; i < size; i++)
            row[i] = (uint8_t)(row[i] + up[i]);
        return true;
    case 3:
        for (size_t i = 0; i < first; i++)
            row[i] = (uint8_t)(row[i] + up[i] / 2);
        for (size_t i = step; i < size; i++)
            row[i] = (uint8_t)(row[i] + (row[i - step] + up[i]) / 2);
        return true;
    case 4:
        for (size_t i = 0; i < first; i++)
            row[i] = (uint8_t)(row[i] + up[i]);
        for (size_t i = step; i < size; i++)
            row[i] = (uint8_t)(row[i] + png_paeth(row[i - step], up[i], up[i - step]));
        return true;
    default:
        return false;
    }
}

/* Sample number i of a row. */
static inline unsigned sample(const struct reader *r, const uint8_t *row, size_t i)
{
    if (r->depth == 8)
        return row[i];
    if (r->depth == 16)
        return be16(row + i * 2);
    size_t per_byte = 8 / (size_t)r->depth;
    unsigned shift = (unsigned)((per_byte - 1 - i % per_byte) * (size_t)r->depth);
    return (unsigned)row[i / per_byte] >> shift & ((1u << r->depth) - 1);
}

/* To 8 bits, rounded to nearest; exact for depths below 8, which divide 255. The two common depths
 * are spared the division, which compilers make a product for a number they know. */
static uint8_t to_8_bits(const struct reader *r, unsigned value)
{
    unsigned largest = (1u << r->depth) - 1;
    if (largest == 255)
        return (uint8_t)value;
    if (largest == 65535)
        return (uint8_t)((value * 255 + 32767) / 65535);
    return (uint8_t)((value * 255 + largest / 2) / largest);
}

/* Pixel i of a row to RGBA; false for an index outside the palette. */
static bool convert_pixel(const struct reader *r, const uint8_t *row, size_t i, uint8_t rgba[4])
{
    unsigned s[4];
    switch (r->type) {
    case INDEXED:
        s[0] = sample(r, row, i);
        if (s[0] >= r->palette_count)
            return false;
        memcpy(rgba, r->palette[s[0]], 4);
        return true;
    case GREY:
    case GREY_ALPHA: {
        size_t at = r->type == GREY ? i : i * 2;
        s[0] = sample(r, row, at);
        rgba[0] = rgba[1] = rgba[2] = to_8_bits(r, s[0]);
        if (r->type == GREY_ALPHA)
            rgba[3] = to_8_bits(r, sample(r, row, at + 1));
        else
            rgba[3] = r->has_key && s[0] == r->key[0] ? 0 : 255;
        return true;
    }
    case RGB:
    case RGB_ALPHA: {
        size_t samples = r->type == RGB ? 3 : 4;
        for (size_t k = 0; k < samples; k++) {
            s[k] = sample(r, row, i * samples + k);
            rgba[k] = to_8_bits(r, s[k]);
        }
        if (r->type == RGB)
            rgba[3] = r->has_key && s[0] == r->key[0] && s[1] == r->key[1] && s[2] == r->key[2] ? 0
                                                                                                : 255;
        return true;
    }
    }
    return false;
}

/* One pass from its filtered bytes at `data` into the picture. */
static bool read_pass(const struct reader *r, struct pass p, uint8_t *data, struct image *out,
                      struct failure *f)
{
    size_t stride = pass_stride(r, p), step = (bits_per_pixel(r) + 7) / 8;
    int columns = pass_columns(r, p), rows = pass_rows(r, p);
    uint8_t *zeros = calloc(stride, 1);
    if (zeros == NULL)
        return fail(f, "out of memory (row)");
    const uint8_t *up = zeros;
    bool ok = true;
    for (int j = 0; ok && j < rows; j++) {
        uint8_t *row = data + (size_t)j * (stride + 1);
        if (!unfilter(row[0], row + 1, up, stride, step)) {
            ok = fail(f, "unknown filter type %d (row %d)", row[0], p.y0 + j * p.dy);
            break;
        }
        up = row + 1;
        uint8_t *to = out->rgba + ((size_t)(p.y0 + j * p.dy) * (size_t)r->width + (size_t)p.x0) * 4;
        for (int i = 0; ok && i < columns; i++, to += (size_t)p.dx * 4)
            if (!convert_pixel(r, row + 1, (size_t)i, to))
                ok = fail(f, "colour is not in the palette (row %d)", p.y0 + j * p.dy);
    }
    free(zeros);
    return ok;
}

static bool read_pixels(struct reader *r, struct image *out, struct failure *f)
{
    const struct pass *passes = r->interlaced ? adam7 : whole_picture;
    int pass_count = r->interlaced ? 7 : 1;
    size_t size = 0, produced = 0;
    for (int i = 0; i < pass_count; i++)
        size += pass_size(r, passes[i]);
    if (size / INFLATE_MAX_RATIO > r->packed.size)
        return fail(f, "file is too small for its picture size (%d x %d)", r->width, r->height);
    uint8_t *raw = malloc(size);
    if (raw == NULL)
        return fail(f, "out of memory (picture of %d x %d)", r->width, r->height);
    bool ok = inflate_zlib(r->packed.data, r->packed.size, raw, size, &produced, NULL, f);
    if (ok && produced != size)
        ok = fail(f, "pixels are missing (%zu of %zu bytes)", produced, size);
    buffer_free(&r->packed);
    ok = ok && image_alloc(out, r->width, r->height, f);
    uint8_t *data = raw;
    for (int i = 0; ok && i < pass_count; i++) {
        size_t bytes = pass_size(r, passes[i]);
        ok = bytes == 0 || read_pass(r, passes[i], data, out, f);
        data += bytes;
    }
    free(raw);
    if (!ok)
        image_free(out);
    return ok;
}

bool png_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f)
{
    struct reader r = {.next = bytes, .end = bytes + size};
    *out = (struct image){0};
    if (size < sizeof png_signature || memcmp(bytes, png_signature, sizeof png_signature) != 0)
        return fail(f, "not a PNG file (signature)");
    r.next += sizeof png_signature;
    bool ok = read_header(&r, f) && read_chunks(&r, f) && read_pixels(&r, out, f);
    buffer_free(&r.packed);
    return ok;
}

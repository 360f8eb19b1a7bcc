/* SPDX-License-Identifier: MIT */
/* test_image.c - tools/image: compression, picture files, animations.
 *
 * What the tools read is made by small encoders here, and by other programs; what they write is read by what has been tested so, and
 * animations by small decoders here that trust nothing: any deviation from the format makes them fail. */
#include "tests/random.h"
#include "tests/test.h"

#include "tools/image/buffer.h"
#include "tools/image/image.h"
#include "tools/image/inflate.h"
#include "tools/image/palette.h"
#include "tools/image/png.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- helpers --- */

static unsigned random_below(unsigned n)
{
    return (unsigned)((uint64_t)random_u32() * n >> 32);
}

/* A name for a file that a test writes and removes: in the folder TMPDIR names, else the current. */
static const char *scratch(const char *name)
{
    static char path[2][512];
    static int turn;
    const char *folder = getenv("TMPDIR");
    turn = 1 - turn;
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder != NULL ? folder : ".", name);
    return path[turn];
}

static bool exists(const char *path)
{
    FILE *stream = fopen(path, "rb");
    if (stream != NULL)
        fclose(stream);
    return stream != NULL;
}

static bool is_temporary_left(const char *path)
{
    char name[600];
    snprintf(name, sizeof name, "%s.tmp", path);
    return exists(name);
}

/* Reads and removes a file that a test has written. */
static struct buffer take_file(const char *path)
{
    struct buffer b = {0};
    struct failure f = {""};
    CHECK(file_read(path, (size_t)1 << 28, &b.data, &b.size, &f));
    remove(path);
    return b;
}

static bool same_pixels(const struct image *a, const struct image *b)
{
    return a->width == b->width && a->height == b->height && a->rgba != NULL && b->rgba != NULL &&
           memcmp(a->rgba, b->rgba, (size_t)a->width * (size_t)a->height * 4) == 0;
}

static uint8_t *pixel(const struct image *image, int x, int y)
{
    return image->rgba + ((size_t)y * (size_t)image->width + (size_t)x) * 4;
}

static struct image make_image(int width, int height)
{
    struct image image;
    struct failure f = {""};
    CHECK(image_alloc(&image, width, height, &f));
    return image;
}

static struct image copy_image(const struct image *from)
{
    struct image to = make_image(from->width, from->height);
    memcpy(to.rgba, from->rgba, (size_t)from->width * (size_t)from->height * 4);
    return to;
}

static struct image noise_image(int width, int height, bool has_alpha)
{
    struct image image = make_image(width, height);
    for (size_t i = 0; i < (size_t)width * (size_t)height * 4; i++)
        if (has_alpha || i % 4 != 3)
            image.rgba[i] = (uint8_t)random_u32();
    return image;
}

/* Smooth shades, what blurred renderings are made of: far more than 256 colours. `shift` moves it. */
static struct image smooth_image(int width, int height, int shift)
{
    struct image image = make_image(width, height);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int u = x + shift, v = y, s = (u * u / 40 + v * v / 30) & 511;
            uint8_t *p = pixel(&image, x, y);
            p[0] = (uint8_t)((u * 2 + v) & 255);
            p[1] = (uint8_t)(s < 256 ? s : 511 - s);
            p[2] = (uint8_t)(255 - v * 255 / height);
        }
    return image;
}

/* --- checksums and compression --- */

static void test_crc32_gives_the_published_check_values(void)
{
    uint8_t all[256];
    CHECK_EQ(crc32_update(0, "", 0), 0);
    CHECK_EQ(crc32_update(0, "123456789", 9), 0xcbf43926);
    CHECK_EQ(crc32_update(0, "IEND", 4), 0xae426082);
    CHECK_EQ(crc32_update(crc32_update(0, "12345", 5), "6789", 4), 0xcbf43926);
    for (unsigned i = 0; i < 256; i++)
        all[i] = (uint8_t)i;
    uint32_t crc = UINT32_MAX;          /* the definition, bit by bit */
    for (unsigned i = 0; i < 256 * 8; i++) {
        uint32_t bit = (crc ^ (uint32_t)(all[i / 8] >> i % 8)) & 1;
        crc = crc >> 1 ^ (bit != 0 ? 0xedb88320 : 0);
    }
    CHECK_EQ(crc32_update(0, all, sizeof all), ~crc);
}

static void test_adler32_gives_the_published_check_value_and_does_not_overflow(void)
{
    static uint8_t full[20000];
    int64_t a = 1, b = 0;
    memset(full, 255, sizeof full);
    for (size_t i = 0; i < sizeof full; i++) {
        a = (a + 255) % 65521;
        b = (b + a) % 65521;
    }
    CHECK_EQ(adler32_update(1, (const uint8_t *)"Wikipedia", 9), 0x11e60398);
    CHECK_EQ(adler32_update(1, full, sizeof full), b * 65536 + a);
    CHECK_EQ(adler32_update(adler32_update(1, full, 7777), full, sizeof full - 7777),
             b * 65536 + a);
}

/* Compresses, and expects inflate_zlib to give the input back. */
static size_t check_round_trip(const uint8_t *bytes, size_t size)
{
    struct buffer packed = {0};
    struct failure f = {""};
    size_t produced = 0, consumed = 0;
    CHECK(deflate_zlib(bytes, size, &packed));
    uint8_t *own = malloc(size + 1);
    CHECK(inflate_zlib(packed.data, packed.size, own, size, &produced, &consumed, &f));
    CHECK(produced == size && consumed == packed.size && memcmp(own, bytes, size) == 0);
    if (size > 0)
        CHECK(!inflate_zlib(packed.data, packed.size, own, size - 1, NULL, NULL, &f));
    free(own);
    size_t result = packed.size;
    buffer_free(&packed);
    return result;
}

static void test_deflate_round_trips_every_small_size_and_many_kinds_of_data(void)
{
    static uint8_t data[150000];
    random_state = 1;
    for (size_t size = 0; size < 300; size++) {
        for (size_t i = 0; i < size; i++)
            data[i] = (uint8_t)(random_below(3) == 0 ? random_u32() : 'a');
        check_round_trip(data, size);
    }
    for (int kind = 0; kind < 6; kind++) {
        for (size_t i = 0; i < sizeof data; i++) {
            switch (kind) {
            case 0: data[i] = (uint8_t)random_u32(); break;            /* cannot be compressed */
            case 1: data[i] = 0; break;
            case 2: data[i] = (uint8_t)(i % 251); break;
            case 3: data[i] = (uint8_t)(random_below(16) * random_below(16)); break;
            case 4: data[i] = i < 32768 ? (uint8_t)random_u32() : data[i - 32768 + i % 3]; break;
            default: data[i] = (uint8_t)(i < 32767 ? random_u32() : data[i - 32767]); break;
            }
        }
        check_round_trip(data, sizeof data);
    }
}

static void test_deflate_finds_matches_of_all_lengths_and_distances(void)
{
    static uint8_t data[400000];
    random_state = 2;
    for (int round = 0; round < 3; round++) {
        size_t at = 0;
        while (at < sizeof data) {
            size_t run = 1 + random_below(round == 0 ? 4 : 40);
            for (; run > 0 && at < sizeof data; run--)
                data[at++] = (uint8_t)random_u32();
            size_t distance = 1 + random_below(random_below(2) == 0 ? 40000 : 300);
            size_t length = 3 + random_below(random_below(2) == 0 ? 270 : 10);
            for (; length > 0 && at < sizeof data && distance <= at; length--, at++)
                data[at] = data[at - distance];
        }
        check_round_trip(data, sizeof data);
    }
}

/* Uses like Fibonacci numbers want codes of more than 15 bits. */
static void test_deflate_limits_the_length_of_codes(void)
{
    static uint8_t data[400000];
    size_t at = 0, uses = 1, last = 1;
    random_state = 3;
    for (unsigned symbol = 0; symbol < 24 && at < sizeof data; symbol++) {
        for (size_t i = 0; i < uses && at < 24000; i++)
            data[at++] = (uint8_t)(symbol * 7);
        size_t sum = uses + last;
        last = uses;
        uses = sum;
    }
    for (size_t i = at - 1; i > 0; i--) {       /* shuffle, so that no matches hide the symbols */
        size_t j = random_below((unsigned)i + 1);
        uint8_t swap = data[i];
        data[i] = data[j];
        data[j] = swap;
    }
    check_round_trip(data, at);
}

/* Bounds measured with zlib 1.2.13 at level 6 on the same bytes, plus 3 %. */
static void test_deflate_is_as_small_as_zlib(void)
{
    static uint8_t data[300000];
    memset(data, 0, sizeof data);
    CHECK(check_round_trip(data, sizeof data) <= 322);
    for (size_t i = 0; i < sizeof data; i++) {
        size_t x = i / 3 % 400, y = i / 1200;
        data[i] = (uint8_t)((x * x / 97 + y * (i % 3 + 1) + x * y / 50) / 8);
    }
    CHECK(check_round_trip(data, sizeof data) <= 111800);
    random_state = 4;
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (uint8_t)"etaoin shrdlu"[random_below(13) * random_below(13) / 13];
    CHECK(check_round_trip(data, sizeof data) <= 134000);
}

/* Writes bits in deflate's order, codes from their top bit. */
struct bit_writer {
    uint8_t data[512];
    size_t bit;
};

static void put_bits(struct bit_writer *w, unsigned value, unsigned count)
{
    for (unsigned i = 0; i < count; i++, w->bit++)
        w->data[w->bit / 8] |= (uint8_t)((value >> i & 1) << w->bit % 8);
}

static void put_huffman(struct bit_writer *w, unsigned code, unsigned count)
{
    for (unsigned i = count; i-- > 0;)
        put_bits(w, code >> i, 1);
}

static bool inflates(const struct bit_writer *w, const char *want)
{
    uint8_t out[1000];
    size_t produced = 0, consumed = 0;
    struct failure f = {""};
    bool ok = inflate_raw(w->data, (w->bit + 7) / 8, out, sizeof out, &produced, &consumed, &f);
    CHECK(ok == (f.text[0] == '\0'));
    return ok && consumed == (w->bit + 7) / 8 && produced == strlen(want) &&
           memcmp(out, want, produced) == 0;
}

/* Whether the stream is refused with a reason that contains `why`. */
static bool is_refused(const struct bit_writer *w, const char *why)
{
    uint8_t out[1000];
    struct failure f = {""};
    return !inflate_raw(w->data, sizeof w->data, out, sizeof out, NULL, NULL, &f) &&
           strstr(f.text, why) != NULL;
}

static void test_inflate_reads_streams_made_by_hand(void)
{
    struct bit_writer w = {{0}, 0};
    put_bits(&w, 0, 3);                         /* stored, not last */
    put_bits(&w, 0, 5);
    put_bits(&w, 2, 16);
    put_bits(&w, 0xfffd, 16);
    put_bits(&w, 'o' | 'h' << 8, 16);
    put_bits(&w, 1 | 1 << 1, 3);                /* fixed, last */
    put_huffman(&w, 0x30 + '!', 8);
    put_huffman(&w, 257 + 3 - 256, 7);          /* length 6 */
    put_huffman(&w, 2, 5);                      /* distance 3: overlaps what it makes */
    put_huffman(&w, 0, 7);
    CHECK(inflates(&w, "oh!oh!oh!"));
}

/* Starts a dynamic block whose code lengths follow as four bits each. */
static void put_dynamic(struct bit_writer *w, unsigned literals, unsigned distances)
{
    put_bits(w, 1 | 2 << 1, 3);
    put_bits(w, literals - 257, 5);
    put_bits(w, distances - 1, 5);
    put_bits(w, 15, 4);                         /* all 19 lengths are sent: */
    put_bits(w, 0, 9);                          /* 16, 17 and 18 are not used, */
    for (int i = 0; i < 16; i++)                /* 0 to 15 have 4 bits */
        put_bits(w, 4, 3);
}

static void put_length(struct bit_writer *w, unsigned length, unsigned times)
{
    while (times-- > 0)
        put_huffman(w, length, 4);
}

static void test_inflate_reads_a_block_with_a_lone_distance_code(void)
{
    struct bit_writer w = {{0}, 0};
    put_dynamic(&w, 258, 1);
    put_length(&w, 0, 'a');
    put_length(&w, 1, 1);                       /* a: 0 */
    put_length(&w, 0, 256 - 'a' - 1);
    put_length(&w, 2, 2);                       /* end: 10, length 3: 11 */
    put_length(&w, 1, 1);                       /* distance 1: 0 */
    put_huffman(&w, 0, 1);
    put_huffman(&w, 3, 2);
    put_huffman(&w, 0, 1);
    put_huffman(&w, 2, 2);
    CHECK(inflates(&w, "aaaa"));
}

static void test_inflate_refuses_what_the_format_forbids(void)
{
    struct bit_writer w = {{0}, 0};
    put_bits(&w, 1 | 3 << 1, 3);
    CHECK(is_refused(&w, "kind of block"));

    w = (struct bit_writer){{0}, 0};
    put_bits(&w, 1, 8);
    put_bits(&w, 2, 16);
    put_bits(&w, 0xfffc, 16);
    CHECK(is_refused(&w, "length of a stored block"));

    static const unsigned reserved[2][2] = {{0xc0 + 6, 0}, {257 + 3 - 256, 30}};
    for (int i = 0; i < 2; i++) {
        w = (struct bit_writer){{0}, 0};
        put_bits(&w, 1 | 1 << 1, 3);
        put_huffman(&w, 0x30 + 'x', 8);
        put_huffman(&w, reserved[i][0], i == 0 ? 8 : 7);
        put_huffman(&w, reserved[i][1], 5);
        CHECK(is_refused(&w, i == 0 ? "reserved length" : "distance"));
    }

    w = (struct bit_writer){{0}, 0};            /* three bytes back after two */
    put_bits(&w, 1 | 1 << 1, 3);
    put_huffman(&w, 0x30 + 'x', 8);
    put_huffman(&w, 0x30 + 'y', 8);
    put_huffman(&w, 1, 7);
    put_huffman(&w, 2, 5);
    CHECK(is_refused(&w, "distance before the start"));

    w = (struct bit_writer){{0}, 0};
    put_dynamic(&w, 287, 1);
    CHECK(is_refused(&w, "number of codes"));
    w = (struct bit_writer){{0}, 0};
    put_dynamic(&w, 257, 31);
    CHECK(is_refused(&w, "number of codes"));

    w = (struct bit_writer){{0}, 0};            /* nothing ends the block */
    put_dynamic(&w, 257, 1);
    put_length(&w, 8, 256);
    put_length(&w, 0, 2);
    CHECK(is_refused(&w, "block without an end"));

    w = (struct bit_writer){{0}, 0};            /* 257 codes of 8 bits */
    put_dynamic(&w, 257, 1);
    put_length(&w, 8, 257);
    put_length(&w, 0, 1);
    CHECK(is_refused(&w, "code lengths"));

    w = (struct bit_writer){{0}, 0};            /* half of the codes are missing */
    put_dynamic(&w, 257, 1);
    put_length(&w, 0, 254);
    put_length(&w, 3, 3);
    put_length(&w, 0, 1);
    CHECK(is_refused(&w, "code lengths"));

    w = (struct bit_writer){{0}, 0};            /* the code of code lengths is over-full */
    put_bits(&w, 1 | 2 << 1, 3);
    put_bits(&w, 0, 10);
    put_bits(&w, 0, 4);
    for (int i = 0; i < 4; i++)
        put_bits(&w, 1, 3);
    CHECK(is_refused(&w, "code lengths"));

    for (int i = 0; i < 2; i++) {               /* nothing to repeat; repeating past the end */
        w = (struct bit_writer){{0}, 0};
        put_bits(&w, 1 | 2 << 1, 3);
        put_bits(&w, 0, 10);
        put_bits(&w, 0, 4);                     /* lengths of 16, 17, 18, 0 */
        put_bits(&w, i == 0 ? 1 : 0, 3);
        put_bits(&w, 0, 3);
        put_bits(&w, i == 0 ? 0 : 1, 3);
        put_bits(&w, 1, 3);
        for (int k = 0; k < 3; k++) {
            put_huffman(&w, 1, 1);
            put_bits(&w, 127, i == 0 ? 2 : 7);
        }
        CHECK(is_refused(&w, i == 0 ? "repeat without a length" : "too many code lengths"));
    }
}

static void test_inflate_checks_header_checksum_and_end_of_zlib_streams(void)
{
    static const uint8_t good[] = {                     /* "a" */
        0x78, 0x9c, 0x4b, 0x04, 0x00, 0x00, 0x62, 0x00, 0x62,
    };
    uint8_t bad[sizeof good], out[8];
    struct failure f = {""};
    size_t produced = 0;
    CHECK(inflate_zlib(good, sizeof good, out, sizeof out, &produced, NULL, &f));
    CHECK(produced == 1 && out[0] == 'a');
    for (size_t size = 0; size < sizeof good; size++) {
        f.text[0] = '\0';
        CHECK(!inflate_zlib(good, size, out, sizeof out, NULL, NULL, &f) && f.text[0] != '\0');
    }
    static const struct { int at, value; } damage[] = {
        {0, 0x77}, {0, 0x88}, {1, 0x9d}, {1, 0xbb}, {5, 0x01}, {6, 0x63}, {8, 0x61},
    };
    for (size_t i = 0; i < sizeof damage / sizeof damage[0]; i++) {
        memcpy(bad, good, sizeof good);
        bad[damage[i].at] = (uint8_t)damage[i].value;
        CHECK(!inflate_zlib(bad, sizeof bad, out, sizeof out, NULL, NULL, &f));
    }
}

/* --- PNG: an encoder of all kinds --- */

/* Signature and IHDR. */
static void put_head(struct buffer *b, uint32_t width, uint32_t height, int depth, int type,
                     int interlace)
{
    struct buffer h OWNED(buffer_free) = {0};
    buffer_append(b, "\x89PNG\r\n\x1a\n", 8);
    buffer_be32(&h, width);
    buffer_be32(&h, height);
    buffer_byte(&h, (unsigned)depth);
    buffer_byte(&h, (unsigned)type);
    buffer_le16(&h, 0);
    buffer_byte(&h, (unsigned)interlace);
    png_chunk(b, "IHDR", h.data, h.size);
}

/* `raw` as a zlib stream of stored blocks. */
static struct buffer store(const uint8_t *raw, size_t size)
{
    struct buffer b = {0};
    uint32_t sum = adler32_update(1, raw, size);
    buffer_append(&b, "\x78\x01", 2);
    for (size_t at = 0; at < size || at == 0;) {
        size_t run = size - at < 1000 ? size - at : 1000;
        buffer_byte(&b, at + run == size);
        buffer_le16(&b, (unsigned)run);
        buffer_le16(&b, (unsigned)run ^ 0xffff);
        buffer_append(&b, raw + at, run);
        at += run + (size == 0);
    }
    buffer_be32(&b, sum);
    return b;
}

static void put_idat(struct buffer *b, const uint8_t *raw, size_t size)
{
    struct buffer packed OWNED(buffer_free) = store(raw, size);
    png_chunk(b, "IDAT", packed.data, packed.size);
}

/* What the filters of the standard predict from left, above and the corner between. */
static unsigned predict(unsigned filter, int a, int b, int c)
{
    int p = a + b - c, pa = abs(p - a), pb = abs(p - b), pc = abs(p - c);
    switch (filter) {
    case 0: return 0;
    case 1: return (unsigned)a;
    case 2: return (unsigned)b;
    case 3: return (unsigned)(a + b) / 2;
    default: return (unsigned)(pa <= pb && pa <= pc ? a : pb <= pc ? b : c);
    }
}

/* Pass of each pixel of an 8 x 8 block in an interlaced file (the figure in the standard). */
static const char adam7_figure[8][9] = {
    "16462646", "77777777", "56565656", "77777777", "36463646", "77777777", "56565656", "77777777",
};

struct sample_picture {
    int width, height, depth, type, channels;
    bool interlaced, has_transparency;
    unsigned palette_count;
    uint8_t palette[256][4];
    uint16_t key[3];
    uint16_t *sample;           /* channels per pixel */
};

static unsigned largest_sample(const struct sample_picture *p)
{
    return (1u << p->depth) - 1;
}

static struct sample_picture make_samples(int width, int height, int depth, int type,
                                          bool interlaced, bool has_transparency)
{
    struct sample_picture p = {.width = width, .height = height, .depth = depth, .type = type,
                               .interlaced = interlaced, .has_transparency = has_transparency};
    p.channels = type == 2 ? 3 : type == 6 ? 4 : type == 4 ? 2 : 1;
    size_t count = (size_t)(width * height * p.channels);
    p.palette_count = 1 + random_below(1u << (depth < 8 ? depth : 8));
    for (unsigned i = 0; i < 256 * 4; i++)
        p.palette[i / 4][i % 4] = (uint8_t)random_u32();
    p.sample = malloc(count * sizeof *p.sample);
    for (size_t i = 0; i < count; i++)
        p.sample[i] = (uint16_t)random_below(type == 3 ? p.palette_count : largest_sample(&p) + 1);
    for (int k = 0; k < 3; k++)         /* the transparent colour is one that occurs */
        p.key[k] = p.sample[(size_t)(p.channels >= 3 ? k : 0)];
    return p;
}

static uint8_t narrowed(const struct sample_picture *p, unsigned value)
{
    return (uint8_t)(value * 255.0 / largest_sample(p) + 0.5);
}

static struct image expected_image(const struct sample_picture *p)
{
    struct image image = make_image(p->width, p->height);
    for (int i = 0; i < p->width * p->height; i++) {
        const uint16_t *s = p->sample + i * p->channels;
        uint8_t *to = image.rgba + i * 4;
        bool is_key = p->has_transparency && p->type != 3 && s[0] == p->key[0] &&
                      (p->type == 0 || (s[1] == p->key[1] && s[2] == p->key[2]));
        if (p->type == 3) {
            memcpy(to, p->palette[s[0]], 4);
            if (!p->has_transparency || s[0] > p->palette_count / 2)    /* tRNS is shorter */
                to[3] = 255;
            continue;
        }
        bool is_grey = p->type == 0 || p->type == 4;
        for (int k = 0; k < 3; k++)
            to[k] = narrowed(p, s[is_grey ? 0 : k]);
        if (p->type == 4 || p->type == 6)
            to[3] = narrowed(p, s[p->channels - 1]);
        else
            to[3] = is_key ? 0 : 255;
    }
    return image;
}

/* The rows of a pass, packed and filtered; filters take turns. */
static void put_pass(struct buffer *raw, const struct sample_picture *p, char pass, unsigned *turn)
{
    size_t step = (size_t)(p->channels * p->depth + 7) / 8;
    size_t most = (size_t)(p->width * p->channels * p->depth + 7) / 8;
    uint8_t *above = calloc(most + step, 1), *row = calloc(most + step, 1);
    for (int y = 0; y < p->height; y++) {
        size_t bit = 0;
        memset(row, 0, most + step);            /* `step` zeros stand left of the first pixel */
        for (int x = 0; x < p->width; x++) {
            if (pass != 0 && adam7_figure[y % 8][x % 8] != pass)
                continue;
            for (int k = 0; k < p->channels; k++) {
                unsigned value = p->sample[(y * p->width + x) * p->channels + k];
                for (int i = p->depth - 1; i >= 0; i--, bit++)
                    row[step + bit / 8] |= (uint8_t)((value >> i & 1) << (7 - bit % 8));
            }
        }
        if (bit == 0)
            continue;
        unsigned filter = (*turn)++ % 5;
        buffer_byte(raw, filter);
        for (size_t i = step; i < step + (bit + 7) / 8; i++) {
            unsigned predicted = predict(filter, row[i - step], above[i], above[i - step]);
            buffer_byte(raw, (row[i] - predicted) & 255);
        }
        uint8_t *swap = above;
        above = row;
        row = swap;
    }
    free(above);
    free(row);
}

static struct buffer png_of_samples(const struct sample_picture *p)
{
    struct buffer b = {0}, raw = {0};
    unsigned turn = random_below(5);
    put_head(&b, (uint32_t)p->width, (uint32_t)p->height, p->depth, p->type, p->interlaced);
    png_chunk(&b, "gAMA", "\0\0\xb1\x8f", 4);
    if (p->type == 3) {
        uint8_t colors[768], alpha[256];
        for (unsigned i = 0; i < 256; i++) {
            memcpy(colors + i * 3, p->palette[i], 3);
            alpha[i] = p->palette[i][3];
        }
        png_chunk(&b, "PLTE", colors, p->palette_count * 3);
        if (p->has_transparency)
            png_chunk(&b, "tRNS", alpha, p->palette_count / 2 + 1 < p->palette_count
                                             ? p->palette_count / 2 + 1 : p->palette_count);
    } else if (p->has_transparency) {
        uint8_t key[6];
        for (int k = 0; k < 3; k++) {
            key[k * 2] = (uint8_t)(p->key[k] >> 8);
            key[k * 2 + 1] = (uint8_t)p->key[k];
        }
        png_chunk(&b, "tRNS", key, p->type == 0 ? 2 : 6);
    }
    for (char pass = '1'; p->interlaced && pass <= '7'; pass++)
        put_pass(&raw, p, pass, &turn);
    if (!p->interlaced)
        put_pass(&raw, p, 0, &turn);
    struct buffer packed = store(raw.data, raw.size);
    for (size_t at = 0; at < packed.size;) {    /* cut anywhere, even into nothing */
        size_t run = random_below(60);
        run = run < packed.size - at ? run : packed.size - at;
        png_chunk(&b, "IDAT", packed.data + at, run);
        at += run;
    }
    png_chunk(&b, "tIME", "\x07\xe8\1\1\0\0\0", 7);
    png_chunk(&b, "IEND", NULL, 0);
    buffer_free(&raw);
    buffer_free(&packed);
    return b;
}

static const struct { int type, depth; } png_kinds[15] = {
    {0, 1}, {0, 2}, {0, 4}, {0, 8}, {0, 16}, {2, 8}, {2, 16}, {3, 1}, {3, 2}, {3, 4}, {3, 8},
    {4, 8}, {4, 16}, {6, 8}, {6, 16},
};

static void check_png_kind(int width, int height, int kind, bool interlaced, bool has_transparency)
{
    int type = png_kinds[kind].type;
    struct sample_picture p = make_samples(width, height, png_kinds[kind].depth, type, interlaced,
                                           has_transparency && type < 4);
    struct buffer file = png_of_samples(&p);
    struct image want = expected_image(&p), got;
    struct failure f = {""};
    if (!CHECK(png_decode(file.data, file.size, &got, &f)))
        test_print(f.text);
    CHECK(same_pixels(&got, &want));
    image_free(&got);
    image_free(&want);
    buffer_free(&file);
    free(p.sample);
}

static void test_png_reads_every_colour_type_depth_interlace_and_filter(void)
{
    random_state = 6;
    for (int kind = 0; kind < 15; kind++)
        for (int flags = 0; flags < 4; flags++) {
            for (int width = 1; width <= 9; width++)
                for (int height = 1; height <= 9; height++)
                    check_png_kind(width, height, kind, (flags & 1) != 0, (flags & 2) != 0);
            check_png_kind(67, 41, kind, (flags & 1) != 0, (flags & 2) != 0);
        }
}

/* --- PNG: damage --- */

static bool png_is_refused(const struct buffer *file, const char *why)
{
    struct image got OWNED(image_free) = { 0 };
    struct failure f = {""};
    bool ok = png_decode(file->data, file->size, &got, &f);
    if (!ok && strstr(f.text, why) != NULL && got.rgba == NULL)
        return true;
    test_print(ok ? "accepted" : f.text);
    test_print("\n");
    return false;
}

static struct buffer small_png(int kind, bool interlaced)
{
    struct sample_picture p = make_samples(7, 5, png_kinds[kind].depth, png_kinds[kind].type,
                                           interlaced, png_kinds[kind].type < 4);
    struct buffer file = png_of_samples(&p);
    free(p.sample);
    return file;
}

static void test_png_notices_every_changed_byte_and_every_cut(void)
{
    random_state = 7;
    for (int kind = 0; kind < 15; kind++) {
        struct buffer file OWNED(buffer_free) = small_png(kind, kind % 2 == 0);
        struct image got OWNED(image_free);
        struct failure f;
        for (size_t i = 0; i < file.size; i++) {
            uint8_t flip = (uint8_t)(1 + random_below(255));
            file.data[i] ^= flip;
            f.text[0] = '\0';
            CHECK(!png_decode(file.data, file.size, &got, &f) && f.text[0] != '\0');
            CHECK(got.rgba == NULL);
            file.data[i] ^= flip;
        }
        for (size_t size = 0; size < file.size; size++) {
            f.text[0] = '\0';
            uint8_t *cut = malloc(size + (size == 0));  /* so that tools see reads behind the end */
            memcpy(cut, file.data, size);
            CHECK(!png_decode(cut, size, &got, &f) && f.text[0] != '\0');
            free(cut);
        }
        CHECK(png_decode(file.data, file.size, &got, &f));
    }
}

/* Sets the checksums of all chunks right that are whole. */
static void mend_checksums(struct buffer *file)
{
    size_t at = 8;
    while (file->size - at >= 12) {
        const uint8_t *p = file->data + at;
        size_t size = (size_t)p[0] << 24 | (size_t)p[1] << 16 | (size_t)p[2] << 8 | p[3];
        if (size > file->size - at - 12)
            return;
        uint32_t crc = crc32_update(0, p + 4, size + 4);
        for (int i = 0; i < 4; i++)
            file->data[at + 8 + size + (size_t)i] = (uint8_t)(crc >> (24 - i * 8));
        at += size + 12;
    }
}

static void test_png_survives_damage_under_right_checksums(void)
{
    int pictures = 0, errors = 0;
    random_state = 8;
    for (int round = 0; round < 6000; round++) {
        struct buffer file OWNED(buffer_free) = small_png(round % 15, round % 2 == 0);
        struct image got OWNED(image_free);
        struct failure f = {""};
        for (unsigned n = 1 + random_below(3); n > 0; n--)
            file.data[random_below((unsigned)file.size)] = (uint8_t)random_u32();
        mend_checksums(&file);
        bool ok = png_decode(file.data, file.size, &got, &f);
        pictures += ok;
        errors += !ok;
        CHECK(ok == (got.rgba != NULL) && ok == (f.text[0] == '\0'));
    }
    CHECK(pictures > 10 && errors > 1000);
}

static void test_png_knows_no_other_colour_types_and_depths(void)
{
    for (int type = 0; type < 9; type++)
        for (int depth = 0; depth < 20; depth++) {
            struct buffer file OWNED(buffer_free) = {0};
            bool known = false;
            for (int i = 0; i < 15; i++)
                known |= png_kinds[i].type == type && png_kinds[i].depth == depth;
            put_head(&file, 1, 1, depth, type, 0);
            CHECK(png_is_refused(&file, known ? "file ends early" : "does not exist"));
        }
}

static void test_png_refuses_sizes_that_are_zero_huge_or_a_lie(void)
{
    static const uint32_t wrong[][2] = {
        {0, 5}, {5, 0}, {16385, 1}, {1, 16385}, {0x80000001, 1}, {0xffffffff, 0xffffffff},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct buffer file OWNED(buffer_free) = {0};
        put_head(&file, wrong[i][0], wrong[i][1], 8, 2, 0);
        CHECK(png_is_refused(&file, "picture size"));
    }
    for (int interlace = 0; interlace < 2; interlace++) {
        struct buffer file OWNED(buffer_free) = {0};
        put_head(&file, 4096, 4096, 16, 6, interlace);
        put_idat(&file, (const uint8_t *)"0123456789", 10);
        png_chunk(&file, "IEND", NULL, 0);
        CHECK(png_is_refused(&file, "too small for its picture size"));
    }
}

/* A picture of one pixel of depth 8, its chunks given by letters. */
static struct buffer chunks_in_order(const char *order, int type)
{
    struct buffer file = {0};
    uint8_t raw[5] = {0, 1, 2, 3, 4};
    put_head(&file, 1, 1, 8, type, 0);
    size_t size = 1 + (size_t)(type == 2 ? 3 : type == 6 ? 4 : 1);
    size_t key_size = type == 0 ? 2 : type == 3 ? 1 : 6;
    for (; *order != '\0'; order++) {
        switch (*order) {
        case 'D': put_idat(&file, raw, size); break;
        case 's': put_idat(&file, raw, size - 1); break;        /* short */
        case 'l': put_idat(&file, raw, size + 1); break;        /* long */
        case 'f': put_idat(&file, (const uint8_t *)"\5\0\0\0", size); break;    /* filter 5 */
        case 'i': put_idat(&file, (const uint8_t *)"\0\3\0\0", size); break;    /* index 3 */
        case 'e': png_chunk(&file, "IDAT", NULL, 0); break;
        case 'a': png_chunk(&file, "anCi", "x", 1); break;
        case 'X': png_chunk(&file, "ABCD", "x", 1); break;
        case 'n': png_chunk(&file, "A1CD", "x", 1); break;
        case 'H': png_chunk(&file, "IHDR", "0123456789abc", 13); break;
        case 'P': png_chunk(&file, "PLTE", "abcdef", 6); break;
        case '4': png_chunk(&file, "PLTE", "abcd", 4); break;
        case '0': png_chunk(&file, "PLTE", NULL, 0); break;
        case 'T': png_chunk(&file, "tRNS", "\0\0\0\0\0\0", key_size); break;
        case '5': png_chunk(&file, "tRNS", "\0\0\0\0\0", 5); break;
        case 'E': png_chunk(&file, "IEND", NULL, 0); break;
        default: break;
        }
    }
    return file;
}

static void test_png_refuses_chunks_that_are_missing_misplaced_or_malformed(void)
{
    static const struct { int type; const char *order, *why; } cases[] = {
        {0, "E", "no pixels"},
        {0, "D", "ends early"},
        {3, "DE", "palette is missing"},
        {0, "PDE", "grey picture has a palette"},
        {4, "PDE", "grey picture has a palette"},
        {3, "PPDE", "two PLTE"},
        {2, "DPE", "PLTE after IDAT"},
        {3, "4DE", "wrong size"},
        {3, "0DE", "wrong size"},
        {3, "TPDE", "more entries"},
        {3, "P5DE", "more entries"},
        {6, "TDE", "alpha has a transparent"},
        {2, "5DE", "wrong size"},
        {0, "TTDE", "misplaced"},
        {0, "DTE", "misplaced"},
        {0, "eaDE", "not consecutive"},
        {0, "XDE", "critical chunk (ABCD)"},
        {0, "DXE", "critical"},
        {0, "nDE", "name of a chunk"},
        {0, "HDE", "critical chunk (IHDR)"},
        {0, "sE", "pixels are missing"},
        {0, "lE", "longer than expected"},
        {0, "fE", "filter type 5"},
        {3, "PiE", "not in the palette"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct buffer file OWNED(buffer_free) = chunks_in_order(cases[i].order, cases[i].type);
        if (!CHECK(png_is_refused(&file, cases[i].why)))
            test_print(cases[i].order);
    }
    struct buffer file = {0};
    buffer_append(&file, "\x89PNG\r\n\x1a\n", 8);
    png_chunk(&file, "IEND", NULL, 0);
    CHECK(png_is_refused(&file, "no IHDR"));
    buffer_free(&file);
    static const int methods[3] = {26, 27, 28};         /* compression, filter, interlace */
    for (int i = 0; i < 3; i++) {
        file = chunks_in_order("DE", 0);
        file.data[methods[i]] = 2;
        mend_checksums(&file);
        CHECK(png_is_refused(&file, "unknown compression, filter or interlace"));
        buffer_free(&file);
    }
}

static void test_png_skips_what_a_picture_does_not_need(void)
{
    static const struct { int type; const char *order; } cases[] = {
        {0, "aTaDaE"}, {2, "PTDE"}, {6, "PDaE"}, {0, "eDeE"}, {0, "DEXXDn"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct buffer file OWNED(buffer_free) = chunks_in_order(cases[i].order, cases[i].type);
        struct image got OWNED(image_free);
        struct failure f = {""};
        CHECK(png_decode(file.data, file.size, &got, &f));
        CHECK(got.rgba != NULL && got.rgba[0] == 1);
    }
}

/* --- PNG: what we write --- */

struct second_png {
    const uint8_t *next, *end;
    bool ok;
};

/* The next chunk's name, data and size; marks the reader when a checksum is wrong. */
static const uint8_t *second_chunk(struct second_png *r, char name[5], size_t *size)
{
    const uint8_t *p = r->next;
    memcpy(name, "none", 5);
    *size = 0;
    if (!r->ok || r->end - p < 12) {
        r->ok = false;
        return NULL;
    }
    *size = (size_t)p[0] << 24 | (size_t)p[1] << 16 | (size_t)p[2] << 8 | p[3];
    r->ok = *size <= (size_t)(r->end - p) - 12;
    if (!r->ok)
        return NULL;
    memcpy(name, p + 4, 4);
    uint32_t crc = crc32_update(0, p + 4, *size + 4);
    for (size_t i = 0; i < 4; i++)
        r->ok = r->ok && p[8 + *size + i] == (crc >> (24 - i * 8) & 255);
    r->next = p + 12 + *size;
    return p + 8;
}

static uint32_t big32(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

/* RGB or RGBA pixels of a compressed rectangle into the picture, read as a PNG of its own. */
static bool second_pixels(const uint8_t *packed, size_t size, int channels, struct image *to,
                          int left, int top, int width, int height)
{
    struct buffer file OWNED(buffer_free) = {0};
    struct image got OWNED(image_free) = {0};
    struct failure f = {""};
    put_head(&file, (uint32_t)width, (uint32_t)height, 8, channels == 3 ? 2 : 6, 0);
    png_chunk(&file, "IDAT", packed, size);
    png_chunk(&file, "IEND", NULL, 0);
    if (left + width > to->width || top + height > to->height || !png_decode(file.data, file.size, &got, &f))
        return false;
    for (int y = 0; y < height; y++)
        memcpy(pixel(to, left, top + y), pixel(&got, 0, y), (size_t)width * 4);
    return true;
}

static bool has_signature(const uint8_t *bytes, size_t size)
{
    return size > 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0;
}

/* Encodes; the decoder must give the picture back. */
static size_t check_png_round_trip(const struct image *image, int channels)
{
    uint8_t *bytes;
    size_t size;
    struct failure f = {""};
    struct image got OWNED(image_free) = { 0 };
    CHECK(png_encode(image, &bytes, &size, &f));
    CHECK(png_decode(bytes, size, &got, &f) && same_pixels(&got, image));
    CHECK_EQ(bytes[25], channels == 3 ? 2 : 6);
    free(bytes);
    return size;
}

static void test_png_round_trips_pictures_of_all_shapes(void)
{
    static const int sizes[][2] = {{1, 1}, {1, 40}, {40, 1}, {2, 3}, {17, 31}, {128, 96}, {701, 3}};
    random_state = 9;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        int width = sizes[i][0], height = sizes[i][1];
        struct image pictures[4] = {
            noise_image(width, height, false), noise_image(width, height, true),
            smooth_image(width, height, 3), make_image(width, height),
        };
        pictures[1].rgba[3] = 7;
        for (int k = 0; k < 4; k++) {
            check_png_round_trip(&pictures[k], k == 1 ? 4 : 3);
            image_free(&pictures[k]);
        }
    }
}

/* zlib at level 6 with the same filters gives 10995 and 853 bytes; 10 % more are allowed. */
static void test_png_is_small(void)
{
    struct image smooth OWNED(image_free) = smooth_image(320, 240, 0), flat = make_image(320, 240);
    for (int i = 0; i < 320 * 240; i++)
        if ((i / 40 + i / 9600) % 2 == 0)
            memcpy(flat.rgba + i * 4, "\x20\x80\xc0", 3);
    CHECK(check_png_round_trip(&smooth, 3) <= 10995 * 11 / 10);
    CHECK(check_png_round_trip(&flat, 3) <= 853 * 11 / 10);
    image_free(&flat);
}

/* --- PPM and PFM --- */

static bool ppm_gives(const char *text, size_t size, int width, int height, const char *rgb)
{
    struct image got OWNED(image_free) = { 0 };
    struct failure f = {""};
    if (!ppm_decode((const uint8_t *)text, size, &got, &f)) {
        test_print(f.text);
        return false;
    }
    bool ok = got.width == width && got.height == height;
    for (int i = 0; ok && i < width * height; i++)
        ok = memcmp(got.rgba + i * 4, rgb + i * 3, 3) == 0 && got.rgba[i * 4 + 3] == 255;
    return ok;
}

#define TEXT(literal) literal, sizeof literal - 1       /* with its zeros, without the last */

static void test_ppm_reads_text_and_binary_of_every_depth(void)
{
    CHECK(ppm_gives(TEXT("P3 2 1 255 1 2 3 255 254 253"), 2, 1, "\1\2\3\xff\xfe\xfd"));
    CHECK(ppm_gives(TEXT("P3\n#by hand\n2\t1 # size\r\n4\n0 1 2 #\n3 4 4\n"), 2, 1,
                    "\0\x40\x80\xbf\xff\xff"));
    CHECK(ppm_gives(TEXT("P2 1 3\n1\n0 1 0"), 1, 3, "\0\0\0\xff\xff\xff\0\0\0"));
    CHECK(ppm_gives(TEXT("P2 2 1 65535 128 129"), 2, 1, "\0\0\0\1\1\1"));
    CHECK(ppm_gives(TEXT("P5#c\n3 1#\n255\nabc"), 3, 1, "aaabbbccc"));
    CHECK(ppm_gives(TEXT("P5 1 2 1000\n\x01\xf4\x03\xe8"), 1, 2, "\x80\x80\x80\xff\xff\xff"));
    CHECK(ppm_gives(TEXT("P6 1 1 255\n\n#\t"), 1, 1, "\n#\t"));
    CHECK(ppm_gives(TEXT("P6 1 1 65535 \xff\xff\x80\x80\x00\x00"), 1, 1, "\xff\x80\0"));
    CHECK(ppm_gives(TEXT("P6 1 1 15\n\x0f\x05\0P6 a second picture"), 1, 1, "\xff\x55\0"));
}

static void test_ppm_refuses_what_is_not_a_picture(void)
{
    static const struct { const char *text; size_t size; const char *why; } cases[] = {
        {TEXT(""), "not a PPM"},
        {TEXT("P6"), "not a PPM"},
        {TEXT("P4 1 1 x"), "not a PPM"},
        {TEXT("P61 1 255 abc"), "not a PPM"},
        {TEXT("P6 1"), "header"},
        {TEXT("P6 x 1 255 abc"), "header"},
        {TEXT("P6 -1 1 255 abc"), "header"},
        {TEXT("P6 1234567 1 255 abc"), "header"},
        {TEXT("P6 0 1 255 abc"), "picture size"},
        {TEXT("P6 1 16385 255 abc"), "picture size"},
        {TEXT("P6 1 1 0 abc"), "largest value"},
        {TEXT("P6 1 1 65536 abcdef"), "largest value"},
        {TEXT("P6 1 1 255"), "after the header"},
        {TEXT("P6 1 1 255#\nabc"), "after the header"},
        {TEXT("P6 1 1 255 ab"), "ends early"},
        {TEXT("P6 1 1 256 abcde"), "ends early"},
        {TEXT("P6 4096 4096 255 abc"), "ends early"},
        {TEXT("P3 4096 4096 9 1 2 3"), "ends early"},
        {TEXT("P3 1 1 9 1 2"), "ends early"},
        {TEXT("P3 1 1 9 1 2    "), "sample"},
        {TEXT("P3 1 1 9 1 2 x"), "sample"},
        {TEXT("P3 1 1 9 1 2 10"), "sample"},
        {TEXT("P3 1 1 9 1 2 3x"), "sample"},
        {TEXT("P6 1 1 100 \1\2\xff"), "sample"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct image got;
        struct failure f = {""};
        uint8_t *copy = malloc(cases[i].size + 1);
        memcpy(copy, cases[i].text, cases[i].size);
        CHECK(!ppm_decode(copy, cases[i].size, &got, &f) && got.rgba == NULL);
        if (!CHECK(strstr(f.text, cases[i].why) != NULL))
            test_print(f.text);
        free(copy);
    }
}

static void test_ppm_round_trips_colours_and_drops_alpha(void)
{
    random_state = 10;
    struct image image OWNED(image_free) = noise_image(33, 21, true), got;
    struct failure f = {""};
    uint8_t *bytes;
    size_t size;
    CHECK(ppm_encode(&image, &bytes, &size, &f));
    CHECK(size == 13 + 33 * 21 * 3);
    for (size_t cut = 0; cut < size; cut++) {
        struct failure g = {""};
        CHECK(!ppm_decode(bytes, cut, &got, &g));
    }
    CHECK(ppm_decode(bytes, size, &got, &f));
    for (int i = 0; i < 33 * 21; i++)
        image.rgba[i * 4 + 3] = 255;
    CHECK(same_pixels(&image, &got));
    image_free(&got);
    free(bytes);
}

static void test_pfm_reads_both_byte_orders_bottom_row_first(void)
{
    static const char little[] = "Pf\n1 2\n-1.0\n\0\0\x80\x3f\0\0\x20\xc0";
    static const char big[] = "PF 1 1 2.5e0\n\x3f\x80\0\0\xc0\x20\0\0\x7f\x80\0\0";
    struct float_image got;
    struct failure f = {""};
    CHECK(pfm_decode((const uint8_t *)little, sizeof little - 1, &got, &f));
    CHECK(got.width == 1 && got.height == 2 && got.channels == 1);
    CHECK(got.value[0] == -2.5f && got.value[1] == 1.0f);
    float_image_free(&got);
    CHECK(pfm_decode((const uint8_t *)big, sizeof big - 1, &got, &f));
    CHECK(got.width == 1 && got.height == 1 && got.channels == 3);
    CHECK(got.value[0] == 1.0f && got.value[1] == -2.5f && got.value[2] > 1e38f);
    float_image_free(&got);
}

static void test_pfm_round_trips_every_bit_pattern(void)
{
    random_state = 11;
    for (int channels = 1; channels <= 3; channels += 2) {
        struct float_image image OWNED(float_image_free), got;
        struct failure f = {""};
        uint8_t *bytes;
        size_t size, values = (size_t)(13 * 9 * channels);
        CHECK(float_image_alloc(&image, 13, 9, channels, &f));
        for (size_t i = 0; i < values; i++) {
            uint32_t bits = i == 0 ? 0x7f800000 : i == 1 ? 0x80000000 : random_u32();
            if ((bits & 0x7f800000) == 0x7f800000 && i > 0)
                bits |= 0x400000;               /* a quiet NaN */
            memcpy(&image.value[i], &bits, 4);
        }
        CHECK(pfm_encode(&image, &bytes, &size, &f));
        const char *header = channels == 3 ? "PF\n13 9\n-1.0\n" : "Pf\n13 9\n-1.0\n";
        CHECK(size == 13 + values * 4 && memcmp(bytes, header, 13) == 0);
        for (size_t cut = 0; cut < size; cut++) {
            struct failure g = {""};
            CHECK(!pfm_decode(bytes, cut, &got, &g) && got.value == NULL);
        }
        CHECK(pfm_decode(bytes, size, &got, &f) && got.channels == channels);
        CHECK(memcmp(got.value, image.value, values * 4) == 0);
        float_image_free(&got);
        free(bytes);
    }
}

static void test_pfm_refuses_what_is_not_a_picture(void)
{
    static const struct { const char *text; size_t size; const char *why; } cases[] = {
        {TEXT("P6\n1 1\n255\nabcd"), "not a PFM"},
        {TEXT("Pf"), "not a PFM"},
        {TEXT("PfX1 1 -1\nabcd"), "not a PFM"},
        {TEXT("Pf\n1"), "header"},
        {TEXT("Pf\n-1 1 -1\nabcd"), "header"},
        {TEXT("Pf\n1 1x -1\nabcd"), "header"},
        {TEXT("Pf\n1 9999999999 -1\nabcd"), "header"},
        {TEXT("Pf\n0 1 -1\nabcd"), "picture size"},
        {TEXT("Pf\n16385 1 -1\nabcd"), "picture size"},
        {TEXT("Pf\n1 1 0.0\nabcd"), "scale"},
        {TEXT("Pf\n1 1 nan\nabcd"), "scale"},
        {TEXT("Pf\n1 1 1x\nabcd"), "scale"},
        {TEXT("Pf\n1 1 -1"), "after the header"},
        {TEXT("Pf\n1 1 -1\nabc"), "ends early"},
        {TEXT("PF\n4096 4096 -1\nabcdefghijkl"), "ends early"},
        {TEXT("Pf\n1 1 -1.000000000000000000000000000000000000\nabcd"), "header"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct float_image got;
        struct failure f = {""};
        uint8_t *copy = malloc(cases[i].size);
        memcpy(copy, cases[i].text, cases[i].size);
        CHECK(!pfm_decode(copy, cases[i].size, &got, &f) && got.value == NULL);
        if (!CHECK(strstr(f.text, cases[i].why) != NULL))
            test_print(f.text);
        free(copy);
    }
}

/* --- pictures in memory and whole files --- */

static void test_pictures_start_opaque_black_or_zero_and_have_sane_sizes(void)
{
    struct image image;
    struct float_image floats;
    struct failure f = {""};
    CHECK(image_alloc(&image, 3, 2, &f));
    for (int i = 0; i < 24; i++)
        CHECK_EQ(image.rgba[i], i % 4 == 3 ? 255 : 0);
    image_free(&image);
    CHECK(image.rgba == NULL && image.width == 0);
    CHECK(float_image_alloc(&floats, 3, 2, 3, &f));
    for (int i = 0; i < 18; i++)
        CHECK(floats.value[i] == 0);
    float_image_free(&floats);
    static const int wrong[][2] = {{0, 1}, {1, 0}, {-1, 5}, {16385, 1}, {1, 16385}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        CHECK(!image_alloc(&image, wrong[i][0], wrong[i][1], &f) && image.rgba == NULL);
        CHECK(!float_image_alloc(&floats, wrong[i][0], wrong[i][1], 1, &f) && floats.value == NULL);
    }
    CHECK(!float_image_alloc(&floats, 1, 1, 2, &f));
}

static void test_files_round_trip_and_end_in_a_zero(void)
{
    static uint8_t data[200000];
    const char *path = scratch("test_image.bin");
    struct failure f = {""};
    uint8_t *back;
    size_t size;
    random_state = 12;
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (uint8_t)random_u32();
    static const size_t sizes[] = {0, 1, 65535, 65536, 131071, sizeof data};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        CHECK(file_write(path, data, sizes[i], &f));
        CHECK(!is_temporary_left(path));
        CHECK(file_read(path, sizes[i], &back, &size, &f));
        CHECK(size == sizes[i] && memcmp(back, data, size) == 0 && back[size] == 0);
        free(back);
        if (sizes[i] > 0) {
            struct failure g = {""};
            CHECK(!file_read(path, sizes[i] - 1, &back, &size, &g) && back == NULL);
            CHECK(strstr(g.text, "too large") != NULL);
        }
    }
    remove(path);
}

static void test_files_that_cannot_be_read_or_written_leave_nothing(void)
{
    const char *path = scratch("no such folder/file");
    struct failure f = {""}, g = {""}, h = {""};
    uint8_t *bytes;
    size_t size;
    CHECK(!file_read(path, 100, &bytes, &size, &f) && bytes == NULL);
    CHECK(strstr(f.text, "cannot be opened") != NULL);
    CHECK(!file_write(path, (const uint8_t *)"x", 1, &g));
    CHECK(strstr(g.text, "cannot be written") != NULL);
    CHECK(gif_begin(path, 4, 4, &h) == NULL && strstr(h.text, "cannot be written") != NULL);
    CHECK(!file_read(".", 100, &bytes, &size, &h) && bytes == NULL);
}

static void test_pictures_are_saved_and_loaded_by_content(void)
{
    const char *path = scratch("test_image.xyz");
    struct failure f = {""}, g = {""};
    random_state = 13;
    struct image image = noise_image(9, 8, false), got;
    CHECK(png_save(path, &image, &f) && image_load(path, &got, &f) && same_pixels(&image, &got));
    image_free(&got);
    CHECK(ppm_save(path, &image, &f) && image_load(path, &got, &f) && same_pixels(&image, &got));
    image_free(&got);
    struct float_image floats;
    CHECK(float_image_alloc(&floats, 2, 2, 1, &f) && pfm_save(path, &floats, &f));
    CHECK(!image_load(path, &got, &g) && strstr(g.text, "neither PNG nor PPM") != NULL);
    float_image_free(&floats);
    image_free(&image);
    remove(path);
    struct failure h = {""};
    CHECK(!png_save(path, &image, &h) && !exists(path));        /* an empty picture */
}

static void test_difference_is_scaled_and_clamped_per_channel(void)
{
    struct image a OWNED(image_free) = make_image(2, 1), b = make_image(2, 1), out;
    struct failure f = {""};
    memcpy(a.rgba, "\x0a\x00\xff\x05\x64\x64\x64\xff", 8);
    memcpy(b.rgba, "\x00\x0a\x00\xff\x64\x63\x5a\xff", 8);
    CHECK(image_difference(&a, &b, 8, &out, &f));
    CHECK(memcmp(out.rgba, "\x50\x50\xff\xff\x00\x08\x50\xff", 8) == 0);
    image_free(&out);
    CHECK(image_difference(&a, &b, INT32_MAX, &out, &f) && out.rgba[0] == 255 && out.rgba[4] == 0);
    image_free(&out);
    CHECK(!image_difference(&a, &b, -1, &out, &f) && out.rgba == NULL);
    image_free(&b);
    CHECK(!image_difference(&a, &b, 1, &out, &f));
    b = make_image(1, 2);
    CHECK(!image_difference(&a, &b, 1, &out, &f));
    image_free(&b);
}

/* --- animations: decoders --- */

enum { MAX_FRAMES = 24 };

struct movie {
    bool ok;
    int width, height, frames;
    struct image frame[MAX_FRAMES];     /* as shown */
    int left[MAX_FRAMES], top[MAX_FRAMES], columns[MAX_FRAMES], rows[MAX_FRAMES];
    int delay[MAX_FRAMES];              /* GIF: 10 ms, APNG: 1 ms */
    int entries[MAX_FRAMES];            /* of the palette */
    int channels;                       /* APNG */
};

static void free_movie(struct movie *m)
{
    for (int i = 0; i < m->frames; i++)
        image_free(&m->frame[i]);
}

struct byte_reader {
    const uint8_t *next, *end;
    bool ok;
};

static unsigned get8(struct byte_reader *r)
{
    if (r->next == r->end) {
        r->ok = false;
        return 0;
    }
    return *r->next++;
}

static unsigned get16(struct byte_reader *r)
{
    unsigned low = get8(r);
    return low | get8(r) << 8;
}

static void expect(struct byte_reader *r, const char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++)
        r->ok = get8(r) == (uint8_t)bytes[i] && r->ok;
}

/* Image data of exactly `count` pixels. */
static void gif_pixels(struct byte_reader *r, uint8_t *index, size_t count)
{
    static uint16_t prefix[4096];
    static uint8_t suffix[4096], reversed[4097];
    struct buffer data = {0};
    unsigned symbol_bits = get8(r);
    for (unsigned run = get8(r); run != 0 && r->ok; run = get8(r))
        for (; run > 0; run--)
            buffer_byte(&data, get8(r));
    r->ok = r->ok && symbol_bits >= 2 && symbol_bits <= 8;
    unsigned clear = 1u << symbol_bits, next = clear + 2, bits = symbol_bits + 1, last = 4096;
    size_t at = 0, bit = 0;
    bool started = false, ended = false;
    while (r->ok && !ended) {
        unsigned code = 0;
        for (unsigned i = 0; i < bits && r->ok; i++, bit++) {
            r->ok = bit / 8 < data.size;
            code |= r->ok ? ((unsigned)data.data[bit / 8] >> bit % 8 & 1) << i : 0;
        }
        if (!started && code != clear)
            r->ok = false;              /* nothing requires it, but every decoder likes it */
        started = true;
        if (code == clear) {
            next = clear + 2;
            bits = symbol_bits + 1;
            last = 4096;
            continue;
        }
        if (code == clear + 1) {
            ended = true;
            continue;
        }
        if (last == 4096 ? code >= clear : code > next || (code == next && next == 4096)) {
            r->ok = false;
            continue;
        }
        size_t length = 0;
        unsigned walk = code == next ? last : code;
        if (code == next)
            length = 1;                 /* the string before plus its own first pixel, set below */
        while (walk >= clear) {
            reversed[length++] = suffix[walk];
            walk = prefix[walk];
        }
        reversed[length++] = (uint8_t)walk;
        if (code == next)
            reversed[0] = (uint8_t)walk;
        r->ok = length <= count - at;
        while (r->ok && length > 0)
            index[at++] = reversed[--length];
        if (last != 4096 && next < 4096) {
            prefix[next] = (uint16_t)last;
            suffix[next++] = (uint8_t)walk;
            if (next == 1u << bits && bits < 12)
                bits++;
        }
        last = code;
    }
    r->ok = r->ok && at == count && (bit + 7) / 8 == data.size;
    buffer_free(&data);
}

static void gif_frame(struct byte_reader *r, struct movie *m)
{
    int n = m->frames;
    expect(r, "\x21\xf9\4", 3);
    unsigned flags = get8(r);
    m->delay[n] = (int)get16(r);
    unsigned transparent = get8(r);
    expect(r, "\0\x2c", 2);
    m->left[n] = (int)get16(r);
    m->top[n] = (int)get16(r);
    m->columns[n] = (int)get16(r);
    m->rows[n] = (int)get16(r);
    unsigned palette_flags = get8(r), entries = 2u << (palette_flags & 7);
    uint8_t palette[256][3];
    for (unsigned i = 0; i < entries * 3; i++)
        palette[i / 3][i % 3] = (uint8_t)get8(r);
    m->entries[n] = (int)entries;
    r->ok = r->ok && (flags & 0xfe) == 4 && (palette_flags & 0xf8) == 0x80 && m->columns[n] > 0 &&
            m->rows[n] > 0 && m->left[n] + m->columns[n] <= m->width &&
            m->top[n] + m->rows[n] <= m->height;
    if (!r->ok)
        return;
    m->frame[n] = n > 0 ? copy_image(&m->frame[n - 1]) : make_image(m->width, m->height);
    m->frames++;
    size_t count = (size_t)m->columns[n] * (size_t)m->rows[n];
    uint8_t *index = malloc(count);
    gif_pixels(r, index, count);
    for (size_t i = 0; r->ok && i < count; i++) {
        if ((flags & 1) != 0 && index[i] == transparent)
            continue;
        r->ok = index[i] < entries;
        if (r->ok)
            memcpy(pixel(&m->frame[n], m->left[n] + (int)i % m->columns[n],
                         m->top[n] + (int)i / m->columns[n]), palette[index[i]], 3);
    }
    free(index);
}

static struct movie read_gif(const struct buffer *file)
{
    struct movie m = {0};
    struct byte_reader r = {file->data, file->data + file->size, true};
    expect(&r, "GIF89a", 6);
    m.width = (int)get16(&r);
    m.height = (int)get16(&r);
    expect(&r, "\x70\0\0\x21\xff\x0bNETSCAPE2.0\3\1\0\0\0", 22);
    while (r.ok && m.frames < MAX_FRAMES && r.next < r.end && *r.next == 0x21)
        gif_frame(&r, &m);
    expect(&r, ";", 1);
    m.ok = r.ok && r.next == r.end;
    return m;
}

static struct movie read_apng(const struct buffer *file)
{
    struct movie m = {0};
    struct second_png r = {file->data + 8, file->data + file->size,
                            has_signature(file->data, file->size)};
    char name[5];
    size_t size;
    const uint8_t *p = second_chunk(&r, name, &size);
    if (!r.ok || strcmp(name, "IHDR") != 0 || size != 13)
        return m;
    m.width = (int)big32(p);
    m.height = (int)big32(p + 4);
    m.channels = p[9] == 2 ? 3 : p[9] == 6 ? 4 : 0;
    bool ok = p[8] == 8 && m.channels != 0 && p[12] == 0;
    p = second_chunk(&r, name, &size);
    if (!ok || !r.ok || strcmp(name, "acTL") != 0 || size != 8 || big32(p + 4) != 0)
        return m;
    uint32_t frames = big32(p), sequence = 0;
    for (int n = 0; r.ok && ok && n < (int)frames && n < MAX_FRAMES; n++) {
        p = second_chunk(&r, name, &size);
        ok = r.ok && strcmp(name, "fcTL") == 0 && size == 26 && big32(p) == sequence++ &&
             p[24] == 0 && p[25] == 0;
        if (!ok)
            break;
        m.columns[n] = (int)big32(p + 4);
        m.rows[n] = (int)big32(p + 8);
        m.left[n] = (int)big32(p + 12);
        m.top[n] = (int)big32(p + 16);
        int unit = p[22] << 8 | p[23];
        m.delay[n] = unit > 0 ? (p[20] << 8 | p[21]) * 1000 / unit : -1;
        m.frame[n] = n > 0 ? copy_image(&m.frame[n - 1]) : make_image(m.width, m.height);
        m.frames++;
        p = second_chunk(&r, name, &size);
        size_t skip = n == 0 ? 0 : 4;
        ok = r.ok && strcmp(name, n == 0 ? "IDAT" : "fdAT") == 0 && size > skip &&
             (n == 0 || big32(p) == sequence++) &&
             second_pixels(p + skip, size - skip, m.channels, &m.frame[n], m.left[n], m.top[n],
                           m.columns[n], m.rows[n]);
    }
    second_chunk(&r, name, &size);
    m.ok = ok && r.ok && strcmp(name, "IEND") == 0 && r.next == r.end && m.frames == (int)frames;
    return m;
}

/* Writes frames with 40 ms each and reads them back; frames are numbered from 0. */
static struct movie write_movie(bool is_gif, const struct image *frames, int count)
{
    const char *path = scratch(is_gif ? "test_image.gif" : "test_image.apng");
    struct failure f = {""};
    struct animation_writer *w = (is_gif ? gif_begin : apng_begin)(path, frames[0].width,
                                                                   frames[0].height, &f);
    if (!CHECK(w != NULL))
        return (struct movie){0};
    for (int i = 0; i < count; i++)
        CHECK(animation_add(w, &frames[i], 40, &f));
    CHECK(!exists(path));
    CHECK(animation_end(w, &f));
    CHECK(!is_temporary_left(path));
    struct buffer file = take_file(path);
    struct movie m = is_gif ? read_gif(&file) : read_apng(&file);
    CHECK(m.ok);
    CHECK(m.frames == count && m.width == frames[0].width && m.height == frames[0].height);
    buffer_free(&file);
    return m;
}

/* A few pixels of another picture. */
static void scribble(struct image *image, int left, int top, int width, int height)
{
    for (int y = top; y < top + height; y++)
        for (int x = left; x < left + width; x++)
            for (int k = 0; k < 3; k++)
                pixel(image, x, y)[k] = (uint8_t)(random_below(4) * 85);
}

/* --- animations: tests --- */

static double mean_square(const struct image *a, const struct image *b)
{
    double sum = 0;
    for (int i = 0; i < a->width * a->height * 4; i++)
        sum += (a->rgba[i] - b->rgba[i]) * (a->rgba[i] - b->rgba[i]);
    return sum / (3.0 * a->width * a->height);
}

static void test_gif_is_exact_for_up_to_256_colours(void)
{
    static const int colors[] = {1, 2, 3, 4, 5, 16, 17, 128, 255, 256};
    random_state = 14;
    for (size_t c = 0; c < sizeof colors / sizeof colors[0]; c++) {
        struct image frames[3];
        for (int n = 0; n < 3; n++) {           /* other colours in each frame */
            uint32_t base = random_u32();
            frames[n] = make_image(83, 61);
            for (int i = 0; i < 83 * 61; i++) {
                unsigned which = i < colors[c] ? (unsigned)i : random_below((unsigned)colors[c]);
                uint32_t color = base + which * 40503u;
                for (int k = 0; k < 3; k++)
                    frames[n].rgba[i * 4 + k] = (uint8_t)(color >> (8 * k));
            }
        }
        struct movie m = write_movie(true, frames, 3);
        for (int n = 0; n < m.frames; n++) {
            /* With all 256 colours a frame that leaves pixels alone has no entry for transparency. */
            if (n == 0 || colors[c] < 256)
                CHECK(same_pixels(&m.frame[n], &frames[n]));
            CHECK(m.delay[n] == 4);
        }
        if (m.frames == 3)
            CHECK(m.entries[0] >= colors[c] && (m.entries[0] < 2 * colors[c] || m.entries[0] == 2));
        free_movie(&m);
        for (int n = 0; n < 3; n++)
            image_free(&frames[n]);
    }
}

/* Rows of every length, so that the data ends at every width of its codes. */
static void test_gif_ends_its_data_at_any_length(void)
{
    random_state = 18;
    for (int colors = 2; colors <= 256; colors *= 2)
        for (int width = 1; width <= 560; width += width < 300 || colors == 256 ? 1 : 37) {
            const char *path = scratch("test_image.gif");
            struct image image OWNED(image_free) = make_image(width, 1);
            struct failure f = {""};
            for (int i = 0; i < width * 4; i += 4)
                image.rgba[i] = (uint8_t)random_below((unsigned)colors);
            struct animation_writer *w = gif_begin(path, width, 1, &f);
            CHECK(animation_add(w, &image, 40, &f) && animation_end(w, &f));
            struct buffer file OWNED(buffer_free) = take_file(path);
            struct movie m OWNED(free_movie) = read_gif(&file);
            CHECK(m.ok && m.frames == 1 && same_pixels(&m.frame[0], &image));
        }
}

static void test_gif_has_room_for_transparency_beside_256_new_colours(void)
{
    struct image frames[2] = {make_image(20, 20), make_image(20, 20)};
    for (int i = 0; i < 256; i++)
        memcpy(frames[1].rgba + (i + i / 20 + 1) * 4, (uint8_t[]){(uint8_t)i, 1, 200}, 3);
    struct movie m = write_movie(true, frames, 2);
    if (m.ok) {
        CHECK(mean_square(&m.frame[1], &frames[1]) < 1);
        CHECK_EQ(m.entries[1], 256);
        for (int i = 0; i <= 12; i++)           /* the pixels left out */
            CHECK(memcmp(m.frame[1].rgba + i * 21 * 4, "\0\0\0", 3) == 0);
    }
    free_movie(&m);
    image_free(&frames[0]);
    image_free(&frames[1]);
}

static void check_rectangle(const struct movie *m, int n, int left, int top, int columns, int rows)
{
    CHECK(m->left[n] == left && m->top[n] == top && m->columns[n] == columns && m->rows[n] == rows);
}

static void test_animations_hold_only_the_rectangle_that_changes(void)
{
    for (int is_gif = 0; is_gif < 2; is_gif++) {
        struct image frames[6];
        random_state = 15;
        frames[0] = make_image(50, 40);
        scribble(&frames[0], 0, 0, 50, 40);
        for (int n = 1; n < 6; n++)
            frames[n] = copy_image(&frames[n - 1]);
        for (int n = 1; n < 6; n++)             /* frame 1 is like frame 0 */
            for (int k = n; k < 6; k++) {
                if (n >= 2)
                    pixel(&frames[k], 7, 5)[1] = (uint8_t)n;
                if (n >= 3)
                    pixel(&frames[k], 20, 30)[1] = (uint8_t)n;
                if (n == 4)
                    pixel(&frames[k], 49, 39)[0] = 1;
                if (n == 5)
                    pixel(&frames[k], 0, 0)[0] = 1;
            }
        struct movie m = write_movie(is_gif != 0, frames, 6);
        for (int n = 0; n < m.frames; n++)
            CHECK(same_pixels(&m.frame[n], &frames[n]));
        if (m.frames == 6) {
            check_rectangle(&m, 0, 0, 0, 50, 40);
            check_rectangle(&m, 1, 0, 0, 1, 1);
            check_rectangle(&m, 2, 7, 5, 1, 1);
            check_rectangle(&m, 3, 7, 5, 14, 26);
            check_rectangle(&m, 4, 7, 5, 43, 35);
            check_rectangle(&m, 5, 0, 0, 21, 31);
        }
        free_movie(&m);
        for (int n = 0; n < 6; n++)
            image_free(&frames[n]);
    }
}

/* Mean square difference of the means of blocks of 8 x 8, the size of the dither's pattern. */
static double block_error(const struct image *a, const struct image *b)
{
    double total = 0;
    int blocks = 0;
    for (int top = 0; top + 8 <= a->height; top += 8)
        for (int left = 0; left + 8 <= a->width; left += 8, blocks++)
            for (int k = 0; k < 3; k++) {
                int sum = 0;
                for (int i = 0; i < 64; i++) {
                    int x = left + i % 8, y = top + i / 8;
                    sum += pixel(a, x, y)[k] - pixel(b, x, y)[k];
                }
                total += sum / 64.0 * (sum / 64.0) / 3;
            }
    return total / blocks;
}

static void test_gif_dithers_smooth_pictures_close_to_the_original(void)
{
    struct image ramp OWNED(image_free) = make_image(256, 192);   /* grey to colour: 6000 colours of few hues */
    for (int y = 0; y < 192; y++)
        for (int x = 0; x < 256; x++) {
            pixel(&ramp, x, y)[0] = (uint8_t)x;
            pixel(&ramp, x, y)[1] = (uint8_t)(x * (255 - y) / 255);
            pixel(&ramp, x, y)[2] = (uint8_t)(x / 2 + y / 4);
        }
    struct movie m OWNED(free_movie) = write_movie(true, &ramp, 1);
    if (m.ok) {
        CHECK(mean_square(&m.frame[0], &ramp) < 4.2 * 4.2);
        CHECK(block_error(&m.frame[0], &ramp) < 1.2);   /* without dither 2.2 */
    }
}

static void test_gif_leaves_unchanged_pixels_of_dithered_frames_alone(void)
{
    struct image frames[8];
    random_state = 16;
    for (int n = 0; n < 8; n++) {               /* a window on something that moves */
        frames[n] = smooth_image(160, 120, 0);
        struct image other OWNED(image_free) = smooth_image(160, 120, 37 * n);
        for (int y = 30; y < 90; y++)
            memcpy(pixel(&frames[n], 40, y), pixel(&other, 40, y), 4 * 80);
    }
    struct movie m = write_movie(true, frames, 8);
    for (int n = 1; n < m.frames; n++) {
        int flickering = 0;
        for (int i = 0; i < 160 * 120; i++)
            flickering += memcmp(frames[n].rgba + i * 4, frames[n - 1].rgba + i * 4, 4) == 0 &&
                          memcmp(m.frame[n].rgba + i * 4, m.frame[n - 1].rgba + i * 4, 4) != 0;
        CHECK_EQ(flickering, 0);
        CHECK(m.left[n] >= 40 && m.left[n] + m.columns[n] <= 120);
        CHECK(mean_square(&m.frame[n], &frames[n]) < 100);
    }
    free_movie(&m);
    for (int n = 0; n < 8; n++)
        image_free(&frames[n]);
}

static void test_gif_catches_up_when_few_colours_follow_many(void)
{
    struct image frames[3] = {smooth_image(64, 48, 0), make_image(64, 48), smooth_image(64, 48, 9)};
    struct movie m = write_movie(true, frames, 3);
    if (m.ok)
        CHECK(same_pixels(&m.frame[1], &frames[1]));
    free_movie(&m);
    for (int n = 0; n < 3; n++)
        image_free(&frames[n]);
}

static void test_gif_shows_translucent_pixels_on_black(void)
{
    struct image image OWNED(image_free) = make_image(3, 1);
    memcpy(image.rgba, "\xff\x80\x00\x80\xc8\xc8\xc8\x00\x01\x02\x03\xff", 12);
    struct movie m OWNED(free_movie) = write_movie(true, &image, 1);
    if (m.ok)
        CHECK(memcmp(m.frame[0].rgba, "\x80\x40\x00\xff\x00\x00\x00\xff\x01\x02\x03\xff", 12) == 0);
}

static void test_animation_delays_add_up(void)
{
    static const int given[] = {33, 33, 34, 33, 33, 34, 17, 17, 16, 0, 0, 5, 100, 600000, 40};
    enum { COUNT = sizeof given / sizeof given[0] };
    for (int is_gif = 0; is_gif < 2; is_gif++) {
        const char *path = scratch("test_image.delays");
        struct failure f = {""};
        struct image image OWNED(image_free) = make_image(4, 4);
        struct animation_writer *w = (is_gif ? gif_begin : apng_begin)(path, 4, 4, &f);
        for (int i = 0; i < COUNT; i++)
            CHECK(animation_add(w, &image, given[i], &f));
        CHECK(animation_end(w, &f));
        struct buffer file OWNED(buffer_free) = take_file(path);
        struct movie m OWNED(free_movie) = is_gif ? read_gif(&file) : read_apng(&file);
        CHECK(m.ok && m.frames == COUNT);
        if (is_gif) {
            int sum = 0;
            for (int i = 0; i < 6; i++)
                sum += m.delay[i];
            CHECK_EQ(sum, 20);                  /* 200 ms */
            for (int i = 6; i < 12; i++)
                CHECK_EQ(m.delay[i], 2);
            CHECK_EQ(m.delay[12], 10);
            CHECK_EQ(m.delay[13], 60000);
        } else {
            for (int i = 0; i < COUNT; i++)
                CHECK_EQ(m.delay[i], given[i]);
        }
    }
}

static void test_apng_is_exact_with_and_without_alpha(void)
{
    random_state = 17;
    for (int has_alpha = 0; has_alpha < 2; has_alpha++) {
        struct image frames[5];
        frames[0] = noise_image(37, 23, has_alpha != 0);
        for (int n = 1; n < 5; n++) {
            frames[n] = copy_image(&frames[n - 1]);
            scribble(&frames[n], n * 3, 4, 10, 2 + n);
            pixel(&frames[n], 30, 20)[3] = (uint8_t)(has_alpha ? n : 255);
        }
        struct movie m = write_movie(false, frames, 5);
        for (int n = 0; n < m.frames; n++)
            CHECK(same_pixels(&m.frame[n], &frames[n]));
        CHECK_EQ(m.channels, 3 + has_alpha);
        free_movie(&m);
        for (int n = 0; n < 5; n++)
            image_free(&frames[n]);
    }
}

static void test_apng_is_a_still_of_its_first_frame_to_others(void)
{
    const char *path = scratch("test_image.apng");
    struct image frames[2] = {smooth_image(30, 20, 0), smooth_image(30, 20, 9)}, got;
    struct failure f = {""};
    struct animation_writer *w = apng_begin(path, 30, 20, &f);
    CHECK(animation_add(w, &frames[0], 10, &f) && animation_add(w, &frames[1], 10, &f));
    CHECK(animation_end(w, &f));
    CHECK(image_load(path, &got, &f) && same_pixels(&got, &frames[0]));
    image_free(&got);
    remove(path);
    image_free(&frames[0]);
    image_free(&frames[1]);
}

static void test_animations_that_fail_or_are_cancelled_leave_no_file(void)
{
    for (int is_gif = 0; is_gif < 2; is_gif++) {
        struct animation_writer *(*start)(const char *, int, int, struct failure *) =
            is_gif ? gif_begin : apng_begin;
        const char *path = scratch("test_image.cancelled");
        struct image image OWNED(image_free) = make_image(4, 4), other = make_image(4, 5);
        struct failure f = {""}, g = {""}, h = {""}, i = {""}, j = {""};
        struct animation_writer *w = start(path, 4, 4, &f);
        CHECK(animation_add(w, &image, 10, &f));
        animation_cancel(w);
        CHECK(!exists(path) && !is_temporary_left(path));
        w = start(path, 4, 4, &f);
        CHECK(!animation_end(w, &g) && strstr(g.text, "no frames") != NULL);
        CHECK(!exists(path) && !is_temporary_left(path));
        w = start(path, 4, 4, &f);
        CHECK(animation_add(w, &image, 10, &f));
        CHECK(!animation_add(w, &other, 10, &h));
        CHECK(strstr(h.text, "frame 1 has another size") != NULL);
        CHECK(!animation_add(w, &image, -1, &i) && strstr(i.text, "delay") != NULL);
        CHECK(animation_add(w, &image, 10, &f));        /* a refused frame harms nothing */
        if (!is_gif) {
            image.rgba[3] = 254;
            CHECK(!animation_add(w, &image, 10, &j) && strstr(j.text, "translucent") != NULL);
            CHECK(!animation_end(w, &j));
            CHECK(!exists(path) && !is_temporary_left(path));
        } else {
            CHECK(animation_end(w, &f) && exists(path));
        }
        remove(path);
        struct failure k = {""};
        CHECK(start(path, 0, 4, &k) == NULL && strstr(k.text, "picture size") != NULL);
        CHECK(start(path, 4, 16385, &k) == NULL && !is_temporary_left(path));
        image_free(&other);
    }
    animation_cancel(NULL);
}

/* Of so many colours that low bits are dropped. */
static void test_palettes_keep_what_is_opaque_and_what_is_clear(void)
{
    enum { COLORS = 200000 };
    uint32_t *argb = malloc(COLORS * sizeof *argb), palette[256];
    for (uint32_t alpha = 0; alpha < 256; alpha += 255) {
        for (uint32_t i = 0; i < COLORS; i++)
            argb[i] = alpha << 24 | (i * 2654435761u >> 8);
        const int count = palette_of(argb, COLORS, 16, 4096, 2, palette);
        CHECK_EQ(count, 16);
        for (int i = 0; i < count; i++)
            CHECK_EQ(palette[i] >> 24, alpha);
    }
    free(argb);
}

#include "build/suites/image.h"

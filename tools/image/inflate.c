/* SPDX-License-Identifier: MIT */
/* inflate.c - decompression of deflate and zlib streams, for PNG.
 *
 * RFC 1951. Everything the format forbids is refused: codes that are over-full or, except for a
 * lone code, incomplete; a block without an end code; the reserved symbols; distances before the
 * start. */
#include "tools/image/inflate.h"

#include <string.h>

enum {
    MAX_BITS = 15,              /* longest code */
    LITERALS = 288, DISTANCES = 32
};

struct bits {
    const uint8_t *next, *end;
    uint64_t hold;              /* the next bit is the lowest; zeros above `count` */
    unsigned count;
};

struct code {
    uint16_t count[MAX_BITS + 1];       /* codes of each length */
    uint16_t symbol[LITERALS];          /* in order of their codes */
};

struct inflater {
    struct bits bits;
    uint8_t *out;
    size_t used, capacity;
    struct code literal, distance;
};

static const uint16_t length_base[29] = {
    3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31,
    35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258,
};
static const uint8_t length_extra[29] = {
    0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0,
};
static const uint16_t distance_base[30] = {
    1, 2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 257, 385, 513, 769, 1025, 1537, 2049,
    3073, 4097, 6145, 8193, 12289, 16385, 24577,
};
static const uint8_t distance_extra[30] = {
    0, 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13,
    13,
};

/* At least 56 bits, or all that are left. */
static void refill(struct bits *b)
{
    while (b->count <= 56 && b->next < b->end) {
        b->hold |= (uint64_t)*b->next++ << b->count;
        b->count += 8;
    }
}

/* n <= 16 bits into *value; false at the end of the data. */
static bool take(struct bits *b, unsigned n, unsigned *value)
{
    if (b->count < n)
        refill(b);
    if (b->count < n)
        return false;
    *value = (unsigned)(b->hold & ((1u << n) - 1));
    b->hold >>= n;
    b->count -= n;
    return true;
}

/* Canonical code from the lengths of n symbols (0: unused). False when it is over-full, or
 * incomplete unless it consists of at most one code of one bit, which RFC 1951 allows for distances
 * and zlib's encoder has always been granted for literals too. */
static bool build_code(struct code *c, const uint8_t *length, unsigned n, bool lone_allowed)
{
    uint16_t offset[MAX_BITS + 2] = {0};
    memset(c, 0, sizeof *c);
    for (unsigned i = 0; i < n; i++)
        c->count[length[i]]++;
    unsigned used = n - c->count[0];
    c->count[0] = 0;
    int left = 1;
    for (unsigned bits = 1; bits <= MAX_BITS; bits++) {
        left = left * 2 - c->count[bits];
        if (left < 0)
            return false;
        offset[bits + 1] = (uint16_t)(offset[bits] + c->count[bits]);
    }
    bool lone = used == 0 || (used == 1 && c->count[1] == 1);
    if (left > 0 && !(lone_allowed && lone))
        return false;
    for (unsigned i = 0; i < n; i++)
        if (length[i] != 0)
            c->symbol[offset[length[i]]++] = (uint16_t)i;
    return true;
}

/* The next symbol, or -1 for a code that is not used or cut off by the end of the data. Bit by bit: at each length the codes are
 * consecutive numbers starting at `first`. */
static int decode(struct bits *b, const struct code *c)
{
    if (b->count < MAX_BITS)
        refill(b);
    int code = 0, first = 0, index = 0;
    for (unsigned length = 1; length <= MAX_BITS && length <= b->count; length++) {
        code |= (int)(b->hold >> (length - 1) & 1);
        int count = c->count[length];
        if (code - first < count) {
            b->hold >>= length;
            b->count -= length;
            return c->symbol[index + code - first];
        }
        index += count;
        first = (first + count) << 1;
        code <<= 1;
    }
    return -1;
}

static bool too_large(const struct inflater *s, struct failure *f)
{
    return fail(f, "compressed data is longer than expected (%zu bytes)", s->capacity);
}

static bool stored_block(struct inflater *s, struct failure *f)
{
    struct bits *b = &s->bits;
    unsigned length, complement, skipped;
    if (!take(b, b->count % 8, &skipped) || !take(b, 16, &length) || !take(b, 16, &complement))
        return fail(f, "compressed data ends early (in a stored block)");
    if (length != (complement ^ 0xffff))
        return fail(f, "compressed data is damaged (length of a stored block)");
    if (length > s->capacity - s->used)
        return too_large(s, f);
    while (length > 0 && b->count > 0) {
        unsigned byte;
        take(b, 8, &byte);
        s->out[s->used++] = (uint8_t)byte;
        length--;
    }
    if (length > (size_t)(b->end - b->next))
        return fail(f, "compressed data ends early (in a stored block)");
    if (length > 0) {
        memcpy(s->out + s->used, b->next, length);
        s->used += length;
        b->next += length;
    }
    return true;
}

static bool read_dynamic_codes(struct inflater *s, struct failure *f)
{
    static const uint8_t order[19] = {
        16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15,
    };
    uint8_t length[LITERALS + DISTANCES] = {0};
    unsigned literals, distances, lengths;
    struct bits *b = &s->bits;
    if (!take(b, 5, &literals) || !take(b, 5, &distances) || !take(b, 4, &lengths))
        return fail(f, "compressed data ends early (in a code description)");
    literals += 257;
    distances += 1;
    lengths += 4;
    if (literals > 286 || distances > 30)
        return fail(f, "compressed data is damaged (number of codes)");
    for (unsigned i = 0; i < lengths; i++) {
        unsigned bits;
        if (!take(b, 3, &bits))
            return fail(f, "compressed data ends early (in a code description)");
        length[order[i]] = (uint8_t)bits;
    }
    if (!build_code(&s->literal, length, 19, false))
        return fail(f, "compressed data is damaged (code lengths)");

    memset(length, 0, sizeof length);
    unsigned at = 0;
    while (at < literals + distances) {
        int symbol = decode(b, &s->literal);
        if (symbol < 0)
            return fail(f, "compressed data is damaged (code lengths)");
        if (symbol < 16) {
            length[at++] = (uint8_t)symbol;
            continue;
        }
        /* 16: repeat the last length 3..6 times; 17 and 18: 3..10 and 11..138 zeros */
        unsigned extra_bits = symbol == 16 ? 2 : symbol == 17 ? 3 : 7;
        unsigned repeat, value = 0;
        if (!take(b, extra_bits, &repeat))
            return fail(f, "compressed data ends early (in a code description)");
        repeat += symbol == 18 ? 11 : 3;
        if (symbol == 16) {
            if (at == 0)
                return fail(f, "compressed data is damaged (repeat without a length)");
            value = length[at - 1];
        }
        if (repeat > literals + distances - at)
            return fail(f, "compressed data is damaged (too many code lengths)");
        memset(length + at, (int)value, repeat);
        at += repeat;
    }
    if (length[256] == 0)
        return fail(f, "compressed data is damaged (block without an end)");
    if (!build_code(&s->literal, length, literals, true) ||
        !build_code(&s->distance, length + literals, distances, true))
        return fail(f, "compressed data is damaged (code lengths)");
    return true;
}

static void fixed_codes(struct inflater *s)
{
    uint8_t length[LITERALS];
    memset(length, 8, 144);
    memset(length + 144, 9, 256 - 144);
    memset(length + 256, 7, 280 - 256);
    memset(length + 280, 8, LITERALS - 280);
    build_code(&s->literal, length, LITERALS, false);
    memset(length, 5, DISTANCES);
    build_code(&s->distance, length, DISTANCES, false);
}

static bool copy_match(struct inflater *s, size_t length, size_t distance, struct failure *f)
{
    if (distance > s->used)
        return fail(f, "compressed data is damaged (distance before the start)");
    if (length > s->capacity - s->used)
        return too_large(s, f);
    for (; length > 0; length--, s->used++)     /* may overlap: repeats the last bytes */
        s->out[s->used] = s->out[s->used - distance];
    return true;
}

static bool coded_block(struct inflater *s, struct failure *f)
{
    struct bits *b = &s->bits;
    for (;;) {
        int symbol = decode(b, &s->literal);
        if (symbol < 0)
            return fail(f, "compressed data is damaged or ends early (symbol)");
        if (symbol < 256) {
            if (s->used == s->capacity)
                return too_large(s, f);
            s->out[s->used++] = (uint8_t)symbol;
            continue;
        }
        if (symbol == 256)
            return true;
        unsigned extra;
        symbol -= 257;
        if (symbol >= 29)
            return fail(f, "compressed data is damaged (reserved length)");
        if (!take(b, length_extra[symbol], &extra))
            return fail(f, "compressed data ends early (in a length)");
        size_t length = length_base[symbol] + extra;
        symbol = decode(b, &s->distance);
        if (symbol < 0 || symbol >= 30)
            return fail(f, "compressed data is damaged or ends early (distance)");
        if (!take(b, distance_extra[symbol], &extra))
            return fail(f, "compressed data ends early (in a distance)");
        if (!copy_match(s, length, distance_base[symbol] + extra, f))
            return false;
    }
}

bool inflate_raw(const uint8_t *in, size_t in_size, uint8_t *out, size_t capacity, size_t *produced,
                 size_t *consumed, struct failure *f)
{
    struct inflater s = {
        .bits = {.next = in, .end = in + in_size}, .out = out, .capacity = capacity,
    };
    unsigned last = 0, kind;
    while (last == 0) {
        if (!take(&s.bits, 1, &last) || !take(&s.bits, 2, &kind))
            return fail(f, "compressed data ends early (between blocks)");
        bool ok;
        if (kind == 0) {
            ok = stored_block(&s, f);
        } else if (kind == 1) {
            fixed_codes(&s);
            ok = coded_block(&s, f);
        } else if (kind == 2) {
            ok = read_dynamic_codes(&s, f) && coded_block(&s, f);
        } else {
            ok = fail(f, "compressed data is damaged (kind of block)");
        }
        if (!ok)
            return false;
    }
    if (produced != NULL)
        *produced = s.used;
    if (consumed != NULL)
        *consumed = (size_t)(s.bits.next - in) - s.bits.count / 8;
    return true;
}

bool inflate_zlib(const uint8_t *in, size_t in_size, uint8_t *out, size_t capacity,
                  size_t *produced, size_t *consumed, struct failure *f)
{
    size_t made, used;
    if (in_size < 2)
        return fail(f, "compressed data ends early (in its header)");
    unsigned header = (unsigned)in[0] << 8 | in[1];
    if ((in[0] & 15) != 8 || in[0] >> 4 > 7 || header % 31 != 0 || (in[1] & 0x20) != 0)
        return fail(f, "compressed data is damaged (zlib header %04x)", header);
    if (!inflate_raw(in + 2, in_size - 2, out, capacity, &made, &used, f))
        return false;
    const uint8_t *check = in + 2 + used;
    if (in_size - 2 - used < 4)
        return fail(f, "compressed data ends early (in its checksum)");
    uint32_t stored = (uint32_t)check[0] << 24 | (uint32_t)check[1] << 16 |
                      (uint32_t)check[2] << 8 | check[3];
    if (stored != adler32_update(1, out, made))
        return fail(f, "checksum mismatch (compressed data)");
    if (produced != NULL)
        *produced = made;
    if (consumed != NULL)
        *consumed = 2 + used + 4;
    return true;
}

uint32_t adler32_update(uint32_t adler, const uint8_t *bytes, size_t size)
{
    uint32_t a = adler & 0xffff, b = adler >> 16;
    while (size > 0) {
        size_t run = size < 5552 ? size : 5552;     /* more additions could overflow 32 bits */
        for (size_t i = 0; i < run; i++) {
            a += bytes[i];
            b += a;
        }
        a %= 65521;
        b %= 65521;
        bytes += run;
        size -= run;
    }
    return b << 16 | a;
}

/* SPDX-License-Identifier: MIT */
/* jpeg_scan.c - the Huffman-coded data of scans, sequential and progressive, to samples or coefficients.
 *
 * What is damaged or missing is refused, as JPEG has no checksums that would tell. Surplus bytes before a marker are
 * passed over: some encoders write them. */
#include "tools/image/jpeg.h"

#include <string.h>

enum { LONGEST = 16, MOST_BITS = 15 };      /* of a code; of a number behind one */

struct bits {
    const uint8_t *next, *end;
    uint64_t hold;              /* the next bit is the highest; zeros below `count` of them */
    unsigned count;
    bool ran_out;               /* more bits were asked for than came before the marker */
};

struct decoder {
    struct bits bits;
    struct jpeg *j;
    const struct jpeg_scan *scan;
    int32_t mean[JPEG_COMPONENTS];      /* coefficient 0 of the last block: what is coded is the difference */
    uint32_t run;               /* blocks yet to come in whose band nothing more is coded */
};

/* ---------------------------------------------------------------------- bits and codes */

/* At least 57 bits, or all up to the next marker. Behind a byte of ones stands a zero, else it begins a marker. */
static void refill(struct bits *b)
{
    while (b->count <= 56 && b->next < b->end) {
        const uint8_t byte = *b->next;
        if (byte == 0xff && (b->end - b->next < 2 || b->next[1] != 0))
            return;
        b->hold |= (uint64_t)byte << (56 - b->count);
        b->count += 8;
        b->next += byte == 0xff ? 2 : 1;
    }
}

/* False where fewer than n bits are left. */
static bool pass(struct bits *b, unsigned n)
{
    if (n > b->count) {
        b->ran_out = true;
        return false;
    }
    b->hold <<= n;
    b->count -= n;
    return true;
}

/* n <= 16 bits into *value, which is 0 for none. */
static bool take(struct bits *b, unsigned n, uint32_t *value)
{
    if (b->count < n)
        refill(b);
    *value = n == 0 ? 0 : (uint32_t)(b->hold >> (64 - n));
    return pass(b, n);
}

bool jpeg_build_code(struct jpeg_code *code, const uint8_t counts[16], const uint8_t *symbols)
{
    uint32_t next = 0;
    int32_t index = 0;
    *code = (struct jpeg_code){ .is_known = true };
    for (unsigned length = 1; length <= LONGEST; length++, next *= 2) {
        const uint32_t count = counts[length - 1];
        if (next + count > 1u << length || index + (int32_t)count > 256)
            return false;
        code->offset[length] = index - (int32_t)next;
        for (uint32_t i = 0; i < count; i++, next++, index++) {
            code->symbol[index] = symbols[index];
            if (length > JPEG_FAST_BITS)
                continue;
            const uint32_t shift = JPEG_FAST_BITS - length;
            for (uint32_t k = next << shift; k < (next + 1) << shift; k++)
                code->fast[k] = (uint16_t)(length << 8 | symbols[index]);
        }
        code->end[length] = next << (LONGEST - length);
    }
    return true;
}

/* The next symbol; -1 where the bits are no code, or not all there. */
static int decode(struct bits *b, const struct jpeg_code *code)
{
    if (b->count < LONGEST)
        refill(b);
    const unsigned fast = code->fast[b->hold >> (64 - JPEG_FAST_BITS)];
    if (fast != 0)
        return pass(b, fast >> 8) ? (int)(fast & 255) : -1;
    const uint32_t bits = (uint32_t)(b->hold >> (64 - LONGEST));
    for (unsigned length = JPEG_FAST_BITS + 1; length <= LONGEST; length++)
        if (bits < code->end[length])
            return pass(b, length) ? code->symbol[code->offset[length] + (int32_t)(bits >> (LONGEST - length))] : -1;
    b->ran_out |= b->count < LONGEST;
    return -1;
}

/* A number of `size` bits: those that begin with 0 are negative. */
static bool take_number(struct bits *b, unsigned size, int32_t *value)
{
    uint32_t bits;
    if (!take(b, size, &bits))
        return false;
    *value = (int32_t)bits - (size > 0 && bits >> (size - 1) == 0 ? (1 << size) - 1 : 0);
    return true;
}

/* ---------------------------------------------------------------------- blocks
 *
 * Each is false where its bits are damaged or missing. */

/* Coefficient 0, in units of bit `low`. */
static bool read_mean(struct decoder *d, int part, int low, int16_t *mean)
{
    int32_t difference;
    const int size = decode(&d->bits, d->scan->dc[part]);
    if (size < 0 || size > MOST_BITS || !take_number(&d->bits, (unsigned)size, &difference))
        return false;
    d->mean[part] += difference;
    const int32_t value = d->mean[part] * (1 << low);
    if (d->mean[part] < -32768 || d->mean[part] > 32767 || value < -32768 || value > 32767)
        return false;
    *mean = (int16_t)value;
    return true;
}

/* How many blocks from this one on end here, by a symbol that says in how many bits (0 to 14) that is told. */
static bool read_run(struct decoder *d, unsigned zeros)
{
    uint32_t more;
    if (!take(&d->bits, zeros, &more))
        return false;
    d->run = (1u << zeros) + more;
    return true;
}

/* A band of coefficients, of which nothing has come before. A symbol tells how many zeros come first, and in how many bits
 * the coefficient behind them follows: in none it is zero, too, and so are all that are left, unless there are 15 before it. */
static bool read_band(struct decoder *d, int part, int first, int16_t *block)
{
    const struct jpeg_scan *s = d->scan;
    for (int k = first; k <= s->last; k++) {
        int32_t value;
        const int symbol = decode(&d->bits, s->ac[part]), zeros = symbol >> 4, size = symbol & 15;
        if (symbol < 0)
            return false;
        if (size == 0 && zeros < 15)
            return read_run(d, d->j->is_progressive ? (unsigned)zeros : 0);
        k += zeros;
        if (k > s->last || size + s->low > MOST_BITS || !take_number(&d->bits, (unsigned)size, &value))
            return false;
        block[k] = (int16_t)(value * (1 << s->low));
    }
    d->run = 1;
    return true;
}

/* A bit more of a coefficient that is not zero. */
static bool refine(struct decoder *d, int16_t *coefficient)
{
    uint32_t bit;
    if (!take(&d->bits, 1, &bit))
        return false;
    const int32_t unit = 1 << d->scan->low, value = *coefficient;
    if (bit != 0 && (value & unit) == 0)
        *coefficient = (int16_t)(value > 0 ? value + unit : value - unit);
    return true;
}

/* Refines what is not zero from *k on, over `zeros` others; *k is then behind the band, or at the next zero. */
static bool refine_over(struct decoder *d, int *k, int zeros, int16_t *block)
{
    for (; *k <= d->scan->last; ++*k) {
        if (block[*k] == 0 && zeros-- == 0)
            return true;
        if (block[*k] != 0 && !refine(d, &block[*k]))
            return false;
    }
    return true;
}

/* A bit more of a band: a symbol tells how many coefficients stay zero before one that does not. */
static bool refine_band(struct decoder *d, int16_t *block)
{
    const struct jpeg_scan *s = d->scan;
    int k = s->first;
    for (; d->run == 0 && k <= s->last; k++) {
        uint32_t positive = 0;
        const int symbol = decode(&d->bits, s->ac[0]), zeros = symbol >> 4, size = symbol & 15;
        if (symbol < 0 || size > 1 || (size == 1 && !take(&d->bits, 1, &positive)))
            return false;
        if (size == 0 && zeros < 15) {
            if (!read_run(d, (unsigned)zeros))
                return false;
            break;
        }
        if (!refine_over(d, &k, zeros, block) || k > s->last)
            return false;
        if (size == 1)
            block[k] = (int16_t)((positive != 0 ? 1 : -1) * (1 << s->low));
    }
    if (d->run == 0) {
        d->run = 1;
        return true;
    }
    for (const int last = s->last; k <= last; k++)
        if (block[k] != 0 && !refine(d, &block[k]))
            return false;
    return true;
}

static bool read_progressive(struct decoder *d, int part, int16_t *block)
{
    const struct jpeg_scan *s = d->scan;
    uint32_t bit;
    if (s->first == 0 && s->high == 0)
        return read_mean(d, part, s->low, block);
    if (s->first == 0) {
        if (!take(&d->bits, 1, &bit))
            return false;
        block[0] = (int16_t)(block[0] | (int32_t)bit << s->low);
        return true;
    }
    if (s->high > 0 ? !refine_band(d, block) : d->run == 0 && !read_band(d, part, s->first, block))
        return false;
    d->run--;
    return true;
}

/* Block (column, row) of a component. */
static bool read_block(struct decoder *d, int part, int column, int row)
{
    struct jpeg_component *c = d->scan->component[part];
    const size_t number = (size_t)row * (size_t)c->stride + (size_t)column;
    if (d->j->is_progressive)
        return read_progressive(d, part, c->coefficient + number * 64);
    int16_t block[64] = { 0 };
    if (!read_mean(d, part, 0, block) || !read_band(d, part, 1, block))
        return false;
    const size_t bytes = (size_t)c->stride * 8;
    jpeg_make_samples(block, c->quantum, c->sample + (size_t)row * 8 * bytes + (size_t)column * 8, bytes);
    return true;
}

/* ---------------------------------------------------------------------- scans */

/* A scan of one component has its blocks in rows; else an MCU has h x v of each. */
static bool read_mcu(struct decoder *d, int x, int y)
{
    const struct jpeg_scan *s = d->scan;
    if (s->count == 1)
        return read_block(d, 0, x, y);
    for (int part = 0; part < s->count; part++) {
        const struct jpeg_component *c = s->component[part];
        for (int i = 0; i < c->h * c->v; i++)
            if (!read_block(d, part, x * c->h + i % c->h, y * c->v + i / c->h))
                return false;
    }
    return true;
}

bool jpeg_find_marker(struct jpeg *j)
{
    for (; j->end - j->next >= 2; j->next++)
        if (j->next[0] == 0xff && j->next[1] != 0 && j->next[1] != 0xff)
            return true;
    j->next = j->end;
    return false;
}

static void begin_interval(struct decoder *d)
{
    d->bits = (struct bits){ .next = d->j->next, .end = d->j->end };
    memset(d->mean, 0, sizeof d->mean);
    d->run = 0;
}

/* Passes restart marker number `count`, counted modulo 8 from 0. */
static bool restart(struct decoder *d, long count, struct failure *f)
{
    struct jpeg *j = d->j;
    j->next = d->bits.next;
    if (!jpeg_find_marker(j))
        return fail(f, "file ends early (in scan %d)", j->scan_count);
    if (j->next[1] != 0xd0 + count % 8)
        return fail(f, "restart marker %ld is not there (scan %d)", count, j->scan_count);
    j->next += 2;
    begin_interval(d);
    return true;
}

static bool damaged(const struct decoder *d, int y, struct failure *f)
{
    const int number = d->j->scan_count;
    if (!d->bits.ran_out)
        return fail(f, "coded data is damaged (scan %d, row %d of MCUs)", number, y);
    if (d->bits.end - d->bits.next < 2)
        return fail(f, "file ends early (in scan %d)", number);
    return fail(f, "coded data ends early (scan %d, row %d of MCUs)", number, y);
}

bool jpeg_read_scan(struct jpeg *j, const struct jpeg_scan *scan, struct failure *f)
{
    struct decoder d = { .j = j, .scan = scan };
    const int columns = scan->count == 1 ? scan->component[0]->columns : j->mcu_columns;
    const int rows = scan->count == 1 ? scan->component[0]->rows : j->mcu_rows;
    long left = j->restart_interval, restarts = 0;
    begin_interval(&d);
    for (int y = 0; y < rows; y++) {
        for (int x = 0; x < columns; x++) {
            if (j->restart_interval > 0 && left-- == 0) {
                if (!restart(&d, restarts++, f))
                    return false;
                left = j->restart_interval - 1;
            }
            if (!read_mcu(&d, x, y))
                return damaged(&d, y, f);
        }
    }
    j->next = d.bits.next;
    return true;
}

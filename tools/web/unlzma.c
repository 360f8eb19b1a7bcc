/* SPDX-License-Identifier: MIT */
/* unlzma.c - reads a .lzma file that ends with an end mark, after Igor Pavlov's lzma-specification. Alone
 * in a module of its own: it unpacks the others.
 *
 * The file's bytes go to unlzma_input(); what unlzma() makes of them lies at unlzma_output(). */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define EXPORT(name) __attribute__((export_name(#name)))

enum { INPUT_ROOM = 1 << 19, OUTPUT_ROOM = 1 << 22, HEADER = 13, MATCH_MIN = 2, LITERAL_ROOM = 0x300 << 4 };

typedef uint16_t chance;                    /* that the next bit is 0, of 2048 */

struct lengths {
    chance is_long, is_longest, low[16][8], middle[16][8], high[256];
};

/* Everything in it is a chance. */
struct model {
    chance match[12][16], rep[12], rep0[12], rep1[12], rep2[12], rep0_long[12][16];
    chance slot[4][64], special[128], align[16];
    struct lengths match_length, rep_length;
    chance literal[LITERAL_ROOM];
};

static struct model model;
static uint8_t input[INPUT_ROOM], output[OUTPUT_ROOM];
static uint32_t input_at, input_size, range, code;

EXPORT(unlzma_input) uint8_t *unlzma_input(void)
{
    return input;
}

EXPORT(unlzma_output) uint8_t *unlzma_output(void)
{
    return output;
}

/* ------------------------------------------------------------------ the range coder */

static inline void refill(void)
{
    if (range < 1u << 24) {
        range <<= 8;
        code = code << 8 | (input_at < input_size ? input[input_at++] : 0);
    }
}

static inline unsigned bit(chance *p)
{
    uint32_t bound = (range >> 11) * *p;
    unsigned is_one = code >= bound;
    if (is_one) {
        range -= bound;
        code -= bound;
        *p -= *p >> 5;
    } else {
        range = bound;
        *p += (2048 - *p) >> 5;
    }
    refill();
    return is_one;
}

static uint32_t plain_bits(unsigned count)
{
    uint32_t value = 0;
    for (; count > 0; count--) {
        range >>= 1;
        unsigned is_one = code >= range;
        code -= is_one ? range : 0;
        refill();
        value = value << 1 | is_one;
    }
    return value;
}

static unsigned tree(chance *p, unsigned bits)
{
    unsigned m = 1;
    for (unsigned i = 0; i < bits; i++)
        m = m << 1 | bit(p + m);
    return m - (1u << bits);
}

/* The lowest bit comes first. */
static unsigned reversed_tree(chance *p, unsigned bits)
{
    unsigned m = 1, value = 0;
    for (unsigned i = 0; i < bits; i++) {
        unsigned b = bit(p + m);
        m = m << 1 | b;
        value |= b << i;
    }
    return value;
}

/* ------------------------------------------------------------------ literals and matches */

/* `expected` is the byte at the last distance, where the last symbol was a match; else it does not count. */
static uint8_t literal(chance *p, bool follows_match, unsigned expected)
{
    unsigned m = 1;
    while (follows_match && m < 256) {
        unsigned e = expected >> 7 & 1, b = bit(p + ((1 + e) << 8) + m);
        m = m << 1 | b;
        expected <<= 1;
        follows_match = b == e;
    }
    while (m < 256)
        m = m << 1 | bit(p + m);
    return (uint8_t)m;
}

static unsigned length_of(struct lengths *l, unsigned place)
{
    if (!bit(&l->is_long))
        return MATCH_MIN + tree(l->low[place], 3);
    if (!bit(&l->is_longest))
        return MATCH_MIN + 8 + tree(l->middle[place], 3);
    return MATCH_MIN + 16 + tree(l->high, 8);
}

/* Less one; UINT32_MAX is the end mark. */
static uint32_t distance_of(unsigned length)
{
    unsigned of = length < 5 ? length - MATCH_MIN : 3, slot = tree(model.slot[of], 6), bits = (slot >> 1) - 1;
    if (slot < 4)
        return slot;
    uint32_t distance = (2u | (slot & 1)) << bits;
    if (slot < 14)
        return distance + reversed_tree(model.special + distance - slot, bits);
    distance += plain_bits(bits - 4) << 4;
    return distance + reversed_tree(model.align, 4);
}

/* One of the last four distances comes to the front. True: it is the first, for a single byte. */
static bool is_single(uint32_t last[4], unsigned state, unsigned place)
{
    if (!bit(&model.rep0[state]))
        return !bit(&model.rep0_long[state][place]);
    int which = !bit(&model.rep1[state]) ? 1 : !bit(&model.rep2[state]) ? 2 : 3;
    uint32_t distance = last[which];
    for (; which > 0; which--)
        last[which] = last[which - 1];
    last[0] = distance;
    return false;
}

/* ------------------------------------------------------------------ a file */

/* Unpacks the first `size` bytes of the input. How many they become, or -1. */
EXPORT(unlzma) int32_t unlzma(uint32_t size)
{
    const unsigned lc = input[0] % 9, lp = input[0] / 9 % 5, pb = input[0] / 45;
    uint32_t n = 0, last[4] = { 0 };
    unsigned state = 0;
    if (size < HEADER + 5 || size > INPUT_ROOM || lc + lp > 4 || pb > 4)
        return -1;
    for (size_t i = 0; i < sizeof model / sizeof(chance); i++)
        ((chance *)&model)[i] = 1024;
    range = UINT32_MAX;
    code = 0;
    input_size = size;
    for (input_at = HEADER; input_at < HEADER + 5;)
        code = code << 8 | input[input_at++];
    for (;;) {
        const unsigned place = n & ((1u << pb) - 1);
        if (!bit(&model.match[state][place])) {
            unsigned before = n > 0 ? output[n - 1] : 0;
            chance *p = model.literal + 0x300 * (((n & ((1u << lp) - 1)) << lc) + (before >> (8 - lc)));
            if (n == OUTPUT_ROOM)
                return -1;
            output[n] = literal(p, state >= 7, state >= 7 ? output[n - last[0] - 1] : 0);
            n++;
            state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
            continue;
        }
        unsigned length = 1;
        if (!bit(&model.rep[state])) {
            length = length_of(&model.match_length, place);
            last[3] = last[2];
            last[2] = last[1];
            last[1] = last[0];
            last[0] = distance_of(length);
            if (last[0] == UINT32_MAX)
                return (int32_t)n;
            state = state < 7 ? 7 : 10;
        } else if (is_single(last, state, place)) {
            state = state < 7 ? 9 : 11;
        } else {
            length = length_of(&model.rep_length, place);
            state = state < 7 ? 8 : 11;
        }
        if (last[0] >= n || length > OUTPUT_ROOM - n)
            return -1;
        for (; length > 0; length--, n++)
            output[n] = output[n - last[0] - 1];
    }
}

/* SPDX-License-Identifier: MIT */
/* deflate.c - compression to zlib streams, for PNG and APNG.
 *
 * RFC 1951. Matches are found through chains of positions with the same next four bytes (of three
 * equal bytes only the last place is known), one position late ("lazy"): a match is given up when
 * the next position starts a longer one. The resulting tokens are written in blocks, each with its
 * own Huffman codes. */
#include "tools/image/image.h"
#include "tools/image/inflate.h"

enum {
    WINDOW = 32768,             /* distances stay below this */
    MIN_MATCH = 3, MAX_MATCH = 258,
    CHAIN_BYTES = 4,            /* positions with these equal are chained */
    HASH_BITS = 15,
    BLOCK_TOKENS = 24576,       /* codes adapt this often; a description costs about 80 bytes */
    LITERALS = 286, DISTANCES = 30, END_OF_BLOCK = 256,
    MAX_BITS = 15,              /* longest code of literals and distances */
    MAX_LENGTH_BITS = 7,        /* longest code of code lengths */

    /* Effort: within 5 % of zlib's level 6 in size, usually 1 or 2, and faster. */
    CHAIN = 24,                 /* candidates looked at per position */
    GOOD_MATCH = 8,             /* a quarter of that when the last position has a match this long */
    LAZY_MATCH = 16,            /* a match longer than this is taken without looking further */
    NICE_MATCH = 128,           /* the search ends with a match this long */
    NEAR_DISTANCE = 4096        /* three bytes from further away cost more than literals */
};

/* A literal byte, or length << 16 | distance - 1 with length >= 3. */
typedef uint32_t token;

struct deflater {
    const uint8_t *in;
    size_t size;
    struct buffer *out;
    uint64_t hold;              /* bits not yet written; the first is the lowest */
    unsigned hold_count;
    size_t token_count;
    token tokens[BLOCK_TOKENS];
    uint32_t literal_uses[LITERALS], distance_uses[DISTANCES];
    uint32_t head3[1 << HASH_BITS];     /* last position + 1 with such 3 bytes; 0: none */
    uint32_t head4[1 << HASH_BITS];     /* the same of four */
    uint32_t previous[WINDOW];          /* the one before it in head4, by position modulo WINDOW */
    uint8_t length_symbol[MAX_MATCH + 1];       /* symbol - 257 */
    uint8_t distance_symbol[512];       /* of d = distance - 1 below 256; of d >> 7 above */
    uint16_t length_base[29], distance_base[DISTANCES];
};

struct huffman {
    uint8_t length[288];
    uint16_t code[288];         /* reversed, as deflate sends codes from the top bit down */
};

static unsigned length_extra_bits(unsigned symbol)
{
    return symbol < 8 || symbol == 28 ? 0 : (symbol - 4) / 4;
}

static unsigned distance_extra_bits(unsigned symbol)
{
    return symbol < 4 ? 0 : (symbol - 2) / 2;
}

static void fill_symbol_tables(struct deflater *d)
{
    unsigned length = MIN_MATCH;
    for (unsigned symbol = 0; symbol < 28; symbol++) {
        d->length_base[symbol] = (uint16_t)length;
        for (unsigned i = 0; i < 1u << length_extra_bits(symbol); i++)
            d->length_symbol[length++] = (uint8_t)symbol;
    }
    d->length_base[28] = MAX_MATCH;             /* takes over the last value of symbol 27 */
    d->length_symbol[MAX_MATCH] = 28;
    unsigned distance = 0;                      /* minus one */
    for (unsigned symbol = 0; symbol < DISTANCES; symbol++) {
        unsigned count = 1u << distance_extra_bits(symbol);
        d->distance_base[symbol] = (uint16_t)distance;
        for (unsigned i = 0; i < count; i++, distance++) {
            if (distance < 256)
                d->distance_symbol[distance] = (uint8_t)symbol;
            else
                d->distance_symbol[256 + (distance >> 7)] = (uint8_t)symbol;
        }
    }
}

static unsigned distance_to_symbol(const struct deflater *d, unsigned distance_minus_1)
{
    return distance_minus_1 < 256 ? d->distance_symbol[distance_minus_1]
                                  : d->distance_symbol[256 + (distance_minus_1 >> 7)];
}

/* count <= 32 */
static void put(struct deflater *d, uint32_t bits, unsigned count)
{
    d->hold |= (uint64_t)bits << d->hold_count;
    d->hold_count += count;
    while (d->hold_count >= 8) {
        buffer_byte(d->out, (unsigned)(d->hold & 255));
        d->hold >>= 8;
        d->hold_count -= 8;
    }
}

static int compare_uses(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/* Lengths of a Huffman code for n <= 288 symbols used so often, none above max_bits, and the
 * canonical codes. A single used symbol gets one bit. */
static void build_huffman(struct huffman *h, const uint32_t *uses, unsigned n, unsigned max_bits)
{
    uint64_t leaf[288];                 /* uses << 16 | symbol: sorts by use, ties by symbol */
    uint64_t weight[288];               /* of inner nodes, in order of making: ascending too */
    uint16_t leaf_parent[288], parent[288];
    unsigned leaves = 0;
    memset(h, 0, sizeof *h);
    for (unsigned i = 0; i < n; i++)
        if (uses[i] != 0)
            leaf[leaves++] = (uint64_t)uses[i] << 16 | i;
    if (leaves == 0)
        return;
    qsort(leaf, leaves, sizeof leaf[0], compare_uses);

    /* Both queues are sorted, so the two lightest nodes are at their fronts. */
    unsigned next_leaf = 0, next_node = 0, nodes = 0;
    while (nodes + 1 < leaves) {
        uint64_t sum = 0;
        for (int child = 0; child < 2; child++) {
            if (next_node == nodes ||
                (next_leaf < leaves && leaf[next_leaf] >> 16 <= weight[next_node])) {
                sum += leaf[next_leaf] >> 16;
                leaf_parent[next_leaf++] = (uint16_t)nodes;
            } else {
                sum += weight[next_node];
                parent[next_node++] = (uint16_t)nodes;
            }
        }
        weight[nodes++] = sum;
    }

    /* How many leaves each depth has, the root being the last node; too deep ones are cut off at
     * max_bits, which overfills the code. */
    unsigned depth[288], count[33] = {0};
    if (nodes == 0) {
        count[1] = 1;
    } else {
        depth[nodes - 1] = 0;
        for (unsigned i = nodes - 1; i-- > 0;)
            depth[i] = depth[parent[i]] + 1;
        for (unsigned i = 0; i < leaves; i++) {
            unsigned bits = depth[leaf_parent[i]] + 1;
            count[bits < max_bits ? bits : max_bits]++;
        }
    }
    /* Room is made by moving a leaf from the deepest free level one down and pairing a cut-off leaf
     * with it; each step frees one code of max_bits. */
    uint32_t total = 0;
    for (unsigned bits = 1; bits <= max_bits; bits++)
        total += count[bits] << (max_bits - bits);
    while (total > 1u << max_bits) {
        unsigned bits = max_bits - 1;
        while (count[bits] == 0)
            bits--;
        count[bits]--;
        count[bits + 1] += 2;
        count[max_bits]--;
        total--;
    }

    unsigned at = 0;                    /* the rarest symbols get the longest codes */
    for (unsigned bits = max_bits; bits >= 1; bits--)
        for (unsigned i = 0; i < count[bits]; i++)
            h->length[leaf[at++] & 0xffff] = (uint8_t)bits;

    unsigned next_code[MAX_BITS + 2] = {0};
    for (unsigned bits = 1; bits <= max_bits; bits++)
        next_code[bits + 1] = (next_code[bits] + count[bits]) << 1;
    for (unsigned i = 0; i < n; i++) {
        unsigned code = h->length[i] != 0 ? next_code[h->length[i]]++ : 0, reversed = 0;
        for (unsigned bit = 0; bit < h->length[i]; bit++)
            reversed = reversed << 1 | (code >> bit & 1);
        h->code[i] = (uint16_t)reversed;
    }
}

/* The lengths of both codes, run-length coded: symbols 0..18 and their extra bits. */
struct code_lengths {
    uint8_t symbol[LITERALS + DISTANCES], extra[LITERALS + DISTANCES];
    unsigned count;
    unsigned literals, distances;       /* lengths described */
    unsigned lengths;                   /* codes of `huffman` sent, in the RFC's order */
    struct huffman huffman;
};

static const uint8_t length_order[19] = {
    16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15,
};

static unsigned code_length_extra_bits(unsigned symbol)
{
    return symbol == 16 ? 2 : symbol == 17 ? 3 : symbol == 18 ? 7 : 0;
}

static void describe_codes(struct code_lengths *c, const struct huffman *literal,
                           const struct huffman *distance)
{
    uint8_t length[LITERALS + DISTANCES];
    uint32_t uses[19] = {0};
    c->count = 0;
    c->literals = LITERALS;
    while (c->literals > 257 && literal->length[c->literals - 1] == 0)
        c->literals--;
    c->distances = DISTANCES;
    while (c->distances > 1 && distance->length[c->distances - 1] == 0)
        c->distances--;
    memcpy(length, literal->length, c->literals);
    memcpy(length + c->literals, distance->length, c->distances);
    unsigned total = c->literals + c->distances;
    for (unsigned i = 0; i < total;) {
        unsigned run = 1;
        while (i + run < total && length[i + run] == length[i] && run < 138)
            run++;
        unsigned symbol = length[i], extra = 0;
        if (symbol == 0 && run >= 3) {
            symbol = run < 11 ? 17 : 18;
            extra = run - (run < 11 ? 3 : 11);
        } else if (i > 0 && length[i - 1] == symbol && run >= 3) {
            run = run < 6 ? run : 6;
            symbol = 16;
            extra = run - 3;
        } else {
            run = 1;
        }
        c->symbol[c->count] = (uint8_t)symbol;
        c->extra[c->count++] = (uint8_t)extra;
        uses[symbol]++;
        i += run;
    }
    build_huffman(&c->huffman, uses, 19, MAX_LENGTH_BITS);
    c->lengths = 19;
    while (c->lengths > 4 && c->huffman.length[length_order[c->lengths - 1]] == 0)
        c->lengths--;
}

static void put_description(struct deflater *d, const struct code_lengths *c)
{
    put(d, c->literals - 257, 5);
    put(d, c->distances - 1, 5);
    put(d, c->lengths - 4, 4);
    for (unsigned i = 0; i < c->lengths; i++)
        put(d, c->huffman.length[length_order[i]], 3);
    for (unsigned i = 0; i < c->count; i++) {
        unsigned symbol = c->symbol[i];
        put(d, c->huffman.code[symbol], c->huffman.length[symbol]);
        put(d, c->extra[i], code_length_extra_bits(symbol));
    }
}

static void put_tokens(struct deflater *d, const struct huffman *literal,
                       const struct huffman *distance)
{
    for (size_t i = 0; i < d->token_count; i++) {
        unsigned length = d->tokens[i] >> 16, value = d->tokens[i] & 0xffff;
        if (length == 0) {
            put(d, literal->code[value], literal->length[value]);
            continue;
        }
        unsigned symbol = d->length_symbol[length];
        put(d, literal->code[257 + symbol], literal->length[257 + symbol]);
        put(d, length - d->length_base[symbol], length_extra_bits(symbol));
        symbol = distance_to_symbol(d, value);
        put(d, distance->code[symbol], distance->length[symbol]);
        put(d, value - d->distance_base[symbol], distance_extra_bits(symbol));
    }
    put(d, literal->code[END_OF_BLOCK], literal->length[END_OF_BLOCK]);
}

/* Writes the tokens gathered so far. */
static void end_block(struct deflater *d, bool last)
{
    struct huffman literal, distance;
    struct code_lengths lengths;
    d->literal_uses[END_OF_BLOCK] = 1;
    build_huffman(&literal, d->literal_uses, LITERALS, MAX_BITS);
    build_huffman(&distance, d->distance_uses, DISTANCES, MAX_BITS);
    describe_codes(&lengths, &literal, &distance);
    put(d, last, 1);
    put(d, 2, 2);
    put_description(d, &lengths);
    put_tokens(d, &literal, &distance);
    d->token_count = 0;
    memset(d->literal_uses, 0, sizeof d->literal_uses);
    memset(d->distance_uses, 0, sizeof d->distance_uses);
}

/* One more token; `end` is the input position after it. */
static void add_token(struct deflater *d, unsigned length, unsigned value, size_t end)
{
    d->tokens[d->token_count++] = length << 16 | value;
    if (length == 0) {
        d->literal_uses[value]++;
    } else {
        d->literal_uses[257 + d->length_symbol[length]]++;
        d->distance_uses[distance_to_symbol(d, value)]++;
    }
    if (d->token_count == BLOCK_TOKENS && end < d->size)
        end_block(d, false);
}

static uint32_t load32(const uint8_t *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* Where else the bytes at a position may stand: positions + 1, 0: none. */
struct candidates {
    uint32_t three;             /* the last with the same three bytes, unless hashes collide */
    uint32_t four;              /* the last with the same four; `previous` leads to the others */
};

/* Enters `at`, which has four bytes or more after it. */
static struct candidates insert(struct deflater *d, size_t at)
{
    uint32_t key = load32(d->in + at);
    uint32_t hash3 = (key & 0xffffff) * 2654435761u >> (32 - HASH_BITS);
    uint32_t hash4 = key * 2654435761u >> (32 - HASH_BITS);
    struct candidates c = {d->head3[hash3], d->head4[hash4]};
    d->head3[hash3] = d->head4[hash4] = (uint32_t)at + 1;
    d->previous[at % WINDOW] = c.four;
    return c;
}

static unsigned common_length(const uint8_t *a, const uint8_t *b, unsigned limit)
{
    unsigned n = 0;
    while (n + 8 <= limit) {
        uint64_t x, y;
        memcpy(&x, a + n, 8);
        memcpy(&y, b + n, 8);
        if (x != y)
            break;
        n += 8;
    }
    while (n < limit && a[n] == b[n])
        n++;
    return n;
}

/* The longest match for `at` that is longer than `best`; returns its length or `best`. */
static unsigned find_match(const struct deflater *d, size_t at, struct candidates c, unsigned best,
                           unsigned *distance)
{
    const uint8_t *here = d->in + at;
    size_t left = d->size - at;
    unsigned limit = left < MAX_MATCH ? (unsigned)left : MAX_MATCH;
    unsigned tries = best >= GOOD_MATCH ? CHAIN / 4 : CHAIN;
    if (best >= limit)
        return best;
    if (best < MIN_MATCH && c.three != 0 && at - (c.three - 1) <= NEAR_DISTANCE) {
        unsigned length = common_length(here, d->in + c.three - 1, limit);
        if (length >= MIN_MATCH) {
            best = length;
            *distance = (unsigned)(at - (c.three - 1));
        }
    }
    if (best < MIN_MATCH)
        best = MIN_MATCH;               /* chains are of four bytes; less is not worth looking at */
    uint32_t start = load32(here), candidate = c.four;
    while (candidate != 0 && tries-- > 0 && best < limit && best < NICE_MATCH) {
        size_t from = candidate - 1;
        if (at - from >= WINDOW)
            break;                      /* at WINDOW the chain's entry is already overwritten */
        const uint8_t *there = d->in + from;
        if (there[best] == here[best] && load32(there) == start) {
            unsigned length = common_length(here, there, limit);
            if (length > best) {
                best = length;
                *distance = (unsigned)(at - from);
            }
        }
        candidate = d->previous[from % WINDOW];
    }
    return best;
}

static void compress(struct deflater *d)
{
    unsigned waiting = 0, waiting_distance = 0;     /* match found at the position before `at` */
    bool has_literal = false;                       /* that position is not written yet */
    size_t at = 0;
    while (at < d->size) {
        unsigned length = 0, distance = 0;
        if (d->size - at >= CHAIN_BYTES) {
            struct candidates c = insert(d, at);
            if (waiting < LAZY_MATCH)
                length = find_match(d, at, c, waiting, &distance);
            if (distance == 0)
                length = 0;
        }
        if (waiting >= MIN_MATCH && length <= waiting) {
            /* The match of the last position stands; enter the positions it covers. */
            size_t end = at - 1 + waiting;
            for (at++; at < end; at++)
                if (d->size - at >= CHAIN_BYTES)
                    insert(d, at);
            add_token(d, waiting, waiting_distance - 1, end);
            waiting = 0;
            has_literal = false;
            continue;
        }
        if (has_literal)
            add_token(d, 0, d->in[at - 1], at);
        has_literal = true;
        waiting = length;
        waiting_distance = distance;
        at++;
    }
    /* A match cannot wait here: its second position would have been visited. */
    if (has_literal)
        add_token(d, 0, d->in[d->size - 1], d->size);
    end_block(d, true);
}

bool deflate_zlib(const uint8_t *bytes, size_t size, struct buffer *out)
{
    struct deflater *d = calloc(1, sizeof *d);
    if (d == NULL || size >= UINT32_MAX) {
        free(d);
        return false;
    }
    d->in = bytes;
    d->size = size;
    d->out = out;
    fill_symbol_tables(d);
    buffer_byte(out, 0x78);             /* deflate, window of 32 kB */
    buffer_byte(out, 0x9c);             /* default effort; makes the two bytes a multiple of 31 */
    compress(d);
    put(d, 0, (8 - d->hold_count) % 8);
    buffer_be32(out, adler32_update(1, bytes, size));
    free(d);
    return !out->failed;
}

/* SPDX-License-Identifier: MIT */
/* pixel_rows.c - the forms that are longer than their references. */
#include "kernels/pixel_rows.h"

/* ------------------------------------------------------------------ 16 bits, nearest levels */

#ifndef __OPTIMIZE_SIZE__
/* Returns two pixels of 16 bits as they lie in memory. */
static inline uint32_t pair_of(uint32_t first, uint32_t second)
{
#if SMEAR_BIG_ENDIAN
    return first << 16 | second;
#else
    return first | second << 16;
#endif
}

static inline void store_pair(uint16_t *out, uint32_t pair)
{
    __builtin_memcpy(__builtin_assume_aligned(out, 4), &pair, 4);
}

SMEAR_INLINE void nearest_pairs(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
    if (((uintptr_t)out & 2u) != 0 && n > 0) {
        *out++ = (uint16_t)nearest_16bit(*in++, format);
        n--;
    }
    if (n <= 0)
        return;
    uint32_t last = ~*in, packed = 0, pair = 0;
    const uint32_t *end = in + n, *end_of_pairs = end - 1, *end_of_sixes = end - 5;
    for (; in < end_of_pairs; in += 2, out += 2) {
        uint32_t a = in[0], b = in[1], first = packed;
        if (a != last) {
            first = nearest_16bit(a, format);
            packed = b == a ? first : nearest_16bit(b, format);
        } else if (b != last) {
            packed = nearest_16bit(b, format);
        } else {
            store_pair(out, pair);
            for (; in < end_of_sixes && in[2] == last && in[3] == last && in[4] == last && in[5] == last;
                 in += 4, out += 4) {
                store_pair(out + 2, pair);
                store_pair(out + 4, pair);
            }
            continue;
        }
        last = b;
        pair = pair_of(packed, packed);
        store_pair(out, pair_of(first, packed));
    }
    if (in < end)
        *out = (uint16_t)nearest_16bit(*in, format);
}

static SMEAR_NOINLINE void nearest_555(uint16_t *out, const uint32_t *in, int32_t n)
{
    nearest_pairs(out, in, n, ROW_555);
}

static SMEAR_NOINLINE void nearest_565(uint16_t *out, const uint32_t *in, int32_t n)
{
    nearest_pairs(out, in, n, ROW_565);
}

static SMEAR_NOINLINE void nearest_565_swapped(uint16_t *out, const uint32_t *in, int32_t n)
{
    nearest_pairs(out, in, n, ROW_565_SWAPPED);
}

void smear_row_nearest_unrolled(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
    if (SMEAR_WITH_RGB && format == ROW_555)
        nearest_555(out, in, n);
    else if (SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED)
        nearest_565_swapped(out, in, n);
    else if (SMEAR_WITH_RGB565)
        nearest_565(out, in, n);
}
#endif

/* ------------------------------------------------------------------ 16 bits, dithered */

#ifndef __OPTIMIZE_SIZE__
/* With thresholds 4 k + 2 of 256, six bits of a level's fraction tell all. Level and fraction of two channels fit into
 * a word, where one sum adds k to both; a column's step is k at both places. */
enum { ORDERED_HIGH = 20, ORDERED_LOW = 9, ORDERED_LEVEL = ORDERED_LOW + 6, ORDERED_WIDTH = 8 };

/* The last colour of a row, ready for steps. */
struct ordered {
    uint32_t last, red_blue, green;
};

/* ordered_two returns the levels of 31 of two codes, at ORDERED_HIGH and ORDERED_LOW; ordered_one that of one code, at
 * ORDERED_HIGH. */
#if defined(__ARM_ARCH_6M__)
/* They look levels up: constants of products would take registers that these cores do not have. */
static inline uint32_t ordered_two(uint32_t high, uint32_t low)
{
    return ((uint32_t)smear_levels_31[high] << (ORDERED_HIGH - ORDERED_LOW) | smear_levels_31[low]) << ORDERED_LOW;
}

static inline uint32_t ordered_one(uint32_t code)
{
    return (uint32_t)smear_levels_31[code] << ORDERED_HIGH;
}
#else
/* They compute c levels / 255 in q8 as c levels + ((c + (c >> 7)) levels >> 8), like level_q16(). */
static inline uint32_t ordered_two(uint32_t high, uint32_t low)
{
    uint32_t both = high << 16 | low;
    both = both * 31u + ((both + (both >> 7 & 0x10001u)) * 31u >> 8 & 0x1f001fu) + 0x20002u;
    return (both & 0xfffc0000u) << (ORDERED_HIGH - 18) | (both & 0xfffcu) << (ORDERED_LOW - 2);
}

static inline uint32_t ordered_one(uint32_t code)
{
    return (code * 31u + ((code + (code >> 7)) * 31u >> 8) + 2u) >> 2 << ORDERED_HIGH;
}
#endif

SMEAR_INLINE void ordered_pixel(uint16_t *out, uint32_t p, uint32_t step, struct ordered *o, bool is_555, bool swapped)
{
    if (p != o->last) {
        SMEAR_KEEP_BRANCH();
        o->last = p;
        o->red_blue = is_555 ? ordered_two(pixel_blue(p), pixel_red(p)) : ordered_two(pixel_red(p), pixel_blue(p));
        /* With 63 levels one product holds for all codes. */
        o->green = is_555 ? ordered_one(pixel_green(p))
                          : (pixel_green(p) * 16579962u + 508400u) >> ORDERED_HIGH << ORDERED_HIGH;
    }
    const uint32_t both = o->red_blue + step;
    const uint32_t packed = (is_555 ? (both >> (ORDERED_LEVEL + 1) & 0x7c00u) | (both >> ORDERED_LEVEL & 0x1fu)
                                    : both >> ORDERED_LEVEL & 0xf81fu)
                          | (o->green + step) >> (ORDERED_HIGH + 6) << 5;
    *out = swapped != SMEAR_BIG_ENDIAN ? __builtin_bswap16((uint16_t)packed) : (uint16_t)packed;
}

/* Stores the pixels [in, end). `step` has those of the columns from the first pixel on, ORDERED_WIDTH of them. */
SMEAR_INLINE void ordered_pixels(uint16_t *out, const uint32_t *in, const uint32_t *end, const uint32_t *step,
                                 bool is_555, bool swapped)
{
    struct ordered o = { in < end ? ~*in : 0, 0, 0 };
#if defined(__ARM_ARCH_6M__)        /* eight at a time, so that each step is loaded from a fixed place */
    for (; end - in >= ORDERED_WIDTH; in += ORDERED_WIDTH, out += ORDERED_WIDTH) {
        ordered_pixel(out, in[0], step[0], &o, is_555, swapped);
        ordered_pixel(out + 1, in[1], step[1], &o, is_555, swapped);
        ordered_pixel(out + 2, in[2], step[2], &o, is_555, swapped);
        ordered_pixel(out + 3, in[3], step[3], &o, is_555, swapped);
        ordered_pixel(out + 4, in[4], step[4], &o, is_555, swapped);
        ordered_pixel(out + 5, in[5], step[5], &o, is_555, swapped);
        ordered_pixel(out + 6, in[6], step[6], &o, is_555, swapped);
        ordered_pixel(out + 7, in[7], step[7], &o, is_555, swapped);
    }
#endif
    for (uint32_t i = 0; in < end; in++, i = (i + 1) % ORDERED_WIDTH)
        ordered_pixel(out++, *in, step[i], &o, is_555, swapped);
}

typedef void ordered_fn(uint16_t *out, const uint32_t *in, const uint32_t *end, const uint32_t *step);

static SMEAR_NOINLINE void ordered_555(uint16_t *out, const uint32_t *in, const uint32_t *end,
                                       const uint32_t *step)
{
    ordered_pixels(out, in, end, step, true, false);
}

static SMEAR_NOINLINE void ordered_565(uint16_t *out, const uint32_t *in, const uint32_t *end,
                                       const uint32_t *step)
{
    ordered_pixels(out, in, end, step, false, false);
}

static SMEAR_NOINLINE void ordered_565_swapped(uint16_t *out, const uint32_t *in, const uint32_t *end,
                                               const uint32_t *step)
{
    ordered_pixels(out, in, end, step, false, true);
}

static inline bool is_flat_block(const uint32_t *in)
{
    const uint32_t p = *in;
    return in[7] == p && in[1] == p && in[2] == p && in[3] == p && in[4] == p && in[5] == p && in[6] == p;
}

static inline void copy_block(uint16_t *out, const uint16_t *from)
{
    pixel_word *to = (pixel_word *)(void *)out;
    const pixel_word *words = (const pixel_word *)(const void *)from;
    to[0] = words[0];
    to[1] = words[1];
    to[2] = words[2];
    to[3] = words[3];
}

void smear_row_dithered_blocks(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                               enum row_16bit format)
{
    ordered_fn *const fn = SMEAR_WITH_RGB && format == ROW_555         ? ordered_555
                         : SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED ? ordered_565_swapped
                                                                          : ordered_565;
    uint32_t steps[2 * ORDERED_WIDTH], *step = steps + (x & (ORDERED_WIDTH - 1));
    const int32_t head = -x & (ORDERED_WIDTH - 1);
    for (uint32_t i = 0; i < ORDERED_WIDTH; i++)
        steps[i] = steps[i + ORDERED_WIDTH] = (uint32_t)(threshold[i] >> 2)
                                            * (1u << ORDERED_HIGH | 1u << ORDERED_LOW);
    const uint32_t *rest = in, *end = in + n;       /* from `rest` on nothing is done */
    if (((uintptr_t)(out + head) & 3u) == 0) {      /* blocks are copied in words */
        const uint16_t *kept = out;
        uint32_t last = n > 0 ? ~*in : 0;
        for (in += head, out += head; end - in >= ORDERED_WIDTH; in += ORDERED_WIDTH, out += ORDERED_WIDTH) {
            if (!is_flat_block(in))
                continue;
            if (*in != last) {
                last = *in;
                kept = out;
                continue;
            }
            if (rest != in)
                fn(out - (in - rest), rest, in, step);
            rest = in + ORDERED_WIDTH;
            step = steps;
            copy_block(out, kept);
        }
    }
    fn(out - (in - rest), rest, end, step);
}
#endif

/* ------------------------------------------------------------------ 16 bits, in lanes */

#if SMEAR_VECTORS && !defined(__OPTIMIZE_SIZE__)
static inline smear_v8u v8u_all(uint16_t a) { return (smear_v8u){ a, a, a, a, a, a, a, a }; }

/* Eight pixels: blue and red of four by turns, of the other four; green of all. */
struct lanes {
    smear_v8u low, high, green;
};

static inline struct lanes lanes_of(smear_v4u a, smear_v4u b)
{
    return (struct lanes){ (smear_v8u)(a & 0xff00ffu), (smear_v8u)(b & 0xff00ffu),
                           (smear_v8u)v4i_narrow((smear_v4i)(a >> 8 & 0xffu), (smear_v4i)(b >> 8 & 0xffu)) };
}

/* Levels become pixels. */
SMEAR_INLINE void lanes_store(uint16_t *out, struct lanes k, enum row_16bit format)
{
    const smear_v8i place = SMEAR_WITH_RGB && format == ROW_555 ? (smear_v8i){ 1024, 1, 1024, 1, 1024, 1, 1024, 1 }
                                                                : (smear_v8i){ 1, 2048, 1, 2048, 1, 2048, 1, 2048 };
    const smear_v4i low = v8i_dot((smear_v8i)k.low, place) << 16 >> 16;
    const smear_v4i high = v8i_dot((smear_v8i)k.high, place) << 16 >> 16;
    smear_v8u pixel = (smear_v8u)v4i_narrow(low, high) | k.green << 5;
    if ((format == ROW_565_SWAPPED) != SMEAR_BIG_ENDIAN)
        pixel = pixel << 8 | pixel >> 8;
    v8i_store(out, (smear_v8i)pixel);
}

static inline smear_v8u nearest_levels(smear_v8u code, uint16_t factor, uint16_t half, int shift)
{
    return (code * v8u_all(factor) + v8u_all(half)) >> shift;
}

SMEAR_INLINE void nearest_lanes(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
    const bool is_555 = SMEAR_WITH_RGB && format == ROW_555;
    for (; n >= 8; n -= 8, in += 8, out += 8) {
        struct lanes k = lanes_of(v4u_load(in), v4u_load(in + 4));
        k.low = nearest_levels(k.low, 249, 1014, 11);
        k.high = nearest_levels(k.high, 249, 1014, 11);
        k.green = is_555 ? nearest_levels(k.green, 249, 1014, 11) : nearest_levels(k.green, 253, 505, 10);
        lanes_store(out, k, format);
    }
    row_nearest_reference(out, in, n, format);
}

void smear_row_nearest_vector(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
    if (SMEAR_WITH_RGB && format == ROW_555)
        nearest_lanes(out, in, n, ROW_555);
    else if (SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED)
        nearest_lanes(out, in, n, ROW_565_SWAPPED);
    else if (SMEAR_WITH_RGB565)
        nearest_lanes(out, in, n, ROW_565);
}

/* level_q16 / 2^8 and a threshold, of which the upper byte is the level. */
static inline smear_v8u dithered_levels(smear_v8u code, uint16_t levels, smear_v8u threshold)
{
    const smear_v8u factor = v8u_all(levels);
    return (code * factor + ((code + (code >> 7)) * factor >> 8) + threshold) >> 8;
}

/* Thresholds of eight columns, in the order of lanes_of. */
static inline struct lanes lanes_of_thresholds(const uint8_t *t)
{
    const smear_v8i all = (smear_v8i){ t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7] };
    return (struct lanes){ (smear_v8u)v4i_twice_low(all), (smear_v8u)v4i_twice_high(all), (smear_v8u)all };
}

/* Blocks of eight columns whose first has a number that eight divides. A block of one colour looks like the last of its
 * colour where thresholds repeat. */
SMEAR_INLINE void dithered_lanes(uint16_t *out, const uint32_t *in, int32_t blocks, int32_t x, const uint8_t *threshold,
                                 int32_t mask, enum row_16bit format)
{
    const bool is_555 = SMEAR_WITH_RGB && format == ROW_555;
    struct lanes step = lanes_of_thresholds(threshold);
    smear_v4u last = v4u_all(0);
    const uint16_t *kept = NULL;                /* of the colour `last` */
    for (; blocks > 0; blocks--, in += 8, out += 8, x += 8) {
        const smear_v4u a = v4u_load(in), b = v4u_load(in + 4);
        const bool flat = !v4u_any((a ^ last) | (b ^ last));
        if (flat && kept != NULL) {
            __builtin_memcpy(out, kept, 16);
            continue;
        }
        if (mask != 7)
            step = lanes_of_thresholds(threshold + (x & mask));
        struct lanes k = lanes_of(a, b);
        k.low = dithered_levels(k.low, 31, step.low);
        k.high = dithered_levels(k.high, 31, step.high);
        k.green = dithered_levels(k.green, is_555 ? 31 : 63, step.green);
        lanes_store(out, k, format);
        if (!flat)
            last = v4u_all(in[7]);
        kept = flat && mask == 7 ? out : NULL;
    }
}

void smear_row_dithered_vector(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                               int32_t mask, enum row_16bit format)
{
    const int32_t head = min_i32(-x & 7, n), blocks = (n - head) >> 3, rest = (n - head) & 7;
    if (head != 0)
        row_dithered_reference(out, in, head, x, threshold, mask, format);
    out += head;
    in += head;
    x += head;
    if (SMEAR_WITH_RGB && format == ROW_555)
        dithered_lanes(out, in, blocks, x, threshold, mask, ROW_555);
    else if (SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED)
        dithered_lanes(out, in, blocks, x, threshold, mask, ROW_565_SWAPPED);
    else if (SMEAR_WITH_RGB565)
        dithered_lanes(out, in, blocks, x, threshold, mask, ROW_565);
    if (rest != 0)
        row_dithered_reference(out + 8 * blocks, in + 8 * blocks, rest, x + 8 * blocks, threshold, mask, format);
}
#endif

/* ------------------------------------------------------------------ L4 */

#ifndef __OPTIMIZE_SIZE__
/* Stores the two pixels of a byte. */
SMEAR_INLINE void l4_pair(uint8_t *out, const uint32_t *in, const uint32_t *step, uint32_t *last, uint32_t *grey,
                          bool dithered)
{
    const uint32_t left = in[0], right = in[1];
    if (left != *last)
        *grey = l4_grey(left, dithered);
    const uint32_t upper = (*grey + step[0]) >> 16 << 4;
    if (right != left)
        *grey = l4_grey(right, dithered);
    *last = right;
    *out = (uint8_t)(upper | (*grey + step[1]) >> 16);
}

void smear_row_l4_blocks(uint8_t *row, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold)
{
    const bool dithered = threshold != NULL;
    uint8_t *out = row + x / 2;
    uint32_t step[ORDERED_WIDTH], last = n > 0 ? ~*in : 0, grey = 0, flat = last;
    uint8_t block[ORDERED_WIDTH / 2] = { 0 };
    for (int i = 0; i < ORDERED_WIDTH; i++)
        step[i] = dithered ? (uint32_t)threshold[i] << 8 : 0;
    for (; n >= ORDERED_WIDTH; n -= ORDERED_WIDTH, in += ORDERED_WIDTH, out += sizeof block) {
        const bool is_flat = is_flat_block(in);
        if (is_flat && *in == flat) {
            __builtin_memcpy(out, block, sizeof block);
            continue;
        }
        for (int i = 0; i < ORDERED_WIDTH; i += 2)
            l4_pair(out + i / 2, in + i, step + i, &last, &grey, dithered);
        if (is_flat) {
            flat = *in;
            __builtin_memcpy(block, out, sizeof block);
        }
    }
    for (int32_t i = 0; i + 1 < n; i += 2)
        l4_pair(out + i / 2, in + i, step + i, &last, &grey, dithered);
    if ((n & 1) != 0)
        out[n / 2] = (uint8_t)((l4_grey(in[n - 1], dithered) + step[n - 1]) >> 16 << 4);
}
#endif

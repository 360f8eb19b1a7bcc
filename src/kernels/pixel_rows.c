/* SPDX-License-Identifier: MIT */
/* pixel_rows.c - the forms that are longer than their references. */
#include "kernels/pixel_rows.h"

#include "kernels/pixel_rows_arm.h"
#include "kernels/pixel_rows_armv6m.h"
#include "kernels/pixel_rows_armv7em.h"

/* ------------------------------------------------------------------ 16 bits, dithered */

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

enum { BLOCK = 8, BLOCK_PAIRS = BLOCK / 2 };

static inline bool is_flat_block(const uint32_t *in)
{
    const uint32_t p = *in;
    return in[7] == p && in[1] == p && in[2] == p && in[3] == p && in[4] == p && in[5] == p && in[6] == p;
}

/* One channel of two pixels fills a word, and a channel's level is (code factor + step) >> 11 of 31 levels, >> 10 of 63: with
 * thresholds of the form 4 k + 2, one even step for each k (smear_dither_steps) gives the levels of all codes, and half of it
 * those of 63. */
enum { DITHER_31 = 249, DITHER_63 = 253 };

#if !SMEAR_ASM_ARMV6M && !SMEAR_ASM_ARMV7EM
/* Exchanges the bytes of each half. */
static inline uint32_t bytes_exchanged(uint32_t pair)
{
#if SMEAR_GNU && defined(__arm__) && __ARM_ARCH >= 6
    __asm__("rev16 %0, %0" : "+l"(pair));
    return pair;
#else
    return (pair >> 8 & 0xff00ffu) | (pair & 0xff00ffu) << 8;
#endif
}

/* Returns two pixels, by factors that the compiler takes as they are: it would make sums of DITHER_31 and DITHER_63. */
SMEAR_INLINE uint32_t dithered_pair(uint32_t p, uint32_t q, uint32_t step, uint32_t by_31, uint32_t by_63, bool is_555, bool swapped)
{
    const uint32_t five = 0xf800f800u, bytes = 0x00ff00ffu;
    const uint32_t lower = pair_of(p & 0xffffu, q & 0xffffu), upper = pair_of(p >> 16, q >> 16);
    const uint32_t red = (upper & bytes) * by_31 + step, blue = (lower & bytes) * by_31 + step, green = lower >> 8 & bytes;
    const uint32_t high = is_555 ? blue : red, low = is_555 ? red : blue;
    const uint32_t pair = is_555 ? (high & five) >> 1 | ((green * by_31 + step) & five) >> 6 | (low & five) >> 11
                                 : (high & five) | ((green * by_63 + (step >> 1)) & 0xfc00fc00u) >> 5 | (low & five) >> 11;
    return swapped != SMEAR_BIG_ENDIAN ? bytes_exchanged(pair) : pair;
}

/* Stores blocks of eight pixels; `out` is at a multiple of four bytes. A block of one colour looks like the last one of one
 * colour, where that is the same. */
SMEAR_INLINE void dithered_blocks(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t step[BLOCK_PAIRS],
                                  bool is_555, bool swapped)
{
    static const pixel_word black[BLOCK_PAIRS] = { 0 };
    pixel_word *to = (pixel_word *)(void *)out;
    const pixel_word *kept = black;
    uint32_t flat = 0, by_31 = DITHER_31, by_63 = DITHER_63;
    SMEAR_KEEP_VALUE(by_31);
    SMEAR_KEEP_VALUE(by_63);
    for (; blocks > 0; blocks--, in += BLOCK, to += BLOCK_PAIRS) {
        const bool is_flat = is_flat_block(in);
        if (is_flat && *in == flat) {
            to[0] = kept[0];
            to[1] = kept[1];
            to[2] = kept[2];
            to[3] = kept[3];
            continue;
        }
        to[0] = dithered_pair(in[0], in[1], step[0], by_31, by_63, is_555, swapped);
        to[1] = dithered_pair(in[2], in[3], step[1], by_31, by_63, is_555, swapped);
        to[2] = dithered_pair(in[4], in[5], step[2], by_31, by_63, is_555, swapped);
        to[3] = dithered_pair(in[6], in[7], step[3], by_31, by_63, is_555, swapped);
        if (is_flat) {
            flat = *in;
            kept = to;
        }
    }
}
#endif

#if SMEAR_ASM_ARM
static SMEAR_NOINLINE void blocks_555_arm(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step)
{
    dithered_blocks_arm(out, in, blocks, step);
}
#endif

SMEAR_INLINE void dithered_blocks_of(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step, bool is_555,
                                     bool swapped)
{
#if SMEAR_ASM_ARMV6M
    dithered_blocks_armv6m(out, in, blocks, step, is_555, swapped);
#elif SMEAR_ASM_ARMV7EM
    dithered_blocks_armv7em(out, in, blocks, step, is_555, swapped);
#else
#if SMEAR_ASM_ARM
    if (is_555) {
        blocks_555_arm(out, in, blocks, step);
        return;
    }
#endif
    dithered_blocks(out, in, blocks, step, is_555, swapped);
#endif
}

typedef void blocks_fn(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step);

static SMEAR_NOINLINE void blocks_555(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step)
{
    dithered_blocks_of(out, in, blocks, step, true, false);
}

static SMEAR_NOINLINE void blocks_565(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step)
{
    dithered_blocks_of(out, in, blocks, step, false, false);
}

static SMEAR_NOINLINE void blocks_565_swapped(uint16_t *out, const uint32_t *in, int32_t blocks, const uint32_t *step)
{
    dithered_blocks_of(out, in, blocks, step, false, true);
}

static inline blocks_fn *blocks_of(enum row_16bit format)
{
    return SMEAR_WITH_RGB && format == ROW_555            ? blocks_555
         : SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED ? blocks_565_swapped
                                                          : blocks_565;
}

/* Few pixels, at the ends of a row. */
static SMEAR_NOINLINE void dithered_ends(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                                         enum row_16bit format)
{
    row_dithered_reference(out, in, n, x, threshold, BLOCK - 1, format);
}

/* The steps of two columns. */
static inline uint32_t steps_of(const uint8_t *threshold, int32_t x)
{
    return pair_of(smear_dither_steps[threshold[x & 7] >> 2], smear_dither_steps[threshold[(x + 1) & 7] >> 2]);
}

void smear_row_dithered_blocks(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold,
                               enum row_16bit format)
{
    blocks_fn *const fn = blocks_of(format);
    const int32_t head = min_i32((int32_t)((uintptr_t)out >> 1 & 1u), n), blocks = (n - head) / BLOCK;
    if (head != 0)
        dithered_ends(out, in, head, x, threshold, format);
    out += head;
    in += head;
    x += head;
    if (blocks > 0) {
        const uint32_t step[BLOCK_PAIRS] = { steps_of(threshold, x), steps_of(threshold, x + 2), steps_of(threshold, x + 4),
                                             steps_of(threshold, x + 6) };
        fn(out, in, blocks, step);
    }
    const int32_t done = BLOCK * blocks;
    if (n - head > done)
        dithered_ends(out + done, in + done, n - head - done, x + done, threshold, format);
}

void smear_rows_dithered_blocks(const struct dithered_rows *r, enum row_16bit format)
{
    blocks_fn *const fn = blocks_of(format);
    const int32_t blocks = r->n / BLOCK;
    uint16_t *out = r->out;
    const uint32_t *in = r->in;
    for (int32_t y = r->y; blocks > 0 && y < r->y + r->rows; y++, out += r->out_stride, in += r->in_stride) {
        const uint32_t *step = smear_dither_pairs + (y & 7) * BLOCK_PAIRS;
#if SMEAR_BIG_ENDIAN
        const uint32_t turned[BLOCK_PAIRS] = { pair_of(step[0] & 0xffffu, step[0] >> 16), pair_of(step[1] & 0xffffu, step[1] >> 16),
                                               pair_of(step[2] & 0xffffu, step[2] >> 16), pair_of(step[3] & 0xffffu, step[3] >> 16) };
        step = turned;
#endif
#if SMEAR_ASM_ARM
        if (SMEAR_WITH_RGB && format == ROW_555) {
            blocks_555_arm(out, in, blocks, step);
            continue;
        }
#endif
        fn(out, in, blocks, step);
    }
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

/* What eight columns add: thresholds in the order of lanes_of, or the steps of such as are 4 k + 2, or what rounds to the nearest level
 * where there are none. */
SMEAR_INLINE struct lanes lanes_of_thresholds(const uint8_t *t, int32_t mask, bool is_555)
{
    smear_v8u all = v8u_all(1014);
    for (int i = 0; i < 8 && t != NULL; i++)
        all[i] = mask == 7 ? smear_dither_steps[t[i] >> 2] : t[i];
    return (struct lanes){ (smear_v8u)v4i_twice_low((smear_v8i)all), (smear_v8u)v4i_twice_high((smear_v8i)all),
                           mask != 7 || is_555 ? all : t == NULL ? v8u_all(505) : all >> 1 };
}

/* Levels of codes: by a step, or by any threshold, level_q16 / 2^8 and that, of which the upper byte is the level. */
SMEAR_INLINE smear_v8u lanes_levels(smear_v8u code, smear_v8u step, bool is_63, bool steps)
{
    if (steps)
        return is_63 ? (code * v8u_all(DITHER_63) + step) >> 10 : (code * v8u_all(DITHER_31) + step) >> 11;
    const smear_v8u factor = v8u_all(is_63 ? 63 : 31);
    return (code * factor + ((code + (code >> 7)) * factor >> 8) + step) >> 8;
}

/* Blocks of eight columns whose first has a number that eight divides. A block of one colour looks like the last of its
 * colour where thresholds repeat. */
SMEAR_INLINE void lanes_rows(uint16_t *out, const uint32_t *in, int32_t blocks, int32_t x, const uint8_t *threshold,
                             int32_t mask, enum row_16bit format)
{
    const bool is_555 = SMEAR_WITH_RGB && format == ROW_555, steps = mask == 7;
    struct lanes step = lanes_of_thresholds(threshold, mask, is_555);
    smear_v4u last = v4u_all(0);
    const uint16_t *kept = NULL;                /* of the colour `last` */
    for (; blocks > 0; blocks--, in += 8, out += 8, x += 8) {
        const smear_v4u a = v4u_load(in), b = v4u_load(in + 4);
        const bool flat = !v4u_any((a ^ last) | (b ^ last));
        if (flat && kept != NULL) {
            __builtin_memcpy(out, kept, 16);
            continue;
        }
        if (!steps)
            step = lanes_of_thresholds(threshold + (x & mask), mask, is_555);
        struct lanes k = lanes_of(a, b);
        k.low = lanes_levels(k.low, step.low, false, steps);
        k.high = lanes_levels(k.high, step.high, false, steps);
        k.green = lanes_levels(k.green, step.green, !is_555, steps);
        lanes_store(out, k, format);
        if (!flat)
            last = v4u_all(in[7]);
        kept = flat && steps ? out : NULL;
    }
}

SMEAR_INLINE void lanes_rows_of(uint16_t *out, const uint32_t *in, int32_t blocks, int32_t x, const uint8_t *threshold, int32_t mask,
                                enum row_16bit format)
{
    if (SMEAR_WITH_RGB && format == ROW_555)
        lanes_rows(out, in, blocks, x, threshold, mask, ROW_555);
    else if (SMEAR_WITH_RGB565 && format == ROW_565_SWAPPED)
        lanes_rows(out, in, blocks, x, threshold, mask, ROW_565_SWAPPED);
    else if (SMEAR_WITH_RGB565)
        lanes_rows(out, in, blocks, x, threshold, mask, ROW_565);
}

void smear_row_nearest_vector(uint16_t *out, const uint32_t *in, int32_t n, enum row_16bit format)
{
    lanes_rows_of(out, in, n >> 3, 0, NULL, 7, format);
    row_nearest_reference(out + (n & ~7), in + (n & ~7), n & 7, format);
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
    if (mask == 7)
        lanes_rows_of(out, in, blocks, x, threshold, 7, format);
    else
        lanes_rows_of(out, in, blocks, x, threshold, mask, format);
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

/* Black is the first colour: its levels are 0. */
void smear_row_l4_blocks(uint8_t *row, const uint32_t *in, int32_t n, int32_t x, const uint8_t *threshold)
{
    const bool dithered = threshold != NULL;
    uint8_t *out = row + x / 2;
    uint32_t step[BLOCK], last = 0, grey = 0, flat = 0;
    uint8_t block[BLOCK / 2] = { 0 };
    for (int i = 0; i < BLOCK; i++)
        step[i] = dithered ? (uint32_t)threshold[i] << 8 : 0;
    for (; n >= BLOCK; n -= BLOCK, in += BLOCK, out += sizeof block) {
        const bool is_flat = is_flat_block(in);
        if (is_flat && *in == flat) {
            __builtin_memcpy(out, block, sizeof block);
            continue;
        }
        for (int i = 0; i < BLOCK; i += 2)
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

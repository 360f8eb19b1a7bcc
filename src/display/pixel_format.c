/* SPDX-License-Identifier: MIT */
/* pixel_format.c - rounding and dither to the display's formats.
 *
 * Undithered levels are the nearest: 5 bits (249 c + 1014) >> 11, 6 bits (253 c + 505) >> 10, both exact for
 * every code. Dithered levels are floor(c levels / 255 + threshold): white stays white and black black. */
#include "display/pixel_format.h"

#include "base/pixel.h"
#include "base/vector.h"

bool smear_format_has(int format, int dither)
{
    static const bool has[] = {
        SMEAR_WITH_XRGB8888, SMEAR_WITH_RGB565, SMEAR_WITH_RGB565, SMEAR_WITH_RGB555, SMEAR_WITH_RGB332,
        SMEAR_WITH_L8, SMEAR_WITH_L4, SMEAR_WITH_L1, SMEAR_WITH_L1
    };
    if (format > SMEAR_L1_PAGES || dither > SMEAR_DITHER_BLUE || !has[format])
        return false;
    return format == SMEAR_XRGB8888 || format == SMEAR_L8 || dither == SMEAR_DITHER_NONE
        || (dither == SMEAR_DITHER_BLUE ? SMEAR_WITH_BLUE_DITHER : SMEAR_WITH_DITHER);
}

uint32_t smear_format_stride(int32_t width, smear_format format)
{
    uint32_t w = (uint32_t)width;
    switch (format) {
    case SMEAR_XRGB8888: return w * 4;
    case SMEAR_RGB565:
    case SMEAR_RGB565_SWAPPED:
    case SMEAR_RGB555: return w * 2;
    case SMEAR_L4: return (w + 1) / 2;
    case SMEAR_L1: return (w + 7) / 8;
    default: return w;
    }
}

uint32_t smear_format_size(int32_t width, int32_t rows, smear_format format)
{
    uint32_t lines = (uint32_t)rows;
    if (format == SMEAR_L1_PAGES)
        lines = (lines + 7) / 8;
    return smear_format_stride(width, format) * lines;
}

/* 0 .. 255 in steps of 1/256 of a level. */
static inline uint32_t threshold_at(int32_t x, int32_t y, smear_dither dither)
{
    return !SMEAR_WITH_BLUE_DITHER || dither == SMEAR_DITHER_ORDERED
             ? smear_dither_ordered[(y & 7) << 3 | (x & 7)]
             : smear_dither_blue[(y & 31) << 5 | (x & 31)];
}

static inline bool is_dithered(smear_dither dither)
{
    return SMEAR_WITH_DITHER && dither != SMEAR_DITHER_NONE;
}

/* floor(c levels / 255 + t / 256): c 257 / 65536 is c / 255 for
 * all that matters here, and exactly 1 at 255. */
static inline uint32_t level_dithered(uint32_t code, uint32_t levels, uint32_t t)
{
    return (code * 257u * levels + (code >> 7) * levels + (t << 8)) >> 16;
}

static inline uint32_t level_nearest(uint32_t code, uint32_t levels)
{
    return (code * levels * 2u + 255u) / 510u;
}

/* Luma of codes, BT.601 weights as display code expects them: (77 r + 150 g + 29 b) / 256. */
static inline uint32_t luma(uint32_t p)
{
    return (77u * pixel_red(p) + 150u * pixel_green(p) + 29u * pixel_blue(p) + 128u) >> 8;
}

static void rgb_levels(uint32_t p, int32_t x, int32_t y, smear_dither dither, uint32_t out[3],
                       const uint32_t levels[3])
{
    const uint32_t code[3] = { pixel_red(p), pixel_green(p), pixel_blue(p) };
    uint32_t t = is_dithered(dither) ? threshold_at(x, y, dither) : 0;
    for (int i = 0; i < 3; i++)
        out[i] = is_dithered(dither) ? level_dithered(code[i], levels[i], t)
                                     : level_nearest(code[i], levels[i]);
}

static inline uint32_t rgb565_bytes(uint32_t p, bool swapped)
{
    uint32_t packed = rgb565_nearest(p);
    return swapped ? packed >> 8 | (packed << 8 & 0xff00u) : packed;
}

void smear_format_swap(uint16_t *pixels, int32_t n)
{
    for (; n > 0; n--, pixels++)
        *pixels = (uint16_t)(*pixels >> 8 | *pixels << 8);
}

#ifdef __OPTIMIZE_SIZE__
static void row_rgb565(uint16_t *out, const uint32_t *in, int32_t n, bool swapped)
{
    while (n-- > 0)
        *out++ = (uint16_t)rgb565_bytes(*in++, swapped);
}
#else
/* Two pixels of 16 bits as they lie in memory. */
static inline uint32_t pair_of(uint32_t first, uint32_t second)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return first << 16 | second;
#else
    return first | second << 16;
#endif
}

static inline void store_pair(uint16_t *out, uint32_t pair)
{
    __builtin_memcpy(__builtin_assume_aligned(out, 4), &pair, 4);
}

/* Flat areas are long: pairs of pixels that stay as they were cost
 * a comparison. Rows are aligned to a pixel. */
SMEAR_INLINE void row_rgb565(uint16_t *out, const uint32_t *in, int32_t n, bool swapped)
{
    if (((uintptr_t)out & 2u) != 0 && n > 0) {
        *out++ = (uint16_t)rgb565_bytes(*in++, swapped);
        n--;
    }
    if (n <= 0)
        return;
    uint32_t last = ~*in, packed = 0, pair = 0;
    const uint32_t *end = in + n, *end_of_pairs = end - 1, *end_of_sixes = end - 5;
    for (; in < end_of_pairs; in += 2, out += 2) {
        uint32_t a = in[0], b = in[1], first = packed;
        if (a != last) {
            first = rgb565_bytes(a, swapped);
            packed = b == a ? first : rgb565_bytes(b, swapped);
        } else if (b != last) {
            packed = rgb565_bytes(b, swapped);
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
        *out = (uint16_t)rgb565_bytes(*in, swapped);
}
#endif

/* `swapped` as the display has it. */
static void row_rgb565_any(uint16_t *out, const uint32_t *in, int32_t n, bool swapped)
{
    const bool big = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    if (swapped != big)
        row_rgb565(out, in, n, true);
    else
        row_rgb565(out, in, n, false);
}

/* Thresholds of row y in 1/256 of a level: threshold[x & mask]. */
static inline const uint8_t *thresholds_of(int32_t y, smear_dither dither, int32_t *mask)
{
    if (SMEAR_WITH_BLUE_DITHER && dither == SMEAR_DITHER_BLUE) {
        *mask = 31;
        return smear_dither_blue + ((y & 31) << 5);
    }
    *mask = 7;
    return smear_dither_ordered + ((y & 7) << 3);
}

/* A code's level in q16, without a threshold: level_dithered adds it. */
static inline uint32_t level_q16(uint32_t code, uint32_t levels)
{
    return code * (257u * levels) + (code >> 7) * levels;
}

/* Blue over green over red of 5 bits each (`is_555`), or red over green over blue of 5, 6, 5. Runs
 * of one colour: only thresholds differ then. */
static void dither_16bit(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, int32_t y,
                         smear_dither dither, bool is_555, bool swapped)
{
    int32_t mask;
    const uint8_t *threshold = thresholds_of(y, dither, &mask);
    uint32_t last = n > 0 ? ~*in : 0, high = 0, green = 0, low = 0;
    for (; n > 0; n--, in++) {
        if (*in != last) {
            last = *in;
            high = level_q16(is_555 ? pixel_blue(last) : pixel_red(last), 31);
            green = level_q16(pixel_green(last), is_555 ? 31 : 63);
            low = level_q16(is_555 ? pixel_red(last) : pixel_blue(last), 31);
        }
        uint32_t t = (uint32_t)threshold[x++ & mask] << 8;
        uint32_t packed = ((high + t) >> 16) << (is_555 ? 10 : 11) | ((green + t) >> 11 & 0x7e0u)
                        | (low + t) >> 16;
        *out++ = (uint16_t)(swapped ? packed >> 8 | packed << 8 : packed);
    }
}

#ifndef __OPTIMIZE_SIZE__
/* Ordered thresholds are 4 k + 2, of 256: six bits of a level's fraction are enough, and level and fraction
 * of two channels fit into a word, where one sum adds k to both. A column's step is k at both places. */
enum { ORDERED_HIGH = 20, ORDERED_LOW = 9, ORDERED_LEVEL = ORDERED_LOW + 6, ORDERED_WIDTH = 8 };

/* The last colour of a row, ready for steps. */
struct ordered {
    uint32_t last, red_blue, green;
};

/* c levels / 255 in q8 is c levels + ((c + (c >> 7)) levels >> 8), as level_dithered() has it. */
SMEAR_INLINE void ordered_pixel(uint16_t *out, uint32_t p, uint32_t add, struct ordered *o, bool is_555,
                                bool swapped)
{
    if (p != o->last) {
        __asm__ volatile ("");      /* one branch: nothing of this is done for nothing */
        const uint32_t high = is_555 ? pixel_blue(p) : pixel_red(p), low = is_555 ? pixel_red(p) : pixel_blue(p);
        o->last = p;
#if defined(__ARM_ARCH_6M__)
        o->red_blue = ((uint32_t)smear_levels_31[high] << (ORDERED_HIGH - ORDERED_LOW) | smear_levels_31[low])
                   << ORDERED_LOW;
        const uint32_t green = is_555 ? (uint32_t)smear_levels_31[pixel_green(p)] << ORDERED_HIGH : 0;
#else
        uint32_t both = high << 16 | low, green = pixel_green(p);
        both = both * 31u + ((both + (both >> 7 & 0x10001u)) * 31u >> 8 & 0x1f001fu) + 0x20002u;
        o->red_blue = (both & 0xfffc0000u) << (ORDERED_HIGH - 18) | (both & 0xfffcu) << (ORDERED_LOW - 2);
        green = (green * 31u + ((green + (green >> 7)) * 31u >> 8) + 2u) >> 2 << ORDERED_HIGH;
#endif
        /* of 63, one product has it for all codes */
        o->green = is_555 ? green : (pixel_green(p) * 16579962u + 508400u) >> ORDERED_HIGH << ORDERED_HIGH;
    }
    const uint32_t both = o->red_blue + add;
    const uint32_t packed = (is_555 ? (both >> (ORDERED_LEVEL + 1) & 0x7c00u) | (both >> ORDERED_LEVEL & 0x1fu)
                                    : both >> ORDERED_LEVEL & 0xf81fu)
                          | (o->green + add) >> (ORDERED_HIGH + 6) << 5;
    *out = swapped ? __builtin_bswap16((uint16_t)packed) : (uint16_t)packed;
}

/* Pixels [in, end). Steps are those of the columns from the first pixel on, ORDERED_WIDTH of them. */
SMEAR_INLINE void ordered_16bit(uint16_t *out, const uint32_t *in, const uint32_t *end, const uint32_t *step,
                                bool is_555, bool swapped)
{
    struct ordered o = { in < end ? ~*in : 0, 0, 0 };
#if defined(__ARM_ARCH_6M__)        /* with few registers, a place of its own for each step */
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
    ordered_16bit(out, in, end, step, true, __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
}

static SMEAR_NOINLINE void ordered_565(uint16_t *out, const uint32_t *in, const uint32_t *end,
                                       const uint32_t *step)
{
    ordered_16bit(out, in, end, step, false, __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
}

static SMEAR_NOINLINE void ordered_565_swapped(uint16_t *out, const uint32_t *in, const uint32_t *end,
                                               const uint32_t *step)
{
    ordered_16bit(out, in, end, step, false, __BYTE_ORDER__ != __ORDER_BIG_ENDIAN__);
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

/* Neighbours often are of one colour: a flat block of columns looks like the last of its
 * colour in this row. Rows are aligned to a pixel. */
static SMEAR_NOINLINE void row_ordered(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, int32_t y,
                                       ordered_fn *fn)
{
    uint32_t steps[2 * ORDERED_WIDTH], *step = steps + (x & (ORDERED_WIDTH - 1));
    const uint8_t *threshold = smear_dither_ordered + ((y & 7) << 3);
    const int32_t head = -x & (ORDERED_WIDTH - 1);
    for (uint32_t i = 0; i < ORDERED_WIDTH; i++)
        steps[i] = steps[i + ORDERED_WIDTH] = (uint32_t)(threshold[i] >> 2)
                                            * (1u << ORDERED_HIGH | 1u << ORDERED_LOW);
    const uint32_t *rest = in, *end = in + n;       /* from `rest` on nothing is done */
    if (((uintptr_t)(out + head) & 3u) == 0) {
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

static void row_16bit(uint16_t *out, const uint32_t *in, int32_t n, int32_t x, int32_t y, smear_format format,
                      smear_dither dither)
{
    const bool big = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__,
               swapped = (format == SMEAR_RGB565_SWAPPED) != big;
    const bool is_555 = SMEAR_WITH_RGB555 && format == SMEAR_RGB555;
    if (!is_dithered(dither)) {
        for (int32_t i = 0; SMEAR_WITH_RGB555 && i < n; i++) {
            uint32_t p = in[i], packed = level_nearest(pixel_blue(p), 31) << 10
                                       | level_nearest(pixel_green(p), 31) << 5
                                       | level_nearest(pixel_red(p), 31);
            out[i] = (uint16_t)(swapped ? packed >> 8 | packed << 8 : packed);
        }
        return;
    }
#ifndef __OPTIMIZE_SIZE__
    if (!SMEAR_WITH_BLUE_DITHER || dither == SMEAR_DITHER_ORDERED) {
        row_ordered(out, in, n, x, y,
                    is_555                                                ? ordered_555
                    : SMEAR_WITH_RGB565 && format == SMEAR_RGB565_SWAPPED ? ordered_565_swapped
                                                                          : ordered_565);
        return;
    }
#endif
    dither_16bit(out, in, n, x, y, dither, is_555, swapped);
}

static uint32_t grey_level(uint32_t p, int32_t x, int32_t y, uint32_t levels, smear_dither dither)
{
    return is_dithered(dither) ? level_dithered(luma(p), levels, threshold_at(x, y, dither))
                               : level_nearest(luma(p), levels);
}

static void row_xrgb8888(uint32_t *out, const uint32_t *in, int32_t n)
{
    int32_t i = 0;
#if SMEAR_VECTORS
    for (; i + 4 <= n; i += 4)
        v4u_store(out + i, v4u_load(in + i) & 0xffffffu);
#endif
    for (; i < n; i++)
        out[i] = in[i] & 0xffffffu;
}

static void row_rgb332(uint8_t *out, const uint32_t *in, int32_t n, int32_t x, int32_t y, smear_dither dither)
{
    static const uint32_t levels[3] = { 7, 7, 3 };
    for (int32_t i = 0; i < n; i++) {
        uint32_t c[3];
        rgb_levels(in[i], x + i, y, dither, c, levels);
        out[i] = (uint8_t)(c[0] << 5 | c[1] << 2 | c[2]);
    }
}

static void row_l8(uint8_t *out, const uint32_t *in, int32_t n)
{
    for (int32_t i = 0; i < n; i++)
        out[i] = (uint8_t)luma(in[i]);
}

static inline uint32_t grey_q16(uint32_t p, bool dithered)
{
    return dithered ? level_q16(luma(p), 15) : level_nearest(luma(p), 15) << 16;
}

#ifndef __OPTIMIZE_SIZE__
/* Two pixels of a byte. */
SMEAR_INLINE void l4_pair(uint8_t *out, const uint32_t *in, const uint32_t *step, uint32_t *last, uint32_t *grey,
                          bool dithered)
{
    const uint32_t left = in[0], right = in[1];
    if (left != *last)
        *grey = grey_q16(left, dithered);
    const uint32_t upper = (*grey + step[0]) >> 16 << 4;
    if (right != left)
        *grey = grey_q16(right, dithered);
    *last = right;
    *out = (uint8_t)(upper | (*grey + step[1]) >> 16);
}

/* Ordered dither, or none; x is a multiple of eight. A flat block of columns looks like the last one of its colour. */
static SMEAR_NOINLINE void row_l4_blocks(uint8_t *out, const uint32_t *in, int32_t n, int32_t y, bool dithered)
{
    uint32_t step[ORDERED_WIDTH], last = ~*in, grey = 0, flat = last;
    uint8_t block[ORDERED_WIDTH / 2] = { 0 };
    for (int i = 0; i < ORDERED_WIDTH; i++)
        step[i] = dithered ? (uint32_t)smear_dither_ordered[(y & 7) << 3 | i] << 8 : 0;
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
        out[n / 2] = (uint8_t)((grey_q16(in[n - 1], dithered) + step[n - 1]) >> 16 << 4);
}
#endif

static void row_l4(uint8_t *row, const uint32_t *in, int32_t n, int32_t x, int32_t y, smear_dither dither)
{
    int32_t mask;
    const bool dithered = is_dithered(dither);
#ifndef __OPTIMIZE_SIZE__
    if (n > 0 && (!SMEAR_WITH_BLUE_DITHER || dither != SMEAR_DITHER_BLUE)) {
        row_l4_blocks(row + x / 2, in, n, y, dithered);
        return;
    }
#endif
    const uint8_t *threshold = thresholds_of(y, dither, &mask);
    uint32_t last = ~*in, grey = 0, left = 0;
    uint8_t *pair = row + x / 2;
    for (int32_t i = 0; i < n; i++) {
        if (in[i] != last) {
            last = in[i];
            grey = grey_q16(last, dithered);
        }
        uint32_t level = (grey + (dithered ? (uint32_t)threshold[(x + i) & mask] << 8 : 0u)) >> 16;
        if (((x + i) & 1) != 0) {
            *pair++ = (uint8_t)(left | level);
        } else {
            left = level << 4;
            *pair = (uint8_t)left;
        }
    }
}

static void row_l1(uint8_t *row, const uint32_t *in, int32_t n, int32_t x, int32_t y, smear_dither dither)
{
    for (int32_t i = 0; i < n; i++) {
        uint8_t *byte = row + (x + i) / 8;
        if (((x + i) & 7) == 0)
            *byte = 0;
        if (grey_level(in[i], x + i, y, 1, dither) != 0)
            *byte = (uint8_t)(*byte | 0x80 >> ((x + i) & 7));
    }
}

static void row_page(uint8_t *page, const uint32_t *in, int32_t n, int32_t x, int32_t y, int bit,
                     smear_dither dither)
{
    for (int32_t i = 0; i < n; i++)
        if (grey_level(in[i], x + i, y, 1, dither) != 0)
            page[x + i] = (uint8_t)(page[x + i] | 1 << bit);
}

void smear_format_row(uint8_t *band, uint32_t stride, const uint32_t *in, int32_t n, int32_t x, int32_t y,
                       int32_t y0, smear_format format, smear_dither dither)
{
    uint8_t *row = band + (uint32_t)(y - y0) * stride;
    if (SMEAR_WITH_XRGB8888 && format == SMEAR_XRGB8888)
        row_xrgb8888((uint32_t *)(void *)row + x, in, n);
    else if (SMEAR_WITH_RGB565 && (format == SMEAR_RGB565 || format == SMEAR_RGB565_SWAPPED)
             && !is_dithered(dither))
        row_rgb565_any((uint16_t *)(void *)row + x, in, n, format == SMEAR_RGB565_SWAPPED);
    else if ((SMEAR_WITH_RGB565 && SMEAR_WITH_DITHER
              && (format == SMEAR_RGB565 || format == SMEAR_RGB565_SWAPPED))
             || (SMEAR_WITH_RGB555 && format == SMEAR_RGB555))
        row_16bit((uint16_t *)(void *)row + x, in, n, x, y, format, dither);
    else if (SMEAR_WITH_RGB332 && format == SMEAR_RGB332)
        row_rgb332(row + x, in, n, x, y, dither);
    else if (SMEAR_WITH_L8 && format == SMEAR_L8)
        row_l8(row + x, in, n);
    else if (SMEAR_WITH_L4 && format == SMEAR_L4)
        row_l4(row, in, n, x, y, dither);
    else if (SMEAR_WITH_L1 && format == SMEAR_L1)
        row_l1(row, in, n, x, y, dither);
    else if (SMEAR_WITH_L1 && format == SMEAR_L1_PAGES)
        row_page(band + (uint32_t)((y - y0) / 8) * stride, in, n, x, y, (y - y0) & 7, dither);
}

uint32_t smear_crc32(uint32_t crc, const uint8_t *bytes, uint32_t size)
{
    /* Four bits at a time: a table of 16 words, and no 64-bit or table start-up anywhere. */
    static const uint32_t nibble[16] = {
        0x00000000u, 0x1db71064u, 0x3b6e20c8u, 0x26d930acu, 0x76dc4190u, 0x6b6b51f4u, 0x4db26158u,
        0x5005713cu, 0xedb88320u, 0xf00f9344u, 0xd6d6a3e8u, 0xcb61b38cu, 0x9b64c2b0u, 0x86d3d2d4u,
        0xa00ae278u, 0xbdbdf21cu
    };
    crc = ~crc;
    for (; size > 0; size--) {
        crc ^= *bytes++;
        crc = crc >> 4 ^ nibble[crc & 15u];
        crc = crc >> 4 ^ nibble[crc & 15u];
    }
    return ~crc;
}

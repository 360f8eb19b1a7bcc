/* SPDX-License-Identifier: MIT */
/* test_convert.c - every display format against a direct formula; dither keeps white, black and the
 * mean; packing; the CRC. Needs neither libc nor floating point. */
#include "display/diffuse.h"
#include "display/pixel_format.h"

#include "base/crc32.h"
#include "base/tables.h"
#include "tests/random.h"
#include "tests/test.h"

enum { MOST = 80 };

static uint32_t pixels[MOST];
static uint8_t band[MOST * 4 * 8];

static void band_fill(uint8_t value)
{
    for (uint32_t i = 0; i < sizeof band; i++)
        band[i] = value;
}

static uint32_t channel(uint32_t pixel, int c)
{
    return pixel >> (16 - 8 * c) & 255u;
}

/* c x levels / 255 to nearest. */
static uint32_t nearest(uint32_t code, uint32_t levels)
{
    return (2 * code * levels + 255) / 510;
}

/* (77 r + 150 g + 29 b) / 256 to nearest. */
static uint32_t luma_of(uint32_t p)
{
    return (77 * channel(p, 0) + 150 * channel(p, 1) + 29 * channel(p, 2) + 128) / 256;
}

/* The 16 bits of pixel i of a band row, whatever the machine's byte order. */
static uint32_t half_at(int i, bool high_first)
{
    return high_first ? (uint32_t)band[2 * i] << 8 | band[2 * i + 1] : band[2 * i] | (uint32_t)band[2 * i + 1] << 8;
}

/* Converts `pixels` as one row at (0, y), its band beginning there. */
static void convert(int n, int y, smear_format format, smear_dither dither)
{
    smear_format_row(band, smear_format_stride(n, format), pixels, n, 0, y, y & ~7, format, dither);
}

/* A row at the top of its band. */
static void convert_top(int n, smear_format format, smear_dither dither)
{
    convert(n, 0, format, dither);
}

static void random_pixels(void)
{
    for (int i = 0; i < MOST; i++)
        pixels[i] = random_u32();           /* the upper byte is rubbish and must not matter */
}

/* ------------------------------------------------------------------ without dither */

static void test_undithered_levels_are_the_nearest(void)
{
    random_state = 1;
    for (int n = 0; n < 60; n++) {
        random_pixels();
        for (int i = 0; i < 52; i++)        /* every code in every channel */
            pixels[i] = (uint32_t)(n * 5 + i) % 256u * 0x010101u;
        convert_top(MOST, SMEAR_RGB565, SMEAR_DITHER_NONE);
        for (int i = 0; i < MOST; i++) {
            uint32_t want = nearest(channel(pixels[i], 0), 31) << 11 | nearest(channel(pixels[i], 1), 63) << 5
                          | nearest(channel(pixels[i], 2), 31);
            REQUIRE_EQ(half_at(i, false), want);
        }
        convert_top(MOST, SMEAR_RGB565_SWAPPED, SMEAR_DITHER_NONE);
        for (int i = 0; i < MOST; i++) {
            uint32_t want = nearest(channel(pixels[i], 0), 31) << 11 | nearest(channel(pixels[i], 1), 63) << 5
                          | nearest(channel(pixels[i], 2), 31);
            REQUIRE_EQ(half_at(i, true), want);
        }
        convert_top(MOST, SMEAR_RGB555, SMEAR_DITHER_NONE);
        for (int i = 0; i < MOST; i++) {
            uint32_t want = nearest(channel(pixels[i], 2), 31) << 10 | nearest(channel(pixels[i], 1), 31) << 5
                          | nearest(channel(pixels[i], 0), 31);
            REQUIRE_EQ(half_at(i, false), want);
        }
        convert_top(MOST, SMEAR_RGB332, SMEAR_DITHER_NONE);
        for (int i = 0; i < MOST; i++) {
            uint32_t want = nearest(channel(pixels[i], 0), 7) << 5 | nearest(channel(pixels[i], 1), 7) << 2
                          | nearest(channel(pixels[i], 2), 3);
            REQUIRE_EQ(band[i], want);
        }
    }
}

static void test_32_bit_pixels_pass_in_the_machines_order_without_their_upper_byte(void)
{
    random_state = 2;
    random_pixels();
    static uint32_t words[MOST];
    smear_format_row((uint8_t *)words, MOST * 4, pixels, MOST, 0, 3, 3, SMEAR_XRGB8888, SMEAR_DITHER_ORDERED);
    for (int i = 0; i < MOST; i++)
        CHECK_EQ(words[i], pixels[i] & 0xffffffu);
}

static void test_grey_is_the_weighted_mean_of_the_codes(void)
{
    random_state = 3;
    random_pixels();
    convert_top(MOST, SMEAR_L8, SMEAR_DITHER_ORDERED);          /* never dithered */
    for (int i = 0; i < MOST; i++)
        CHECK_EQ(band[i], luma_of(pixels[i]));
    for (uint32_t code = 0; code < 256; code++) {
        pixels[0] = code * 0x010101u;
        convert_top(1, SMEAR_L8, SMEAR_DITHER_NONE);
        CHECK_EQ(band[0], code);
    }
}

/* ------------------------------------------------------------------ packing */

static void test_four_bit_grey_packs_the_left_pixel_high(void)
{
    random_state = 4;
    for (int n = 1; n <= 9; n++) {
        random_pixels();
        band_fill(0xee);
        convert_top(n, SMEAR_L4, SMEAR_DITHER_NONE);
        for (int i = 0; i < n; i++) {
            uint32_t level = i & 1 ? band[i / 2] & 15u : band[i / 2] >> 4;
            CHECK_EQ(level, nearest(luma_of(pixels[i]), 15));
        }
        if (n & 1)
            CHECK_EQ(band[n / 2] & 15u, 0);
        CHECK_EQ(band[(n + 1) / 2], 0xee);          /* not a byte more */
    }
}

static void test_one_bit_rows_pack_the_left_pixel_into_bit_7(void)
{
    random_state = 5;
    for (int n = 1; n <= 33; n++) {
        for (int i = 0; i < n; i++)
            pixels[i] = random_u32() & 1u ? 0xffffffu : 0;
        band_fill(0xee);
        convert_top(n, SMEAR_L1, SMEAR_DITHER_NONE);
        for (int i = 0; i < (n + 7) / 8 * 8; i++)
            CHECK_EQ(band[i / 8] >> (7 - i % 8) & 1, i < n && pixels[i] != 0);
        CHECK_EQ(band[(n + 7) / 8], 0xee);
    }
}

static void test_pages_pack_eight_rows_with_the_top_one_in_bit_0(void)
{
    random_state = 6;
    enum { N = 19, ROWS = 21 };
    static uint32_t picture[N * ROWS];
    for (int i = 0; i < N * ROWS; i++)
        picture[i] = random_u32() & 1u ? 0xffffffu : 0;
    CHECK_EQ(smear_format_stride(N, SMEAR_L1_PAGES), N);
    CHECK_EQ(smear_format_size(N, ROWS, SMEAR_L1_PAGES), 3 * N);
    for (int order = 0; order < 2; order++) {           /* rows may come in any order, in pieces of 8 columns */
        band_fill(0);
        for (int k = 0; k < ROWS; k++) {
            int y = order == 0 ? k : ROWS - 1 - k;
            for (int x = 0; x < N; x += 8)
                smear_format_row(band, N, picture + y * N + x, x + 8 < N ? 8 : N - x, x, 40 + y, 40,
                                 SMEAR_L1_PAGES, SMEAR_DITHER_NONE);
        }
        for (int y = 0; y < ROWS; y++)
            for (int x = 0; x < N; x++)
                CHECK_EQ(band[y / 8 * N + x] >> y % 8 & 1, picture[y * N + x] != 0);
        for (int x = 0; x < N; x++)
            CHECK_EQ(band[2 * N + x] >> (ROWS - 16), 0);        /* rows beyond the frame stay dark */
        CHECK_EQ(band[3 * N], 0);
    }
}

static void test_pieces_of_a_row_give_the_bytes_of_the_row(void)
{
    static uint8_t whole[MOST * 4];
    random_state = 7;
    for (int format = SMEAR_XRGB8888; format <= SMEAR_L1; format++)
        for (int dither = SMEAR_DITHER_ORDERED; dither <= SMEAR_DITHER_BLUE; dither++) {
            random_pixels();
            int n = 8 * 9 + 5;
            uint32_t stride = smear_format_stride(n, (smear_format)format);
            band_fill(0);
            convert_top(n, (smear_format)format, (smear_dither)dither);
            for (uint32_t i = 0; i < stride; i++)
                whole[i] = band[i];
            band_fill(0);
            for (int x = 0; x < n; x += 24)
                smear_format_row(band, stride, pixels + x, x + 24 < n ? 24 : n - x, x, 0, 0, (smear_format)format,
                                 (smear_dither)dither);
            for (uint32_t i = 0; i < stride; i++)
                REQUIRE_EQ(band[i], whole[i]);
        }
}

static void test_sizes_follow_from_width_and_rows(void)
{
    static const struct { smear_format format; uint32_t stride, size; } want[] = {      /* 13 x 10 */
        { SMEAR_XRGB8888, 52, 520 }, { SMEAR_RGB565, 26, 260 }, { SMEAR_RGB565_SWAPPED, 26, 260 },
        { SMEAR_RGB555, 26, 260 }, { SMEAR_RGB332, 13, 130 }, { SMEAR_L8, 13, 130 }, { SMEAR_L4, 7, 70 },
        { SMEAR_L1, 2, 20 }, { SMEAR_L1_PAGES, 13, 26 }
    };
    for (int i = 0; i < 9; i++) {
        CHECK_EQ(smear_format_stride(13, want[i].format), want[i].stride);
        CHECK_EQ(smear_format_size(13, 10, want[i].format), want[i].size);
    }
}

/* ------------------------------------------------------------------ dither */

/* code levels / 255 in 1/256, nearly, plus a threshold. */
static uint32_t level_of(uint32_t code, uint32_t levels, uint32_t t)
{
    return ((code * 257 + (code >> 7)) * levels / 256 + t) >> 8;
}

static void test_white_and_black_are_exact_under_every_dither(void)
{
    for (int dither = SMEAR_DITHER_ORDERED; dither <= SMEAR_DITHER_BLUE; dither++)
        for (int format = SMEAR_RGB565; format <= SMEAR_L1_PAGES; format++)
            for (int y = 0; y < 32; y++)
                for (int white = 0; white < 2; white++) {
                    uint32_t stride = smear_format_stride(MOST, (smear_format)format);
                    uint32_t bytes = format == SMEAR_L1_PAGES ? MOST : stride;
                    for (int i = 0; i < MOST; i++)
                        pixels[i] = white ? 0xffffffu : 0;
                    band_fill(0);
                    smear_format_row(band, stride, pixels, MOST, 0, y, y, (smear_format)format,
                                     (smear_dither)dither);
                    for (uint32_t i = 0; i < bytes; i++) {
                        uint32_t lit = format == SMEAR_L1_PAGES ? 1
                                     : format == SMEAR_RGB555 ? (i & 1 ? 0x7f : 0xff) : 0xff;
                        REQUIRE_EQ(band[i], white ? lit : 0);
                    }
                }
}

static void test_ordered_16_bit_pixels_are_the_formulas_for_all_codes(void)
{
    for (int first = 0; first < 256; first++)
        for (int y = 0; y < 8; y++) {
            for (int i = 0; i < MOST; i++) {
                const uint32_t code = (uint32_t)(first + i / 3 * 37) & 255u;
                pixels[i] = code << 16 | ((code * 7 + 5) & 255u) << 8 | (255 - code);
            }
            for (int format = SMEAR_RGB565; format <= SMEAR_RGB555; format++) {
                smear_format_row(band, smear_format_stride(MOST, (smear_format)format), pixels, MOST, 0, y, y,
                                 (smear_format)format, SMEAR_DITHER_ORDERED);
                for (int i = 0; i < MOST; i++) {
                    const uint32_t t = smear_dither_ordered[y << 3 | (i & 7)], p = pixels[i];
                    const bool is_555 = format == SMEAR_RGB555;
                    const uint32_t r = level_of(channel(p, 0), 31, t), b = level_of(channel(p, 2), 31, t),
                                   g = level_of(channel(p, 1), is_555 ? 31 : 63, t);
                    const uint32_t want = is_555 ? b << 10 | g << 5 | r : r << 11 | g << 5 | b;
                    REQUIRE_EQ(half_at(i, format == SMEAR_RGB565_SWAPPED), want);
                }
            }
        }
}

/* Sum of the levels of a flat area of 32 x 32 pixels of one code, in the red channel or in grey. */
static uint32_t level_sum(uint32_t code, smear_format format, smear_dither dither)
{
    uint32_t sum = 0;
    for (int i = 0; i < 32; i++)
        pixels[i] = code * 0x010101u;
    for (int y = 0; y < 32; y++) {
        band_fill(0);
        smear_format_row(band, smear_format_stride(32, format), pixels, 32, 0, y, y, format, dither);
        for (int i = 0; i < 32; i++)
            switch (format) {
            case SMEAR_RGB565: sum += half_at(i, false) >> 11; break;
            case SMEAR_RGB565_SWAPPED: sum += half_at(i, true) >> 5 & 63u; break;
            case SMEAR_RGB555: sum += half_at(i, false) & 31u; break;
            case SMEAR_RGB332: sum += band[i] >> 5; break;
            case SMEAR_L4: sum += i & 1 ? band[i / 2] & 15u : band[i / 2] >> 4; break;
            case SMEAR_L1: sum += (uint32_t)band[i / 8] >> (7 - i % 8) & 1u; break;
            default: sum += band[i] & 1u; break;
            }
    }
    return sum;
}

static void test_a_dithered_flat_area_has_the_mean_of_its_code(void)
{
    static const struct { smear_format format; uint32_t levels; } kinds[] = {
        { SMEAR_RGB565, 31 }, { SMEAR_RGB565_SWAPPED, 63 }, { SMEAR_RGB555, 31 }, { SMEAR_RGB332, 7 },
        { SMEAR_L4, 15 }, { SMEAR_L1, 1 }, { SMEAR_L1_PAGES, 1 }
    };
    for (int dither = SMEAR_DITHER_ORDERED; dither <= SMEAR_DITHER_BLUE; dither += SMEAR_DITHER_BLUE)
        for (int k = 0; k < 7; k++) {
            uint32_t last = 0;
            for (uint32_t code = 0; code < 256; code += code % 5 + 1) {
                uint32_t sum = level_sum(code, kinds[k].format, (smear_dither)dither);
                /* Ordered thresholds are 64 steps of 1/64 level, blue ones finer: the mean of 1024 pixels is off by
                 * no more than half a step and what c / 255 loses. */
                int32_t want = (int32_t)(code * kinds[k].levels * 1024u / 255u);
                if (!CHECK_NEAR(sum, want, 20) || !CHECK(sum >= last))
                    return;
                last = sum;
            }
        }
}

static void test_dither_moves_a_level_by_less_than_one(void)
{
    random_state = 8;
    for (int dither = SMEAR_DITHER_ORDERED; dither <= SMEAR_DITHER_BLUE; dither += SMEAR_DITHER_BLUE)
        for (int n = 0; n < 50; n++) {
            random_pixels();
            convert(MOST, n & ~7, SMEAR_RGB565, (smear_dither)dither);
            for (int i = 0; i < MOST; i++) {
                uint32_t p = half_at(i, false);
                const uint32_t got[3] = { p >> 11, p >> 5 & 63u, p & 31u };
                for (int c = 0; c < 3; c++) {
                    uint32_t levels = c == 1 ? 63 : 31, exact = channel(pixels[i], c) * levels;     /* of 255 */
                    REQUIRE(got[c] * 255u + 255u > exact && got[c] * 255u < exact + 255u);
                }
            }
        }
}

static void test_dither_patterns_repeat_and_hold_every_threshold_alike(void)
{
    /* Ordered: each threshold 4 k + 2 once in 8 x 8. Blue: each of 0 .. 255 four times in 32 x 32. */
    int ordered[256] = { 0 }, blue[256] = { 0 };
    for (int i = 0; i < 64; i++)
        ordered[smear_dither_ordered[i]]++;
    for (int i = 0; i < 1024; i++)
        blue[smear_dither_blue[i]]++;
    for (int t = 0; t < 256; t++) {
        CHECK_EQ(ordered[t], t % 4 == 2);
        CHECK_EQ(blue[t], 4);
    }
}

/* ------------------------------------------------------------------ CRC */

static void test_the_crc_is_that_of_zlib(void)
{
    static const uint8_t digits[9] = { '1', '2', '3', '4', '5', '6', '7', '8', '9' };
    CHECK_EQ(smear_crc32(0, digits, 9), 0xcbf43926u);
    CHECK_EQ(smear_crc32(0, digits, 0), 0);
    CHECK_EQ(smear_crc32(0, digits, 1), 0x83dcefb7u);
    /* Continued, cut anywhere. */
    for (uint32_t n = 0; n <= 9; n++)
        CHECK_EQ(smear_crc32(smear_crc32(0, digits, n), digits + n, 9 - n), 0xcbf43926u);
    static const uint8_t zeros[32];
    CHECK_EQ(smear_crc32(0, zeros, 32), 0x190a55adu);
}

enum { WIDE = 67, HIGH = 24 };

static uint8_t grey[WIDE * HIGH], whole[WIDE * HIGH], parts[WIDE * HIGH];
static uint16_t left_over[(3 * WIDE + 5) / 2];

/* A ramp with noise on it. */
static void make_grey(void)
{
    uint32_t state = 7;
    for (int32_t i = 0; i < WIDE * HIGH; i++) {
        state = state * 1664525u + 1013904223u;
        grey[i] = (uint8_t)((uint32_t)(i % WIDE * 3) + (state >> 27));
    }
}

static void diffuse(uint8_t *out, smear_format format, int32_t rows_at_once)
{
    __builtin_memcpy(out, grey, sizeof grey);
    for (int32_t y = 0; y < HIGH; y += rows_at_once)
        smear_diffuse_band(out + y * WIDE, WIDE, y, rows_at_once, format, left_over);
}

static uint32_t bit_of(const uint8_t *bits, int32_t x, int32_t y, smear_format format)
{
    return format == SMEAR_L1 ? bits[y * ((WIDE + 7) / 8) + x / 8] >> (7 - x % 8) & 1u : bits[y / 8 * WIDE + x] >> y % 8 & 1u;
}

static void test_diffused_bits_are_the_same_in_both_packings(void)
{
    make_grey();
    diffuse(whole, SMEAR_L1, HIGH);
    diffuse(parts, SMEAR_L1_PAGES, HIGH);
    for (int32_t y = 0; y < HIGH; y++)
        for (int32_t x = 0; x < WIDE; x++)
            CHECK_EQ(bit_of(whole, x, y, SMEAR_L1), bit_of(parts, x, y, SMEAR_L1_PAGES));
}

static void test_a_frame_diffused_in_bands_is_that_diffused_at_once(void)
{
    make_grey();
    diffuse(whole, SMEAR_L1_PAGES, HIGH);
    diffuse(parts, SMEAR_L1_PAGES, 8);
    for (int32_t y = 0; y < HIGH / 8; y++)
        for (int32_t x = 0; x < WIDE; x++)
            CHECK_EQ(whole[y * WIDE + x], parts[8 * y * WIDE + x]);
}

/* The sum of what a flat area shows, in 1/255 of a pixel. */
static int32_t shown_of(uint8_t code, smear_format format)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < WIDE * HIGH; i++)
        grey[i] = code;
    diffuse(whole, format, HIGH);
    for (int32_t y = 0; y < HIGH; y++)
        for (int32_t x = 0; x < WIDE; x++)
            sum += format == SMEAR_L4 ? 17 * (int32_t)(whole[y * ((WIDE + 1) / 2) + x / 2] >> (x % 2 == 0 ? 4 : 0) & 15)
                                      : 255 * (int32_t)bit_of(whole, x, y, format);
    return sum;
}

static void test_a_diffused_flat_area_has_the_mean_of_its_code(void)
{
    enum { PIXELS = WIDE * HIGH };
    for (int32_t code = 0; code < 256; code += 5) {
        const int32_t stretched = (code * 341 >> 8) - 43, shown = stretched < 0 ? 0 : stretched > 255 ? 255 : stretched;
        CHECK_NEAR(shown_of((uint8_t)code, SMEAR_L4), code * PIXELS, PIXELS);
        CHECK_NEAR(shown_of((uint8_t)code, SMEAR_L1), shown * PIXELS, 6 * PIXELS);
    }
    CHECK_EQ(shown_of(0, SMEAR_L1), 0);
    CHECK_EQ(shown_of(255, SMEAR_L1), 255 * PIXELS);
}

#include "build/suites/convert.h"

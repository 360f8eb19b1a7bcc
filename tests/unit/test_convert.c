/* SPDX-License-Identifier: MIT */
/* test_convert.c - display formats: levels, white and black, sizes, diffused error, the CRC. Golden frames hold the rest. Needs neither
 * libc nor floating point. */
#include "display/pixel_format.h"
#include "screen/screen.h"

#include "base/base.h"
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

/* ------------------------------------------------------------------ packing */

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

/* Tiles of a filter may have four columns. */
static void test_four_columns_are_dithered_as_in_their_row(void)
{
    static uint8_t whole[sizeof band];
    for (int dither = SMEAR_DITHER_ORDERED; dither <= SMEAR_DITHER_BLUE; dither++)
        for (int format = SMEAR_XRGB8888; format <= SMEAR_L1; format++)
            for (int y = 0; y < 8; y++) {
                const uint32_t stride = smear_format_stride(MOST, (smear_format)format);
                random_pixels();
                smear_format_row(whole, stride, pixels, MOST, 0, y, y, (smear_format)format, (smear_dither)dither);
                for (int x = 0; x < MOST; x += 4)
                    smear_format_row(band, stride, pixels + x, 4, x, y, y, (smear_format)format, (smear_dither)dither);
                for (uint32_t i = 0; i < stride; i++)
                    REQUIRE_EQ(band[i], whole[i]);
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

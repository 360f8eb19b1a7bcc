/* SPDX-License-Identifier: MIT */
/* test_tables.c - what the constants promise each other. That a fresh run of tools/gentables gives
 * the same file is a rule of the Makefile. Needs neither libc nor floating point. */
#include "base/pixel.h"
#include "base/tables.h"

#include "tests/test.h"

static void test_every_code_survives_decoding_and_encoding(void)
{
    for (uint32_t code = 0; code < 256; code++) {
        CHECK_EQ(smear_srgb_encode[smear_srgb_decode[code] >> 4], code);
        CHECK_EQ(smear_srgb_encode[smear_srgb_light[code]], code);
    }
}

static void test_light_rises_with_the_code_from_black_to_one(void)
{
    CHECK_EQ(smear_srgb_decode[0], 0);
    CHECK_EQ(smear_srgb_decode[255], 65535);
    CHECK_EQ(smear_srgb_encode[0], 0);
    CHECK_EQ(smear_srgb_encode[4095], 255);
    for (int code = 1; code < 256; code++)
        CHECK(smear_srgb_decode[code] > smear_srgb_decode[code - 1]);
    for (int light = 1; light < 4096; light++)
        CHECK(smear_srgb_encode[light] >= smear_srgb_encode[light - 1]);
}

static void test_searching_finds_what_the_table_has(void)
{
    for (uint32_t light = 0; light < 4096; light++)
        CHECK_EQ(srgb_encode_searched(light), smear_srgb_encode[light]);
}

static void test_middle_values_are_those_of_the_standard(void)
{
    /* IEC 61966-2-1: code 128 is 0.215861, 188 is 0.502887; the straight part ends at 0.04045. */
    CHECK_EQ(smear_srgb_decode[128], 14146);
    CHECK_EQ(smear_srgb_decode[188], 32957);
    CHECK_EQ(smear_srgb_decode[1], 20);
    CHECK_EQ(smear_srgb_decode[10], 199);
    CHECK_EQ(smear_srgb_decode[11], 219);
    CHECK_EQ(smear_srgb_encode[2048], 188);         /* half the light */
}

static void test_the_sine_has_its_symmetries(void)
{
    for (int i = 0; i < 64; i++) {
        CHECK_NEAR(smear_sine[i], -smear_sine[i + 128], 0);
        CHECK_EQ(smear_sine[128 - i], smear_sine[i]);
        /* sin^2 + cos^2 = 127^2, each rounded by 1/2 */
        int sine = smear_sine[i], cosine = smear_sine[i + 64];
        CHECK_NEAR(sine * sine + cosine * cosine, 127 * 127, 181);
    }
    CHECK_EQ(smear_sine[64], 127);
    CHECK_EQ(smear_sine[0], 0);
}

static void test_roots_and_reciprocals_have_their_ends(void)
{
    for (int i = 0; i < 1024; i++) {
        int root = smear_sqrt_q3[i];
        /* 8 sqrt(i) - 1/2 < root <= 8 sqrt(i) + 1/2, but for the last ones, held to 255 */
        CHECK((2 * root - 1) * (2 * root - 1) <= 256 * i || root == 0);
        CHECK((2 * root + 1) * (2 * root + 1) > 256 * i || root == 255);
    }
    CHECK_EQ(smear_recip_seed[0], 2046);
    CHECK_EQ(smear_recip_seed[511], 1025);
    for (int i = 1; i < 512; i++)
        CHECK(smear_recip_seed[i] < smear_recip_seed[i - 1]);
}

#include "build/suites/tables.h"

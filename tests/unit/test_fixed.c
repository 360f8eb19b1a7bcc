/* SPDX-License-Identifier: MIT */
/* test_fixed.c - the narrowing, saturating and wrapping helpers against 64-bit arithmetic, and the forms for cores
 * without a wide multiply against the plain ones. Needs neither libc nor floating point. */

#include "tests/unit/poor.h"

#include "tests/random.h"
#include "tests/test.h"

/* Random values of every magnitude: a plain random word is nearly always large. */
static int32_t random_i32(void)
{
    int shift = (int)(random_u32() % 32u);
    uint32_t x = random_u32() >> shift;
    return random_u32() & 1u ? (int32_t)x : (int32_t)(0u - x);
}

static const int32_t extreme[] = {
    INT32_MIN, INT32_MIN + 1, -0x7fff8000, -0x40000000, -0x10001, -0x10000, -0xffff, -0x8001, -0x8000, -0x7fff,
    -2, -1, 0, 1, 2, 0x7fff, 0x8000, 0x8001, 0xffff, 0x10000, 0x10001, 0x3fffffff, 0x40000000, 0x7fff0000,
    0x7fff8000, 0x7fffffff
};
enum { EXTREMES = sizeof extreme / sizeof extreme[0], RANDOMS = 20000 };

/* floor(a / 2^32) of the exact product, without relying on shifts of negative numbers. */
static int32_t high_word(int64_t product)
{
    return (int32_t)(uint32_t)((uint64_t)product >> 32);
}

static bool check_products(int32_t a, int32_t b)
{
    uint32_t ua = (uint32_t)a, ub = (uint32_t)b;
    bool ok = CHECK_EQ(mulh_i32(a, b), high_word((int64_t)a * b));
    ok = CHECK_EQ(poor_mulh_i32(a, b), high_word((int64_t)a * b)) && ok;
    ok = CHECK_EQ(mul_wide(a, b), (int64_t)a * b) && ok;
    ok = CHECK_EQ(poor_mul_wide(a, b), (int64_t)a * b) && ok;
    ok = CHECK_EQ(mulh_u32(ua, ub), (int64_t)((uint64_t)ua * ub >> 32)) && ok;
    for (int shift = 1; shift < 32; shift += 5) {
        const int32_t shifted = (int32_t)(uint32_t)((uint64_t)((int64_t)a * b) >> shift);
        ok = CHECK_EQ(mul_shift(a, b, shift), shifted) && ok;
        ok = CHECK_EQ(poor_mul_shift(a, b, shift), shifted) && ok;
    }
    return CHECK_EQ(poor_mulh_u32(ua, ub), (int64_t)((uint64_t)ua * ub >> 32)) && ok;
}

static void test_sums_of_products_are_exact_in_both_forms(void)
{
    random_state = 2;
    for (int i = 0; i < RANDOMS; i++) {
        int32_t a[9], b[3];
        for (int k = 0; k < 9; k++)
            a[k] = random_i32() >> 1;
        for (int k = 0; k < 3; k++)
            b[k] = random_i32() >> 1;
        const int64_t dot = (int64_t)a[0] * b[0] + (int64_t)a[3] * b[1] + (int64_t)a[6] * b[2];
        CHECK_EQ(dot_wide(a, 3, b, 1), dot);
        CHECK_EQ(poor_dot_wide(a, 3, b, 1), dot);
        const int64_t cross = (int64_t)a[0] * b[1] - (int64_t)a[1] * b[0];
        CHECK_EQ(cross_wide(a[0], a[1], b[0], b[1]), cross);
        END_UNLESS(CHECK_EQ(poor_cross_wide(a[0], a[1], b[0], b[1]), cross));
    }
    const int32_t least[3] = { INT32_MIN, INT32_MIN, INT32_MIN };           /* a square of a length: of 64 bits without a sign */
    CHECK((uint64_t)dot_wide(least, 1, least, 1) == 3ull << 62);
    CHECK((uint64_t)poor_dot_wide(least, 1, least, 1) == 3ull << 62);
}

static void test_high_products_of_extremes_are_exact_in_both_forms(void)
{
    for (int i = 0; i < EXTREMES; i++)
        for (int j = 0; j < EXTREMES; j++)
            END_UNLESS(check_products(extreme[i], extreme[j]));
}

static void test_high_products_of_random_values_are_exact_in_both_forms(void)
{
    random_state = 1;
    for (int i = 0; i < RANDOMS; i++) {
        int32_t a = random_i32(), b = random_i32();
        END_UNLESS(check_products(a, b));
    }
}

static void test_wrapping_arithmetic_is_modulo_2_to_the_32(void)
{
    for (int i = 0; i < EXTREMES; i++) {
        for (int j = 0; j < EXTREMES; j++) {
            int64_t a = extreme[i], b = extreme[j];
            CHECK_EQ((uint32_t)add_wrap(extreme[i], extreme[j]), (uint64_t)(a + b) & 0xffffffffu);
            CHECK_EQ((uint32_t)sub_wrap(extreme[i], extreme[j]), (uint64_t)(a - b) & 0xffffffffu);
            CHECK_EQ((uint32_t)mul_wrap(extreme[i], extreme[j]), (uint64_t)(a * b) & 0xffffffffu);
        }
        for (int shift = 0; shift < 32; shift++)
            CHECK_EQ((uint32_t)shl_wrap(extreme[i], shift), ((uint64_t)(uint32_t)extreme[i] << shift) & 0xffffffffu);
    }
}

/* a 2^shift as scale_sat promises it: to nearest with ties up when it shrinks, clamped when it grows. */
static int64_t scaled(int32_t a, int shift)
{
    if (shift >= 0) {
        int64_t wide = (int64_t)a * ((int64_t)1 << shift);
        return wide > INT32_MAX ? INT32_MAX : wide < -(int64_t)INT32_MAX ? -(int64_t)INT32_MAX : wide;
    }
    int64_t unit = (int64_t)1 << -shift, twice = 2 * (int64_t)a + unit;     /* floor(a / unit + 1/2) */
    int64_t q = twice / (2 * unit);
    return twice % (2 * unit) < 0 ? q - 1 : q;
}

static void test_scaling_rounds_to_nearest_and_saturates(void)
{
    random_state = 3;
    for (int shift = -31; shift <= 31; shift++) {
        for (int i = 0; i < EXTREMES; i++) {
            if (shift == 0)
                CHECK_EQ(scale_sat(extreme[i], shift), extreme[i]);
            else if (!CHECK_EQ(scale_sat(extreme[i], shift), scaled(extreme[i], shift)))
                return;
        }
        for (int i = 0; i < RANDOMS / 64; i++) {
            int32_t a = random_i32();
            if (a != INT32_MIN && !CHECK_EQ(scale_sat(a, shift), scaled(a, shift)))
                return;
            CHECK_EQ(poor_scale_sat(a, shift), scale_sat(a, shift));
        }
    }
}

static void test_saturated_values_can_always_be_negated(void)
{
    CHECK_EQ(narrow_sat(INT64_MAX), INT32_MAX);
    CHECK_EQ(narrow_sat(INT64_MIN), -INT32_MAX);
    CHECK_EQ(narrow_sat((int64_t)INT32_MAX + 1), INT32_MAX);
    CHECK_EQ(narrow_sat((int64_t)INT32_MIN), -INT32_MAX);
    CHECK_EQ(narrow_sat(-12345), -12345);
    CHECK_EQ(scale_sat(-0x40000001, 1), -INT32_MAX);
    CHECK_EQ(scale_sat(-1, 31), -INT32_MAX);
    CHECK_EQ(scale_sat(0, 31), 0);
}

static void test_clamps_keep_their_limits(void)
{
    CHECK_EQ(clamp_i32(5, -2, 3), 3);
    CHECK_EQ(clamp_i32(-5, -2, 3), -2);
    CHECK_EQ(clamp_i32(3, -2, 3), 3);
    CHECK_EQ(clamp_i32(INT32_MIN, -INT32_MAX, INT32_MAX), -INT32_MAX);
    CHECK_EQ(min_i32(INT32_MIN, INT32_MAX), INT32_MIN);
    CHECK_EQ(max_i32(INT32_MIN, INT32_MAX), INT32_MAX);
    CHECK_EQ(min_u32(0x80000000u, 1u), 1);
    CHECK_EQ(max_u32(0x80000000u, 1u), 0x80000000u);
    CHECK_EQ(abs_i32(-INT32_MAX), INT32_MAX);
}

#include "build/suites/fixed.h"

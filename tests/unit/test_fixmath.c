/* SPDX-License-Identifier: MIT */
/* test_fixmath.c - the stated errors of reciprocals, ratios and roots over sweeps of their domains, and the same bits
 * on cores without a wide multiply or a leading zero count. Needs neither libc nor floating point. */

#include "tests/unit/poor.h"

#include "tests/random.h"
#include "tests/test.h"

static uint64_t random_u64(void)
{
    uint64_t word = (uint64_t)random_u32() << 32;
    word |= random_u32();
    return word >> random_u32() % 64u;
}

static void test_leading_zeros_are_counted_at_every_bit(void)
{
    for (int bit = 0; bit < 32; bit++) {
        const uint32_t power = 1u << bit, values[3] = { power, power | (power - 1), power | power >> 1 };
        for (int i = 0; i < 3; i++) {
            CHECK_EQ(count_leading_zeros(values[i]), 31 - bit);
            CHECK_EQ(poor_count_leading_zeros(values[i]), 31 - bit);
        }
    }
    for (int bit = 0; bit < 64; bit++) {
        const uint64_t power = (uint64_t)1 << bit, values[2] = { power, power | (power - 1) };
        for (int i = 0; i < 2; i++) {
            CHECK_EQ(count_leading_zeros_64(values[i]), 63 - bit);
            CHECK_EQ(poor_count_leading_zeros_64(values[i]), 63 - bit);
        }
    }
}

/* |r m - 2^61|, which is the relative error of r times 2^61. */
static uint64_t reciprocal_error(uint32_t m, uint32_t r)
{
    const uint64_t one = (uint64_t)1 << 61;
    uint64_t product = (uint64_t)m * r;
    return product > one ? product - one : one - product;
}

static bool check_reciprocals(uint32_t m)
{
    uint32_t r = recip_norm(m), precise = recip_norm_precise(m);
    return CHECK(reciprocal_error(m, r) < (uint64_t)1 << (61 - 18))
        && CHECK(r >= (1u << 29) - 256 && r <= 1u << 30)
        && CHECK(reciprocal_error(m, precise) < (uint64_t)1 << (61 - 26))
        && CHECK(precise >= 1u << 29 && precise <= 1u << 30)
        && CHECK_EQ(poor_recip_norm(m), r) && CHECK_EQ(poor_recip_norm_precise(m), precise);
}

static void test_reciprocals_keep_their_stated_errors(void)
{
    /* The ends and neighbours of each of the seed's 512 cells, and an odd stride in between. */
    for (uint32_t cell = 0; cell < 512; cell++) {
        uint32_t first = 0x80000000u + (cell << 22), last = first + (1u << 22) - 1;
        if (!check_reciprocals(first) || !check_reciprocals(first + 1) || !check_reciprocals(last)
            || !check_reciprocals(last - 1) || !check_reciprocals(first + (1u << 21)))
            return;
    }
    for (uint64_t m = 0x80000000u; m <= UINT32_MAX; m += 78643u)
        END_UNLESS(check_reciprocals((uint32_t)m));
}

static void test_reciprocals_of_powers_of_two_are_close_to_powers_of_two(void)
{
    /* 2^61 / 2^31: off by less than the stated error, and never above 2^30. */
    CHECK_NEAR(recip_norm(0x80000000u), 1 << 30, 1 << 12);
    CHECK_NEAR(recip_norm_precise(0x80000000u), 1 << 30, 1 << 4);
    CHECK_NEAR(recip_norm_precise(UINT32_MAX), 1 << 29, 1 << 3);
}

static void test_division_rounds_down_and_leaves_a_remainder_of_the_divisors_sign(void)
{
    static const int32_t dividend[] = { INT32_MIN, INT32_MIN + 1, -65537, -65536, -7, -1, 0, 1, 7, 65536, INT32_MAX };
    static const int32_t divisor[] = { 1, 2, 3, 7, 255, 256, 65535, 1 << 20, INT32_MAX };
    for (int i = 0; i < (int)(sizeof dividend / sizeof dividend[0]); i++) {
        for (int j = 0; j < (int)(sizeof divisor / sizeof divisor[0]); j++) {
            int32_t a = dividend[i], b = divisor[j], rest = -1;
            int32_t q = divide_floor(a, b, &rest);
            CHECK(rest >= 0 && rest < b);
            CHECK_EQ((int64_t)q * b + rest, a);
        }
    }
}

/* floor(a 2^30 / c) by long division; c < 2^63. */
static uint32_t exact_ratio_q30(uint64_t a, uint64_t c)
{
    uint32_t q = (uint32_t)(a / c);
    uint64_t rest = a % c;
    for (int bit = 0; bit < 30; bit++) {
        rest <<= 1;
        q <<= 1;
        if (rest >= c) {
            rest -= c;
            q |= 1;
        }
    }
    return q;
}

static bool check_ratio(int64_t a, int64_t c)
{
    int32_t got = ratio_q30(a, c);
    return CHECK_NEAR(got, exact_ratio_q30((uint64_t)a, (uint64_t)c), 1 << 5) && CHECK(got >= 0 && got <= 1 << 30)
        && CHECK_EQ(poor_ratio_q30(a, c), got);
}

static void test_ratios_are_within_2_to_the_minus_25_of_the_quotient(void)
{
    static const int64_t whole[] = { 1, 2, 3, 255, 256, 65535, 0x7fffffff, 0x80000000, 0xffffffff, 0x100000001,
                                     (int64_t)1 << 43, ((int64_t)1 << 52) - 1, INT64_MAX };
    for (int i = 0; i < (int)(sizeof whole / sizeof whole[0]); i++) {
        int64_t c = whole[i];
        if (!check_ratio(0, c) || !check_ratio(c, c) || !check_ratio(c / 2, c) || !check_ratio(c - c / 3, c)
            || !check_ratio(1, c) || !check_ratio(c - 1, c))
            return;
    }
    random_state = 4;
    for (int i = 0; i < 20000; i++) {
        int64_t c = (int64_t)(random_u64() >> 1) | 1;
        int64_t a = (int64_t)(random_u64() % ((uint64_t)c + 1));
        END_UNLESS(check_ratio(a, c));
    }
}

static bool check_root(uint64_t x)
{
    uint64_t root = sqrt_floor_64(x);
    bool not_above = root * root <= x;
    bool not_below = root == UINT32_MAX || (root + 1) * (root + 1) > x;
    return CHECK(not_above) && CHECK(not_below) && CHECK_EQ(poor_sqrt_floor_64(x), (int64_t)root);
}

static void test_square_roots_are_exact_floors(void)
{
    for (uint64_t x = 0; x < 300; x++)
        END_UNLESS(check_root(x));
    for (uint32_t root = 1; root != 0 && root >> 31 == 0; root = root * 3 + 1) {
        uint64_t square = (uint64_t)root * root;
        if (!check_root(square) || !check_root(square - 1) || !check_root(square + 1))
            return;
    }
    const uint64_t top = (uint64_t)UINT32_MAX * UINT32_MAX;
    check_root(top);
    check_root(top - 1);
    check_root(UINT64_MAX);
    random_state = 5;
    for (int i = 0; i < 4000; i++)
        END_UNLESS(check_root(random_u64()));
}

static void test_short_roots_keep_their_stated_error(void)
{
    /* Against 8 sqrt(x) in 1/2^20, whole numbers below 2^34. */
    for (uint32_t x = 0; x < 1u << 20; x += x < 8192u ? 1u : 13u) {
        int64_t want = (int64_t)sqrt_floor_64((uint64_t)x << 40) * 8, got = (int64_t)sqrt_q3(x) << 20;
        int64_t off = got > want ? got - want : want - got;
        REQUIRE(off <= want / 128 + (1 << 19) + 8);
    }
    CHECK_EQ(sqrt_q3(0), 0);
    CHECK_EQ(sqrt_q3(1), 8);
    CHECK_EQ(sqrt_q3(4), 16);
    CHECK_EQ(sqrt_q3(1u << 18), 8 << 9);
}

static void test_short_roots_never_decrease(void)
{
    uint32_t last = 0;
    for (uint32_t x = 0; x < 1u << 20; x++) {
        uint32_t root = sqrt_q3(x);
        REQUIRE(root >= last);
        last = root;
    }
}

#include "build/suites/fixmath.h"

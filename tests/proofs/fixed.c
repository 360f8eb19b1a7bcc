/* SPDX-License-Identifier: MIT */
/* fixed.c - every helper of fixed.h and fixmath.h, called with all that it promises to take: Frama-C's Eva follows all values
 * at once and names each operation that could go wrong (`make proofs`). Of the two reciprocals it is told what they return:
 * reciprocals.c tries all that these may be given. */
#include "base/fixed.h"

/*@ assigns \result \from m;
    ensures 536868864 <= \result <= 1073741824; */
static inline uint32_t recip_norm(uint32_t m);
/*@ assigns \result \from m;
    ensures 536868864 <= \result <= 1073741824; */
static inline uint32_t recip_norm_precise(uint32_t m);

#include "base/fixmath.h"

volatile int32_t any_int;
volatile uint32_t any_word;
volatile int64_t any_long;
volatile uint64_t any_double_word;
volatile int64_t seen;

static void products(int32_t a, int32_t b, uint32_t x, uint32_t y)
{
    seen = add_wrap(a, b);
    seen = sub_wrap(a, b);
    seen = mul_wrap(a, b);
    seen = mulh_i32(a, b);
    seen = mulh_u32(x, y);
    seen = narrow_sat(any_long);
    seen = (int64_t)magnitude(any_long);
    const int32_t shift = any_int;
    if (shift >= 1 && shift <= 31)
        seen = mul_shift(a, b, shift);
    if (shift >= 0 && shift <= 31)
        seen = shl_wrap(a, shift);
    if (shift >= -31 && shift <= 31)
        seen = scale_sat(a, shift);
}

static void quotients(int32_t a, int32_t b, uint32_t x)
{
    int32_t remainder;
    if (b > 0)
        seen = divide_floor(a, b, &remainder);
    if (x > 0)
        seen = count_leading_zeros(x);
    const uint64_t z = any_double_word;
    if (z > 0)
        seen = count_leading_zeros_64(z);
    const int64_t n = any_long, c = any_long;
    if (n >= 0 && c > 0 && n <= c)
        seen = ratio_q30(n, c);
    seen = sqrt_floor_64(z);
    if (x < 1u << 20)
        seen = sqrt_q3(x);
}

int main(void)
{
    products(any_int, any_int, any_word, any_word);
    quotients(any_int, any_int, any_word);
    return 0;
}

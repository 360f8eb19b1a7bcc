/* SPDX-License-Identifier: MIT */
/* reciprocals.c - reciprocals of all 2^31 normalised numbers, or of every STEP-th: none overflows (the build stops there),
 * all lie in [2^29 - 2^11, 2^30], and errors are as fixmath.h states them.
 *
 *     reciprocals [STEP] */
#include "base/fixmath.h"

#include <stdio.h>
#include <stdlib.h>

enum { LEAST = (1 << 29) - (1 << 11),
       MOST = 1 << 30 };

/* |r m - 2^61| <= 2^61 / 2^bits, of which only the high word matters. */
static bool is_near(uint32_t r, uint32_t m, int bits)
{
    const int64_t error = (int64_t)((uint64_t)r * m - ((uint64_t)1 << 61));
    return error <= (int64_t)1 << (61 - bits) && -error <= (int64_t)1 << (61 - bits);
}

int main(int argc, char **argv)
{
    const uint32_t step = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 1;
    uint32_t count = 0;
    for (uint64_t at = 1u << 31; at < (uint64_t)1 << 32; at += step, count++) {
        const uint32_t m = (uint32_t)at, r = recip_norm(m), precise = recip_norm_precise(m);
        if (r < LEAST || r > MOST || precise < LEAST || precise > MOST || !is_near(r, m, 18) || !is_near(precise, m, 26)) {
            fprintf(stderr, "reciprocals: %lu: %lu, %lu\n", (unsigned long)m, (unsigned long)r, (unsigned long)precise);
            return 1;
        }
    }
    printf("reciprocals of %lu numbers: no overflow, errors as stated\n", (unsigned long)count);
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* random.c - see random.h. */
#include "tests/random.h"

uint32_t random_state;

uint32_t random_u32(void)
{
    random_state = random_state * 1664525u + 1013904223u;
    uint32_t x = random_state;
    x ^= x >> 15;
    x *= 0x2c1b3c6du;
    return x ^ x >> 13;
}

int32_t between(int32_t low, int32_t high)
{
    uint32_t span = (uint32_t)high - (uint32_t)low + 1u;
    return (int32_t)((uint32_t)low + (span != 0 ? random_u32() % span : random_u32()));
}

bool chance(int one_in)
{
    return random_u32() % (uint32_t)one_in == 0;
}

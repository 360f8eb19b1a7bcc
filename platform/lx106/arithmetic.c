/* SPDX-License-Identifier: MIT */
/* arithmetic.c - what gcc calls for products and quotients, and has no library of here: an ESP8266 has these in its ROM. */
#include <stdint.h>

uint64_t __umulsidi3(uint32_t a, uint32_t b);
uint64_t __muldi3(uint64_t a, uint64_t b);
uint32_t __udivsi3(uint32_t a, uint32_t b);
uint32_t __umodsi3(uint32_t a, uint32_t b);
int32_t __divsi3(int32_t a, int32_t b);
uint64_t __udivdi3(uint64_t a, uint64_t b);
uint64_t __umoddi3(uint64_t a, uint64_t b);
int64_t __divdi3(int64_t a, int64_t b);
uint64_t __udivmoddi4(uint64_t a, uint64_t b, uint64_t *rest);     /* libgcc's */

static inline uint64_t of_halves(uint32_t high, uint32_t low)
{
    return (uint64_t)high << 32 | low;
}

/* Of four products of halves, as the core's own has 32 bits. */
static inline uint64_t product(uint32_t a, uint32_t b)
{
    uint32_t a0 = a & 0xffff, a1 = a >> 16, b0 = b & 0xffff, b1 = b >> 16;
    uint32_t low = a0 * b0, middle = a1 * b0 + (low >> 16), other = a0 * b1 + (middle & 0xffff);
    return of_halves(a1 * b1 + (middle >> 16) + (other >> 16), other << 16 | (low & 0xffff));
}

uint64_t __umulsidi3(uint32_t a, uint32_t b)
{
    return product(a, b);
}

uint64_t __muldi3(uint64_t a, uint64_t b)
{
    uint32_t a0 = (uint32_t)a, b0 = (uint32_t)b;
    return product(a0, b0) + of_halves((uint32_t)(a >> 32) * b0 + a0 * (uint32_t)(b >> 32), 0);
}

/* Bit by bit, from the first on that the quotient can have. By zero: all ones. */
static inline uint32_t quotient(uint32_t a, uint32_t b, uint32_t *rest)
{
    uint32_t q = 0;
    *rest = a;
    if (b == 0)
        return UINT32_MAX;
    if (a < b)
        return 0;
    for (int bit = __builtin_clz(b) - __builtin_clz(a); bit >= 0; bit--)
        if (a >= b << bit) {
            a -= b << bit;
            q |= 1u << bit;
        }
    *rest = a;
    return q;
}

uint32_t __udivsi3(uint32_t a, uint32_t b)
{
    uint32_t rest;
    return quotient(a, b, &rest);
}

uint32_t __umodsi3(uint32_t a, uint32_t b)
{
    uint32_t rest;
    quotient(a, b, &rest);
    return rest;
}

int32_t __divsi3(int32_t a, int32_t b)
{
    uint32_t rest, q = quotient(a < 0 ? 0u - (uint32_t)a : (uint32_t)a, b < 0 ? 0u - (uint32_t)b : (uint32_t)b, &rest);
    return (int32_t)((a ^ b) < 0 ? 0u - q : q);
}

uint64_t __udivdi3(uint64_t a, uint64_t b)
{
    return __udivmoddi4(a, b, 0);
}

uint64_t __umoddi3(uint64_t a, uint64_t b)
{
    uint64_t rest;
    __udivmoddi4(a, b, &rest);
    return rest;
}

int64_t __divdi3(int64_t a, int64_t b)
{
    uint64_t q = __udivmoddi4(a < 0 ? 0u - (uint64_t)a : (uint64_t)a, b < 0 ? 0u - (uint64_t)b : (uint64_t)b, 0);
    return (int64_t)((a ^ b) < 0 ? 0u - q : q);
}

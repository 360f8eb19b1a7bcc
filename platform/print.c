/* SPDX-License-Identifier: MIT */
/* print.c - see print.h. */
#include "platform/print.h"

#include "platform/platform.h"

void print_decimal(uint32_t value)
{
    char digits[11];
    char *at = digits + sizeof digits;
    *--at = '\0';
    do {
        *--at = (char)('0' + value % 10);
        value /= 10;
    } while (value != 0);
    platform_print(at);
}

void print_signed(int32_t value)
{
    if (value < 0)
        platform_print("-");
    print_decimal(value < 0 ? 0u - (uint32_t)value : (uint32_t)value);
}

void print_hex(uint32_t value)
{
    char digits[9];
    for (int i = 0; i < 8; i++)
        digits[i] = "0123456789abcdef"[value >> (28 - 4 * i) & 15];
    digits[8] = '\0';
    platform_print(digits);
}

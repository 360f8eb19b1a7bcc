/* SPDX-License-Identifier: MIT */
/* print.h - numbers as text for the programs for targets, which have no printf. */
#ifndef SMEAR_PLATFORM_PRINT_H
#define SMEAR_PLATFORM_PRINT_H

#include <stdint.h>

void print_decimal(uint32_t value);
void print_signed(int32_t value);
void print_hex(uint32_t value);         /* 8 digits */

#endif

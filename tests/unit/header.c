/* SPDX-License-Identifier: MIT */
/* header.c - the public header, alone and first, as C99 and as C++11; the size macro as a constant. */
#include <smear.h>

static unsigned char memory[SMEAR_MEMORY_SIZE(240, 240, 12, 600, 8)];

int smear_header_test(void);

int smear_header_test(void)
{
    return (int)sizeof memory + SMEAR_OK;
}

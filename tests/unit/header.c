/* SPDX-License-Identifier: MIT */
/* header.c - the public headers, alone and first, as C99 and as C++11; memory as a constant. */
#include <smear_memory.h>

static uint64_t memory[SMEAR_MEMORY(240, 240, 600, 8)];

int smear_header_test(void);

int smear_header_test(void)
{
    return (int)sizeof memory + SMEAR_OK;
}

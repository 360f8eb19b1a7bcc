/* SPDX-License-Identifier: MIT */
/* header.c - the public headers, alone and first, as C99 and as C++11; memory as a constant, and its desc. */
#include <smear_memory.h>

#define SCREEN 240, 240, 600, 8
static uint64_t memory[SMEAR_MEMORY_WORDS(SCREEN)];

int smear_header_test(void);

int smear_header_test(void)
{
    return (int)sizeof memory + SMEAR_DESC(SCREEN).width + SMEAR_OK;
}

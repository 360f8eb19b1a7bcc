/* SPDX-License-Identifier: MIT */
/* memory_forms.c - prints SMEAR_MEMORY of values of every kind: C and C++ come to the same. */
#include <smear_memory.h>
#include <stdio.h>

int main(void)
{
    static const size_t words[] = {
        SMEAR_MEMORY(240, 240, 0, 0),
        SMEAR_MEMORY(1, 1, 1, 1),
        SMEAR_MEMORY(321, 479, 600, 8, SMEAR_L1_PAGES),
        SMEAR_MEMORY(2048, 3, 100000, 65535, SMEAR_RGB555),
        SMEAR_MEMORY(97, 1300, 700, 16, SMEAR_RGB332),
        SMEAR_MEMORY_BAND(160, 120, SMEAR_L4),
        SMEAR_MEMORY_BAND(33, 39, SMEAR_RGB565_SWAPPED),
        SMEAR_MEMORY_WORKER(320, 240),
        SMEAR_MEMORY_WORKER(7, 2048),
        SMEAR_MEMORY_SKETCH(240, 240, 600, 8),
        SMEAR_MEMORY_SKETCH(321, 479, 0, 0, SMEAR_L4)
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        printf("%lu\n", (unsigned long)words[i]);
    return 0;
}

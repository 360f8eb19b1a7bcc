/* SPDX-License-Identifier: MIT */
/* memory_forms.c - prints SMEAR_MEMORY of values of every kind: macros of C and functions of C++ come to the same. */
#include <smear_memory.h>
#include <stdio.h>

#define EVERY (SMEAR_SET_FILTERS | SMEAR_SET_TEMPORAL | SMEAR_SET_LAYERS | SMEAR_SET(SMEAR_ACCUMULATE))

int main(void)
{
    static const size_t bytes[] = {
        SMEAR_MEMORY(240, 240, 0, 0),
        SMEAR_MEMORY(1, 1, 1, 1, SMEAR_SET(SMEAR_NONE)),
        SMEAR_MEMORY(321, 479, 600, 8, SMEAR_SET(SMEAR_NONE), 0, 0, 0, 24, 2, SMEAR_L1_PAGES, 1, 0, 1, 0, 0, 0, 0, SMEAR_DITHER_DIFFUSE, 3),
        SMEAR_MEMORY(96, 64, 200, 4, SMEAR_SET(SMEAR_RECONSTRUCT), 0, 0, 0, 0, 1, SMEAR_RGB565),
        SMEAR_MEMORY(640, 480, 5000, 255, SMEAR_SET(SMEAR_HALF) | SMEAR_SET(SMEAR_PINGPONG), 32, 40, 0, 0, 2, SMEAR_L4, 3, 256, 0, 0, 3),
        SMEAR_MEMORY(2048, 3, 100000, 65535, SMEAR_SET_TEMPORAL, 16, 15, 128, 0, 1, SMEAR_RGB555, 2, 1024, 0, 7, 0, 0, 1),
        SMEAR_MEMORY(97, 1300, 700, 16, SMEAR_SET_LAYERS, 8, 64, 0, 0, 0, SMEAR_RGB332, 8, 16),
        SMEAR_MEMORY(33, 39, 7, 2, EVERY, 64, 30, 256, 0, 1, SMEAR_XRGB8888, 4, 64, 1, 1, 2, 1, 1, 0, 1)
    };
    for (size_t i = 0; i < sizeof bytes / sizeof *bytes; i++)
        printf("%lu\n", (unsigned long)bytes[i]);
    return 0;
}

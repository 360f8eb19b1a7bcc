/* SPDX-License-Identifier: MIT */
/* platform.c - platform.h on a machine with an operating system. */
#include "platform/platform.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ARENA_BYTES = 16 << 20 };

const char platform_clock_unit[] = "microseconds";

void platform_print(const char *text)
{
    fputs(text, stdout);
}

void *platform_arena(size_t *bytes)
{
    static void *arena;
    if (arena == NULL)
        arena = malloc(ARENA_BYTES);
    *bytes = arena != NULL ? ARENA_BYTES : 0;
    return arena;
}

uint32_t platform_stack_used(void)
{
    return 0;
}

void platform_clock_start(void)
{
}

uint32_t platform_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (uint32_t)now.tv_sec * 1000000u + (uint32_t)(now.tv_nsec / 1000);
}

uint32_t platform_clock_count(uint32_t ticks)
{
    return ticks;
}

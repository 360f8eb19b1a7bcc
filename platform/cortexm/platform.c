/* SPDX-License-Identifier: MIT */
/* platform.c - platform.h on QEMU's Cortex-M boards.
 *
 * The clock is the CMSDK timer of the mps2 boards (25 MHz, 32 bits, counts down). Under
 * `qemu -icount shift=7` each instruction lasts 2^7 ns of virtual time, so a tick of 40 ns is 5/16
 * of an instruction: counts are exact to the single instruction and wrap after 1.3e9 of them. Other
 * boards have no such timer: programs that read the clock are for mps2 only. */
#include "../platform.h"
#include "semihost.h"
#include "stack.h"

struct cmsdk_timer {
    uint32_t control, value, reload;
};

#define TIMER ((volatile struct cmsdk_timer *)0x40000000u)

extern uint64_t link_arena_start[], link_arena_end[];

const char platform_clock_unit[] = "instructions";

void platform_print(const char *text)
{
    semihost_print(text);
}

void *platform_arena(size_t *bytes)
{
    *bytes = (size_t)((uintptr_t)link_arena_end - (uintptr_t)link_arena_start);
    return link_arena_start;
}

uint32_t platform_stack_used(void)
{
    const uint32_t *lowest = link_stack_limit;
    while (lowest < link_stack_top && *lowest == STACK_PAINT)
        lowest++;
    if (lowest == link_stack_limit)
        return UINT32_MAX;
    return (uint32_t)((uintptr_t)link_stack_top - (uintptr_t)lowest);
}

void platform_clock_start(void)
{
    TIMER->reload = UINT32_MAX;
    TIMER->value = UINT32_MAX;
    TIMER->control = 1;
}

uint32_t platform_clock(void)
{
    return 0u - TIMER->value;
}

uint32_t platform_clock_count(uint32_t ticks)
{
    return ticks / 16 * 5 + (ticks % 16 * 5 + 8) / 16;
}

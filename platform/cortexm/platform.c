/* SPDX-License-Identifier: MIT */
/* platform.c - platform.h on QEMU's Cortex-M boards.
 *
 * The clock is the CMSDK timer of the mps2 boards (32 bits, counts down every TICK_NS). Under
 * `qemu -icount shift=6` each instruction lasts 2^6 ns of virtual time, so a tick of 40 ns is 5/8 of
 * an instruction: counts are exact to the single instruction and wrap after 2.7e9 of them (a frame of
 * 240x240 by time masks on a Cortex-M0+ takes up to 1.4e9). Other boards have no such timer: programs
 * that read the clock are for mps2 only. */
#include "platform/platform.h"
#include "platform/common/semihost.h"

struct cmsdk_timer {
    uint32_t control, value, reload;
};

#ifndef TIMER_ADDRESS
#define TIMER_ADDRESS 0x40000000u
#define TICK_NS 40
#endif
#define TIMER ((volatile struct cmsdk_timer *)TIMER_ADDRESS)

enum { INSTRUCTION_NS = 64 };

const char platform_clock_unit[] = "instructions";

void platform_print(const char *text)
{
    semihost_print(text);
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
    return ticks / INSTRUCTION_NS * TICK_NS +
           (ticks % INSTRUCTION_NS * TICK_NS + INSTRUCTION_NS / 2) / INSTRUCTION_NS;
}

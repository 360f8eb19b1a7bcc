/* SPDX-License-Identifier: MIT */
/* platform.c - platform.h on QEMU's sim machine: what a simulator does for a program is asked for by the instruction
 * `simcall`, whose number is in a2 and whose arguments follow (Xtensa ISA, simulator calls). */
#include "platform/platform.h"

#include <stddef.h>

int main(int argc, char **argv);
void xtensa_main(void);

enum { SIM_EXIT = 1, SIM_WRITE = 4, SIM_ARGC = 1000, SIM_ARGV_BYTES = 1001, SIM_ARGV = 1002 };
enum { STANDARD_OUTPUT = 1 };

const char platform_clock_unit[] = "instructions";

static uint32_t simcall(uint32_t number, uint32_t first, const void *second, uint32_t third)
{
    register uint32_t a2 __asm("a2") = number;
    register uint32_t a3 __asm("a3") = first;
    register const void *a4 __asm("a4") = second;
    register uint32_t a5 __asm("a5") = third;
    __asm volatile("simcall" : "+r"(a2), "+r"(a3) : "r"(a4), "r"(a5) : "memory");
    return a2;
}

void platform_print(const char *text)
{
    uint32_t length = 0;
    while (text[length] != '\0')
        length++;
    simcall(SIM_WRITE, STANDARD_OUTPUT, text, length);
}

void platform_clock_start(void)
{
}

/* Under `qemu -icount shift=0` an instruction takes a nanosecond, and the counter goes on every 25 of them. */
uint32_t platform_clock(void)
{
    uint32_t count;
    __asm volatile("rsr %0, ccount" : "=r"(count) : : "memory");
    return count;
}

uint32_t platform_clock_count(uint32_t ticks)
{
    return ticks * 25u;
}

void xtensa_main(void)
{
    static uint32_t argument[256];      /* addresses, a zero, what they point to */
    char **argv = (char **)argument;
    uint32_t count = simcall(SIM_ARGC, 0, NULL, 0);
    if (simcall(SIM_ARGV_BYTES, 0, NULL, 0) > sizeof argument)
        count = 0;
    else
        simcall(SIM_ARGV, (uint32_t)argument, NULL, 0);
    simcall(SIM_EXIT, (uint32_t)main((int)count, argv), NULL, 0);
}

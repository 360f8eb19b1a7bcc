/* SPDX-License-Identifier: MIT */
/* platform.c - platform.h on QEMU's virt machine. Under `qemu -icount shift=0` the counter of retired
 * instructions is exact. */
#include "platform/platform.h"
#include "platform/common/arguments.h"
#include "platform/common/semihost.h"

int main(int argc, char **argv);
void riscv_main(void);

const char platform_clock_unit[] = "instructions";

void platform_print(const char *text)
{
    semihost_print(text);
}

void platform_clock_start(void)
{
}

uint32_t platform_clock(void)
{
    uint32_t count;
    __asm volatile(".option push\n\t.option arch, +zicsr\n\tcsrr %0, minstret\n\t.option pop"
                   : "=r"(count) : : "memory");
    return count;
}

uint32_t platform_clock_count(uint32_t ticks)
{
    return ticks;
}

void riscv_main(void)
{
    static char line[COMMAND_LINE_BYTES];
    static char *argument[MAX_ARGUMENTS + 1];
    int count = semihost_command_line(line, sizeof line) ? arguments_split(line, argument) : 0;
    semihost_exit(main(count, argument));
}

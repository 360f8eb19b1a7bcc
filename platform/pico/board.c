/* SPDX-License-Identifier: MIT */
/* board.c - platform.h on an RP2040 or RP2350: clock, memory, stacks, and main.
 *
 * Text goes to UART0 (GP0), 115200 baud. Arguments lie in flash, where an emulator or a tool that edits the image puts
 * them; without any the demo shows its loop. A first argument cores=1 leaves core 1 alone. All RAM behind the program's
 * own data is the arena. Core 0's stack are both small banks of RAM, 8 kB; core 1's is an array. */
#include "platform/platform.h"
#include "platform/common/arguments.h"
#include "platform/pico/board.h"
#include "platform/pico/sdk.h"
#include "platform/words.h"

#include <string.h>

enum { UART_TX = 0, BAUD = 115200, CORE1_STACK = 5008, STACK_PAINT = 0x5ac35ac3 };

/* The text is found by its mark. */
static const volatile struct {
    char mark[16], text[COMMAND_LINE_BYTES];
} arguments __attribute__((used)) = { .mark = "smear arguments" };

const char platform_clock_unit[] = "cycles";

extern uint32_t __end__[];
extern uint64_t __StackLimit[], __StackTop[];
extern uint32_t link_hot_start[], link_hot_end[], link_hot_load[];

static uint32_t core1_stack[CORE1_STACK / 4];

static int cores = 2;

int demo_main(int argc, char **argv);

int board_cores(void)
{
    return cores;
}

void *platform_arena(size_t *bytes)
{
    /* The SDK's script ends data at a word. */
    const uintptr_t start = ((uintptr_t)__end__ + 7) & ~(uintptr_t)7;
    *bytes = (size_t)((uintptr_t)__StackLimit - start);
    return (void *)start;
}

void platform_print(const char *text)
{
    for (; *text != '\0'; text++)
        uart_putc(uart0, *text);
}

/* From `limit` up, how much differs from the paint. */
static uint32_t used(const uint32_t *limit, const uint32_t *top)
{
    const uint32_t *lowest = limit;
    while (lowest < top && *lowest == STACK_PAINT)
        lowest++;
    return lowest == limit ? UINT32_MAX : (uint32_t)((uintptr_t)top - (uintptr_t)lowest);
}

/* Of both cores together. */
uint32_t platform_stack_used(void)
{
    const uint32_t first = used((const uint32_t *)__StackLimit, (const uint32_t *)__StackTop);
    const uint32_t second = used(core1_stack, core1_stack + CORE1_STACK / 4);
    return first == UINT32_MAX || second == UINT32_MAX ? UINT32_MAX : first + second;
}

void platform_clock_start(void)
{
}

/* Microseconds; the chip has no counter of 32 bits that is finer. */
uint32_t platform_clock(void)
{
    return time_us_32();
}

uint32_t platform_clock_count(uint32_t ticks)
{
    return ticks * (BOARD(CLOCK_KHZ) / 1000);
}

void board_start_core1(void (*entry)(void))
{
    multicore_launch_core1_with_stack(entry, core1_stack, sizeof core1_stack);
}

static void paint_stacks(void)
{
    const uint32_t *here = __builtin_frame_address(0);
    for (volatile uint32_t *at = (volatile uint32_t *)__StackLimit; at < here - 64; at++)
        *at = STACK_PAINT;
    for (uint32_t i = 0; i < CORE1_STACK / 4; i++)
        core1_stack[i] = STACK_PAINT;
}

int main(void)
{
    static char line[COMMAND_LINE_BYTES + 8] = "program ";
    static char *word[MAX_ARGUMENTS + 1];
    char **argument = word;
    paint_stacks();
    memcpy(link_hot_start, link_hot_load, (size_t)((uintptr_t)link_hot_end - (uintptr_t)link_hot_start));
    set_sys_clock_khz(BOARD(CLOCK_KHZ), true);
    clock_configure(clk_peri, 0, CLOCKS_CLK_PERI_CTRL_AUXSRC_VALUE_CLK_SYS, BOARD(CLOCK_KHZ) * 1000, BOARD(CLOCK_KHZ) * 1000);
    uart_init(uart0, BAUD);
    gpio_set_function(UART_TX, GPIO_FUNC_UART);
    for (int i = 0; i < COMMAND_LINE_BYTES - 1; i++)
        line[8 + i] = arguments.text[i];
    int count = arguments_split(line, word);
    if (count > 1 && is_word(word[1], "cores=1")) {
        cores = 1;
        argument++;
        count--;
    }
    const int status = demo_main(count, argument);
    platform_print(status == 0 ? "#exit 0\n" : "#exit 1\n");
    for (;;)
        __wfi();
}

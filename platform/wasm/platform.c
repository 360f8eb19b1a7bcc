/* SPDX-License-Identifier: MIT */
/* platform.c - platform.h in a WebAssembly module. Text and the clock are functions of whoever loads it (run.mjs, game.js): they
 * write the command line where wasm_command_line says, and call wasm_main. */
#include "platform/platform.h"
#include "platform/common/arguments.h"

#define EXPORT(name) __attribute__((export_name(#name)))
#define IMPORT(name) __attribute__((import_module("platform"), import_name(#name)))

enum { ARENA_BYTES = 16 << 20 };

int main(int argc, char **argv);

IMPORT(print) void import_print(const char *text);
IMPORT(clock) uint32_t import_clock(void);      /* microseconds */

const char platform_clock_unit[] = "microseconds";

static char command_line[COMMAND_LINE_BYTES];

EXPORT(wasm_command_line) char *wasm_command_line(void)
{
    return command_line;
}

EXPORT(wasm_command_line_bytes) int wasm_command_line_bytes(void)
{
    return COMMAND_LINE_BYTES;
}

EXPORT(wasm_main) int wasm_main(void)
{
    static char *argument[MAX_ARGUMENTS + 1];
    const int count = arguments_split(command_line, argument);
    return main(count, argument);
}

void platform_print(const char *text)
{
    import_print(text);
}

void *platform_arena(size_t *bytes)
{
    static uint64_t arena[ARENA_BYTES / 8];
    *bytes = sizeof arena;
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
    return import_clock();
}

uint32_t platform_clock_count(uint32_t ticks)
{
    return ticks;
}

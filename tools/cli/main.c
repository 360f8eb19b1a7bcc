/* SPDX-License-Identifier: MIT */
/* main.c - the program `smear`: finds the command and hands over. */
#include "commands.h"

#include "arguments.h"
#include "say.h"

#include <string.h>

int main(int argc, char **argv)
{
    static const struct {
        const char *name;
        int (*run)(int count, char **text);
    } commands[] = {
        { "render", command_render }, { "compare", command_compare }, { "info", command_info },
        { "help", command_help },     { "--help", command_help },     { "-h", command_help },
    };
    static const char *const planned[] = { "view", "convert", "bench", "chart", NULL };
    if (argc < 2)
        return say_bad_usage("no command", "render, compare, info or help (smear help)");
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        if (strcmp(argv[1], commands[i].name) == 0)
            return commands[i].run(argc - 2, argv + 2);
    if (read_name(argv[1], planned) >= 0)
        return say_bad_usage(argv[1], "not built yet");
    return say_bad_usage(argv[1], "unknown command (smear help)");
}

/* SPDX-License-Identifier: MIT */
/* main.c - the program `smear`: finds the command and hands over. */
#include "tools/cli/commands.h"

#include "tools/guess.h"
#include "tools/image/file.h"
#include "tools/options/arguments.h"
#include "tools/options/say.h"
#include "smear.h"

#include <stdio.h>
#include <string.h>

static int command_version(int count, char **text)
{
    if (count > 0)
        return say_bad_usage(text[0], "one argument too many");
    printf("smear %d.%d.%d\n", SMEAR_VERSION_MAJOR, SMEAR_VERSION_MINOR, SMEAR_VERSION_PATCH);
    return STATUS_OK;
}

static const struct {
    const char *name;
    int (*run)(int count, char **text);
} commands[] = {
    { "convert", command_convert }, { "show", command_show },
    { "render", command_render }, { "compare", command_compare }, { "info", command_info },
    { "view", command_view },     { "bench", command_bench },     { "chart", command_chart },
    { "help", command_help },     { "--help", command_help },     { "-h", command_help },
    { "--version", command_version }, { "-v", command_version },
};

int say_unknown_command(const char *name)
{
    struct guess guess = { .word = name };
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        guess_try(&guess, commands[i].name);
    return say_unknown(name, "unknown command", &guess, "smear help");
}

static int run_command(const char *name, int count, char **text)
{
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
        if (strcmp(name, commands[i].name) == 0)
            return commands[i].run(count, text);
    return say_unknown_command(name);
}

int main(int argc, char **argv)
{
    output_catch_signals();
    int status = argc < 2 ? help_print(NULL) : run_command(argv[1], argc - 2, argv + 2);
    struct failure f = { "" };
    if (!output_flush_standard(&f) && status == STATUS_OK)
        status = say_bad_input("standard output", &f);
    if (status == STATUS_OK)
        say_done();
    return status;
}

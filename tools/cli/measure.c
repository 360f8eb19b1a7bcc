/* SPDX-License-Identifier: MIT */
/* measure.c - `smear bench` and `smear chart`: the program smear-bench, which is built with this
 * one and lies beside it. It is one of its own because it runs itself under callgrind and brings a
 * second renderer to measure against. */
#include "tools/cli/commands.h"

#include "tools/options/say.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_LIMIT = 4096 };

/* Where this program is; where it is built, if nobody knows. */
static void path_beside(char out[PATH_LIMIT], const char *name)
{
    ssize_t length = readlink("/proc/self/exe", out, PATH_LIMIT - 1);
    out[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(out, '/');
    size_t folder = slash != NULL ? (size_t)(slash + 1 - out) : 0;
    if (folder == 0 || folder + strlen(name) >= PATH_LIMIT)
        snprintf(out, PATH_LIMIT, "build/%s", name);
    else
        memcpy(out + folder, name, strlen(name) + 1);
}

/* Returns only when that fails. */
static int hand_over(const char *command, const char *report, int count, char **text)
{
    char path[PATH_LIMIT];
    struct failure f = { "" };
    int n = 0;
    path_beside(path, "smear-bench");
    const char **argument = calloc((size_t)count + 3, sizeof *argument);
    if (argument == NULL) {
        fail(&f, "out of memory");
        return say_bad_input(command, &f);
    }
    argument[n++] = path;
    if (report != NULL)
        argument[n++] = report;
    for (int i = 0; i < count; i++)
        argument[n++] = text[i];
    /* execv takes pointers to char for history's sake and changes nothing. */
    char **plain = calloc((size_t)n + 1, sizeof *plain);
    if (plain != NULL) {
        memcpy(plain, argument, (size_t)n * sizeof *plain);
        execv(path, plain);
    }
    fail(&f, "cannot be run (%s); `make` builds it", strerror(errno));
    free(plain);
    free(argument);
    return say_bad_input(path, &f);
}

static bool asks_for_help(int count, char **text)
{
    return count > 0 && strcmp(text[0], "--help") == 0;
}

int command_bench(int count, char **text)
{
    if (asks_for_help(count, text))
        return help_print("bench");
    return hand_over("bench", NULL, count, text);
}

int command_chart(int count, char **text)
{
    if (asks_for_help(count, text))
        return help_print("chart");
    return hand_over("chart", "chart", count, text);
}

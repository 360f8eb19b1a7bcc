/* SPDX-License-Identifier: MIT */
/* arguments.c - see arguments.h. */
#include "platform/common/arguments.h"

#include <stddef.h>

int arguments_split(char *line, char **argument)
{
    int count = 0;
    while (*line != '\0' && count < MAX_ARGUMENTS) {
        while (*line == ' ')
            *line++ = '\0';
        if (*line == '\0')
            break;
        argument[count++] = line;
        while (*line != '\0' && *line != ' ')
            line++;
    }
    argument[count] = NULL;
    return count;
}

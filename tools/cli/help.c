/* SPDX-License-Identifier: MIT */
#include "commands.h"
#include <stdio.h>
int help_print(const char *command) { printf("help %s\n", command ? command : ""); return 0; }
int command_help(int count, char **text) { return help_print(count > 0 ? text[0] : 0); }

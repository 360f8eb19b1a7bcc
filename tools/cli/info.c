/* SPDX-License-Identifier: MIT */
#include "commands.h"
int command_info(int count, char **text) { (void)count; (void)text; return 2; }

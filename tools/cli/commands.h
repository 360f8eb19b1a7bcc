/* SPDX-License-Identifier: MIT */
/* commands.h - the commands of the program. Each gets the arguments behind its name, and returns
 * the exit status after it has said what went wrong. */
#ifndef SMEAR_TOOLS_CLI_COMMANDS_H
#define SMEAR_TOOLS_CLI_COMMANDS_H

int command_render(int count, char **text);
int command_convert(int count, char **text);
int command_compare(int count, char **text);
int command_info(int count, char **text);
int command_view(int count, char **text);
int command_show(int count, char **text);
int command_bench(int count, char **text);
int command_chart(int count, char **text);
int command_help(int count, char **text);

int view_help_print(void);

/* The board of this name. Returns null, or what is wrong with the name. */
struct board;
const char *view_read_board(const char *value, const struct board **board);

/* Says that there is no such command, and which may have been meant. A status. */
int say_unknown_command(const char *name);

/* Prints the help of a command (null: of the program) on standard output. */
int help_print(const char *command);

#endif

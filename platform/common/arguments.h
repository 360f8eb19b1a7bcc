/* SPDX-License-Identifier: MIT */
/* arguments.h - a command line as main wants it. */
#ifndef SMEAR_ARGUMENTS_H
#define SMEAR_ARGUMENTS_H

enum { MAX_ARGUMENTS = 8, COMMAND_LINE_BYTES = 128 };

/* Splits `line` at its spaces, which become NULs; argument has room for MAX_ARGUMENTS and a null.
 * Returns their number. */
int arguments_split(char *line, char **argument);

#endif

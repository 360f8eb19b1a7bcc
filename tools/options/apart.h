/* SPDX-License-Identifier: MIT */
/* apart.h - whether a command's outputs are files of their own: no two of them one file, and none a file that is read,
 * whatever they are called. */
#ifndef SMEAR_TOOLS_CLI_APART_H
#define SMEAR_TOOLS_CLI_APART_H

#include <stdbool.h>

/* An output, `-` for standard output; null: there is none. Where it is a pattern, its last %d or %0Nd stands for the
 * numbers first .. last. */
struct apart_output {
    const char *path;
    bool is_pattern;
    long first, last;
};

/* A status: STATUS_BAD_USAGE, and a line, when two of them may be one file: by their names, by links of either kind, or by
 * what standard output leads to. Looks into their folders and changes nothing. */
int apart_check(const struct apart_output *list, int count);

/* Likewise when one of them is a file that has been read (file_keep). */
int apart_check_inputs(const struct apart_output *list, int count);

#endif

/* SPDX-License-Identifier: MIT */
/* arguments.h - walks a command line by a table of options, and reads strict numbers.
 *
 * `--name value` and `--name=value` are the same; `--` ends the options. */
#ifndef SMEAR_TOOLS_CLI_ARGUMENTS_H
#define SMEAR_TOOLS_CLI_ARGUMENTS_H

#include <stdbool.h>

/* How an option's value (null when it has none) gets into what `options` points to. Returns null,
 * or what is wrong with it. */
typedef const char *option_read_fn(void *options, const char *value);

struct option {
    const char *name;           /* with its dashes; null ends the table */
    bool has_value;
    option_read_fn *read;
};

/* Reads a whole command line: options through the table, up to `operand_limit` operands into
 * `operand` (the rest null). With --help among the options *wants_help is set and the rest is not
 * looked at. Returns a status. */
int arguments_read(int count, char **text, const struct option *table, void *options,
                   const char **operand, int operand_limit, bool *wants_help);

/* Options of this table, too, are what a misspelt one may have meant. */
void arguments_guess_also(const struct option *table);

/* The whole text must be one decimal number within low..high (inclusive): no sign but '-', no
 * blanks, no "inf", "nan" or hexadecimal. Integers are digits only. */
bool read_number(const char *text, double low, double high, double *out);
bool read_integer(const char *text, long low, long high, long *out);
/* Three numbers of +-1e9, with commas. */
bool read_vector(const char *text, double out[3]);
/* Two integers within 1..limit, with an x. */
bool read_size(const char *text, long limit, int *width, int *height);
/* A-B, both 0..999999999, A <= B. */
bool read_range(const char *text, long *first, long *last);
/* RRGGBB, six hexadecimal digits. */
bool read_color(const char *text, unsigned *rgb);
/* The index of `text` in a null-terminated list, or -1; then the line that is said tells the nearest name. */
int read_name(const char *text, const char *const *names);
/* Takes a name into account that `text`, which is none, may have meant. */
void read_near(const char *text, const char *name);
/* A list NAME or NAME=VALUE with commas: takes one after the other, with a null value where there is none. False when that
 * says so, or a part is too long. */
enum { LIST_PART = 160 };       /* bytes of a part, with its end */
typedef bool read_part_fn(void *to, const char *name, const char *value);
bool read_list(const char *text, read_part_fn *take, void *to);

#endif

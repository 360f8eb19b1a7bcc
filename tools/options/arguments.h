/* SPDX-License-Identifier: MIT */
/* arguments.h - walks a command line by a table of options, and reads strict numbers.
 *
 * `--name value` and `--name=value` are the same; `--` ends the options. */
#ifndef SMEAR_TOOLS_CLI_ARGUMENTS_H
#define SMEAR_TOOLS_CLI_ARGUMENTS_H

#include <stdbool.h>
#include <stddef.h>

/* How a value gets into what `options` points to, where no other kind does. Returns null, or what is wrong with it. */
typedef const char *option_read_fn(void *options, const char *value);

/* What the value of an option is, and what it becomes in the member of a struct of options. */
enum option_kind {
    OPTION_FLAG,                /* there is none: a bool or enum becomes 1 */
    OPTION_TEXT,                /* a text that is not empty */
    OPTION_INTEGER,             /* a whole number within low..high */
    OPTION_NUMBER,              /* a number within low..high: a double */
    OPTION_NAME,                /* one of `names`: an integer, bool or enum becomes its value or, without values, low + its index */
    OPTION_READ                 /* what `read` takes */
};

struct option {
    const char *name;           /* with its dashes; null ends the table */
    enum option_kind kind;
    size_t at, size;            /* of the member, whose size tells its type */
    size_t given;               /* of a bool that becomes true with it; 0: none */
    double low, high;
    const char *needs;          /* the noun of its error; null: "a number", "a file name" */
    const char *const *names;   /* null ends them */
    const int *values;
    option_read_fn *read;
};

#define OPTION_AT(type, member) .at = offsetof(type, member), .size = sizeof(((type *)0)->member)
#define OPTION_NAMES(...) .names = (const char *const[]){ __VA_ARGS__, NULL }
#define OPTION_VALUES(...) .values = (const int[]){ __VA_ARGS__ }

static inline bool option_has_value(const struct option *option)
{
    return option->kind != OPTION_FLAG;
}

/* Reads a whole command line: options through the table, up to `operand_limit` operands into
 * `operand` (the rest null). With --help among the options *wants_help is set and the rest is not
 * looked at. Returns a status. */
int arguments_read(int count, char **text, const struct option *table, void *options,
                   const char **operand, int operand_limit, bool *wants_help);

/* From now on command lines may have options of this table, too, which go into what `options` points to. */
void arguments_also(const struct option *table, void *options);

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

/* SPDX-License-Identifier: MIT */
/* arguments.c - see arguments.h. */
#include "tools/options/arguments.h"

#include "tools/guess.h"
#include "tools/options/say.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The option that `text` names, up to an equals sign if there is one; or null. */
static const struct option *find_option(const struct option *table, const char *text,
                                        const char **value)
{
    const char *equals = strncmp(text, "--", 2) == 0 ? strchr(text, '=') : NULL;
    size_t length = equals != NULL ? (size_t)(equals - text) : strlen(text);
    *value = equals != NULL ? equals + 1 : NULL;
    for (; table->name != NULL; table++)
        if (strlen(table->name) == length && strncmp(table->name, text, length) == 0)
            return table;
    return NULL;
}

/* Of a command whose options are in two tables: the one whose names go first. */
static const struct option *other_table;
static void *other_options;

void arguments_also(const struct option *table, void *options)
{
    other_table = table;
    other_options = options;
}

static int say_no_option(const char *text, const struct option *table)
{
    char word[GUESS_LETTERS + 2];
    struct guess guess = { .word = word };
    snprintf(word, sizeof word, "%.*s", (int)strcspn(text, "="), text);
    for (; table->name != NULL; table++)
        guess_try(&guess, table->name);
    for (table = other_table; table != NULL && table->name != NULL; table++)
        guess_try(&guess, table->name);
    return say_unknown(text, "unknown option", &guess, NULL);
}

/* What a value may have meant that is none of the names it can have. */
static struct guess near;

void read_near(const char *text, const char *name)
{
    if (near.word != text)
        near = (struct guess){ .word = text };
    guess_try(&near, name);
}

static int say_wrong(const char *option, const char *wrong, const char *value)
{
    if (value == NULL)
        return say_bad_usage(option, "%s", wrong);
    if (near.best == NULL)
        return say_bad_usage(option, "%s (\"%s\")", wrong, value);
    return say_bad_usage(option, "%s; did you mean %s? (\"%s\")", wrong, near.best, value);
}

/* ------------------------------------------------------------------ values */

static const char *say_needs(const char *format, ...)
{
    static char text[280];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return text;
}

static const char *say_names(const char *const *names)
{
    char list[240] = "";
    for (size_t used = 0; *names != NULL && used < sizeof list; names++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", *names,
                                 names[1] == NULL ? "" : names[2] == NULL ? " or " : ", ");
    return say_needs("needs %s", list);
}

static void put_integer(const struct option *option, void *options, long number)
{
    void *to = (char *)options + option->at;
    switch (option->size) {
    case sizeof(bool): *(bool *)to = number != 0; break;
    case sizeof(int): *(int *)to = (int)number; break;
    default: *(long *)to = number; break;
    }
}

/* Returns null, or what is wrong. */
static const char *take_value(const struct option *option, void *options, const char *value)
{
    void *to = (char *)options + option->at;
    const char *noun = option->needs;
    long number = 1;
    int found;
    switch (option->kind) {
    case OPTION_READ: return option->read(options, value);
    case OPTION_TEXT:
        *(const char **)to = value;
        if (value[0] == '\0')
            return say_needs("needs %s", noun != NULL ? noun : "a file name");
        break;
    case OPTION_NUMBER:
        if (!read_number(value, option->low, option->high, to))
            return say_needs("needs %s from %.9g to %.9g", noun != NULL ? noun : "a number", option->low, option->high);
        break;
    case OPTION_INTEGER:
        if (!read_integer(value, (long)option->low, (long)option->high, &number))
            return say_needs("needs %s from %ld to %ld", noun != NULL ? noun : "a number", (long)option->low, (long)option->high);
        put_integer(option, options, number);
        break;
    case OPTION_NAME:
        found = read_name(value, option->names);
        if (found < 0)
            return say_names(option->names);
        put_integer(option, options, option->values != NULL ? option->values[found] : (long)option->low + found);
        break;
    case OPTION_FLAG: put_integer(option, options, 1); break;
    }
    if (option->given != 0)
        *((bool *)options + option->given) = true;
    return NULL;
}

/* ------------------------------------------------------------------ command lines */

int arguments_read(int count, char **text, const struct option *table, void *options,
                   const char **operand, int operand_limit, bool *wants_help)
{
    bool options_ended = false;
    int operands = 0;
    *wants_help = false;
    for (int i = 0; i < operand_limit; i++)
        operand[i] = NULL;
    for (int i = 0; i < count; i++) {
        const char *value, *wrong;
        if (!options_ended && strcmp(text[i], "--") == 0) {
            options_ended = true;
            continue;
        }
        if (options_ended || text[i][0] != '-' || text[i][1] == '\0') {
            if (operands == operand_limit)
                return say_bad_usage(text[i], "one argument too many");
            operand[operands++] = text[i];
            continue;
        }
        if (strcmp(text[i], "--help") == 0 || strcmp(text[i], "-h") == 0) {
            *wants_help = true;
            return STATUS_OK;
        }
        const struct option *option = other_table != NULL ? find_option(other_table, text[i], &value) : NULL;
        void *const to = option != NULL ? other_options : options;
        if (option == NULL)
            option = find_option(table, text[i], &value);
        if (option == NULL)
            return say_no_option(text[i], table);
        if (!option_has_value(option) && value != NULL)
            return say_bad_usage(option->name, "takes no value");
        if (option_has_value(option) && value == NULL && ++i == count)
            return say_bad_usage(option->name, "needs a value");
        if (option_has_value(option) && value == NULL)
            value = text[i];
        near = (struct guess){ .word = NULL };
        wrong = take_value(option, to, value);
        if (wrong != NULL)
            return say_wrong(option->name, wrong, value);
    }
    return STATUS_OK;
}

bool read_number(const char *text, double low, double high, double *out)
{
    const char *digits = *text == '-' ? text + 1 : text;
    if (*digits == '\0' || strchr("0123456789.", *digits) == NULL ||
        strspn(text, "0123456789.eE+-") != strlen(text))
        return false;
    char *end;
    double value = strtod(text, &end);
    if (*end != '\0' || !isfinite(value) || !(value >= low && value <= high))
        return false;
    *out = value;
    return true;
}

bool read_integer(const char *text, long low, long high, long *out)
{
    size_t length = strlen(text);
    if (length == 0 || strspn(text, "0123456789") != length)
        return false;
    errno = 0;
    long value = strtol(text, NULL, 10);
    if (errno != 0 || value < low || value > high)
        return false;
    *out = value;
    return true;
}

/* Copies the text up to `stop` (or to the end, when stop is NUL) and returns what follows it. */
static const char *cut_piece(const char *text, char stop, char piece[64])
{
    size_t length = stop != '\0' && strchr(text, stop) != NULL
                        ? (size_t)(strchr(text, stop) - text) : strlen(text);
    if (length >= 64 || (stop != '\0' && text[length] != stop))
        return NULL;
    memcpy(piece, text, length);
    piece[length] = '\0';
    return text + length + (stop != '\0' ? 1 : 0);
}

bool read_vector(const char *text, double out[3])
{
    char piece[64];
    for (int i = 0; i < 3; i++) {
        text = cut_piece(text, i < 2 ? ',' : '\0', piece);
        if (text == NULL || !read_number(piece, -1e9, 1e9, &out[i]))
            return false;
    }
    return true;
}

static bool read_pair(const char *text, char between, long low, long high, long out[2])
{
    char piece[64];
    for (int i = 0; i < 2; i++) {
        text = cut_piece(text, i < 1 ? between : '\0', piece);
        if (text == NULL || !read_integer(piece, low, high, &out[i]))
            return false;
    }
    return true;
}

bool read_size(const char *text, long limit, int *width, int *height)
{
    long pair[2];
    if (!read_pair(text, 'x', 1, limit, pair))
        return false;
    *width = (int)pair[0];
    *height = (int)pair[1];
    return true;
}

bool read_range(const char *text, long *first, long *last)
{
    long pair[2];
    if (!read_pair(text, '-', 0, 999999999, pair) || pair[0] > pair[1])
        return false;
    *first = pair[0];
    *last = pair[1];
    return true;
}

bool read_color(const char *text, unsigned *rgb)
{
    if (strlen(text) != 6 || strspn(text, "0123456789abcdefABCDEF") != 6)
        return false;
    *rgb = (unsigned)strtoul(text, NULL, 16);
    return true;
}

int read_name(const char *text, const char *const *names)
{
    for (int i = 0; names[i] != NULL; i++)
        if (strcmp(text, names[i]) == 0)
            return i;
    for (int i = 0; names[i] != NULL; i++)
        read_near(text, names[i]);
    return -1;
}

bool read_list(const char *text, read_part_fn *take, void *to)
{
    for (;;) {
        char part[LIST_PART];
        size_t length = strcspn(text, ",");
        if (length >= sizeof part)
            return false;
        memcpy(part, text, length);
        part[length] = '\0';
        char *value = strchr(part, '=');
        if (value != NULL)
            *value++ = '\0';
        if (!take(to, part, value))
            return false;
        if (text[length] == '\0')
            return true;
        text += length + 1;
    }
}

/* SPDX-License-Identifier: MIT */
/* failure.h - how the host tools report bad input.
 *
 * A function that can fail on what a user gave it takes a `struct failure *`, returns true on success,
 * and on failure returns false with one line of text: what is wrong, and where in brackets. The caller
 * knows the file and prints `smear: FILE: text`. The first failure is kept: code that cleans up after an
 * error cannot hide its cause. */
#ifndef SMEAR_TOOLS_FAILURE_H
#define SMEAR_TOOLS_FAILURE_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

struct failure {
    char text[200];     /* empty while nothing has failed */
};

/* Notes the failure in printf style unless one is there already; always returns false, so that
 * `return fail(f, ...)` reads well. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static inline bool fail(struct failure *f, const char *format, ...)
{
    if (f->text[0] == '\0') {
        va_list args;
        va_start(args, format);
        vsnprintf(f->text, sizeof f->text, format, args);
        va_end(args);
    }
    return false;
}

#endif

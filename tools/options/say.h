/* SPDX-License-Identifier: MIT */
/* say.h - the one line a user sees when something is wrong, and the exit status that goes with it.
 *
 * Functions of the program that return `int` return a status: STATUS_OK, or another one after they
 * have printed their line. */
#ifndef SMEAR_TOOLS_CLI_SAY_H
#define SMEAR_TOOLS_CLI_SAY_H

#include "tools/failure.h"
#include "tools/guess.h"

enum status {
    STATUS_OK = 0,
    STATUS_BAD_INPUT = 1,       /* a file, or what the machine can do with it */
    STATUS_BAD_USAGE = 2        /* the command line */
};

/* `smear: WHAT: text` on standard error; control characters come out as '?', so that it is one line
 * whatever a file is called. `what` is a file, a command or an option. */
int say_bad_input(const char *what, const struct failure *f);
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
int say_bad_usage(const char *what, const char *format, ...);
/* That there is no such thing: what it may have meant, else the help (if not null) that lists what there is. */
int say_unknown(const char *what, const char *text, const struct guess *guess, const char *help);

/* A warning that is said when what was asked for is done, as what fails has one line only. Said once, however often it comes;
 * of very many the first are kept. */
void say_warning_when_done(const char *what, const char *text);
void say_done(void);

/* How far a long run has come, on a terminal only, from the first second on. The next line that is
 * printed by say_* or say_progress_end wipes it away. */
void say_progress(long done, long all, const char *unit);
void say_progress_end(void);

/* What there is instead of what was asked for: names in quotes, as many as fit, and how many more there are. Begins
 * zeroed. */
struct say_list {
    char text[220];
    int count, left_out;
    struct guess guess;         /* with a word: what that may have meant */
};
void say_list_add(struct say_list *list, const char *name);
const char *say_list_end(struct say_list *list);

#endif

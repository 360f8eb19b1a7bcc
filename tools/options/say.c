/* SPDX-License-Identifier: MIT */
/* say.c - see say.h. */
#include "tools/options/say.h"

#include <string.h>
#include <time.h>
#include <unistd.h>

static bool progress_shown;

enum { LINE = 4400, KEPT = 4 };

/* What say_done says. */
static char kept[KEPT][LINE];
static bool is_said[KEPT];

static void make_line(char line[LINE], const char *what, const char *kind, const char *text)
{
    int length = snprintf(line, LINE, "smear: %s: %s%s", *what != '\0' ? what : "\"\"", kind, text);
    for (int i = 0; i < length && line[i] != '\0'; i++)
        if ((unsigned char)line[i] < 32 || line[i] == 127)
            line[i] = '?';
}

static void say_line(const char *what, const char *text)
{
    char line[LINE];
    make_line(line, what, "", text);
    say_progress_end();
    fprintf(stderr, "%s\n", line);
}

int say_bad_input(const char *what, const struct failure *f)
{
    say_line(what, f->text);
    return STATUS_BAD_INPUT;
}

int say_bad_usage(const char *what, const char *format, ...)
{
    char text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    say_line(what, text);
    return STATUS_BAD_USAGE;
}

int say_unknown(const char *what, const char *text, const struct guess *guess, const char *help)
{
    if (guess->best != NULL)
        return say_bad_usage(what, "%s (did you mean %s?)", text, guess->best);
    return help != NULL ? say_bad_usage(what, "%s (%s)", text, help) : say_bad_usage(what, "%s", text);
}

void say_warning_when_done(const char *what, const char *text)
{
    char line[LINE];
    make_line(line, what, "warning: ", text);
    for (int i = 0; i < KEPT; i++) {
        if (strcmp(kept[i], line) == 0)
            return;
        if (kept[i][0] == '\0') {
            memcpy(kept[i], line, sizeof line);
            return;
        }
    }
}

void say_done(void)
{
    say_progress_end();
    for (int i = 0; i < KEPT && kept[i][0] != '\0'; i++) {
        if (!is_said[i])
            fprintf(stderr, "%s\n", kept[i]);
        is_said[i] = true;
    }
}

void say_progress(long done, long all, const char *unit)
{
    static struct timespec start, shown;
    struct timespec now;
    if (isatty(STDERR_FILENO) == 0 || clock_gettime(CLOCK_MONOTONIC, &now) != 0)
        return;
    if (start.tv_sec == 0 && start.tv_nsec == 0)
        start = now;
    if (now.tv_sec - start.tv_sec < 1 || now.tv_sec == shown.tv_sec)
        return;
    shown = now;
    progress_shown = true;
    fprintf(stderr, "\r%s %ld of %ld ", unit, done, all);
    fflush(stderr);
}

void say_progress_end(void)
{
    if (progress_shown)
        fprintf(stderr, "\r%40s\r", "");
    progress_shown = false;
}

enum { ROOM_FOR_MORE = 24 };

void say_list_add(struct say_list *list, const char *name)
{
    size_t used = strlen(list->text), room = sizeof list->text - ROOM_FOR_MORE - used;
    int length = list->left_out > 0 ? -1 : snprintf(list->text + used, room, "%s\"%s\"", used > 0 ? ", " : "", name);
    list->count++;
    if (list->guess.word != NULL)
        guess_try(&list->guess, name);
    if (length < 0 || (size_t)length >= room) {
        list->text[used] = '\0';
        list->left_out++;
    }
}

const char *say_list_end(struct say_list *list)
{
    size_t used = strlen(list->text);
    if (list->left_out > 0)
        snprintf(list->text + used, sizeof list->text - used, "%s%d%s", used > 0 ? " and " : "", list->left_out,
                 used > 0 ? " more" : " with long names");
    return list->count > 0 ? list->text : "none";
}

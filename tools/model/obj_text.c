/* SPDX-License-Identifier: MIT */
/* obj_text.c - see obj_text.h. */
#include "tools/model/obj_text.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool obj_text_open(const uint8_t *bytes, size_t size, struct obj_text *out, struct failure *f)
{
    static const uint8_t byte_order_mark[3] = { 0xef, 0xbb, 0xbf };
    *out = (struct obj_text){ 0 };
    if (size >= 3 && memcmp(bytes, byte_order_mark, 3) == 0)
        bytes += 3, size -= 3;
    if (memchr(bytes, '\0', size) != NULL)
        return fail(f, "neither glTF nor text");
    out->copy = malloc(size + 1);
    if (out->copy == NULL)
        return fail(f, "out of memory (%zu bytes of text)", size);
    memcpy(out->copy, bytes, size);
    out->copy[size] = '\0';
    out->size = size;
    return true;
}

void obj_text_close(struct obj_text *text)
{
    free(text->copy);
    *text = (struct obj_text){ 0 };
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* The line at `at`, joined with those that a backslash continues; NUL takes the place of its end.
 */
static char *next_line(struct obj_text *t)
{
    char *line = t->copy + t->at;
    t->line = t->lines_read + 1;
    for (;;) {
        char *end = memchr(t->copy + t->at, '\n', t->size - t->at);
        t->lines_read++;
        if (end == NULL) {
            t->at = t->size;
            return line;
        }
        t->at = (size_t)(end - t->copy) + 1;
        char *last = end > line && end[-1] == '\r' ? end - 1 : end;
        if (last == line || last[-1] != '\\') {
            *end = '\0';
            return line;
        }
        for (char *p = last - 1; p <= end; p++)
            *p = ' ';
    }
}

/* A '#' inside a word belongs to the word: names may have one. */
static void cut_comment(char *line)
{
    for (char *p = strchr(line, '#'); p != NULL; p = strchr(p + 1, '#')) {
        if (p == line || is_blank(p[-1])) {
            *p = '\0';
            return;
        }
    }
}

bool obj_text_next(struct obj_text *t, char **word, char **rest)
{
    while (t->at < t->size) {
        char *line = next_line(t);
        cut_comment(line);
        size_t length = strlen(line);
        while (length > 0 && is_blank(line[length - 1]))
            line[--length] = '\0';
        *rest = line;
        *word = obj_word(rest);
        if (*word != NULL)
            return true;
    }
    return false;
}

char *obj_word(char **rest)
{
    char *start = *rest;
    while (is_blank(*start))
        start++;
    char *end = start;
    while (*end != '\0' && !is_blank(*end))
        end++;
    *rest = end;
    if (*end != '\0') {
        *end++ = '\0';
        while (is_blank(*end))
            end++;
        *rest = end;
    }
    return *start == '\0' ? NULL : start;
}

bool obj_number(const char *word, float *out)
{
    if (word == NULL || word[strspn(word, "0123456789+-.eE")] != '\0')
        return false;
    char *end;
    double value = strtod(word, &end);
    if (end == word || *end != '\0' || !(fabs(value) <= (double)FLT_MAX))
        return false;
    *out = (float)value;
    return true;
}

/* Whether the word is this one, in letters of either size; `end` may follow it. */
static bool is_word(const char *word, const char *small, char end)
{
    for (; *small != '\0'; word++, small++) {
        if ((*word | 32) != *small)
            return false;
    }
    return *word == '\0' || *word == end;
}

bool obj_is_not_finite(const char *word)
{
    word += *word == '-' || *word == '+';
    return is_word(word, "nan", '(') || is_word(word, "inf", '\0') || is_word(word, "infinity", '\0') ||
           strncmp(word, "1.#", 3) == 0;
}

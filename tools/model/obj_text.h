/* SPDX-License-Identifier: MIT */
/* obj_text.h - the line format that OBJ and MTL share: statements of words, one per line, '#'
 * comments, a backslash at a line's end joins it to the next. */
#ifndef SMEAR_TOOLS_OBJ_TEXT_H
#define SMEAR_TOOLS_OBJ_TEXT_H

#include "tools/failure.h"

#include <stddef.h>
#include <stdint.h>

struct obj_text {
    char *copy;                 /* NUL-terminated; lines are cut up in place */
    size_t size, at;
    int line;                   /* of the statement last returned, from 1 */
    int lines_read;
};

/* Copies the text; refuses one with NUL bytes, which is no text. */
bool obj_text_open(const uint8_t *bytes, size_t size, struct obj_text *out, struct failure *f);
void obj_text_close(struct obj_text *text);

/* The next statement that is not empty: *word is its keyword, *rest what follows, without blanks at
 * either end. False at the end. */
bool obj_text_next(struct obj_text *text, char **word, char **rest);

/* Cuts the first word off *rest; null when there is none. */
char *obj_word(char **rest);

/* A decimal number that fits a float; hexadecimal, infinities and NaN are none. */
bool obj_number(const char *word, float *out);

/* What programs write for a result that is no finite number: nan, -inf, 1.#IND and their like. */
bool obj_is_not_finite(const char *word);

#endif

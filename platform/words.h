/* SPDX-License-Identifier: MIT */
/* words.h - arguments of the programs for targets, which have no string.h. */
#ifndef SMEAR_PLATFORM_WORDS_H
#define SMEAR_PLATFORM_WORDS_H

#include <stdbool.h>
#include <stdint.h>

static inline bool is_word(const char *text, const char *word)
{
    while (*text != '\0' && *text == *word)
        text++, word++;
    return *text == *word;
}

/* The digits that `text` begins with; 0 where there are none. */
static inline uint32_t read_decimal(const char *text)
{
    uint32_t value = 0;
    for (; *text >= '0' && *text <= '9'; text++)
        value = value * 10 + (uint32_t)(*text - '0');
    return value;
}

#endif

/* SPDX-License-Identifier: MIT */
/* glb.c - see glb.h. */
#include "tests/ref/glb.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void append(char *text, size_t room, const char *format, ...)
{
    const size_t length = strlen(text);
    va_list args;
    va_start(args, format);
    vsnprintf(text + length, room - length, format, args);
    va_end(args);
}

static void put_word(uint8_t *at, size_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> 8 * i);
}

uint8_t *glb_make(const char *json, const uint8_t *bin, size_t bin_size, size_t *size)
{
    const size_t length = strlen(json), padded = (length + 3) / 4 * 4, rest = (bin_size + 3) / 4 * 4;
    *size = 28 + padded + rest;
    uint8_t *glb = calloc(1, *size);
    if (glb == NULL)
        abort();
    memcpy(glb, "glTF", 4);
    put_word(glb + 4, 2);
    put_word(glb + 8, *size);
    put_word(glb + 12, padded);
    memcpy(glb + 16, "JSON", 4);
    memset(glb + 20, ' ', padded);
    for (size_t i = 0; i < length; i++)
        glb[20 + i] = (uint8_t)(json[i] == '\'' ? '"' : json[i]);
    put_word(glb + 20 + padded, rest);
    memcpy(glb + 24 + padded, "BIN", 4);
    memcpy(glb + 28 + padded, bin, bin_size);
    return glb;
}

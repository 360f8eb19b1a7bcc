/* SPDX-License-Identifier: MIT */
/* buffer.h - bytes that grow at the end; every encoder of this folder writes into one.
 *
 * Running out of memory is remembered instead of reported by each call: the encoder writes on and
 * its caller looks at `failed` once. Zero-initialise; release with buffer_free. */
#ifndef SMEAR_TOOLS_IMAGE_BUFFER_H
#define SMEAR_TOOLS_IMAGE_BUFFER_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct buffer {
    uint8_t *data;
    size_t size, capacity;
    bool failed;                /* out of memory; further appends are ignored */
};

static inline void buffer_free(struct buffer *b)
{
    free(b->data);
    *b = (struct buffer){0};
}

/* Makes room for `more` bytes after the end; false when there is no memory. */
static inline bool buffer_reserve(struct buffer *b, size_t more)
{
    if (b->failed || more > SIZE_MAX / 2 - b->size) {
        b->failed = true;
        return false;
    }
    size_t need = b->size + more;
    if (need <= b->capacity)
        return true;
    size_t capacity = b->capacity < 512 ? 1024 : b->capacity * 2;
    if (capacity < need)
        capacity = need;
    uint8_t *data = realloc(b->data, capacity);
    if (data == NULL) {
        b->failed = true;
        return false;
    }
    b->data = data;
    b->capacity = capacity;
    return true;
}

static inline void buffer_append(struct buffer *b, const void *bytes, size_t size)
{
    if (size != 0 && buffer_reserve(b, size)) {
        memcpy(b->data + b->size, bytes, size);
        b->size += size;
    }
}

static inline void buffer_byte(struct buffer *b, unsigned value)
{
    if (b->size < b->capacity || buffer_reserve(b, 1))
        b->data[b->size++] = (uint8_t)value;
}

static inline void buffer_le16(struct buffer *b, unsigned value)
{
    buffer_byte(b, value & 255);
    buffer_byte(b, value >> 8 & 255);
}

static inline void buffer_le32(struct buffer *b, uint32_t value)
{
    buffer_le16(b, value & 65535);
    buffer_le16(b, value >> 16);
}

static inline void buffer_be32(struct buffer *b, uint32_t value)
{
    for (int shift = 24; shift >= 0; shift -= 8)
        buffer_byte(b, value >> shift & 255);
}

/* Text for a comment of C: nothing in it ends one. */
static inline void buffer_comment(struct buffer *b, const char *text)
{
    for (; *text != '\0'; text++)
        buffer_byte(b, *text == '*' || (unsigned char)*text < 32 ? '?' : (unsigned char)*text);
}

/* Hands the bytes over, for the caller to free; false, and none, where memory has run out. */
static inline bool buffer_give(struct buffer *b, uint8_t **bytes, size_t *size)
{
    if (b->failed)
        buffer_free(b);
    *bytes = b->data;
    *size = b->size;
    return b->data != NULL;
}

/* Text in printf style, of 1000 bytes at most. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static inline void buffer_print(struct buffer *b, const char *format, ...)
{
    char text[1000];
    va_list args;
    va_start(args, format);
    const int size = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (size < 0 || (size_t)size >= sizeof text)
        b->failed = true;
    else
        buffer_append(b, text, (size_t)size);
}

#endif

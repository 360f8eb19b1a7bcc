/* SPDX-License-Identifier: MIT */
/* libc.c - text, sorting, and files that are blocks of memory: what the page drops in, the tools
 * open by name; what they write, the page hands out. */
#include "web_file.h"

#include <ctype.h>
#include <errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

int web_errno;

/* ------------------------------------------------------------------ memory and text */

void *memcpy(void *restrict to, const void *restrict from, size_t size)
{
    return __builtin_memcpy(to, from, size);            /* one instruction: -mbulk-memory */
}

void *memmove(void *to, const void *from, size_t size)
{
    return __builtin_memmove(to, from, size);
}

void *memset(void *to, int byte, size_t size)
{
    return __builtin_memset(to, byte, size);
}

int memcmp(const void *a, const void *b, size_t size)
{
    const unsigned char *x = a, *y = b;
    for (size_t i = 0; i < size; i++)
        if (x[i] != y[i])
            return x[i] - y[i];
    return 0;
}

void *memchr(const void *in, int byte, size_t size)
{
    const unsigned char *p = in;
    for (size_t i = 0; i < size; i++)
        if (p[i] == (unsigned char)byte)
            return (void *)(uintptr_t)(p + i);
    return NULL;
}

size_t strlen(const char *text)
{
    size_t n = 0;
    while (text[n] != '\0')
        n++;
    return n;
}

int strncmp(const char *a, const char *b, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (a[i] != b[i] || a[i] == '\0')
            return (unsigned char)a[i] - (unsigned char)b[i];
    return 0;
}

int strcmp(const char *a, const char *b)
{
    return strncmp(a, b, SIZE_MAX);
}

char *strchr(const char *text, int c)
{
    for (;; text++) {
        if (*text == (char)c)
            return (char *)(uintptr_t)text;
        if (*text == '\0')
            return NULL;
    }
}

char *strrchr(const char *text, int c)
{
    const char *found = NULL;
    for (;; text++) {
        if (*text == (char)c)
            found = text;
        if (*text == '\0')
            return (char *)(uintptr_t)found;
    }
}

static size_t span(const char *text, const char *set, bool inside)
{
    size_t n = 0;
    while (text[n] != '\0' && (strchr(set, text[n]) != NULL) == inside)
        n++;
    return n;
}

size_t strspn(const char *text, const char *set)
{
    return span(text, set, true);
}

size_t strcspn(const char *text, const char *set)
{
    return span(text, set, false);
}

char *strpbrk(const char *text, const char *set)
{
    const char *p = text + span(text, set, false);
    return *p != '\0' ? (char *)(uintptr_t)p : NULL;
}

int tolower(int c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
}

float strtof(const char *text, char **end)
{
    return (float)strtod(text, end);
}

/* Decimal only; the ends of the range for what lies outside it. */
long strtol(const char *text, char **end, int base)
{
    const char *p = text;
    bool negative = *p == '-', any = false;
    int64_t value = 0;
    (void)base;
    for (p += *p == '-' || *p == '+'; *p >= '0' && *p <= '9'; p++, any = true)
        value = value < ((int64_t)1 << 40) ? value * 10 + (*p - '0') : value;
    if (end != NULL)
        *end = (char *)(uintptr_t)(any ? p : text);
    value = negative ? -value : value;
    if (value > INT32_MAX || value < INT32_MIN) {
        web_errno = ERANGE;
        value = value > 0 ? INT32_MAX : INT32_MIN;
    }
    return (long)value;
}

/* Hexadecimal only. */
unsigned long strtoul(const char *text, char **end, int base)
{
    unsigned long value = 0;
    (void)base;
    for (;; text++) {
        int c = tolower(*text);
        if (c >= '0' && c <= '9')
            value = value << 4 | (unsigned long)(c - '0');
        else if (c >= 'a' && c <= 'f')
            value = value << 4 | (unsigned long)(c - 'a' + 10);
        else
            break;
    }
    if (end != NULL)
        *end = (char *)(uintptr_t)text;
    return value;
}

char *strerror(int error)
{
    return error == ENOENT ? "No such file or directory"
           : error == ENOMEM ? "Cannot allocate memory" : "Invalid argument";
}

_Noreturn void abort(void)
{
    __builtin_trap();
}

/* ------------------------------------------------------------------ sorting */

static void merge(char *base, char *spare, size_t count, size_t size,
                  int (*compare)(const void *, const void *))
{
    size_t left = count / 2, i = 0, j = left, n = 0;
    if (count < 2)
        return;
    merge(base, spare, left, size, compare);
    merge(base + left * size, spare, count - left, size, compare);
    while (i < left && j < count) {
        size_t from = compare(base + i * size, base + j * size) <= 0 ? i++ : j++;
        memcpy(spare + n++ * size, base + from * size, size);
    }
    memcpy(spare + n * size, base + i * size, (left - i) * size);
    memcpy(base, spare, (n + left - i) * size);
}

void qsort(void *base, size_t count, size_t size, int (*compare)(const void *, const void *))
{
    char *spare = malloc(count * size + 1);
    if (spare == NULL)
        abort();
    merge(base, spare, count, size, compare);
    free(spare);
}

/* ------------------------------------------------------------------ files */

/* A file, and how far its one reader or writer is. */
struct web_file {
    char *name;                 /* null: a free place */
    uint8_t *data;
    size_t size, room, at;
    bool ended, failed;
};

enum { FILES = 64 };
static struct web_file file[FILES];
static struct web_file out, err;
FILE *const stdout = &out, *const stderr = &err;

static struct web_file *find(const char *name)
{
    for (int i = 0; i < FILES; i++)
        if (file[i].name != NULL && strcmp(file[i].name, name) == 0)
            return &file[i];
    return NULL;
}

static void clear(struct web_file *f)
{
    free(f->data);
    f->data = NULL;
    f->size = f->room = f->at = 0;
    f->ended = f->failed = false;
}

static struct web_file *create(const char *name)
{
    struct web_file *f = find(name);
    size_t length = strlen(name) + 1;
    for (int i = 0; f == NULL && i < FILES; i++)
        if (file[i].name == NULL)
            f = &file[i];
    if (f == NULL)
        return NULL;
    clear(f);
    if (f->name == NULL) {
        f->name = malloc(length);
        if (f->name == NULL)
            return NULL;
        memcpy(f->name, name, length);
    }
    return f;
}

static bool reserve(struct web_file *f, size_t size)
{
    if (size <= f->room)
        return true;
    size_t room = f->room * 2 > size ? f->room * 2 : size + 256;
    uint8_t *moved = realloc(f->data, room);
    if (moved == NULL)
        return false;
    f->data = moved;
    f->room = room;
    return true;
}

/* Files that are dropped have no folders: `Textures/a.png` is `a.png`, too. */
static struct web_file *find_dropped(const char *path)
{
    struct web_file *f = find(path);
    const char *slash = strrchr(path, '/');
    return f != NULL || slash == NULL ? f : find(slash + 1);
}

FILE *fopen(const char *path, const char *mode)
{
    struct web_file *f = mode[0] == 'r' ? find_dropped(path) : create(path);
    if (f == NULL) {
        web_errno = mode[0] == 'r' ? ENOENT : ENOMEM;
        return NULL;
    }
    f->at = 0;
    f->ended = f->failed = false;
    return f;
}

int fclose(FILE *f)
{
    return f->failed ? EOF : 0;
}

size_t fread(void *to, size_t size, size_t count, FILE *f)
{
    size_t bytes = size * count, left = f->at < f->size ? f->size - f->at : 0;
    if (bytes > left) {
        bytes = left;
        f->ended = true;
    }
    memcpy(to, f->data + f->at, bytes);
    f->at += bytes;
    return size > 0 ? bytes / size : 0;
}

size_t fwrite(const void *from, size_t size, size_t count, FILE *f)
{
    size_t bytes = size * count;
    if (!reserve(f, f->at + bytes)) {
        f->failed = true;
        web_errno = ENOMEM;
        return 0;
    }
    memcpy(f->data + f->at, from, bytes);
    f->at += bytes;
    f->size = f->at > f->size ? f->at : f->size;
    return count;
}

int fseek(FILE *f, long offset, int origin)
{
    long base = origin == SEEK_SET ? 0 : origin == SEEK_CUR ? (long)f->at : (long)f->size;
    if (base + offset < 0 || base + offset > (long)f->size)
        return -1;
    f->at = (size_t)(base + offset);
    f->ended = false;
    return 0;
}

int fflush(FILE *f)
{
    return f->failed ? EOF : 0;
}

int feof(FILE *f)
{
    return f->ended;
}

int ferror(FILE *f)
{
    return f->failed;
}

int fputs(const char *text, FILE *f)
{
    size_t length = strlen(text);
    return fwrite(text, 1, length, f) == length ? 0 : EOF;
}

int fputc(int c, FILE *f)
{
    unsigned char byte = (unsigned char)c;
    return fwrite(&byte, 1, 1, f) == 1 ? c : EOF;
}

int putchar(int c)
{
    return fputc(c, stdout);
}

int remove(const char *path)
{
    struct web_file *f = find(path);
    if (f == NULL)
        return -1;
    clear(f);
    free(f->name);
    f->name = NULL;
    return 0;
}

int rename(const char *from, const char *to)
{
    struct web_file *f = find(from);
    size_t length = strlen(to) + 1;
    char *name = malloc(length);
    if (f == NULL || name == NULL)
        return -1;
    remove(to);
    memcpy(name, to, length);
    free(f->name);
    f->name = name;
    return 0;
}

/* ------------------------------------------------------------------ for web.c */

uint8_t *web_file_make(const char *name, size_t size)
{
    struct web_file *f = create(name);
    if (f == NULL || !reserve(f, size + 1)) {
        remove(name);
        return NULL;
    }
    f->size = size;
    return f->data;
}

const uint8_t *web_file_data(const char *name, size_t *size)
{
    static const uint8_t nothing;
    struct web_file *f = strcmp(name, ".out") == 0 ? &out : strcmp(name, ".err") == 0 ? &err
                                                                                      : find(name);
    *size = f != NULL ? f->size : 0;
    return f == NULL ? NULL : f->size > 0 ? f->data : &nothing;
}

void web_file_clear_texts(void)
{
    clear(&out);
    clear(&err);
}

/* ------------------------------------------------------------------ time */

__attribute__((import_module("page"), import_name("clock_us"))) double web_clock_us(void);

int clock_gettime(int clock, struct timespec *now)
{
    double us = web_clock_us();
    (void)clock;
    now->tv_sec = (long long)(us / 1e6);
    now->tv_nsec = (long)((us - (double)now->tv_sec * 1e6) * 1e3);
    return 0;
}

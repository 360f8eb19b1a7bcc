/* SPDX-License-Identifier: MIT */
/* stdlib.h - memory, sorting and numbers in text; see heap.c, libc.c, decimal.c. */
#ifndef SMEAR_WEB_STDLIB_H
#define SMEAR_WEB_STDLIB_H

#include <stddef.h>

void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *block, size_t size);
void free(void *block);

_Noreturn void abort(void);
static inline int abs(int x)
{
    return x < 0 ? -x : x;
}

/* Stable, as the host's is. */
void qsort(void *base, size_t count, size_t size, int (*compare)(const void *, const void *));

double strtod(const char *text, char **end);
float strtof(const char *text, char **end);
/* In tens and in sixteens, whatever `base` says. */
long strtol(const char *text, char **end, int base);
unsigned long strtoul(const char *text, char **end, int base);

#endif

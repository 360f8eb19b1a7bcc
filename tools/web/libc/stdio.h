/* SPDX-License-Identifier: MIT */
/* stdio.h - files are blocks of memory with a name; see libc.c. */
#ifndef SMEAR_WEB_STDIO_H
#define SMEAR_WEB_STDIO_H

#include <stdarg.h>
#include <stddef.h>

typedef struct web_file FILE;

enum { SEEK_SET, SEEK_CUR, SEEK_END };
#define EOF (-1)

extern FILE *const stdout, *const stderr;

FILE *fopen(const char *path, const char *mode);
int fclose(FILE *f);
size_t fread(void *to, size_t size, size_t count, FILE *f);
size_t fwrite(const void *from, size_t size, size_t count, FILE *f);
int fseek(FILE *f, long offset, int origin);
int fflush(FILE *f);
int feof(FILE *f);
int ferror(FILE *f);
int fputs(const char *text, FILE *f);
int fputc(int c, FILE *f);
int putchar(int c);
int remove(const char *path);
int rename(const char *from, const char *to);

__attribute__((format(printf, 1, 2))) int printf(const char *format, ...);
__attribute__((format(printf, 2, 3))) int fprintf(FILE *f, const char *format, ...);
__attribute__((format(printf, 3, 4))) int snprintf(char *out, size_t room, const char *format, ...);
__attribute__((format(printf, 3, 0))) int vsnprintf(char *out, size_t room, const char *format,
                                                    va_list args);

#endif

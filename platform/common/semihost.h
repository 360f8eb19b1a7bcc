/* SPDX-License-Identifier: MIT */
/* semihost.h - semihosting: a debugger or emulator does input and output. */
#ifndef SMEAR_SEMIHOST_H
#define SMEAR_SEMIHOST_H

#include <stddef.h>
#include <stdint.h>

void semihost_print(const char *text);
_Noreturn void semihost_exit(int status);

/* The command line into `text`, with a NUL; 0 when there is none or it does not fit. */
int semihost_command_line(char *text, size_t room);

/* A file of the host's current folder. `mode` as in fopen: 1 "rb", 5 "wb". Negative on failure. */
int semihost_open(const char *path, int mode);
uint32_t semihost_write(int file, const void *bytes, uint32_t count);  /* bytes NOT written */
uint32_t semihost_read(int file, void *bytes, uint32_t count);         /* bytes NOT read */
int semihost_close(int file);

#endif

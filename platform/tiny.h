/* SPDX-License-Identifier: MIT */
/* tiny.h - where tiny.c writes its frame: a file of the host. */
#ifndef SMEAR_TINY_H
#define SMEAR_TINY_H

#include <stdint.h>

/* 0, or -1. One file at a time. */
int tiny_file_open(const char *path);
int tiny_file_write(const void *bytes, uint32_t count);
int tiny_file_close(void);

#endif

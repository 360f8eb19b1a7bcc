/* SPDX-License-Identifier: MIT */
/* file.c - tiny.h by semihosting. */
#include "platform/common/semihost.h"
#include "platform/tiny.h"

enum { MODE_WB = 5 };

static int file;

int tiny_file_open(const char *path)
{
    file = semihost_open(path, MODE_WB);
    return file < 0 ? -1 : 0;
}

int tiny_file_write(const void *bytes, uint32_t count)
{
    return semihost_write(file, bytes, count) == 0 ? 0 : -1;
}

int tiny_file_close(void)
{
    return semihost_close(file) == 0 ? 0 : -1;
}

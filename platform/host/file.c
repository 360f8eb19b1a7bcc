/* SPDX-License-Identifier: MIT */
/* file.c - tiny.h by stdio. */
#include "platform/tiny.h"

#include <stdio.h>

static FILE *file;

int tiny_file_open(const char *path)
{
    file = fopen(path, "wb");
    return file != NULL ? 0 : -1;
}

int tiny_file_write(const void *bytes, uint32_t count)
{
    return fwrite(bytes, 1, count, file) == count ? 0 : -1;
}

int tiny_file_close(void)
{
    return fclose(file) == 0 ? 0 : -1;
}

/* SPDX-License-Identifier: MIT */
/* mkcpio.c - an initramfs on standard output, without root:
 *
 *     mkcpio FILE=path/in/archive ... > initramfs.cpio
 *
 * "newc" format: regular files of mode 0755 and the folders they need. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static unsigned long written, inode = 1;

static void put(const void *bytes, size_t size)
{
    fwrite(bytes, 1, size, stdout);
    written += size;
}

static void align(void)
{
    while (written & 3)
        put("", 1);
}

static void entry(const char *name, unsigned mode, const void *data, unsigned long size)
{
    char head[112];
    snprintf(head, sizeof head, "070701%08lX%08X%08X%08X%08X%08X%08lX%08X%08X%08X%08X%08X%08X",
             inode++, mode, 0u, 0u, 1u, 0u, size, 0u, 0u, 0u, 0u, (unsigned)strlen(name) + 1, 0u);
    put(head, 110);
    put(name, strlen(name) + 1);
    align();
    put(data, size);
    align();
}

static int add_file(char *argument)
{
    char *name = strchr(argument, '=');
    if (name == NULL)
        return 1;
    *name++ = '\0';
    for (char *slash = strchr(name, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        entry(name, 040755, "", 0);
        *slash = '/';
    }
    FILE *file = fopen(argument, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
        perror(argument);
        return 1;
    }
    long size = ftell(file);
    char *bytes = malloc((size_t)size + 1);
    rewind(file);
    if (bytes == NULL || fread(bytes, 1, (size_t)size, file) != (size_t)size)
        return 1;
    fclose(file);
    entry(name, 0100755, bytes, (unsigned long)size);
    free(bytes);
    return 0;
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++)
        if (add_file(argv[i]) != 0)
            return 1;
    entry("TRAILER!!!", 0, "", 0);
    return 0;
}

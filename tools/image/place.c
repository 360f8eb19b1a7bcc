/* SPDX-License-Identifier: MIT */
/* place.c - what a file is and where it lies: whoever opens a name that a stranger wrote asks here. */
#define _XOPEN_SOURCE 700               /* realpath */
#include "tools/image/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Without O_NONBLOCK the opening itself would wait at a pipe; regular files know no such thing. */
FILE *file_open_regular(const char *path, struct failure *f)
{
    struct stat there;
    int file = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (file < 0) {
        fail(f, "cannot be opened (%s)", strerror(errno));
        return NULL;
    }
    FILE *stream = NULL;
    if (fstat(file, &there) != 0)
        fail(f, "cannot be opened (%s)", strerror(errno));
    else if (!S_ISREG(there.st_mode))
        fail(f, "is no regular file");
    else if ((stream = fdopen(file, "rb")) == NULL)
        fail(f, "cannot be opened (%s)", strerror(errno));
    if (stream == NULL)
        close(file);
    return stream;
}

long long file_left(FILE *stream)
{
    struct stat there;
    long at = ftell(stream);
    if (at < 0 || fstat(fileno(stream), &there) != 0 || !S_ISREG(there.st_mode) || there.st_size < at)
        return -1;
    return (long long)there.st_size - at;
}

char *file_behind_links(const char *path)
{
    enum { MAX_LINKS = 16 };
    char *at = malloc(strlen(path) + 1);
    struct stat there;
    if (at != NULL)
        memcpy(at, path, strlen(path) + 1);
    for (int i = 0; at != NULL && lstat(at, &there) == 0 && S_ISLNK(there.st_mode); i++) {
        char target[4096];
        ssize_t length = readlink(at, target, sizeof target);
        const char *slash = strrchr(at, '/');
        size_t folder = slash != NULL && target[0] != '/' ? (size_t)(slash - at) + 1 : 0;
        char *next = i < MAX_LINKS && length > 0 && length < (ssize_t)sizeof target ? malloc(folder + (size_t)length + 1) : NULL;
        if (next != NULL) {
            memcpy(next, at, folder);
            memcpy(next + folder, target, (size_t)length);
            next[folder + (size_t)length] = '\0';
        }
        free(at);
        at = next;
    }
    return at;
}

bool file_lies_in(const char *path, const char *folder, struct failure *f)
{
    char *real = realpath(path, NULL);
    if (real == NULL)
        return fail(f, "cannot be opened (%s)", strerror(errno));
    char *around = realpath(folder[0] != '\0' ? folder : ".", NULL);
    bool ok = around != NULL || fail(f, "cannot be opened (its folder: %s)", strerror(errno));
    size_t length = ok ? strlen(around) : 0;
    while (length > 0 && around[length - 1] == '/')         /* the root */
        length--;
    if (ok && (strncmp(real, around, length) != 0 || real[length] != '/'))
        ok = fail(f, "lies outside of the model's folder (--outside)");
    free(real);
    free(around);
    return ok;
}

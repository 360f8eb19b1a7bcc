/* SPDX-License-Identifier: MIT */
/* faults.c - see faults.h. Streams are the C library's, over reads and writes of our own (fopencookie), so that each
 * transfer can fail where a disk's would. */
#define _GNU_SOURCE                     /* fopencookie */
#include "tests/faults/faults.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *const fault_names[FAULT_KINDS] = { "memory", "open", "read", "write", "sync", "close", "rename", "link", "remove",
                                               "thread" };

enum { STREAMS = 64, WRITTEN = 256 };

static struct fault_counts nobody, *counts = &nobody;
static enum fault_mode mode;
static long fault_at;

static struct stream {
    FILE *stream;
    int file;
} streams[STREAMS];

/* Files that have been opened for writing: what of them is on the disk for good. */
static struct written {
    int file;
    off_t synced;
} written[WRITTEN];
static int written_count;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
int __real_open(const char *path, int flags, ...);
int __real_fileno(FILE *stream);
FILE *__real_open_memstream(char **text, size_t *size);
char *__real_realpath(const char *path, char *out);
int __real_fsync(int file);
int __real_rename(const char *from, const char *to);
int __real_link(const char *from, const char *to);
int __real_unlink(const char *path);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *with);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
int __wrap_open(const char *path, int flags, ...);
FILE *__wrap_fopen(const char *path, const char *how);
FILE *__wrap_fdopen(int file, const char *how);
int __wrap_fileno(FILE *stream);
FILE *__wrap_open_memstream(char **text, size_t *size);
char *__wrap_realpath(const char *path, char *out);
int __wrap_fsync(int file);
int __wrap_rename(const char *from, const char *to);
int __wrap_link(const char *from, const char *to);
int __wrap_unlink(const char *path);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *with);

/* ------------------------------------------------------------------ which call is hit */

static void power_goes(void)
{
    for (int i = 0; i < written_count; i++)
        if (ftruncate(written[i].file, written[i].synced) != 0)
            _exit(1);
    _exit(FAULT_EXIT);
}

/* Whether this call fails. */
static bool is_hit(enum fault_kind kind, bool changes)
{
    counts->all++;
    counts->by_kind[kind]++;
    counts->changes += changes;
    bool hit = (mode == FAULT_FAILS && counts->all == fault_at) || (mode == FAULT_POWER && changes && counts->changes == fault_at);
    if (!hit)
        return false;
    counts->hit = kind;
    counts->was_hit = true;
    if (mode == FAULT_POWER)
        power_goes();
    return true;
}

static bool fails(enum fault_kind kind, bool changes, int error)
{
    if (!is_hit(kind, changes))
        return false;
    errno = error;
    return true;
}

/* ------------------------------------------------------------------ memory, threads */

void *__wrap_malloc(size_t size)
{
    return fails(FAULT_MEMORY, false, ENOMEM) ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return fails(FAULT_MEMORY, false, ENOMEM) ? NULL : __real_calloc(count, size);
}

void *__wrap_realloc(void *old, size_t size)
{
    return fails(FAULT_MEMORY, false, ENOMEM) ? NULL : __real_realloc(old, size);
}

FILE *__wrap_open_memstream(char **text, size_t *size)
{
    return fails(FAULT_MEMORY, false, ENOMEM) ? NULL : __real_open_memstream(text, size);
}

char *__wrap_realpath(const char *path, char *out)
{
    return fails(FAULT_MEMORY, false, ENOMEM) ? NULL : __real_realpath(path, out);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*run)(void *), void *with)
{
    return is_hit(FAULT_THREAD, false) ? EAGAIN : __real_pthread_create(thread, how, run, with);
}

/* ------------------------------------------------------------------ streams */

static ssize_t read_stream(void *cookie, char *to, size_t size)
{
    struct stream *s = cookie;
    return fails(FAULT_READ, false, EIO) ? -1 : read(s->file, to, size);
}

static ssize_t write_stream(void *cookie, const char *from, size_t size)
{
    struct stream *s = cookie;
    if (!fails(FAULT_WRITE, true, ENOSPC))
        return write(s->file, from, size);
    if (write(s->file, from, size / 2) < 0)
        errno = EIO;
    errno = ENOSPC;
    return 0;
}

static int seek_stream(void *cookie, off64_t *offset, int origin)
{
    struct stream *s = cookie;
    *offset = lseek(s->file, *offset, origin);
    return *offset < 0 ? -1 : 0;
}

static int close_stream(void *cookie)
{
    struct stream *s = cookie;
    close(s->file);
    s->stream = NULL;
    return fails(FAULT_CLOSE, false, EIO) ? -1 : 0;
}

static FILE *stream_of(int file, const char *how)
{
    const cookie_io_functions_t calls = { read_stream, write_stream, seek_stream, close_stream };
    for (int i = 0; i < STREAMS; i++)
        if (streams[i].stream == NULL) {
            streams[i].file = file;
            streams[i].stream = fopencookie(&streams[i], how, calls);
            return streams[i].stream;
        }
    errno = EMFILE;
    return NULL;
}

static void note_written(int file)
{
    struct stat there;
    if (counts != &nobody && written_count < WRITTEN && fstat(file, &there) == 0 && S_ISREG(there.st_mode))
        written[written_count++] = (struct written){ dup(file), there.st_size };
}

int __wrap_open(const char *path, int flags, ...)
{
    bool writes = (flags & O_ACCMODE) != O_RDONLY;
    va_list args;
    va_start(args, flags);
    int rights = (flags & O_CREAT) != 0 ? va_arg(args, int) : 0;
    va_end(args);
    if (fails(FAULT_OPEN, writes, writes ? ENOSPC : EMFILE))
        return -1;
    int file = __real_open(path, flags, rights);
    if (file >= 0 && writes)
        note_written(file);
    return file;
}

FILE *__wrap_fopen(const char *path, const char *how)
{
    bool writes = how[0] != 'r';
    if (fails(FAULT_OPEN, writes, EMFILE))
        return NULL;
    int file = __real_open(path, writes ? O_WRONLY | O_CREAT | O_TRUNC : O_RDONLY, 0666);
    FILE *stream = file >= 0 ? stream_of(file, how) : NULL;
    if (stream != NULL && writes)
        note_written(file);
    return stream;
}

FILE *__wrap_fdopen(int file, const char *how)
{
    return fails(FAULT_MEMORY, false, ENOMEM) ? NULL : stream_of(file, how);
}

int __wrap_fileno(FILE *stream)
{
    for (int i = 0; i < STREAMS; i++)
        if (streams[i].stream == stream)
            return streams[i].file;
    return __real_fileno(stream);
}

/* ------------------------------------------------------------------ files */

int __wrap_fsync(int file)
{
    struct stat mine, other;
    if (fails(FAULT_SYNC, true, EIO))
        return -1;
    if (fstat(file, &mine) != 0)
        return -1;
    for (int i = 0; i < written_count; i++)
        if (fstat(written[i].file, &other) == 0 && other.st_ino == mine.st_ino && other.st_dev == mine.st_dev)
            written[i].synced = mine.st_size;
    return 0;                           /* without waiting for a disk that will not go off */
}

int __wrap_rename(const char *from, const char *to)
{
    return fails(FAULT_RENAME, true, EIO) ? -1 : __real_rename(from, to);
}

int __wrap_link(const char *from, const char *to)
{
    return fails(FAULT_LINK, true, EPERM) ? -1 : __real_link(from, to);
}

/* A file that cannot be removed stays: nothing can be done about that, so these are never made to fail. */
int __wrap_unlink(const char *path)
{
    if (mode == FAULT_POWER)
        is_hit(FAULT_REMOVE, true);
    return __real_unlink(path);
}

void faults_begin(struct fault_counts *shared, enum fault_mode how, long at)
{
    FILE *out = stream_of(dup(1), "w");
    if (out == NULL)
        _exit(1);
    stdout = out;
    counts = shared;
    mode = how;
    fault_at = at;
}

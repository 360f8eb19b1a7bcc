/* SPDX-License-Identifier: MIT */
/* file.c - whole files in. */
#include "tools/image/file.h"
#include "tools/image/image.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Bytes as they come. */
struct reading {
    FILE *stream;
    uint8_t *data;
    size_t used, capacity, max_bytes;
};

static bool make_room(struct reading *r, size_t capacity, struct failure *f)
{
    uint8_t *moved = realloc(r->data, capacity);
    if (moved == NULL)
        return fail(f, "out of memory (%zu bytes read)", r->used);
    r->data = moved;
    r->capacity = capacity;
    return true;
}

/* Up to `limit` bytes in all; *ended at the end of the file. */
static bool read_to(struct reading *r, size_t limit, bool *ended, struct failure *f)
{
    while (r->used < limit && !*ended) {
        if (r->capacity - r->used < 2) {
            size_t larger = r->capacity < r->max_bytes / 2 ? r->capacity * 2 : r->max_bytes + 2;
            if (!make_room(r, larger, f))
                return false;
        }
        size_t room = r->capacity - r->used - 1, wanted = room < limit - r->used ? room : limit - r->used;
        errno = 0;
        r->used += fread(r->data + r->used, 1, wanted, r->stream);
        if (r->used > r->max_bytes)
            return fail(f, "file is too large (more than %zu bytes)", r->max_bytes);
        if (ferror(r->stream) != 0)
            return fail(f, "cannot be read (%s)", errno != 0 ? strerror(errno) : "read error");
        *ended = feof(r->stream) != 0;
    }
    return true;
}

static bool read_all(struct reading *r, file_head_fn *look, const void *user, struct failure *f)
{
    long long left = file_left(r->stream);
    bool ended = false;
    if (left > 0 && (unsigned long long)left > r->max_bytes)
        return fail(f, "file is too large (%lld bytes, at most %zu)", left, r->max_bytes);
    if (!make_room(r, FILE_HEAD + 2, f) || !read_to(r, FILE_HEAD, &ended, f) ||
        (look != NULL && !look(user, r->data, r->used, f)))
        return false;
    if (left > FILE_HEAD && !make_room(r, (size_t)left + 2, f))
        return false;
    return read_to(r, SIZE_MAX, &ended, f);
}

bool file_read_stream(FILE *stream, size_t max_bytes, file_head_fn *look, const void *user, uint8_t **bytes,
                      size_t *size, struct failure *f)
{
    struct reading r = { .stream = stream, .max_bytes = max_bytes };
    bool ok = read_all(&r, look, user, f);
    fclose(stream);
    *bytes = NULL;
    *size = 0;
    if (!ok) {
        free(r.data);
        return false;
    }
    r.data[r.used] = 0;
    *bytes = r.data;
    *size = r.used;
    return true;
}

bool file_read(const char *path, size_t max_bytes, uint8_t **bytes, size_t *size, struct failure *f)
{
    FILE *stream = fopen(path, "rb");
    *bytes = NULL;
    *size = 0;
    if (stream == NULL)
        return fail(f, "cannot be opened (%s)", strerror(errno));
    return file_read_stream(stream, max_bytes, NULL, NULL, bytes, size, f);
}

/* Files that have been read, whatever they are called. */
static struct kept {
    dev_t device;
    ino_t number;
} *kept;
static size_t kept_count;

static bool is_kept(const struct stat *file)
{
    for (size_t i = 0; i < kept_count; i++)
        if (kept[i].device == file->st_dev && kept[i].number == file->st_ino)
            return true;
    return false;
}

bool file_keep(const char *path, struct failure *f)
{
    struct stat file;
    if (stat(path, &file) != 0 || !S_ISREG(file.st_mode) || is_kept(&file))
        return true;            /* nothing that could be replaced */
    struct kept *more = realloc(kept, (kept_count + 1) * sizeof *kept);
    if (more == NULL)
        return fail(f, "out of memory");
    kept = more;
    kept[kept_count++] = (struct kept){ file.st_dev, file.st_ino };
    return true;
}

bool file_is_kept(const char *path)
{
    struct stat file;
    return stat(path, &file) == 0 && is_kept(&file);
}

bool file_is_replaceable(const char *path, struct failure *f)
{
    struct stat there;
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode))
        return fail(f, "cannot be written (it is there and no regular file)");
    return !file_is_kept(path) || fail(f, "cannot be written (it has been read, and would be lost)");
}

bool file_write(const char *path, const uint8_t *bytes, size_t size, struct failure *f)
{
    struct output o;
    if (!output_open(&o, path, f))
        return false;
    errno = 0;
    if (size != 0 && fwrite(bytes, 1, size, o.stream) != size) {
        fail(f, "cannot be written (%s)", errno != 0 ? strerror(errno) : "write error");
        output_discard(&o);
        return false;
    }
    return output_commit(&o, f);
}

/* SPDX-License-Identifier: MIT */
/* file.c - whole files in, complete files out. */
#include "tools/image/file.h"
#include "tools/image/image.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool file_read(const char *path, size_t max_bytes, uint8_t **bytes, size_t *size, struct failure *f)
{
    *bytes = NULL;
    *size = 0;
    FILE *stream = fopen(path, "rb");
    if (stream == NULL)
        return fail(f, "cannot be opened (%s)", strerror(errno));

    /* Read until the end instead of asking for the length, so that pipes work too. */
    size_t used = 0, capacity = 0;
    uint8_t *data = NULL;
    bool ok = true, ended = false;
    while (ok && !ended) {
        if (capacity - used < 2) {
            size_t larger = capacity == 0 ? (size_t)1 << 16 : capacity * 2;
            uint8_t *moved = larger > capacity ? realloc(data, larger) : NULL;
            if (moved == NULL) {
                ok = fail(f, "out of memory (%zu bytes read)", used);
                break;
            }
            data = moved;
            capacity = larger;
        }
        size_t got = fread(data + used, 1, capacity - used - 1, stream);
        used += got;
        if (used > max_bytes)
            ok = fail(f, "file is too large (more than %zu bytes)", max_bytes);
        else if (ferror(stream) != 0)
            ok = fail(f, "cannot be read (%s)", strerror(errno));
        else
            ended = feof(stream) != 0;
    }
    fclose(stream);
    if (!ok) {
        free(data);
        return false;
    }
    data[used] = 0;
    *bytes = data;
    *size = used;
    return true;
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

char *volatile output_unfinished[OUTPUTS_MAX];

static void note_unfinished(char *path, char *instead)
{
    for (int i = 0; i < OUTPUTS_MAX; i++)
        if (output_unfinished[i] == path) {
            output_unfinished[i] = instead;
            break;
        }
}

bool output_open(struct output *o, const char *path, struct failure *f)
{
    static const char suffix[] = ".tmp";
    size_t length = strlen(path);
    *o = (struct output){0};
    if (!file_is_replaceable(path, f))
        return false;
    o->path = malloc(length + 1);
    o->temporary = malloc(length + sizeof suffix);
    if (o->path == NULL || o->temporary == NULL) {
        output_discard(o);
        return fail(f, "out of memory (file name)");
    }
    memcpy(o->path, path, length + 1);
    memcpy(o->temporary, path, length);
    memcpy(o->temporary + length, suffix, sizeof suffix);
    o->stream = fopen(o->temporary, "wb");
    if (o->stream == NULL) {
        int reason = errno;
        output_discard(o);
        return fail(f, "cannot be written (%s)", strerror(reason));
    }
    note_unfinished(NULL, o->temporary);
    return true;
}

bool output_commit(struct output *o, struct failure *f)
{
    errno = 0;
    bool ok = fflush(o->stream) == 0 && ferror(o->stream) == 0;
    int reason = errno;
    if (fclose(o->stream) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    o->stream = NULL;
    if (ok && rename(o->temporary, o->path) != 0) {
        ok = false;
        reason = errno;
    }
    if (!ok) {
        remove(o->temporary);
        fail(f, "cannot be written (%s)", reason != 0 ? strerror(reason) : "write error");
    }
    output_discard(o);
    return ok;
}

void output_discard(struct output *o)
{
    if (o->stream != NULL) {
        fclose(o->stream);
        remove(o->temporary);
    }
    if (o->temporary != NULL)
        note_unfinished(o->temporary, NULL);
    free(o->path);
    free(o->temporary);
    *o = (struct output){0};
}

bool file_write(const char *path, const uint8_t *bytes, size_t size, struct failure *f)
{
    struct output o;
    if (!output_open(&o, path, f))
        return false;
    if (size != 0 && fwrite(bytes, 1, size, o.stream) != size) {
        fail(f, "cannot be written (%s)", strerror(errno));
        output_discard(&o);
        return false;
    }
    return output_commit(&o, f);
}

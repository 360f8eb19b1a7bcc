/* SPDX-License-Identifier: MIT */
/* external.c - see external.h. */
#include "tools/model/external.h"

#include "tools/image/file.h"

#include <stdlib.h>
#include <string.h>

/* "http:", "file:", "C:" ... as RFC 3986 has it: a letter, then letters, digits, + - . and a
 * colon. */
static bool has_scheme(const char *name)
{
    size_t n = strspn(name, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.");
    return n > 0 && name[n] == ':' && strchr("0123456789+-.", name[0]) == NULL;
}

static char *join(const char *folder, const char *name)
{
    size_t at = strlen(folder), length = strlen(name);
    char *path = malloc(at + length + 2);
    if (path == NULL)
        return NULL;
    memcpy(path, folder, at);
    if (at > 0 && path[at - 1] != '/')
        path[at++] = '/';
    memcpy(path + at, name, length + 1);
    return path;
}

static bool read_path(struct external *e, const char *path, uint8_t **bytes, size_t *size, struct failure *f)
{
    if (e->files == MODEL_MAX_FILES)
        return fail(f, "more than %d files for one model", MODEL_MAX_FILES);
    e->files++;
    if (!e->anywhere && !file_lies_in(path, e->folder, f))
        return false;
    FILE *stream = file_open_regular(path, f);
    if (stream == NULL)
        return false;
    if (!file_keep(path, f)) {
        fclose(stream);
        return false;
    }
    if (!file_read_stream(stream, MODEL_MAX_BYTES - e->bytes, NULL, NULL, bytes, size, f))
        return false;
    e->bytes += *size;
    return true;
}

bool external_read(struct external *e, const char *name, uint8_t **bytes, size_t *size, struct failure *f)
{
    *bytes = NULL;
    *size = 0;
    if (name[0] == '\0')
        return fail(f, "a file name is empty");
    if (name[0] == '/' || name[0] == '\\' || has_scheme(name))
        return fail(f, "%.80s is no relative path", name);
    if (e->folder == NULL)
        return fail(f, "needs the file %.80s, which cannot be looked up from here", name);
    char *path = join(e->folder, name);
    if (path == NULL)
        return fail(f, "out of memory (a path)");
    struct failure why = { 0 };
    bool ok = read_path(e, path, bytes, size, &why);
    free(path);
    return ok || fail(f, "%.80s: %s", name, why.text);
}

static bool starts_with(const uint8_t *bytes, size_t size, size_t at, const char *magic)
{
    size_t length = strlen(magic);
    return size >= at && size - at >= length && memcmp(bytes + at, magic, length) == 0;
}

bool picture_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f)
{
    static const struct { const char *magic, *name; } others[] = {
        { "\xff\xd8\xff", "JPEG" }, { "GIF8", "GIF" }, { "BM", "BMP" }, { "DDS ", "DDS" },
        { "\xabKTX", "KTX" }, { "sB\x98\x01", "Basis" }, { "II*", "TIFF" }, { "MM", "TIFF" },
        { "qoif", "QOI" }, { "8BPS", "Photoshop" }
    };
    *out = (struct image){ 0 };
    if (starts_with(bytes, size, 0, "\x89PNG"))
        return png_decode(bytes, size, out, f);
    if (starts_with(bytes, size, 0, "RIFF") && starts_with(bytes, size, 8, "WEBP"))
        return fail(f, "a WebP picture; only PNG is read");
    if (starts_with(bytes, size, 4, "ftypavif"))
        return fail(f, "an AVIF picture; only PNG is read");
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        if (starts_with(bytes, size, 0, others[i].magic))
            return fail(f, "a %s picture; only PNG is read", others[i].name);
    }
    return fail(f, "a picture of an unknown format; only PNG is read");
}

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

bool picture_decode(const uint8_t *bytes, size_t size, struct image *out, struct failure *f)
{
    static const struct { size_t at; const char *magic, *name; } others[] = {
        { 8, "WEBP", "a WebP" }, { 1, "KTX", "a KTX" }, { 4, "ftypavif", "an AVIF" }, { 0, "sB", "a Basis" }, { 0, "DDS ", "a DDS" },
        { 0, "GIF8", "a GIF" }, { 0, "BM", "a BMP" }, { 0, "II*", "a TIFF" }, { 0, "MM", "a TIFF" }, { 0, "qoif", "a QOI" },
        { 0, "8BPS", "a Photoshop" }, { 4, "jP  ", "a JPEG 2000" }, { 0, "\xff\x0a", "a JPEG XL" }, { 4, "JXL ", "a JPEG XL" }
    };
    *out = (struct image){ 0 };
    if (size >= 4 && memcmp(bytes, "\x89PNG", 4) == 0)
        return png_decode(bytes, size, out, f);
    if (size >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0)
        return jpeg_decode(bytes, size, out, f);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        const size_t length = strlen(others[i].magic);
        if (size >= others[i].at + length && memcmp(bytes + others[i].at, others[i].magic, length) == 0)
            return fail(f, "%s picture; PNG and JPEG are read", others[i].name);
    }
    return fail(f, "a picture of an unknown format; PNG and JPEG are read");
}

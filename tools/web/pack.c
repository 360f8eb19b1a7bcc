/* SPDX-License-Identifier: MIT */
/* pack.c - the page in one file. Runs on the host.
 *
 *     pack join OUT FILE...        the files in one, each with its size in front
 *     pack page PAGE.html OUT.html copies PAGE; a line that is only
 *                                      @include FILE   becomes the file, from the folder of PAGE
 *                                      @bytes FILE     becomes the file's bytes as text
 *
 * Scripts and styles lose indentation, empty lines and lines that are only a comment. Bytes are their number
 * and text of 91 characters, each pair of which holds 13 bits, or 14 (after Joachim Henke's basE91, with
 * characters that a script element may hold). unpack.js reads both. */
#include "tools/image/image.h"
#include "tools/image/inflate.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_BYTES = 1 << 26 };

struct bytes {
    uint8_t *data;
    size_t size;
};

/* ------------------------------------------------------------------ bytes and lines */

static void put_text(FILE *out, const uint8_t *bytes, size_t size)
{
    char alphabet[91];
    int count = 0;
    uint32_t hold = 0;
    unsigned bits = 0;
    fprintf(out, "%zu ", size);
    for (int c = 33; c < 127; c++)
        if (c != '"' && c != '\\' && c != '<')
            alphabet[count++] = (char)c;
    for (size_t i = 0; i < size; i++) {
        hold |= (uint32_t)bytes[i] << bits;
        bits += 8;
        if (bits > 13) {
            unsigned value = hold & 8191, used = value > 88 ? 13 : 14;
            value = hold & ((1u << used) - 1);
            hold >>= used;
            bits -= used;
            fputc(alphabet[value % 91], out);
            fputc(alphabet[value / 91], out);
        }
    }
    fputc(alphabet[hold % 91], out);
    fputc(alphabet[hold / 91], out);
}

/* Without the blanks in front of a line, and lines that are only a comment. */
static void append_stripped(struct buffer *out, const struct bytes *file)
{
    const char *p = (const char *)file->data, *end = p + file->size;
    while (p < end) {
        size_t length = strcspn(p, "\n");
        const char *start = p + strspn(p, " "), *stop = p + length;
        bool is_empty = start >= stop, is_comment = strncmp(start, "// ", 3) == 0;
        if (!is_empty && !is_comment) {
            buffer_append(out, start, (size_t)(stop - start));
            buffer_byte(out, '\n');
        }
        p += length + 1;
    }
}

static bool ends_with(const char *name, const char *ending)
{
    size_t n = strlen(name), m = strlen(ending);
    return n >= m && strcmp(name + n - m, ending) == 0;
}

static bool append_file(struct buffer *out, const char *name, struct failure *f)
{
    struct bytes file;
    struct failure why = { "" };
    if (!file_read(name, MAX_BYTES, &file.data, &file.size, &why))
        return fail(f, "%s: %s", name, why.text);
    if (ends_with(name, ".js") || ends_with(name, ".css"))
        append_stripped(out, &file);
    else
        buffer_append(out, file.data, file.size);
    free(file.data);
    return !out->failed || fail(f, "out of memory");
}

/* ------------------------------------------------------------------ join */

static void put_number(struct buffer *out, size_t number)
{
    for (; number >= 128; number >>= 7)
        buffer_byte(out, (unsigned)(number & 127) | 128);
    buffer_byte(out, (unsigned)number);
}

static bool join(FILE *out, int count, char **name, struct failure *f)
{
    struct buffer all = { 0 }, part = { 0 };
    bool ok = true;
    for (int i = 0; i < count && ok; i++) {
        part.size = 0;
        ok = append_file(&part, name[i], f);
        put_number(&all, part.size);
        buffer_append(&all, part.data, part.size);
    }
    ok = ok && (!all.failed || fail(f, "out of memory"));
    if (ok)
        fwrite(all.data, 1, all.size, out);
    buffer_free(&all);
    buffer_free(&part);
    return ok;
}

/* ------------------------------------------------------------------ page */

static bool put_line(FILE *out, const char *folder, const char *line, struct failure *f)
{
    struct buffer part = { 0 };
    char name[1200];
    bool ok;
    line += strspn(line, " ");
    if (line[0] != '@') {
        if (line[0] != '\0')
            fprintf(out, "%s\n", line);
        return true;
    }
    if (strncmp(line, "@include ", 9) == 0) {
        snprintf(name, sizeof name, "%s%s", folder, line + 9);
        ok = append_file(&part, name, f);
        fwrite(part.data, 1, part.size, out);
    } else if (strncmp(line, "@bytes ", 7) == 0) {
        ok = append_file(&part, line + 7, f);
        put_text(out, part.data, part.size);
        fputc('\n', out);
    } else {
        ok = fail(f, "a line is not understood (%s)", line);
    }
    buffer_free(&part);
    return ok;
}

static bool put_page(FILE *out, const char *path, struct failure *f)
{
    struct bytes page;
    char folder[1000];
    const char *slash = strrchr(path, '/');
    bool ok = true;
    snprintf(folder, sizeof folder, "%.*s", slash != NULL ? (int)(slash - path) + 1 : 0, path);
    if (!file_read(path, MAX_BYTES, &page.data, &page.size, f))
        return false;
    for (char *p = (char *)page.data, *end = p + page.size; p < end && ok;) {
        char *next = p + strcspn(p, "\n") + 1;
        next[-1] = '\0';
        ok = put_line(out, folder, p, f);
        p = next;
    }
    free(page.data);
    return ok;
}

int main(int count, char **argument)
{
    struct failure f = { "" };
    bool joins = count >= 4 && strcmp(argument[1], "join") == 0;
    if (!joins && (count != 4 || strcmp(argument[1], "page") != 0)) {
        fprintf(stderr, "usage: pack join OUT FILE... | pack page PAGE.html OUT.html\n");
        return 2;
    }
    const char *name = argument[joins ? 2 : 3];
    FILE *out = fopen(name, "wb");
    bool ok = out != NULL;
    if (ok) {
        ok = joins ? join(out, count - 3, argument + 3, &f) : put_page(out, argument[2], &f);
        ok = ferror(out) == 0 && ok;
        ok = fclose(out) == 0 && ok;
    }
    if (ok)
        return 0;
    remove(name);
    fprintf(stderr, "pack: %s: %s\n", name, f.text[0] != '\0' ? f.text : "cannot be written");
    return 1;
}

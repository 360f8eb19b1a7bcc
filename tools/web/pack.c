/* SPDX-License-Identifier: MIT */
/* pack.c - the page in one file. Runs on the host.
 *
 *     pack PAGE.html OUT.html
 *
 * copies PAGE to OUT. A line that is only
 *
 *     @include FILE          becomes the file
 *     @text FILE...          becomes up to three files, each with its size in front, compressed
 *     @pack A.wasm B.wasm    becomes both modules: A, and how B differs from it, compressed
 *
 * Files of @include and @text lie beside PAGE unless they name a folder; they lose indentation and lines that are only
 * a comment. What is compressed is text of 91 characters, each pair of which holds 13 bits, or 14 (after Joachim Henke's
 * basE91, with characters that a script element may hold). */
#include "../image/deflate.h"
#include "../image/image.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_BYTES = 1 << 26, HASH_BITS = 18, MATCH_MIN = 24 };

struct bytes {
    uint8_t *data;
    size_t size;
};

static int failed(const char *what, const char *why)
{
    fprintf(stderr, "pack: %s: %s\n", what, why);
    return 1;
}

/* ------------------------------------------------------------------ differences */

static void put_number(struct buffer *out, size_t number)
{
    for (; number >= 128; number >>= 7)
        buffer_byte(out, (unsigned)(number & 127) | 128);
    buffer_byte(out, (unsigned)number);
}

static uint32_t hash_of(const uint8_t *p)
{
    uint32_t h = 0;
    for (int i = 0; i < MATCH_MIN; i++)
        h = h * 31 + p[i];
    return h * 2654435761u >> (32 - HASH_BITS);
}

static size_t same(const struct bytes *a, size_t i, const struct bytes *b, size_t j)
{
    size_t n = 0;
    while (i + n < a->size && j + n < b->size && a->data[i + n] == b->data[j + n])
        n++;
    return n;
}

/* `b` as a list of: how many bytes of its own, these bytes, how many bytes of `a`, from where. Looks first where the
 * last copy ended, then for a place with the same beginning. */
static void put_difference(struct buffer *out, const struct bytes *a, const struct bytes *b)
{
    uint32_t *last = calloc((size_t)1 << HASH_BITS, sizeof *last);     /* place in `a` + 1 */
    size_t own = 0, next = 0;
    if (last == NULL) {
        out->failed = true;
        return;
    }
    for (size_t i = 0; i + MATCH_MIN <= a->size; i++)
        last[hash_of(a->data + i)] = (uint32_t)i + 1;
    for (size_t j = 0; j < b->size;) {
        size_t from = next + (j - own), length = 0;
        if (from < a->size)
            length = same(a, from, b, j);
        if (length < MATCH_MIN && j + MATCH_MIN <= b->size && last[hash_of(b->data + j)] != 0) {
            from = last[hash_of(b->data + j)] - 1;
            length = same(a, from, b, j);
        }
        if (length < MATCH_MIN) {
            j++;
            continue;
        }
        put_number(out, j - own);
        buffer_append(out, b->data + own, j - own);
        put_number(out, length);
        put_number(out, from);
        j += length;
        own = j;
        next = from + length;
    }
    put_number(out, b->size - own);
    buffer_append(out, b->data + own, b->size - own);
    put_number(out, 0);
    put_number(out, 0);
    free(last);
}

/* ------------------------------------------------------------------ text */

static void put_text(FILE *out, const uint8_t *bytes, size_t size)
{
    char alphabet[91];
    int count = 0;
    uint32_t hold = 0;
    unsigned bits = 0;
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

/* As one zlib stream, with its size in front. */
static bool put_compressed(FILE *out, const struct buffer *raw, struct failure *f)
{
    struct buffer packed = { 0 };
    for (int shift = 0; shift < 32; shift += 8)
        buffer_byte(&packed, (unsigned)(raw->size >> shift) & 255);
    bool ok = !raw->failed && deflate_zlib(raw->data, raw->size, &packed);
    if (ok)
        put_text(out, packed.data, packed.size);
    fputc('\n', out);
    buffer_free(&packed);
    return ok || fail(f, "out of memory");
}

/* [size of A] A [size of the difference] difference */
static bool put_modules(FILE *out, const char *first, const char *second, struct failure *f)
{
    struct bytes a, b;
    struct buffer raw = { 0 }, difference = { 0 };
    if (!file_read(first, MAX_BYTES, &a.data, &a.size, f))
        return false;
    if (!file_read(second, MAX_BYTES, &b.data, &b.size, f)) {
        free(a.data);
        return false;
    }
    put_difference(&difference, &a, &b);
    put_number(&raw, a.size);
    buffer_append(&raw, a.data, a.size);
    put_number(&raw, difference.size);
    buffer_append(&raw, difference.data, difference.size);
    bool ok = !difference.failed && put_compressed(out, &raw, f);
    free(a.data);
    free(b.data);
    buffer_free(&raw);
    buffer_free(&difference);
    return ok;
}

/* ------------------------------------------------------------------ lines */

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

static bool append_file(struct buffer *out, const char *folder, const char *name, struct failure *f)
{
    char path[1200];
    struct bytes file;
    struct failure why = { "" };
    snprintf(path, sizeof path, "%s%s", strchr(name, '/') == NULL ? folder : "", name);
    if (!file_read(path, MAX_BYTES, &file.data, &file.size, &why))
        return fail(f, "%s %s", name, why.text);
    append_stripped(out, &file);
    free(file.data);
    return true;
}

static bool put_line(FILE *out, const char *folder, char *line, struct failure *f)
{
    struct buffer text = { 0 }, part = { 0 };
    char *word[5] = { 0 };
    int count = 0;
    bool ok = true;
    if (line[0] != '@') {
        line += strspn(line, " ");
        return line[0] == '\0' || fprintf(out, "%s\n", line) > 0 || fail(f, "cannot be written");
    }
    for (char *w = strtok(line, " "); w != NULL && count < 5; w = strtok(NULL, " "))
        word[count++] = w;
    if (count == 3 && strcmp(word[0], "@pack") == 0)
        return put_modules(out, word[1], word[2], f);
    if (count == 2 && strcmp(word[0], "@include") == 0) {
        ok = append_file(&text, folder, word[1], f);
        fwrite(text.data, 1, text.size, out);
    } else if (count >= 2 && strcmp(word[0], "@text") == 0) {
        for (int i = 1; i < count && ok; i++) {
            part.size = 0;
            ok = append_file(&part, folder, word[i], f);
            put_number(&text, part.size);
            buffer_append(&text, part.data, part.size);
        }
        ok = ok && put_compressed(out, &text, f);
    } else {
        ok = fail(f, "a line is not understood (%s)", word[0]);
    }
    buffer_free(&text);
    buffer_free(&part);
    return ok;
}

int main(int count, char **argument)
{
    struct failure f = { "" };
    struct bytes page;
    char folder[1000];
    if (count != 3)
        return failed("usage", "pack PAGE.html OUT.html");
    const char *slash = strrchr(argument[1], '/');
    int length = slash != NULL ? (int)(slash - argument[1]) + 1 : 0;
    snprintf(folder, sizeof folder, "%.*s", length, argument[1]);
    if (!file_read(argument[1], MAX_BYTES, &page.data, &page.size, &f))
        return failed(argument[1], f.text);
    FILE *out = fopen(argument[2], "wb");
    if (out == NULL)
        return failed(argument[2], "cannot be written");
    char *p = (char *)page.data, *end = p + page.size;
    bool ok = true;
    while (p < end && ok) {
        size_t n = strcspn(p, "\n");
        char *next = p + n + 1;
        p[n] = '\0';
        ok = put_line(out, folder, p, &f);
        p = next;
    }
    free(page.data);
    ok = fclose(out) == 0 && ok;
    if (!ok) {
        remove(argument[2]);
        return failed(argument[1], f.text[0] != '\0' ? f.text : "cannot be written");
    }
    return 0;
}

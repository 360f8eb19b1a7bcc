/* SPDX-License-Identifier: MIT */
/* golden.c - see golden.h. */
#include "tools/view/golden.h"

#include "tools/image/file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_FILE_BYTES = 64 << 20, MAX_DIFFERENCES_KEPT = 16, DIFFERENCE_GAIN = 8 };

static bool push(struct golden_line **list, int *count, int *room, struct golden_line line)
{
    if (*count == *room) {
        int larger = *room > 0 ? *room * 2 : 64;
        struct golden_line *grown = realloc(*list, (size_t)larger * sizeof *grown);
        if (grown == NULL)
            return false;
        *list = grown;
        *room = larger;
    }
    (*list)[(*count)++] = line;
    return true;
}

static bool read_line(const char *text, struct golden_line *line)
{
    unsigned long crc;
    int end = 0;
    if (sscanf(text, "frame=%ld crc32=%8lx%n", &line->frame, &crc, &end) != 2 || text[end] != '\0')
        return false;
    line->crc32 = (uint32_t)crc;
    return true;
}

static bool read_expected(struct golden *g, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    int room = 0, number = 0;
    bool ok = true;
    if (!file_read(g->path, MAX_FILE_BYTES, &bytes, &size, f))
        return false;
    char *text = (char *)bytes;
    for (char *next; ok && text != NULL && *text != '\0'; text = next) {
        next = strchr(text, '\n');
        if (next != NULL)
            *next++ = '\0';
        number++;
        struct golden_line line;
        if (text[0] == '\0' || text[0] == '#')
            continue;
        ok = read_line(text, &line) || fail(f, "is no list of frame=N crc32=X (line %d)", number);
        ok = ok && (push(&g->expected, &g->expected_count, &room, line) ||
                    fail(f, "out of memory"));
    }
    free(bytes);
    return ok;
}

bool golden_open(struct golden *g, const char *path, bool prints, bool updates, struct failure *f)
{
    *g = (struct golden){ .path = path, .prints = prints, .updates = updates };
    return path == NULL || (updates ? file_is_replaceable(path, f) : read_expected(g, f));
}

bool golden_wants_pictures(const struct golden *g)
{
    return g->path != NULL;
}

static void name_of(const struct golden *g, int index, const char *kind, char out[4096])
{
    snprintf(out, 4096, "%s.%04d%s.png", g->path, index, kind);
}

/* What was drawn, and how it differs from what was accepted, where that picture is at hand. */
static bool keep_difference(const struct golden *g, int index, const struct image *got,
                            struct failure *f)
{
    char name[4096];
    struct image accepted, difference;
    struct failure ignored = { "" };
    name_of(g, index, ".got", name);
    if (!png_save(name, got, f))
        return false;
    name_of(g, index, "", name);
    if (!image_load(name, &accepted, &ignored))
        return true;
    bool ok = true;
    if (image_difference(&accepted, got, DIFFERENCE_GAIN, &difference, &ignored)) {
        name_of(g, index, ".difference", name);
        ok = png_save(name, &difference, f);
        image_free(&difference);
    }
    image_free(&accepted);
    return ok;
}

/* Pictures of an earlier failure would mislead. */
static void forget_difference(const struct golden *g, int index)
{
    char name[4096];
    name_of(g, index, ".got", name);
    unlink(name);
    name_of(g, index, ".difference", name);
    unlink(name);
}

bool golden_add(struct golden *g, long frame, uint32_t crc32, const struct image *picture,
                struct failure *f)
{
    int index = g->count;
    struct golden_line line = { frame, crc32 };
    char name[4096];
    if (!push(&g->line, &g->count, &g->room, line))
        return fail(f, "out of memory");
    if (g->path == NULL)
        return true;
    forget_difference(g, index);
    if (g->updates) {
        name_of(g, index, "", name);
        return png_save(name, picture, f);
    }
    if (index < g->expected_count && g->expected[index].frame == frame &&
        g->expected[index].crc32 == crc32)
        return true;
    if (g->different++ == 0)
        g->first_different = index;
    return g->different > MAX_DIFFERENCES_KEPT || keep_difference(g, index, picture, f);
}

static void print_lines(const struct golden *g, FILE *to)
{
    for (int i = 0; i < g->count; i++)
        fprintf(to, "frame=%ld crc32=%08lx\n", g->line[i].frame, (unsigned long)g->line[i].crc32);
}

static bool write_lines(const struct golden *g, struct failure *f)
{
    struct output out = { 0 };
    if (!output_open_text(&out, g->path, f))
        return false;
    print_lines(g, out.stream);
    return output_commit(&out, f);
}

static bool tell_difference(const struct golden *g, struct failure *f)
{
    int i = g->first_different;
    char name[4096];
    name_of(g, i, "", name);
    const char *hint = access(name, R_OK) == 0 ? "" : "; no accepted picture beside the file";
    if (i >= g->expected_count)
        return fail(f, "has %d pictures, %d were drawn", g->expected_count, g->count);
    if (g->expected[i].frame != g->line[i].frame)
        return fail(f, "picture %d is of frame %ld, frame %ld was drawn", i, g->expected[i].frame,
                    g->line[i].frame);
    return fail(f, "%d of %d pictures differ, first frame %ld: crc32 %08lx, not %08lx%s (--update)",
                g->different, g->count, g->line[i].frame, (unsigned long)g->line[i].crc32,
                (unsigned long)g->expected[i].crc32, hint);
}

bool golden_end(struct golden *g, struct failure *f)
{
    if (g->prints)
        print_lines(g, stdout);
    if (g->path == NULL)
        return true;
    if (g->updates)
        return write_lines(g, f);
    if (g->different > 0)
        return tell_difference(g, f);
    return g->count == g->expected_count ||
           fail(f, "has %d pictures, %d were drawn", g->expected_count, g->count);
}

void golden_close(struct golden *g)
{
    free(g->line);
    free(g->expected);
    *g = (struct golden){ .path = NULL };
}

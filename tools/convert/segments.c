/* SPDX-License-Identifier: MIT */
/* segments.c - see segments.h. */
#include "tools/convert/segments.h"

#include "tools/image/buffer.h"
#include "tools/model/obj.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SEGMENTS_MOST = 16383 };         /* smear_ribbon.count */

struct reader {
    struct obj_text text;
    struct failure *f;
    double scale;
    int32_t (*place)[3];                /* of vertices, q16 */
    long places, room;
    struct buffer out;
    int count;
};

static bool read_place(struct reader *r, char *rest)
{
    if (r->places == r->room) {
        r->room = r->room == 0 ? 256 : 2 * r->room;
        void *grown = realloc(r->place, (size_t)r->room * sizeof *r->place);
        if (grown == NULL)
            return fail(r->f, "out of memory (line %d)", r->text.line);
        r->place = grown;
    }
    for (int k = 0; k < 3; k++) {
        const char *word = obj_word(&rest);
        float value;
        if (word == NULL || !obj_number(word, &value))
            return fail(r->f, "v needs 3 numbers (line %d)", r->text.line);
        if (fabs((double)value * r->scale) >= 32767)
            return fail(r->f, "%.20s is more than 32767 units away (line %d; --scale)", word, r->text.line);
        r->place[r->places][k] = (int32_t)lround((double)value * r->scale * 65536);
    }
    r->places++;
    return true;
}

/* Vertices from 1 on, or from the last one, -1, back; what follows a slash is a place in a texture. */
static bool read_index(struct reader *r, const char *word, long *out)
{
    char *end;
    *out = strtol(word, &end, 10);
    *out = *out < 0 ? r->places + *out : *out - 1;
    if (end == word || (*end != '\0' && *end != '/') || *out < 0 || *out >= r->places)
        return fail(r->f, "no vertex '%.20s' (line %d)", word, r->text.line);
    return true;
}

static void put_ends(struct reader *r, long a, long b)
{
    const int32_t *p = r->place[a], *q = r->place[b];
    buffer_print(&r->out, "{ { %d, %d, %d }, { %d, %d, %d } }", (int)p[0], (int)p[1], (int)p[2], (int)q[0], (int)q[1], (int)q[2]);
}

static bool read_line(struct reader *r, char *rest)
{
    long before = -1, index;
    for (const char *word; (word = obj_word(&rest)) != NULL; before = index) {
        if (!read_index(r, word, &index))
            return false;
        if (before < 0)
            continue;
        if (++r->count > SEGMENTS_MOST)
            return fail(r->f, "more than %d lines", SEGMENTS_MOST);
        buffer_print(&r->out, "    { ");
        put_ends(r, before, index);             /* now, and a frame ago */
        buffer_print(&r->out, ", ");
        put_ends(r, before, index);
        buffer_print(&r->out, " },\n");
    }
    return true;
}

bool segments_to_header(const uint8_t *bytes, size_t size, double scale, const char *name, const char *from, uint8_t **out,
                        size_t *out_size, int *count, struct failure *f)
{
    struct reader r = { .f = f, .scale = scale };
    char *word, *rest, big[64] = "";
    if (!obj_text_open(bytes, size, &r.text, f))
        return false;
    for (size_t i = 0; name[i] != '\0' && i + 1 < sizeof big; i++)
        big[i] = (char)(name[i] >= 'a' && name[i] <= 'z' ? name[i] - 'a' + 'A' : name[i]);
    buffer_print(&r.out, "/* %s.h - ", name);
    buffer_comment(&r.out, from);
    buffer_print(&r.out, " for smear, written by smear convert. Include it in one source file. */\n#include <smear_ribbon.h>\n\n"
                         "static const smear_segment %s[] = {\n", name);
    bool ok = true;
    while (ok && obj_text_next(&r.text, &word, &rest))
        ok = strcmp(word, "v") == 0 ? read_place(&r, rest) : strcmp(word, "l") == 0 ? read_line(&r, rest) : true;
    if (ok && r.count == 0)
        ok = fail(f, "no lines (l): --lines is for OBJ files that have some");
    buffer_print(&r.out, "};\n\n#define %s_SEGMENTS %d\n", big, r.count);
    obj_text_close(&r.text);
    free(r.place);
    *count = r.count;
    if (!ok)
        buffer_free(&r.out);
    return buffer_give(&r.out, out, out_size) || (ok && fail(f, "out of memory"));
}

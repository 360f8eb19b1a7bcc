/* SPDX-License-Identifier: MIT */
/* script.c - see script.h. */
#include "tools/view/script.h"

#include "tools/image/image.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_BYTES = 16 << 20 };

struct script_line {
    long tick;
    struct event event;
};

static const struct {
    const char *name;
    int key;
} named[] = {
    { "left", SCREEN_LEFT },         { "right", SCREEN_RIGHT },         { "up", SCREEN_UP },
    { "down", SCREEN_DOWN },         { "pageup", SCREEN_PAGE_UP },      { "pagedown", SCREEN_PAGE_DOWN },
    { "home", SCREEN_HOME },         { "end", SCREEN_END },             { "enter", SCREEN_ENTER },
    { "tab", SCREEN_TAB },           { "escape", SCREEN_ESCAPE },       { "space", ' ' },
};
enum { NAMED = sizeof named / sizeof *named };

const char *key_name(int key, char buffer[16])
{
    for (int i = 0; i < NAMED; i++)
        if (named[i].key == key)
            return named[i].name;
    snprintf(buffer, 16, key > 32 && key < 127 ? "%c" : "key%d", key);
    return buffer;
}

static int find_key(const char *name)
{
    for (int i = 0; i < NAMED; i++)
        if (strcmp(named[i].name, name) == 0)
            return named[i].key;
    return name[0] > 32 && name[0] < 127 && name[1] == '\0' ? name[0] : 0;
}

static bool read_line(const char *text, struct script_line *line)
{
    char name[16];
    int end = 0;
    struct event *e = &line->event;
    *line = (struct script_line){ .tick = -1 };
    if (sscanf(text, "%ld key %15s%n", &line->tick, name, &end) == 2) {
        e->kind = EVENT_KEY;
        e->key = find_key(name);
        return line->tick >= 0 && text[end] == '\0' && e->key != 0;
    }
    if (sscanf(text, "%ld drag %d %d %d%n", &line->tick, &e->button, &e->x, &e->y, &end) == 4)
        e->kind = EVENT_DRAG;
    else if (sscanf(text, "%ld wheel %d%n", &line->tick, &e->y, &end) == 2)
        e->kind = EVENT_WHEEL;
    else
        return false;
    return line->tick >= 0 && text[end] == '\0' && abs(e->x) < 100000 && abs(e->y) < 100000;
}

bool script_play(struct script *s, const char *path, struct failure *f)
{
    uint8_t *bytes;
    size_t size;
    int number = 0;
    if (!file_read(path, MAX_BYTES, &bytes, &size, f))
        return false;
    s->text = (char *)bytes;
    s->line = calloc(size / 2 + 1, sizeof *s->line);    /* a line has two characters at least */
    if (s->line == NULL)
        return fail(f, "out of memory");
    for (char *text = s->text, *next; text != NULL && *text != '\0'; text = next) {
        next = strchr(text, '\n');
        if (next != NULL)
            *next++ = '\0';
        number++;
        if (text[0] == '\0' || text[0] == '#')
            continue;
        if (!read_line(text, &s->line[s->count]))
            return fail(f, "is no input (line %d)", number);
        if (s->count > 0 && s->line[s->count].tick < s->line[s->count - 1].tick)
            return fail(f, "goes back in time (line %d)", number);
        s->count++;
    }
    return true;
}

bool script_record(struct script *s, const char *path, struct failure *f)
{
    return output_open_text(&s->out, path, f);
}

bool script_event(struct script *s, long tick, struct event *out)
{
    if (s->next >= s->count || s->line[s->next].tick > tick)
        return false;
    *out = s->line[s->next++].event;
    return true;
}

void script_note(struct script *s, long tick, const struct event *e)
{
    char buffer[16];
    if (s->out.stream == NULL)
        return;
    if (e->kind == EVENT_KEY)
        fprintf(s->out.stream, "%ld key %s\n", tick, key_name(e->key, buffer));
    else if (e->kind == EVENT_DRAG)
        fprintf(s->out.stream, "%ld drag %d %d %d\n", tick, e->button, e->x, e->y);
    else if (e->kind == EVENT_WHEEL)
        fprintf(s->out.stream, "%ld wheel %d\n", tick, e->y);
}

bool script_end(struct script *s, struct failure *f)
{
    return s->out.stream == NULL || output_commit(&s->out, f);
}

void script_close(struct script *s)
{
    output_discard(&s->out);
    free(s->text);
    free(s->line);
    *s = (struct script){ .text = NULL };
}

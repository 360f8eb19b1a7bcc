/* SPDX-License-Identifier: MIT */
/* screen.h - where pictures are seen and keys come from: a window, a terminal, a framebuffer, or
 * nowhere. One at a time. */
#ifndef SMEAR_TOOLS_VIEW_SCREEN_H
#define SMEAR_TOOLS_VIEW_SCREEN_H

#include "tools/failure.h"
#include "tools/view/surface.h"

#include <stdbool.h>

enum { TEXT_ROWS = 48, TEXT_COLUMNS = 120 };

/* Lines in printable ASCII over the picture, from the top left corner. */
struct text {
    int rows;
    char line[TEXT_ROWS][TEXT_COLUMNS + 1];
};

/* Printable ASCII keys are themselves; Enter is 13, Tab 9, Escape 27. */
enum key {
    SCREEN_LEFT = 256, SCREEN_RIGHT, SCREEN_UP, SCREEN_DOWN, SCREEN_PAGE_UP, SCREEN_PAGE_DOWN,
    SCREEN_HOME, SCREEN_END,
    SCREEN_ENTER = 13, SCREEN_TAB = 9, SCREEN_ESCAPE = 27
};

enum event_kind {
    EVENT_KEY,
    EVENT_DRAG,                 /* the pointer moved by x, y with `button` held */
    EVENT_WHEEL,                /* y: 1 away from the user, -1 towards him */
    EVENT_RESIZE,               /* the surface has another size */
    EVENT_EXPOSE,               /* what was shown is gone; show it again */
    EVENT_CLOSE,                /* the user or the system wants the program to end */
    EVENT_LOST                  /* the screen is gone; `screen->lost` says why */
};

struct event {
    enum event_kind kind;
    int key;                    /* EVENT_KEY */
    int button;                 /* EVENT_DRAG: 1 left, 2 middle, 3 right */
    int x, y;                   /* pixels of the surface */
};

struct screen_wish {
    const char *title;
    int width, height;          /* of the surface, where there is a choice */
    bool no_shared_memory;      /* x11 */
    int colors;                 /* term: 24 or 8 bits; 0: what the terminal says it can */
};

struct screen {
    const struct screen_kind *kind;
    int width, height;          /* of the surface */
    bool has_text;              /* shows text by itself */
    char what[100];             /* for people: where, and how pictures get there */
    struct failure lost;
};

struct screen_kind {
    const char *name;
    struct screen *(*open)(const struct screen_wish *wish, struct failure *f);
    /* Where the next picture is to be drawn; valid until it is shown. */
    bool (*surface)(struct screen *screen, struct surface *out, struct failure *f);
    /* `text` may be null; screens without has_text never look at it. */
    bool (*show)(struct screen *screen, const struct text *text, struct failure *f);
    /* The next event; false when none has come within wait_ms (-1: for ever). */
    bool (*event)(struct screen *screen, int wait_ms, struct event *out);
    void (*close)(struct screen *screen);
};

extern const struct screen_kind screen_null, screen_term, screen_x11, screen_fb, screen_drm;

/* Opens the named back end or, with null, the first that works of those that fit the place: in a
 * desktop the window; in a terminal window or over ssh the terminal; on a console the display
 * itself. Null on failure. */
struct screen *screen_open(const char *name, const struct screen_wish *wish, struct failure *f);

/* "x11", "term", ... ; null ends the list. */
extern const char *const screen_names[];

#endif

/* SPDX-License-Identifier: MIT */
/* screen.c - which back end there is. */
#include "tools/view/screen.h"

#include "tools/view/guard.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *const screen_names[] = { "x11", "term", "fb", "drm", "null", NULL };
static const struct screen_kind *const kinds[] = { &screen_x11, &screen_term, &screen_fb,
                                                   &screen_drm, &screen_null };

/* The kernel's own console, as opposed to a terminal window or ssh. */
static bool is_console(void)
{
    const char *name = isatty(STDIN_FILENO) ? ttyname(STDIN_FILENO) : NULL;
    if (name == NULL)
        return !isatty(STDOUT_FILENO);
    return strncmp(name, "/dev/tty", 8) == 0 || strcmp(name, "/dev/console") == 0;
}

struct screen *screen_open(const char *name, const struct screen_wish *wish, struct failure *f)
{
    static const struct screen_kind *const on_desktop[] = { &screen_x11, &screen_term, NULL };
    static const struct screen_kind *const on_console[] = { &screen_x11, &screen_drm, &screen_fb,
                                                            &screen_term, NULL };
    for (int i = 0; name != NULL && screen_names[i] != NULL; i++)
        if (strcmp(screen_names[i], name) == 0)
            return kinds[i]->open(wish, f);
    const struct screen_kind *const *list = is_console() ? on_console : on_desktop;
    char all[sizeof f->text] = "";
    for (; *list != NULL && !guard_is_asked(); list++) {
        struct failure why = { "" };
        struct screen *screen = (*list)->open(wish, &why);
        if (screen != NULL)
            return screen;
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s: %s", used > 0 ? "; " : "", (*list)->name,
                 why.text);
    }
    fail(f, "%s", all);
    return NULL;
}

/* ------------------------------------------------------------------ nobody looks */

/* Nobody looks: for tests and for machines without a display. */

struct null_screen {
    struct screen screen;
    uint32_t *pixel;
};

static struct screen *null_open(const struct screen_wish *wish, struct failure *f)
{
    struct null_screen *n = calloc(1, sizeof *n);
    size_t pixels = (size_t)wish->width * (size_t)wish->height;
    if (n != NULL)
        n->pixel = calloc(pixels, sizeof *n->pixel);
    if (n == NULL || n->pixel == NULL) {
        free(n);
        fail(f, "out of memory");
        return NULL;
    }
    n->screen = (struct screen){ .kind = &screen_null, .width = wish->width,
                                 .height = wish->height, .what = "null" };
    return &n->screen;
}

static bool null_surface(struct screen *screen, struct surface *out, struct failure *f)
{
    struct null_screen *n = (struct null_screen *)screen;
    (void)f;
    *out = (struct surface){ screen->width, screen->height, (size_t)screen->width, n->pixel };
    return true;
}

static bool null_show(struct screen *screen, const struct text *text, struct failure *f)
{
    (void)screen;
    (void)text;
    (void)f;
    return true;
}

static bool null_event(struct screen *screen, int wait_ms, struct event *out)
{
    (void)screen;
    (void)wait_ms;
    (void)out;
    return false;
}

static void null_close(struct screen *screen)
{
    free(((struct null_screen *)screen)->pixel);
    free(screen);
}

const struct screen_kind screen_null = { "null", null_open, null_surface, null_show, null_event,
                                         null_close };

/* SPDX-License-Identifier: MIT */
/* screen_null.c - nobody looks: for tests and for machines without a display. */
#include "tools/view/screen.h"

#include <stdlib.h>

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

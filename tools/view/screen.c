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

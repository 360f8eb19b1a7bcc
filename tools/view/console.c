/* SPDX-License-Identifier: MIT */
/* console.c - see console.h. */
#ifdef __linux__
#include "tools/view/console.h"

#include "tools/view/guard.h"
#include "tools/view/tty.h"

#include <errno.h>
#include <linux/kd.h>
#include <poll.h>
#include <sys/ioctl.h>

static volatile int text_mode = -1;     /* what the console was in; -1: it is none, or is restored */
static bool has_keys;

/* All that a signal handler may do. */
static void undo(void)
{
    int error = errno;
    if (text_mode >= 0)
        ioctl(tty_file(), KDSETMODE, text_mode);
    text_mode = -1;
    tty_restore();
    errno = error;
}

void console_open(void)
{
    struct failure ignored = { "" };
    int mode;
    has_keys = tty_open(&ignored);
    guard_set(undo);
    if (has_keys && ioctl(tty_file(), KDGETMODE, &mode) == 0 &&
        ioctl(tty_file(), KDSETMODE, KD_GRAPHICS) == 0)
        text_mode = mode;
}

void console_close(void)
{
    undo();
    guard_set(NULL);
    tty_close();
    has_keys = false;
}

bool console_event(struct screen *screen, int wait_ms, struct event *out)
{
    if (!has_keys) {
        poll(NULL, 0, wait_ms);
        return false;
    }
    if (!tty_event(wait_ms, NULL, out))
        return false;
    if (out->kind == EVENT_LOST)
        fail(&screen->lost, "the terminal is gone");
    return true;
}

#else

typedef int console_is_for_linux;     /* C wants something in every file */

#endif

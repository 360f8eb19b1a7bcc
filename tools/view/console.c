/* SPDX-License-Identifier: MIT */
/* console.c - see console.h. */
#ifdef __linux__
#include "tools/view/console.h"

#include "tools/view/evdev.h"
#include "tools/view/guard.h"
#include "tools/view/tty.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/kd.h>
#include <sys/ioctl.h>
#include <unistd.h>

static struct {
    volatile int file;              /* of the console; -1: there is none, or it is restored */
    int text_mode;                  /* what it was in */
    bool has_keys, is_own;          /* a terminal; `file` was opened here */
    void (*also)(void);
} console = { .file = -1 };

/* All that a signal handler may do. */
static void undo(void)
{
    const int error = errno, file = console.file;
    console.file = -1;
    if (console.also != NULL)
        console.also();
    if (file >= 0)
        ioctl(file, KDSETMODE, console.text_mode);
    if (file >= 0 && console.is_own)
        close(file);
    evdev_close();
    tty_restore();
    errno = error;
}

/* The one whose text is on the display, whatever this program was started from. */
static int find_console(void)
{
    int mode;
    if (console.has_keys && ioctl(tty_file(), KDGETMODE, &mode) == 0)
        return tty_file();
    console.is_own = true;
    return open("/dev/tty0", O_RDWR | O_CLOEXEC | O_NOCTTY);
}

void console_open(void (*also)(void))
{
    struct failure ignored = { "" };
    console.has_keys = tty_open(&ignored);
    console.is_own = false;
    console.also = also;
    guard_set(undo);
    evdev_open(!console.has_keys);
    const int file = find_console();
    if (file >= 0 && ioctl(file, KDGETMODE, &console.text_mode) == 0 && ioctl(file, KDSETMODE, KD_GRAPHICS) == 0)
        console.file = file;
    else if (file >= 0 && console.is_own)
        close(file);
}

void console_close(void)
{
    undo();
    guard_set(NULL);
    tty_close();
    console.has_keys = false;
    console.also = NULL;
}

bool console_event(struct screen *screen, int wait_ms, struct event *out)
{
    if (!console.has_keys)
        return evdev_event(wait_ms, -1, out);
    if (!tty_event(0, NULL, out) && !evdev_event(wait_ms, tty_file(), out) && !tty_event(0, NULL, out))
        return false;
    if (out->kind == EVENT_LOST)
        fail(&screen->lost, "the terminal is gone");
    return true;
}

#else

typedef int console_is_for_linux;     /* C wants something in every file */

#endif

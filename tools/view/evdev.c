/* SPDX-License-Identifier: MIT */
/* evdev.c - see evdev.h. Kernel documentation, "Linux Input Subsystem userspace API". */
#ifdef __linux__
#define _DEFAULT_SOURCE         /* struct timeval in <linux/input.h> */
#include "tools/view/evdev.h"

#include <fcntl.h>
#include <linux/input.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { MAX_DEVICES = 16, MAX_NUMBERS = 32, LONG_BITS = 8 * sizeof(unsigned long) };

static int file[MAX_DEVICES];
static volatile int count;

int evdev_key(int code)
{
    /* Of a keyboard, row by row, by what is printed on it in most places. */
    static const struct {
        int first;
        const char *keys;
    } row[] = {
        { KEY_1, "1234567890-=" }, { KEY_Q, "qwertyuiop[]" }, { KEY_A, "asdfghjkl;" }, { KEY_Z, "zxcvbnm,./" }, { KEY_SPACE, " " }
    };
    static const struct {
        int code, key;
    } other[] = {
        { KEY_UP, SCREEN_UP }, { KEY_DOWN, SCREEN_DOWN }, { KEY_LEFT, SCREEN_LEFT }, { KEY_RIGHT, SCREEN_RIGHT },
        { KEY_PAGEUP, SCREEN_PAGE_UP }, { KEY_PAGEDOWN, SCREEN_PAGE_DOWN }, { KEY_HOME, SCREEN_HOME }, { KEY_END, SCREEN_END },
        { KEY_ENTER, SCREEN_ENTER }, { KEY_TAB, SCREEN_TAB }, { KEY_ESC, SCREEN_ESCAPE },
        { BTN_DPAD_UP, SCREEN_UP }, { BTN_DPAD_DOWN, SCREEN_DOWN }, { BTN_DPAD_LEFT, SCREEN_LEFT }, { BTN_DPAD_RIGHT, SCREEN_RIGHT },
        { BTN_SOUTH, 'a' }, { BTN_EAST, 'a' }, { BTN_NORTH, 'x' }, { BTN_WEST, 'y' }, { BTN_TL, SCREEN_LEFT }, { BTN_TR, SCREEN_RIGHT },
        { BTN_START, SCREEN_ENTER }, { BTN_SELECT, SCREEN_TAB }, { BTN_MODE, SCREEN_ESCAPE }
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++)
        if (code >= row[i].first && code < row[i].first + (int)strlen(row[i].keys))
            return (unsigned char)row[i].keys[code - row[i].first];
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        if (code == other[i].code)
            return other[i].key;
    return 0;
}

static bool has(const unsigned long *bits, int code)
{
    return bits[code / LONG_BITS] >> code % LONG_BITS & 1;
}

void evdev_open(bool keyboards)
{
    for (int i = 0; i < MAX_NUMBERS && count < MAX_DEVICES; i++) {
        unsigned long bits[KEY_MAX / LONG_BITS + 1] = { 0 };
        char path[32];
        snprintf(path, sizeof path, "/dev/input/event%d", i);
        const int device = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
        if (device < 0)
            continue;
        const bool is_known = ioctl(device, EVIOCGBIT(EV_KEY, sizeof bits), bits) >= 0;
        const bool is_pad = is_known && (has(bits, BTN_SOUTH) || has(bits, BTN_DPAD_UP));
        const bool is_keyboard = is_known && keyboards && (has(bits, KEY_UP) || has(bits, KEY_ENTER) || has(bits, KEY_SPACE));
        if (!is_pad && !is_keyboard) {
            close(device);
            continue;
        }
        if (is_keyboard)
            ioctl(device, EVIOCGRAB, 1);
        file[count] = device;
        count = count + 1;
    }
}

void evdev_close(void)
{
    for (int i = count; i-- > 0;) {
        count = i;
        close(file[i]);
    }
}

/* Pressed, or held so long that it counts again; a hat is a cross of keys. */
static int key_of(const struct input_event *e)
{
    if (e->type == EV_KEY && e->value != 0)
        return evdev_key(e->code);
    if (e->type != EV_ABS || e->value == 0)
        return 0;
    if (e->code == ABS_HAT0X)
        return e->value < 0 ? SCREEN_LEFT : SCREEN_RIGHT;
    if (e->code == ABS_HAT0Y)
        return e->value < 0 ? SCREEN_UP : SCREEN_DOWN;
    return 0;
}

static bool take(struct event *out)
{
    struct input_event e;
    for (int i = 0; i < count; i++)
        while (read(file[i], &e, sizeof e) == (ssize_t)sizeof e) {
            const int key = key_of(&e);
            if (key == 0)
                continue;
            *out = (struct event){ .kind = EVENT_KEY, .key = key };
            return true;
        }
    return false;
}

bool evdev_event(int wait_ms, int also, struct event *out)
{
    struct pollfd ready[MAX_DEVICES + 1];
    const int devices = count;
    if (take(out))
        return true;
    for (int i = 0; i < devices; i++)
        ready[i] = (struct pollfd){ .fd = file[i], .events = POLLIN };
    ready[devices] = (struct pollfd){ .fd = also, .events = POLLIN };
    if (poll(ready, (nfds_t)(devices + (also >= 0)), wait_ms) <= 0)
        return false;
    for (int i = 0; i < devices; i++)
        if ((ready[i].revents & (POLLHUP | POLLERR)) != 0)
            evdev_close();              /* a pad has been pulled out: poll would not wait any more */
    return take(out);
}

#else

typedef int evdev_is_for_linux;     /* C wants something in every file */

#endif

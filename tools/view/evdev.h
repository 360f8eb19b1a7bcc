/* SPDX-License-Identifier: MIT */
/* evdev.h - keys and pads of Linux's input devices, /dev/input/event*: of handhelds, and where there is no terminal. */
#ifndef SMEAR_TOOLS_VIEW_EVDEV_H
#define SMEAR_TOOLS_VIEW_EVDEV_H

#include "tools/view/screen.h"

/* Opens pads; with `keyboards`, also what has keys of a keyboard, which then belong to this program alone, so that what is
 * pressed does not reach a shell behind the picture. */
void evdev_open(bool keyboards);

/* Gives all of them back; a signal handler may call it. */
void evdev_close(void);

/* The next event; false when none has come within wait_ms (-1: for ever), or when `also`, a file (-1: none), can be read. */
bool evdev_event(int wait_ms, int also, struct event *out);

/* The key of screen.h for a code of <linux/input.h>; 0: none. */
int evdev_key(int code);

#endif

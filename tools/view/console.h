/* SPDX-License-Identifier: MIT */
/* console.h - the keyboard beside a display that is drawn on directly, and a console that keeps its
 * text off it. */
#ifndef SMEAR_TOOLS_VIEW_CONSOLE_H
#define SMEAR_TOOLS_VIEW_CONSOLE_H

#include "tools/view/screen.h"

/* Keys come from the terminal and from pads or, where there is no terminal, from all input devices; there may be none. Signals
 * put everything right, and call `also`, which may do what a signal handler may; it may be null. */
void console_open(void (*also)(void));
void console_close(void);

/* As the event of a screen. */
bool console_event(struct screen *screen, int wait_ms, struct event *out);

#endif

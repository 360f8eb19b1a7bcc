/* SPDX-License-Identifier: MIT */
/* console.h - the keyboard beside a display that is drawn on directly, and a console that keeps its
 * text off it. */
#ifndef SMEAR_TOOLS_VIEW_CONSOLE_H
#define SMEAR_TOOLS_VIEW_CONSOLE_H

#include "tools/view/screen.h"

/* Where there is no terminal, no keys come; that is no failure. Signals put everything right. */
void console_open(void);
void console_close(void);

/* As the event of a screen. */
bool console_event(struct screen *screen, int wait_ms, struct event *out);

#endif

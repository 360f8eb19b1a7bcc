/* SPDX-License-Identifier: MIT */
/* tty.h - keys and the pointer from a terminal or console, as events. There is one at a time, as
 * whatever ends the program must put it right (guard.h). */
#ifndef SMEAR_TOOLS_VIEW_TTY_H
#define SMEAR_TOOLS_VIEW_TTY_H

#include "tools/view/screen.h"

#include <stdbool.h>

/* Takes standard input, or else the controlling terminal; no echo, no lines, no signals by keys. */
bool tty_open(struct failure *f);
/* As it was before. May be called by a signal handler, and more than once. */
void tty_restore(void);
/* Raw again, after tty_restore. */
void tty_again(void);
void tty_close(void);

/* The terminal's file; -1: there is none. */
int tty_file(void);

/* The next event within wait_ms (-1: for ever). `suspend` is called for Ctrl-Z; null: it is
 * ignored. Ctrl-C and Ctrl-backslash are EVENT_CLOSE; the end of the terminal is EVENT_LOST. */
bool tty_event(int wait_ms, void (*suspend)(void), struct event *out);

/* The next event in bytes from a terminal: how many bytes it took, 0 when more may follow. The
 * event's kind is EVENT_EXPOSE when the bytes mean nothing. `is_last`: nothing follows soon. */
int tty_decode(const unsigned char *bytes, int count, bool is_last, struct event *out);

/* Writes it all, or a part when the program is asked to end; false when nobody reads any more. */
bool tty_write(int file, const char *bytes, size_t size);

/* Writes to a terminal without waiting: where it takes no more, what waits there is dropped. May be called by a signal handler. */
void tty_write_at_once(int file, const char *bytes, size_t size);

#endif

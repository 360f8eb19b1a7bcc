/* SPDX-License-Identifier: MIT */
/* guard.h - whatever ends the program, the terminal is put right first. */
#ifndef SMEAR_TOOLS_VIEW_GUARD_H
#define SMEAR_TOOLS_VIEW_GUARD_H

#include <stdbool.h>

/* From now on SIGINT, SIGTERM, SIGHUP and SIGQUIT ask the program to end (guard_is_asked). A second one, some seconds in which
 * it does not end, and every crash run `undo` and then end it as if nothing had caught the signal. `undo` may call only what a
 * signal handler may, and must not wait for anything; null: there is nothing to undo. */
void guard_set(void (*undo)(void));

bool guard_is_asked(void);

/* Stops the program (Ctrl-Z): `undo` runs before, `redo` when it goes on. */
void guard_suspend(void (*redo)(void));

#endif

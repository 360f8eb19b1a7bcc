/* SPDX-License-Identifier: MIT */
/* script.h - the user's input in a file, so that it can be given again.
 *
 *     12 key b            before picture number 12 (from 0 on) is drawn, `b` was pressed
 *     13 key left         named keys: left right up down pageup pagedown home end enter tab escape
 *                         space
 *     14 drag 1 5 -3      the pointer moved by 5, -3 with button 1 held
 *     15 wheel 1          one notch away from the user
 *
 * Lines that begin with # are comments. */
#ifndef SMEAR_TOOLS_VIEW_SCRIPT_H
#define SMEAR_TOOLS_VIEW_SCRIPT_H

#include "tools/failure.h"
#include "tools/image/file.h"
#include "tools/view/screen.h"

#include <stdbool.h>

struct script {
    struct output out;          /* being recorded; stream null: not */
    char *text;                 /* being played; null: not */
    struct script_line *line;
    int count, next;
};

bool script_play(struct script *script, const char *path, struct failure *f);
bool script_record(struct script *script, const char *path, struct failure *f);

/* The next event of the script that is due before picture `tick`. */
bool script_event(struct script *script, long tick, struct event *out);
/* Notes an event of the user; kinds other than keys, drags and wheels are left out. */
void script_note(struct script *script, long tick, const struct event *event);

/* Completes a recording. script_close in any case. */
bool script_end(struct script *script, struct failure *f);
void script_close(struct script *script);

/* The name of a key as it stands in scripts and in the help, in a buffer of 16. */
const char *key_name(int key, char buffer[16]);

#endif

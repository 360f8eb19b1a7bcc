/* SPDX-License-Identifier: MIT */
/* file.h - a file that appears under its name only when it is complete. */
#ifndef SMEAR_TOOLS_IMAGE_FILE_H
#define SMEAR_TOOLS_IMAGE_FILE_H

#include "tools/failure.h"

#include <stdio.h>

struct output {
    FILE *stream;               /* write here; null when closed */
    char *path, *temporary;     /* the final name, and the one beside it that is written */
};

/* From now on nothing that is written replaces the file `path`, which has been read: false when that cannot be
 * promised. */
bool file_keep(const char *path, struct failure *f);
bool file_is_kept(const char *path);

/* A complete file replaces what has its name; false where that is a device or folder, which must stay, or is kept. */
bool file_is_replaceable(const char *path, struct failure *f);

/* Opens `path`.tmp for writing and seeking; `path` must be replaceable. */
bool output_open(struct output *o, const char *path, struct failure *f);

/* Closes and renames to the final name. Any write error since the opening fails here at the latest;
 * then nothing is left behind. The struct is empty afterwards in any case. */
bool output_commit(struct output *o, struct failure *f);

/* Closes and removes the temporary file. Harmless on an empty struct. */
void output_discard(struct output *o);

/* From now on a signal that ends the program removes what is unfinished first (interrupt.c). */
void output_catch_signals(void);

/* Removes what is unfinished; may be called by a signal handler. */
void output_remove_all(void);

/* Temporary files that are open now, or null. */
enum { OUTPUTS_MAX = 16 };
extern char *volatile output_unfinished[OUTPUTS_MAX];

#endif

/* SPDX-License-Identifier: MIT */
/* file.h - files that are read whole, and files that appear under their names only when all is complete. */
#ifndef SMEAR_TOOLS_IMAGE_FILE_H
#define SMEAR_TOOLS_IMAGE_FILE_H

#include "tools/failure.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* --- reading (file_read: image.h) --- */

/* Looks at the first bytes of a file (fewer than FILE_HEAD only where it ends) and says whether to read on. */
enum { FILE_HEAD = 4096 };
typedef bool file_head_fn(const void *user, const uint8_t *head, size_t size, struct failure *f);

/* All that is left of a stream, up to max_bytes, with a NUL behind it; `look` may be null. A regular file that is too
 * large is refused before anything is read, and memory is taken for its size alone. Closes the stream. */
bool file_read_stream(FILE *stream, size_t max_bytes, file_head_fn *look, const void *user, uint8_t **bytes,
                      size_t *size, struct failure *f);

/* Opens a regular file; anything else is refused: a pipe waits for somebody to write, a device may have no end. */
FILE *file_open_regular(const char *path, struct failure *f);

/* Bytes from here to the end of a regular file; -1 where nobody knows. */
long long file_left(FILE *stream);

/* Whether the file lies in the folder ("": the current one) or in one below it, whatever links lead there. */
bool file_lies_in(const char *path, const char *folder, struct failure *f);

/* What a chain of links leads to, which need not be there, for the caller to free; null when it has no end, or without
 * memory. */
char *file_behind_links(const char *path);

/* From now on nothing that is written replaces the file `path`, which has been read: false when that cannot be
 * promised. */
bool file_keep(const char *path, struct failure *f);
bool file_is_kept(const char *path);

/* --- writing ---
 *
 * An output is written into a new file beside the one it will be, .smear-*.tmp, which no other program has; only when
 * it is complete and has reached the disk does it take the other's place. A command that writes several holds them
 * (outputs_hold), and gives all their names at its end, or none. What is unfinished is kept in one list of the program:
 * one thread writes at a time. */

struct output_name;
struct output {
    FILE *stream;               /* write here; null when closed */
    struct output_name *name;
};

/* A complete file replaces what has its name; false where that is a device or folder, which must stay, or is kept. */
bool file_is_replaceable(const char *path, struct failure *f);

/* Opens for writing and seeking; `path` must be replaceable. */
bool output_open(struct output *o, const char *path, struct failure *f);

/* The same for text, which goes to standard output for the name `-`, when it is complete. */
bool output_open_text(struct output *o, const char *path, struct failure *f);

/* Text that may also go into a device or pipe. A link to a file stays, and the file behind it is replaced. */
bool output_open_stream(struct output *o, const char *path, struct failure *f);

/* Closes, and gives the file its name unless outputs are held. Any write error since the opening fails here at the
 * latest; then nothing is left behind. The struct is empty afterwards in any case. */
bool output_commit(struct output *o, struct failure *f);

/* Closes and removes the temporary file. Harmless on an empty struct. */
void output_discard(struct output *o);

/* From now on outputs that are committed wait for outputs_publish, which gives all of them their names or, where one
 * can't have it, none, and then says whose; or for outputs_drop, which removes them. */
void outputs_hold(void);
bool outputs_publish(const char **failed, struct failure *f);
void outputs_drop(void);

/* Writes all that is left of standard output; false when any of it was lost. */
bool output_flush_standard(struct failure *f);

/* From now on a signal that ends the program removes what is unfinished first (output.c). */
void output_catch_signals(void);

/* Those signals wait while names are given, so that all are or none. */
void output_block_signals(bool blocked);

/* Removes what is unfinished; may be called by a signal handler. */
void output_remove_all(void);

#endif

/* SPDX-License-Identifier: MIT */
/* tape.h - records presented frames as C source that platform/play.c plays on any target. Host only.
 *
 * One source holds any number of tapes; what they have in common (a mesh used in every frame, a
 * texture used by two tapes) is stored once. Everything is const, so it stays in flash; numbers are
 * written as numbers, so byte order and struct layout are the target compiler's. */
#ifndef SMEAR_TOOLS_TAPE_H
#define SMEAR_TOOLS_TAPE_H

#include "tools/failure.h"
#include "tools/scenes/present.h"

struct tape_writer;

/* Null when out of memory. */
struct tape_writer *tape_writer_new(struct failure *f);
void tape_writer_free(struct tape_writer *writer);

/* Starts a tape. `name` is printable ASCII without quotes or backslashes, at most 63 characters.
 * Callbacks of `desc` are left out. */
bool tape_begin(struct tape_writer *writer, const char *name, const smear_desc *desc,
                struct failure *f);

/* Adds a frame to the tape; `crc` is the expected CRC or null. Either all frames of a tape have one
 * or none counts. */
bool tape_add(struct tape_writer *writer, const struct presented *frame, const uint32_t *crc,
              struct failure *f);

/* Writes the source; it includes "platform/play.h" and defines tape_list and tape_count. `command` goes into
 * its first lines: who wrote it. */
bool tape_write(struct tape_writer *writer, const char *path, const char *command,
                struct failure *f);

#endif

/* SPDX-License-Identifier: MIT */
/* golden.h - frames by their CRC: printed, or held against a file that was accepted before.
 *
 * A file is text: `frame=0 crc32=0297a34a`, one line for each picture in the order shown; lines
 * that begin with # are comments. Beside FILE lie the accepted pictures, FILE.0000.png and so on
 * by line number; where one differs, FILE.0000.got.png and FILE.0000.difference.png are written. */
#ifndef SMEAR_TOOLS_VIEW_GOLDEN_H
#define SMEAR_TOOLS_VIEW_GOLDEN_H

#include "tools/image/image.h"

#include <stdbool.h>
#include <stdint.h>

struct golden_line {
    long frame;                 /* -1: between frames */
    uint32_t crc32;
};

struct golden {
    const char *path;           /* null: lines are only printed */
    bool prints, updates;
    int count, room;
    struct golden_line *line;   /* as drawn */
    int expected_count;
    struct golden_line *expected;
    int different;              /* pictures so far */
    int first_different;
};

/* Reads the file unless it is to be updated. golden_close in any case. */
bool golden_open(struct golden *golden, const char *path, bool prints, bool updates,
                 struct failure *f);
bool golden_add(struct golden *golden, long frame, uint32_t crc32, const struct image *picture,
                struct failure *f);
/* Prints, writes, or tells by `f` what differs. */
bool golden_end(struct golden *golden, struct failure *f);
void golden_close(struct golden *golden);

/* Whether golden_add wants a picture. */
bool golden_wants_pictures(const struct golden *golden);

#endif

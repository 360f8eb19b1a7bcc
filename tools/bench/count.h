/* SPDX-License-Identifier: MIT */
/* count.h - instructions per frame: runs this program again under callgrind, which is told to
 * collect inside bench_frame and nowhere else. Counts do not depend on the machine's load. */
#ifndef SMEAR_BENCH_COUNT_H
#define SMEAR_BENCH_COUNT_H

#include "tools/failure.h"

#include <stdbool.h>
#include <stdint.h>

enum { COUNT_MAX_FRAMES = 512 };

struct counter {
    const char *program;        /* path of this program */
    const char *folder;         /* for callgrind's files; exists */
};

/* Draws the takes of a group that are listed (at most COUNT_MAX_FRAMES) and counts each: what is in and below bench_frame, on the
 * thread that calls it. May run on several threads, as long as no two lists begin with the same take. */
bool count_list(const struct counter *counter, const char *group, const int *index, int frames, uint64_t *instructions,
                struct failure *f);

/* The same for `frames` takes from the first on. */
bool count_takes(const struct counter *counter, const char *group, int first, int frames, uint64_t *instructions,
                 struct failure *f);

/* The other side: what this program does when it is run by count_list; numbers with commas. */
bool count_serve(const char *group, const char *list, struct failure *f);

#endif

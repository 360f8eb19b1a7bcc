/* SPDX-License-Identifier: MIT */
/* sheet.h - what all reports share: where counts come from, and how many bars were met. */
#ifndef SMEAR_BENCH_SHEET_H
#define SMEAR_BENCH_SHEET_H

#include "tools/failure.h"
#include "tools/bench/count.h"

#include <stdbool.h>

struct sheet {
    struct counter counter;
    const char *folder;         /* for files: truths, callgrind's dumps */
    int met, missed;            /* bars */
};

/* Notes whether value <= bar, and returns the word for it. */
const char *sheet_most(struct sheet *sheet, double value, double bar);

/* Sorts; the middle one, or the mean of the two in the middle. */
double median(double *value, int count);

/* exp of the mean logarithm of positive numbers. */
double geometric_mean(const double *value, int count);

/* Seconds that the clock on the wall shows, and those this process has used. */
double wall_seconds(void);
double process_seconds(void);

/* The reports. Each prints to standard output. */
bool peers_report(struct sheet *sheet, struct failure *f);      /* instructions, time */
bool targets_report(struct sheet *sheet, const char *path, struct failure *f);

#endif

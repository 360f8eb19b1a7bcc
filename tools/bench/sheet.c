/* SPDX-License-Identifier: MIT */
/* sheet.c - bars, means, clocks. */
#include "tools/bench/sheet.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

const char *sheet_most(struct sheet *sheet, double value, double bar)
{
    const bool is_met = value <= bar;
    if (is_met)
        sheet->met++;
    else
        sheet->missed++;
    return is_met ? "met" : "MISSED";
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double median(double *value, int count)
{
    qsort(value, (size_t)count, sizeof *value, compare);
    return (value[(count - 1) / 2] + value[count / 2]) / 2.0;
}

double geometric_mean(const double *value, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += log(value[i]);
    return exp(sum / count);
}

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double wall_seconds(void)
{
    return seconds(CLOCK_MONOTONIC);
}

double process_seconds(void)
{
    return seconds(CLOCK_PROCESS_CPUTIME_ID);
}

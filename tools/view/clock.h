/* SPDX-License-Identifier: MIT */
/* clock.h - time that only goes forward, in microseconds. */
#ifndef SMEAR_TOOLS_VIEW_CLOCK_H
#define SMEAR_TOOLS_VIEW_CLOCK_H

#include <time.h>

static inline double clock_us(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e6 + (double)now.tv_nsec / 1e3;
}

#endif

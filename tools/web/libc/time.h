/* SPDX-License-Identifier: MIT */
/* time.h - the page's clock. */
#ifndef SMEAR_WEB_TIME_H
#define SMEAR_WEB_TIME_H

struct timespec {
    long long tv_sec;
    long tv_nsec;
};
enum { CLOCK_MONOTONIC = 1 };

int clock_gettime(int clock, struct timespec *out);

#endif

/* SPDX-License-Identifier: MIT */
/* random.h - numbers that look random and are the same on every machine, for suites on hosts and on targets. A test sets
 * random_state first, so that it meets the same numbers whether it runs alone or after others. */
#ifndef SMEAR_TESTS_RANDOM_H
#define SMEAR_TESTS_RANDOM_H

#include <stdbool.h>
#include <stdint.h>

extern uint32_t random_state;

uint32_t random_u32(void);

/* low .. high, both included */
int32_t between(int32_t low, int32_t high);

/* True once in so many calls. */
bool chance(int one_in);

/* low .. high; for hosts, where floating point exists. */
static inline double uniform(double low, double high)
{
    return low + (high - low) * random_u32() / 4294967295.0;
}

#endif

/* SPDX-License-Identifier: MIT */
/* decimal.h - doubles as decimal digits, exactly. */
#ifndef SMEAR_WEB_DECIMAL_H
#define SMEAR_WEB_DECIMAL_H

#include <stdbool.h>

enum { DECIMAL_DIGITS = 800 };

/* 0.d1d2d3... x 10^point, the first digit not 0 (of zero: no digits). */
struct decimal {
    int count, point;
    char digit[DECIMAL_DIGITS];
};

/* All digits of a finite x >= 0. */
void decimal_of(double x, struct decimal *out);

/* Keeps `count` digits, to nearest, halves to even; `count` may be 0 or below. */
void decimal_round(struct decimal *d, int count);

/* The double nearest to it. `more`: there were further digits, not all of them 0. */
double decimal_value(const struct decimal *d, bool more);

#endif

/* SPDX-License-Identifier: MIT */
/* host.h - what suites of the host are written with: checks, numbers by chance, the C library. */
#ifndef SMEAR_TESTS_HOST_H
#define SMEAR_TESTS_HOST_H

#include "tests/random.h"
#include "tests/test.h"
#include "tools/scenes/color.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a variable of the environment asks for; or what is usual. */
static inline uint32_t number_from(const char *name, uint32_t usual)
{
    const char *value = getenv(name);
    return value != NULL && atoi(value) > 0 ? (uint32_t)atoi(value) : usual;
}

/* Between codes, 0 to 255, and light, 0 to 1. */
static inline double light_of(double code) { return color_decode(code / 255); }
static inline double code_of(double light) { return 255 * color_encode(light); }

/* Of vectors; unit3 makes one of length 1 and returns how long it was. */
static inline double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static inline void cross3(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static inline double unit3(double v[3])
{
    const double length = sqrt(dot3(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return length;
}

/* A rotation about an axis of length 1, by Rodrigues' formula; and the product of two matrices. */
static inline void turn3(double m[9], const double n[3], double angle)
{
    const double c = cos(angle), s = sin(angle), across[9] = { 0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0 };
    for (int i = 0; i < 9; i++)
        m[i] = (i % 4 == 0 ? c : 0) + s * across[i] + (1 - c) * n[i / 3] * n[i % 3];
}

static inline void product3(double out[9], const double a[9], const double b[9])
{
    for (int i = 0; i < 9; i++)
        out[i] = a[i / 3 * 3] * b[i % 3] + a[i / 3 * 3 + 1] * b[3 + i % 3] + a[i / 3 * 3 + 2] * b[6 + i % 3];
}

/* Prints what differs, so that a failed comparison can be understood. */
static inline bool same_text(const char *got, const char *want)
{
    if (strcmp(got, want) == 0)
        return true;
    test_print("  got:  ");
    test_print(got);
    test_print("\n  want: ");
    test_print(want);
    test_print("\n");
    return false;
}

/* For qsort. */
static inline int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

#endif

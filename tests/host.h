/* SPDX-License-Identifier: MIT */
/* host.h - what suites of the host are written with: checks, numbers by chance, the C library. */
#ifndef SMEAR_TESTS_HOST_H
#define SMEAR_TESTS_HOST_H

#include "tests/random.h"
#include "tests/test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#endif

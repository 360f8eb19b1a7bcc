/* SPDX-License-Identifier: MIT */
/* fixmath.c - the one copy of the larger helpers, on small cores where size counts; else nothing. */
#define SMEAR_COPY_IS_HERE 1
#include "base/fixmath.h"

/* A translation unit must not be empty. */
typedef int32_t smear_fixmath_is_here;

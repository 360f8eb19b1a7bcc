/* SPDX-License-Identifier: MIT */
/* require.h - what a fuzzer asks of what it calls: else it ends, and libFuzzer keeps the input. */
#ifndef SMEAR_FUZZ_REQUIRE_H
#define SMEAR_FUZZ_REQUIRE_H

#include <stdbool.h>
#include <stdlib.h>

static inline void require(bool ok)
{
    if (!ok)
        abort();
}

#endif

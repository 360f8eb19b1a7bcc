/* SPDX-License-Identifier: MIT */
/* target_unit.c - runs the test suites that need neither a C library nor floating point.
 *
 * Which suites these are is the Makefile's UNIT_SUITES: it defines TARGET_SUITES as `SUITE(a)
 * SUITE(b)`, where SUITE(a) stands for suite_a(). An argument selects tests whose names contain it. */
#include "platform/platform.h"
#include "platform/print.h"
#include "tests/test.h"

#ifndef TARGET_SUITES
#error "TARGET_SUITES must be defined, e.g. -D'TARGET_SUITES=SUITE(fixmath) SUITE(clip)'"
#endif

#define SUITE(name) void suite_##name(void);
TARGET_SUITES
#undef SUITE

void test_print(const char *text)
{
    platform_print(text);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        test_state.filter = argv[1];
#define SUITE(name) suite_##name();
    TARGET_SUITES
#undef SUITE
    platform_print("unit tests: ");
    print_signed(test_state.passed);
    platform_print(" passed, ");
    print_signed(test_state.failed);
    platform_print(" failed\n");
    return test_state.failed != 0 || test_state.passed == 0;
}

/* SPDX-License-Identifier: MIT */
/* run.c - the test program of the host: `run` executes every suite, `run WORD` the tests whose name contains WORD.
 * The Makefile lists the suites: SUITE(name) stands for suite_name() in test_name.c of tests/unit or tests/suite. */
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

#define SUITE(name) void suite_##name(void);
TEST_SUITES
#undef SUITE

static const struct suite {
    const char *name;
    void (*run)(void);
} suites[] = {
#define SUITE(name) { #name, suite_##name },
    TEST_SUITES
#undef SUITE
};

void test_print(const char *text)
{
    fputs(text, stdout);
}

/* `run --suite NAME` executes one suite, so that several can run at once. */
int main(int argc, char **argv)
{
    const char *only = argc > 2 && strcmp(argv[1], "--suite") == 0 ? argv[2] : NULL;
    bool found = only == NULL;
    if (argc > 1 && only == NULL)
        test_state.filter = argv[1];
    for (size_t i = 0; i < sizeof suites / sizeof *suites; i++) {
        if (only != NULL && strcmp(only, suites[i].name) != 0)
            continue;
        found = true;
        suites[i].run();
        fflush(stdout);
    }
    if (!found) {
        fprintf(stderr, "run: no suite %s\n", only);
        return 2;
    }
    printf("%d passed, %d failed\n", test_state.passed, test_state.failed);
    return test_state.failed != 0 || test_state.passed == 0;
}

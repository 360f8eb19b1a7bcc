/* SPDX-License-Identifier: MIT */
/* test.h - the whole test framework: checks that count, and tests that are named by their claim.
 *
 * A test file defines `void suite_NAME(void)` which calls RUN(test_function) for each test. A failed
 * check prints file, line and values, and the test goes on, so one run shows every mismatch. The same
 * header serves the host and bare-metal targets: printing goes through test_print(), which the runner
 * of each target provides. */
#ifndef SMEAR_TEST_H
#define SMEAR_TEST_H

#include <stdbool.h>
#include <stdint.h>

struct test_state {
    const char *filter;         /* run only tests whose name contains this; null runs all */
    const char *name;           /* the running test */
    int passed, failed;         /* tests */
    int failures_here;          /* failed checks in the running test */
};

extern struct test_state test_state;

void test_print(const char *text);              /* provided by the target */
void test_run(const char *name, void (*function)(void));
bool test_check(bool ok, const char *file, int line, const char *what);
bool test_check_eq(int64_t got, int64_t want, const char *file, int line, const char *what);
bool test_check_near(int64_t got, int64_t want, int64_t slack, const char *file, int line,
                     const char *what);

/* Of a variable that is given to `function` where its block ends, by return and break, too. */
#define OWNED(function) __attribute__((cleanup(function)))

#define RUN(function) test_run(#function, function)

/* Each returns true when it holds, so that a test may stop where going on makes no sense. */
#define CHECK(condition) test_check((condition), __FILE__, __LINE__, #condition)
#define CHECK_EQ(got, want) test_check_eq((got), (want), __FILE__, __LINE__, #got " == " #want)
#define CHECK_NEAR(got, want, slack) \
    test_check_near((got), (want), (slack), __FILE__, __LINE__, #got " near " #want)

/* And ends the test, or what it has called, where going on makes no sense. */
#define END_UNLESS(ok) \
    do { \
        if (!(ok)) \
            return; \
    } while (0)
#define REQUIRE(condition) END_UNLESS(CHECK(condition))
#define REQUIRE_EQ(got, want) END_UNLESS(test_check_eq((got), (want), __FILE__, __LINE__, #got " == " #want))
#define REQUIRE_NEAR(got, want, slack) \
    END_UNLESS(test_check_near((got), (want), (slack), __FILE__, __LINE__, #got " near " #want))

/* For hosts, where floating point exists: |got - want| <= slack, and neither is NaN. */
#define CHECK_CLOSE(got, want, slack) \
    test_check(((got) >= (want) - (slack)) && ((got) <= (want) + (slack)), __FILE__, __LINE__, \
               #got " within " #slack " of " #want)

#endif

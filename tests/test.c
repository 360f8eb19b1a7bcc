/* SPDX-License-Identifier: MIT */
/* test.c - counts and prints; needs nothing but test_print(), so it runs on bare metal too. */
#include "tests/test.h"

#include <stddef.h>

struct test_state test_state;

static bool contains(const char *text, const char *part)
{
    for (; *text != '\0'; text++) {
        const char *a = text, *b = part;
        while (*b != '\0' && *a == *b)
            a++, b++;
        if (*b == '\0')
            return true;
    }
    return *part == '\0';
}

static void print_number(int64_t value)
{
    char digits[24];
    size_t at = sizeof digits - 1;
    uint64_t magnitude = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
    digits[at] = '\0';
    do {
        digits[--at] = (char)('0' + magnitude % 10);
        magnitude /= 10;
    } while (magnitude != 0);
    if (value < 0)
        digits[--at] = '-';
    test_print(digits + at);
}

void test_run(const char *name, void (*function)(void))
{
    if (test_state.filter != NULL && !contains(name, test_state.filter))
        return;
    test_state.name = name;
    test_state.failures_here = 0;
    function();
    if (test_state.failures_here == 0) {
        test_state.passed++;
    } else {
        test_state.failed++;
        test_print("FAIL ");
        test_print(name);
        test_print("\n");
    }
}

static void print_place(const char *file, int line, const char *what)
{
    test_print("  ");
    test_print(file);
    test_print(":");
    print_number(line);
    test_print(": ");
    test_print(what);
}

bool test_check(bool ok, const char *file, int line, const char *what)
{
    if (ok)
        return true;
    test_state.failures_here++;
    print_place(file, line, what);
    test_print("\n");
    return false;
}

bool test_check_near(int64_t got, int64_t want, int64_t slack, const char *file, int line,
                     const char *what)
{
    if (got >= want - slack && got <= want + slack)
        return true;
    test_state.failures_here++;
    print_place(file, line, what);
    test_print(": got ");
    print_number(got);
    test_print(", want ");
    print_number(want);
    if (slack != 0) {
        test_print(" +- ");
        print_number(slack);
    }
    test_print("\n");
    return false;
}

bool test_check_eq(int64_t got, int64_t want, const char *file, int line, const char *what)
{
    return test_check_near(got, want, 0, file, line, what);
}

/* SPDX-License-Identifier: MIT */
/* check_kernels.c - the suite of kernels, then what each form of them costs on this machine, in nanoseconds per pixel: the
 * least time of many rounds. `check_kernels WORD` does so for kernels whose name contains it. */
#include "tests/kernels/kernels.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

void suite_kernels(void);

static const char *wanted_name = "";

void test_print(const char *text)
{
    fputs(text, stdout);
}

static double now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

static void no_call(struct kernel_call *c)
{
    (void)c;
}

/* A call on fresh data: the least of many rounds of calls, the time of fresh data included. */
static double least_ns(const struct kernel *k, const struct kernel_call *c, void (*call)(struct kernel_call *))
{
    enum { ROUNDS = 60, CALLS = 50 };
    double least = 1e12;
    for (int i = 0; i < ROUNDS; i++) {
        const double before = now_ns();
        for (int j = 0; j < CALLS; j++) {
            struct kernel_call mine = *c;
            kernel_call_restore(k, c);
            call(&mine);
        }
        const double took = (now_ns() - before) / CALLS;
        least = took < least ? took : least;
    }
    return least;
}

static int32_t timed_length(const struct kernel *k)
{
    int32_t size = 4;
    for (int i = 0; i < KERNEL_PLANES; i++)
        size = k->size[i] > size ? k->size[i] : size;
    return k->timed != 0 ? k->timed : KERNEL_BYTES / size;
}

static void time_kernel(const struct kernel *k)
{
    if (strstr(k->name, wanted_name) == NULL)
        return;
    const int32_t n = timed_length(k);
    struct kernel_call c;
    kernel_call_make(k, &c, n, 0, 0);
    const double nothing = least_ns(k, &c, no_call);
    printf("%-36s %5d", k->name, n);
    for (int form = 0; form < KERNEL_FORMS && k->form[form].name != NULL; form++) {
        const double took = least_ns(k, &c, k->form[form].call) - nothing;
        printf("  %10s %7.3f", k->form[form].name, (took > 0 ? took : 0) / n);
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    wanted_name = argc > 1 ? argv[1] : "";
    suite_kernels();
    printf("%-36s %5s  nanoseconds per pixel\n", "kernel", "n");
    kernels_each(time_kernel);
    printf("%d passed, %d failed\n", test_state.passed, test_state.failed);
    return test_state.failed != 0 || test_state.passed == 0;
}

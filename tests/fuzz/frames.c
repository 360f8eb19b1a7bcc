/* SPDX-License-Identifier: MIT */
/* frames.c - draws cases of the generator by their numbers (cases_draw.c).
 *
 *     frames valid|wild FIRST COUNT           draws cases; says at the end how many frames these were
 *     frames valid|wild FIRST SECONDS s       as many as take so long
 *     frames many FIRST FRAMES f              cases of 256 to 20,000 triangles by 2 to 8 workers, against one worker with room for
 *                                             all, until so many frames have been compared (in other modes: drawn)
 *     frames valid|wild NUMBER                one case, step by step
 *     frames sums FIRST COUNT                 draws valid cases once and prints a checksum of each: compare builds with it
 *     frames threads FIRST COUNT              valid cases, each by 2 to 8 workers: for the thread sanitizer
 *     frames parts FIRST COUNT                valid cases, each at once and in room for 1 to 400 triangles
 *
 * A finding ends the program; the number that it names finds it again. */
#include "tests/fuzz/cases.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static void say_where(int signal_number)
{
    static const char text[] = "finding: ";
    (void)signal_number;
    (void)!write(2, text, sizeof text - 1);
    (void)!write(2, now_at, strlen(now_at));
    (void)!write(2, "\n", 1);
    _exit(1);
}

/* Sanitizers call this before they end the program. */
void __sanitizer_set_death_callback(void (*callback)(void)) __attribute__((weak));

/* Broken promises of a CHECK build trap: the sanitizer shows where. */
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "handle_sigill=1:detect_leaks=1:quarantine_size_mb=32";
}

static void say_at_death(void)
{
    fprintf(stderr, "finding: %s\n", now_at);
}

int main(int argc, char **argv)
{
    static const int ends[] = { SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP };
    static const struct itimerval most = { .it_value = { .tv_sec = 120 } }; /* no case takes so long of the cores */
    static const char letters[] = "vwstmp";                                 /* as in enum mode */
    struct counts counts = { 0, 0, 0, 0, 0, 0 };
    if (argc < 3 || argv[1][0] == 0 || strchr(letters, argv[1][0]) == NULL) {
        fputs("usage: frames valid|wild|sums|threads|many|parts FIRST [COUNT | SECONDS s | FRAMES f]\n", stderr);
        return 2;
    }
    const enum mode mode = (enum mode)(strchr(letters, argv[1][0]) - letters);
    const char unit = argc > 4 ? argv[4][0] : 'n';
    const uint64_t first = strtoull(argv[2], NULL, 10), count = argc > 3 ? strtoull(argv[3], NULL, 10) : 1;
    const time_t end = time(NULL) + (time_t)count;
    talks = argc == 3;
    signal(SIGPROF, say_where);
    if (__sanitizer_set_death_callback != NULL)
        __sanitizer_set_death_callback(say_at_death);
    else
        for (size_t i = 0; i < sizeof ends / sizeof *ends; i++)
            signal(ends[i], say_where);
    const uint64_t *const drawn = mode == MODE_MANY ? &counts.compared : &counts.frames;
    for (uint64_t n = first; unit == 's' ? time(NULL) < end : unit == 'f' ? *drawn < count : n < first + count; n++) {
        setitimer(ITIMER_PROF, &most, NULL);
        const uint32_t sum = run_case(&counts, n, mode);
        if (mode == MODE_SUMS)
            printf("%llu %08x\n", (unsigned long long)n, (unsigned)sum);
    }
    if (mode == MODE_SUMS)
        printf("%llu cases, %llu frames\n", (unsigned long long)counts.cases, (unsigned long long)counts.frames);
    else
        printf("%s from %llu: %llu cases, %llu frames, %llu compared, %llu in parts, %llu descs and %llu frames refused\n",
               argv[1], (unsigned long long)first, (unsigned long long)counts.cases, (unsigned long long)counts.frames,
               (unsigned long long)counts.compared, (unsigned long long)counts.parts, (unsigned long long)counts.refused,
               (unsigned long long)counts.errors);
    return 0;
}

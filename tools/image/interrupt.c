/* SPDX-License-Identifier: MIT */
/* interrupt.c - what a signal ends leaves no unfinished files. */
#include "tools/image/file.h"

#include <signal.h>

static const int ending[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ };
enum { ENDINGS = sizeof ending / sizeof *ending };

static void end(int signal_number)
{
    output_remove_all();
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

void output_catch_signals(void)
{
    for (int i = 0; i < ENDINGS; i++) {
        struct sigaction action = { .sa_handler = end }, before;
        sigemptyset(&action.sa_mask);
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(ending[i], &action, NULL);
    }
}

void output_block_signals(bool blocked)
{
    static sigset_t before;
    sigset_t those;
    sigemptyset(&those);
    for (int i = 0; i < ENDINGS; i++)
        sigaddset(&those, ending[i]);
    sigaddset(&those, SIGALRM);         /* ends the viewer, some time after one of those */
    if (blocked)
        sigprocmask(SIG_BLOCK, &those, &before);
    else
        sigprocmask(SIG_SETMASK, &before, NULL);
}

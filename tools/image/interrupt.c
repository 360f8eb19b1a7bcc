/* SPDX-License-Identifier: MIT */
/* interrupt.c - what a signal ends leaves no unfinished files. */
#include "tools/image/file.h"

#include <signal.h>
#include <unistd.h>

void output_remove_all(void)
{
    for (int i = 0; i < OUTPUTS_MAX; i++)
        if (output_unfinished[i] != NULL)
            unlink(output_unfinished[i]);
}

static void end(int signal_number)
{
    output_remove_all();
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

void output_catch_signals(void)
{
    static const int ending[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ };
    for (size_t i = 0; i < sizeof ending / sizeof *ending; i++) {
        struct sigaction action = { .sa_handler = end }, before;
        sigemptyset(&action.sa_mask);
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(ending[i], &action, NULL);
    }
}

/* SPDX-License-Identifier: MIT */
/* guard.c - see guard.h. */
#include "tools/view/guard.h"

#include "tools/image/file.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

/* Seconds after which a program that has been asked to end, and hangs in a call that no signal ends, or draws on, is ended. */
enum { GRACE = 3 };

static volatile sig_atomic_t asked;             /* the signal; 0: none */
static void (*volatile undo_all)(void);

static void die(int signal_number)
{
    void (*undo)(void) = undo_all;
    if (signal_number == SIGALRM && asked != 0)
        signal_number = asked;
    undo_all = NULL;
    if (undo != NULL)
        undo();
    output_remove_all();
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void ask(int signal_number)
{
    if (asked)
        die(signal_number);
    asked = signal_number;
    alarm(GRACE);
}

static void handle(int signal_number, void (*handler)(int), int flags)
{
    struct sigaction action = { .sa_handler = handler, .sa_flags = flags };
    sigemptyset(&action.sa_mask);
    sigaction(signal_number, &action, NULL);
}

void guard_set(void (*undo)(void))
{
    static const int asking[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT };
    static const int crashes[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };
    undo_all = undo;
    for (size_t i = 0; i < sizeof asking / sizeof *asking; i++)
        handle(asking[i], ask, 0);      /* no SA_RESTART: waiting for events must end */
    handle(SIGALRM, die, 0);
    for (size_t i = 0; i < sizeof crashes / sizeof *crashes; i++)
        handle(crashes[i], die, 0);
    handle(SIGPIPE, SIG_IGN, 0);
}

bool guard_is_asked(void)
{
    return asked != 0;
}

void guard_suspend(void (*redo)(void))
{
    void (*undo)(void) = undo_all;
    if (undo != NULL)
        undo();
    raise(SIGSTOP);
    redo();
}

/* SPDX-License-Identifier: MIT */
/* stalled.c - `smear view` before a terminal that nobody reads, and before X servers that say nothing, or nothing more: the first
 * signal ends it, whatever it waits for, and the terminal is as it was.
 *
 *     stalled SMEAR [RUNS]        prints each run that went wrong and, last, `N passed, N failed`
 *
 * Runs are drawn from a generator: where it stalls, which signal, and how long it is left alone before, so that the signal comes
 * before, in and after each call that waits. */
#define _GNU_SOURCE                     /* posix_openpt */
#include "tests/random.h"
#include "tests/x_server.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

/* A program that has not ended by then never will: it is many times what the slowest machine takes. */
enum { PATIENCE_MS = 60000, STEP_MS = 5 };

static void rest(int ms)
{
    nanosleep(&(struct timespec){ ms / 1000, ms % 1000 * 1000000L }, NULL);
}

/* ------------------------------------------------------------------ what stalls */

enum stall { TERMINAL, SILENT_SERVER, GREETING_SERVER, STALLS };
static const char *const stall_names[STALLS] = { "a terminal that is not read", "a server that says nothing", "a server that only greets" };

/* A server's process: it takes whoever comes, greets or does not, and never reads. */
static pid_t serve(int listening, bool greets)
{
    pid_t pid = fork();
    if (pid != 0)
        return pid;
    uint8_t hello[X_GREETING];
    struct x_greeting greeting = x_greeting_usual();
    x_greeting_write(&greeting, hello);
    for (;;) {
        int client = accept(listening, NULL, NULL);
        if (client >= 0 && greets)
            (void)!send(client, hello, sizeof hello, MSG_NOSIGNAL);
    }
}

/* A socket at a display's number; -1 where none is free. */
static int listen_as(char display[32])
{
    struct sockaddr_un address = { .sun_family = AF_UNIX };
    int file = socket(AF_UNIX, SOCK_STREAM, 0);
    for (int i = 0; i < 100 && file >= 0; i++) {
        int number = 30000 + (int)(((unsigned)getpid() * 7u + (unsigned)i) % 20000u);
        int length = snprintf(address.sun_path + 1, sizeof address.sun_path - 1, "/tmp/.X11-unix/X%d", number);
        if (bind(file, (struct sockaddr *)&address, (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + (size_t)length)) == 0
            && listen(file, 8) == 0) {
            snprintf(display, 32, ":%d", number);
            return file;
        }
    }
    return -1;
}

/* ------------------------------------------------------------------ a run */

struct run {
    enum stall stall;
    int signal, delay_ms, terminal, keyboard;   /* the pseudo-terminal's two ends */
    char display[32];
};

static void become_viewer(const struct run *run, const char *program)
{
    const bool is_terminal = run->stall == TERMINAL;
    setenv("TERM", "xterm", 1);
    setenv("DISPLAY", run->display, 1);
    setenv("XAUTHORITY", "/dev/null", 1);
    setsid();
    ioctl(run->terminal, TIOCSCTTY, 0);
    int nowhere = open("/dev/null", O_RDWR);
    dup2(is_terminal ? run->terminal : nowhere, STDIN_FILENO);
    dup2(is_terminal ? run->terminal : nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execl(program, program, "view", "builtin:suite/pan", "--size", "64x48", "--out", is_terminal ? "term" : "x11", (char *)NULL);
    _exit(127);
}

/* Whether it ends; it is made to where it does not. */
static bool ends(pid_t pid)
{
    for (int waited = 0; waited < PATIENCE_MS; waited += STEP_MS) {
        int status;
        if (waitpid(pid, &status, WNOHANG) == pid)
            return true;
        rest(STEP_MS);
    }
    kill(pid, SIGKILL);
    waitpid(pid, NULL, 0);
    return false;
}

/* Whether the terminal, read at last, goes back to its own screen where it left that. */
static bool is_left(int keyboard)
{
    static char said[1 << 20];
    size_t size = 0;
    ssize_t n;
    fcntl(keyboard, F_SETFL, fcntl(keyboard, F_GETFL) | O_NONBLOCK);
    while (size < sizeof said - 1 && (n = read(keyboard, said + size, sizeof said - 1 - size)) > 0)
        size += (size_t)n;
    said[size] = '\0';
    return strstr(said, "\033[?1049h") == NULL || strstr(said, "\033[?1049l") != NULL;
}

static bool go(struct run *run, const char *program)
{
    struct termios before, after;
    struct winsize size = { .ws_row = 50, .ws_col = 200 };
    int listening = run->stall != TERMINAL ? listen_as(run->display) : -1;
    pid_t server = listening >= 0 ? serve(listening, run->stall == GREETING_SERVER) : 0;
    run->keyboard = posix_openpt(O_RDWR | O_NOCTTY);
    if (run->keyboard < 0 || grantpt(run->keyboard) != 0 || unlockpt(run->keyboard) != 0)
        return false;
    run->terminal = open(ptsname(run->keyboard), O_RDWR | O_NOCTTY);
    ioctl(run->terminal, TIOCSWINSZ, &size);
    tcgetattr(run->terminal, &before);
    pid_t viewer = fork();
    if (viewer == 0)
        become_viewer(run, program);
    rest(run->delay_ms);
    kill(viewer, run->signal);
    bool ok = ends(viewer);
    tcgetattr(run->terminal, &after);
    ok = is_left(run->keyboard) && ok && before.c_lflag == after.c_lflag && before.c_iflag == after.c_iflag
      && before.c_oflag == after.c_oflag;
    close(run->terminal);
    close(run->keyboard);
    if (server > 0) {
        kill(server, SIGKILL);
        waitpid(server, NULL, 0);
    }
    if (listening >= 0)
        close(listening);
    return ok;
}

int main(int argc, char **argv)
{
    static const int signals[] = { SIGTERM, SIGINT, SIGHUP, SIGQUIT };
    int runs = argc > 2 ? atoi(argv[2]) : 24, failed = 0;
    if (argc < 2)
        return 2;
    random_state = 1;
    for (int i = 0; i < runs; i++) {
        struct run run = { .stall = (enum stall)(i % STALLS), .signal = signals[between(0, 3)],
                           .delay_ms = between(0, chance(3) ? 60 : 500) };
        if (go(&run, argv[1]))
            continue;
        failed++;
        printf("FAIL: %s, signal %d after %d ms\n", stall_names[run.stall], run.signal, run.delay_ms);
        fflush(stdout);
    }
    printf("%d passed, %d failed\n", runs - failed, failed);
    return failed > 0 || runs == 0;
}

/* SPDX-License-Identifier: MIT */
/* view_linux_init.c - the first process of a Linux that has a display and nothing else: runs
 * each line of /commands on the console, tells on the serial line how it ended and how it left
 * the console, and waits for the machine to be switched off. Modules in /modules/list are loaded
 * before. */
#include <fcntl.h>
#include <linux/kd.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

enum { MAX_WORDS = 40 };

static int serial = -1;

static void load_modules(void)
{
    char line[128], path[160];
    FILE *list = fopen("/modules/list", "r");
    while (list != NULL && fgets(line, sizeof line, list) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        snprintf(path, sizeof path, "/modules/%s", line);
        int file = open(path, O_RDONLY | O_CLOEXEC);
        if (file < 0 || syscall(SYS_finit_module, file, "", 0) != 0)
            dprintf(serial, "NO MODULE %s\n", line);
    }
    if (list != NULL)
        fclose(list);
}

static void become(char *line)
{
    char *word[MAX_WORDS + 1] = { NULL };
    int count = 0;
    for (char *w = strtok(line, " "); w != NULL && count < MAX_WORDS; w = strtok(NULL, " "))
        word[count++] = w;
    setsid();
    int console = open("/dev/tty1", O_RDWR);
    ioctl(console, TIOCSCTTY, 1);
    dup2(console, 0);
    dup2(serial, 1);
    dup2(serial, 2);
    execv("/smear", word);
    _exit(127);
}

static void tell_console(void)
{
    struct termios t;
    int mode = -1, console = open("/dev/tty1", O_RDWR | O_NOCTTY);
    ioctl(console, KDGETMODE, &mode);
    tcgetattr(console, &t);
    dprintf(serial, "CONSOLE %s %s\n", mode == KD_TEXT ? "text" : "graphics",
            (t.c_lflag & (ICANON | ECHO | ISIG)) == (ICANON | ECHO | ISIG) ? "cooked" : "raw");
    close(console);
}

int main(void)
{
    char line[512];
    mount("devtmpfs", "/dev", "devtmpfs", 0, NULL);
    serial = open("/dev/ttyS0", O_WRONLY | O_NOCTTY);
    setenv("TERM", "linux", 1);
    load_modules();
    FILE *commands = fopen("/commands", "r");
    for (int i = 0; commands != NULL && fgets(line, sizeof line, commands) != NULL; i++) {
        int status = 0;
        line[strcspn(line, "\n")] = '\0';
        dprintf(serial, "RUN %d\n", i);
        pid_t child = fork();
        if (child == 0)
            become(line);
        waitpid(child, &status, 0);
        dprintf(serial, "END %d %d\n", i, WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status));
        tell_console();
    }
    dprintf(serial, "DONE\n");
    for (;;)
        pause();
}

/* SPDX-License-Identifier: MIT */
/* view_linux_init.c - the first process of a Linux that has a display and nothing else: runs
 * each line of /commands on the console, tells on the serial line how it ended and how it left
 * the console, and waits for the machine to be switched off. Modules in /modules/list are loaded
 * before, with the parameters behind their names. Words before a command:
 *
 *     @alone      without a terminal
 *     @kill=N     once it shows pictures it gets signal N */
#include <fcntl.h>
#include <linux/fb.h>
#include <linux/kd.h>
#include <signal.h>
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
        char *parameters = line + strcspn(line, " ");
        if (*parameters != '\0')
            *parameters++ = '\0';
        snprintf(path, sizeof path, "/modules/%s", line);
        int file = open(path, O_RDONLY | O_CLOEXEC);
        if (file < 0 || syscall(SYS_finit_module, file, parameters, 0) != 0)
            dprintf(serial, "NO MODULE %s\n", line);
    }
    if (list != NULL)
        fclose(list);
}

static void become(char *line, int is_alone)
{
    char *word[MAX_WORDS + 1] = { NULL };
    int count = 0;
    for (char *w = strtok(line, " "); w != NULL && count < MAX_WORDS; w = strtok(NULL, " "))
        word[count++] = w;
    setsid();
    int console = open(is_alone ? "/dev/null" : "/dev/tty1", O_RDWR);
    if (!is_alone)
        ioctl(console, TIOCSCTTY, 1);
    dup2(console, 0);
    dup2(serial, 1);
    dup2(serial, 2);
    execv("/smear", word);
    _exit(127);
}

static int console_mode(void)
{
    int mode = -1, console = open("/dev/tty1", O_RDWR | O_NOCTTY);
    ioctl(console, KDGETMODE, &mode);
    close(console);
    return mode;
}

/* Two seconds after it has taken the display. */
static void send_signal(pid_t child, int number)
{
    for (int i = 0; i < 600 && console_mode() != KD_GRAPHICS; i++)
        usleep(100000);
    sleep(2);
    kill(child, number);
}

static void tell_console(void)
{
    struct termios t;
    struct fb_var_screeninfo var;
    int mode = console_mode(), console = open("/dev/tty1", O_RDWR | O_NOCTTY), framebuffer = open("/dev/fb0", O_RDWR);
    if (framebuffer >= 0 && ioctl(framebuffer, FBIOGET_VSCREENINFO, &var) == 0)
        dprintf(serial, "ROW %u of %u\n", var.yoffset, var.yres_virtual);
    if (framebuffer >= 0)
        close(framebuffer);
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
        int status = 0, number = 0, is_alone = 0;
        char *command = line;
        line[strcspn(line, "\n")] = '\0';
        for (; *command == '@'; command += strcspn(command, " ") + 1) {
            is_alone |= strncmp(command, "@alone", 6) == 0;
            if (strncmp(command, "@kill=", 6) == 0)
                number = atoi(command + 6);
        }
        dprintf(serial, "RUN %d\n", i);
        pid_t child = fork();
        if (child == 0)
            become(command, is_alone);
        if (number != 0)
            send_signal(child, number);
        waitpid(child, &status, 0);
        dprintf(serial, "END %d %d\n", i, WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status));
        tell_console();
    }
    dprintf(serial, "DONE\n");
    for (;;)
        pause();
}

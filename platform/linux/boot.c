/* SPDX-License-Identifier: MIT */
/* boot.c - what a program does first when it is Linux's only process: gets device files, loads the
 * modules named in /modules/list, and takes the console. As any other process it does nothing. */
#define _DEFAULT_SOURCE         /* syscall, usleep */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/reboot.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { CARD_TRIES = 500 };      /* of 10 ms */

static void load_modules(void)
{
    char name[64], path[80];
    FILE *list = fopen("/modules/list", "r");
    if (list == NULL)
        return;
    while (fscanf(list, "%63s", name) == 1) {
        snprintf(path, sizeof path, "/modules/%s", name);
        int file = open(path, O_RDONLY | O_CLOEXEC);
        if (file < 0 || syscall(SYS_finit_module, file, "", 0) != 0)
            perror(path);
        if (file >= 0)
            close(file);
    }
    fclose(list);
    for (int i = 0; i < CARD_TRIES && access("/dev/dri/card0", R_OK) != 0; i++)
        usleep(10000);
}

/* Keys come from the first virtual terminal; text stays on the kernel's console. */
static void take_terminal(void)
{
    int terminal = open("/dev/tty1", O_RDWR);
    if (terminal < 0)
        return;
    setsid();
    ioctl(terminal, TIOCSCTTY, 1);
    dup2(terminal, STDIN_FILENO);
    close(terminal);
}

/* The kernel panics when its first process ends. */
static void power_off(void)
{
    fflush(stdout);
    sync();
    reboot(RB_POWER_OFF);
}

__attribute__((constructor)) static void boot(void)
{
    if (getpid() != 1)
        return;
    mkdir("/dev", 0755);
    mount("devtmpfs", "/dev", "devtmpfs", 0, NULL);
    setvbuf(stdout, NULL, _IOLBF, 0);
    load_modules();
    take_terminal();
    atexit(power_off);
}

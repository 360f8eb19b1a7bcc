/* SPDX-License-Identifier: MIT */
/* x_server.c - see x_server.h. Linux: sockets whose names are no files. */
#define _DEFAULT_SOURCE                 /* setenv */
#include "tests/x_server.h"

#include <poll.h>
#include <pthread.h>
#include "tests/host.h"
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

enum { FIRST_DISPLAY = 20000, DISPLAYS = 30000 };

static struct {
    int listening, stop[2];
    const uint8_t *bytes;
    size_t size;
    pthread_t thread;
} server = { .listening = -1 };

struct x_greeting x_greeting_usual(void)
{
    return (struct x_greeting){ .max_request = 65535, .min_key = 8, .max_key = 255, .depth = 24, .bits = 32, .pad = 32,
                                .mask = { 0xff0000, 0xff00, 0xff } };
}

static void put16(uint8_t *at, unsigned value)
{
    const uint16_t word = (uint16_t)value;
    memcpy(at, &word, 2);
}

static void put32(uint8_t *at, uint32_t value)
{
    memcpy(at, &value, 4);
}

void x_greeting_write(const struct x_greeting *g, uint8_t out[X_GREETING])
{
    const uint16_t probe = 1;
    uint8_t *setup = out + 8, *format = setup + 40, *screen = format + 8, *visual = screen + 48, is_little;
    memcpy(&is_little, &probe, 1);
    memset(out, 0, X_GREETING);
    out[0] = 1;
    put16(out + 2, 11);
    put16(out + 6, (X_GREETING - 8) / 4);
    put32(setup + 4, 0x200000);         /* names of its clients' things */
    put32(setup + 8, 0x1fffff);
    put16(setup + 16, 5);               /* its vendor: smear */
    put16(setup + 18, g->max_request);
    setup[20] = setup[21] = 1;          /* a screen, a format */
    setup[22] = !is_little;
    setup[26] = g->min_key;
    setup[27] = g->max_key;
    memcpy(setup + 32, "smear", 5);
    format[0] = g->depth;
    format[1] = g->bits;
    format[2] = g->pad;
    put32(screen, 1);
    put32(screen + 32, 2);              /* its visual */
    screen[38] = g->depth;
    screen[39] = 1;
    screen[40] = g->depth;
    put16(screen + 42, 1);
    put32(visual, 2);
    visual[4] = 4;                      /* true colour */
    for (int i = 0; i < 3; i++)
        put32(visual + 8 + 4 * i, g->mask[i]);
}

static void serve_one(int client)
{
    uint8_t heard[4096];
    for (size_t sent = 0; sent < server.size;) {
        ssize_t n = send(client, server.bytes + sent, server.size - sent, MSG_NOSIGNAL);
        if (n <= 0)
            break;
        sent += (size_t)n;
    }
    shutdown(client, SHUT_WR);
    struct pollfd ready[2] = { { .fd = client, .events = POLLIN }, { .fd = server.stop[0], .events = POLLIN } };
    while (poll(ready, 2, -1) > 0 && ready[1].revents == 0 && recv(client, heard, sizeof heard, 0) > 0)
        continue;
    close(client);
}

static void *serve(void *unused)
{
    struct pollfd ready[2] = { { .fd = server.listening, .events = POLLIN }, { .fd = server.stop[0], .events = POLLIN } };
    (void)unused;
    while (poll(ready, 2, -1) > 0 && ready[1].revents == 0) {
        int client = accept(server.listening, NULL, NULL);
        if (client >= 0)
            serve_one(client);
    }
    return NULL;
}

static bool listen_somewhere(void)
{
    struct sockaddr_un address = { .sun_family = AF_UNIX };
    server.listening = socket(AF_UNIX, SOCK_STREAM, 0);
    for (int i = 0; server.listening >= 0 && i < 100; i++) {
        int number = FIRST_DISPLAY + (int)((unsigned)getpid() * 7u + (unsigned)i) % DISPLAYS;
        int length = snprintf(address.sun_path + 1, sizeof address.sun_path - 1, "/tmp/.X11-unix/X%d", number);
        socklen_t size = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + (size_t)length);
        if (bind(server.listening, (struct sockaddr *)&address, size) == 0 && listen(server.listening, 8) == 0) {
            char name[16];
            snprintf(name, sizeof name, ":%d", number);
            setenv("DISPLAY", name, 1);
            setenv("XAUTHORITY", "/dev/null", 1);
            return true;
        }
    }
    return false;
}

bool x_server_begin(const uint8_t *bytes, size_t size)
{
    server.bytes = bytes;
    server.size = size;
    if (server.listening < 0 && !listen_somewhere())
        return false;
    return pipe(server.stop) == 0 && pthread_create(&server.thread, NULL, serve, NULL) == 0;
}

void x_server_end(void)
{
    close(server.stop[1]);
    pthread_join(server.thread, NULL);
    close(server.stop[0]);
}

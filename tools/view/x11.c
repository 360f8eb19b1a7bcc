/* SPDX-License-Identifier: MIT */
/* x11.c - see x11.h. "X Window System Protocol", version 11; numbers are its own. */
#include "tools/view/x11.h"

#include "tools/view/guard.h"

#include <errno.h>
#include <netdb.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <unistd.h>

enum { ERROR = 0, REPLY = 1, GENERIC_EVENT = 35 };
enum { INTERN_ATOM = 16, GET_INPUT_FOCUS = 43 };
enum { TRUE_COLOR = 4, DIRECT_COLOR = 5, MAX_REPLY = 64 << 20, TCP_PORT = 6000, LONG_MS = 500 };
enum { MAX_TRIES = 3, TRY_AGAIN_MS = 100 };

/* ------------------------------------------------------------------ bytes */

static bool is_interrupted(void)
{
    return errno == EINTR && !guard_is_asked();
}

static void send_all(struct x11 *x, struct iovec *part, int count)
{
    while (count > 0 && !x->is_lost) {
        struct msghdr message = { .msg_iov = part, .msg_iovlen = (size_t)count };
        ssize_t n = sendmsg(x->file, &message, MSG_NOSIGNAL);
        if (n < 0) {
            if (!is_interrupted())
                x->is_lost = true;
            continue;
        }
        size_t sent = (size_t)n;
        for (; count > 0 && sent >= part->iov_len; part++, count--)
            sent -= part->iov_len;
        if (count > 0) {
            part->iov_base = (char *)part->iov_base + sent;
            part->iov_len -= sent;
        }
    }
}

static bool receive(struct x11 *x, void *to, size_t size)
{
    char *at = to;
    while (size > 0 && !x->is_lost) {
        ssize_t n = recv(x->file, at, size, 0);
        if (n > 0) {
            at += n;
            size -= (size_t)n;
        } else if (n == 0 || !is_interrupted()) {
            x->is_lost = true;
        }
    }
    return !x->is_lost;
}

/* Whether the server has sent something within wait_ms. */
static bool is_readable(struct x11 *x, int wait_ms)
{
    struct pollfd ready = { .fd = x->file, .events = POLLIN };
    return !x->is_lost && poll(&ready, 1, wait_ms) > 0;
}

/* ------------------------------------------------------------------ requests, replies, events */

void x11_send(struct x11 *x, const void *head, size_t head_size, const void *body,
              size_t body_size)
{
    struct iovec part[2] = { { (void *)head, head_size }, { (void *)body, body_size } };
    x->sequence++;
    send_all(x, part, body_size > 0 ? 2 : 1);
}

static void keep(struct x11 *x, const uint8_t packet[X11_PACKET])
{
    if (x->kept_count == X11_KEPT_EVENTS)
        return;                     /* a flood: what is left over is no loss for a viewer */
    int at = (x->kept_first + x->kept_count++) % X11_KEPT_EVENTS;
    memcpy(x->kept[at], packet, X11_PACKET);
}

/* One packet from the server. Errors go to x->error; what follows a reply or a generic event goes
 * into *body. */
static bool read_packet(struct x11 *x, uint8_t packet[X11_PACKET], uint8_t **body, size_t *size)
{
    *body = NULL;
    *size = 0;
    if (!receive(x, packet, X11_PACKET))
        return false;
    if (packet[0] == ERROR) {
        memcpy(x->error, packet, X11_PACKET);
        x->error[0] = 1;
    }
    if (packet[0] != REPLY && (packet[0] & 127) != GENERIC_EVENT)
        return true;
    *size = (size_t)x11_get32(packet + 4) * 4;
    if (*size == 0)
        return true;
    if (*size > MAX_REPLY || (*body = malloc(*size)) == NULL) {
        x->is_lost = true;
        return false;
    }
    if (receive(x, *body, *size))
        return true;
    free(*body);
    *body = NULL;
    return false;
}

bool x11_reply(struct x11 *x, uint8_t reply[X11_PACKET], uint8_t **body, size_t *body_size)
{
    uint8_t *rest;
    size_t size;
    while (read_packet(x, reply, &rest, &size)) {
        if (reply[0] == REPLY && x11_get16(reply + 2) == x->sequence) {
            if (body != NULL) {
                *body = rest;
                *body_size = size;
            } else {
                free(rest);
            }
            return true;
        }
        free(rest);
        if (reply[0] == ERROR && x11_get16(reply + 2) == x->sequence)
            return false;
        if (reply[0] != ERROR && reply[0] != REPLY)
            keep(x, reply);
    }
    return false;
}

bool x11_check(struct x11 *x)
{
    const uint16_t checked = x->sequence;
    struct {
        uint8_t code, unused;
        uint16_t length;
    } request = { GET_INPUT_FOCUS, 0, 1 };
    uint8_t reply[X11_PACKET];
    x->error[0] = 0;
    x11_send(x, &request, sizeof request, NULL, 0);
    return x11_reply(x, reply, NULL, NULL) &&
           !(x->error[0] != 0 && x11_get16(x->error + 2) == checked);
}

bool x11_event(struct x11 *x, int wait_ms, uint8_t event[X11_PACKET])
{
    uint8_t *rest;
    size_t size;
    if (x->kept_count > 0) {
        memcpy(event, x->kept[x->kept_first], X11_PACKET);
        x->kept_first = (x->kept_first + 1) % X11_KEPT_EVENTS;
        x->kept_count--;
        return true;
    }
    while (is_readable(x, wait_ms)) {
        if (!read_packet(x, event, &rest, &size))
            return false;
        free(rest);
        if (event[0] != ERROR && event[0] != REPLY)
            return true;
        wait_ms = 0;
    }
    return false;
}

bool x11_wait(struct x11 *x, uint8_t kind)
{
    uint8_t packet[X11_PACKET], *rest;
    size_t size;
    while (!x->is_lost && !guard_is_asked()) {
        if (!is_readable(x, LONG_MS))
            continue;
        if (!read_packet(x, packet, &rest, &size))
            return false;
        free(rest);
        if (packet[0] == ERROR && x11_get16(packet + 2) == x->sequence)
            return false;
        if ((packet[0] & 127) == kind)
            return true;
        if (packet[0] != ERROR && packet[0] != REPLY)
            keep(x, packet);
    }
    return false;
}

uint32_t x11_atom(struct x11 *x, const char *name)
{
    size_t length = strlen(name);
    struct {
        uint8_t code, only_if_exists;
        uint16_t length, name_length, unused;
        char name[64];
    } request = { INTERN_ATOM, 0, (uint16_t)(2 + (length + 3) / 4), (uint16_t)length, 0, "" };
    uint8_t reply[X11_PACKET];
    if (length > sizeof request.name)
        return 0;
    memcpy(request.name, name, length);
    x11_send(x, &request, (size_t)request.length * 4, NULL, 0);
    return x11_reply(x, reply, NULL, NULL) ? x11_get32(reply + 8) : 0;
}

uint32_t x11_new_id(struct x11 *x)
{
    uint32_t step = x->id_mask & (~x->id_mask + 1);     /* its lowest bit */
    return x->id_base | (x->id_next++ * step & x->id_mask);
}

/* ------------------------------------------------------------------ connecting */

/* [host]:number[.screen] */
struct display {
    char host[256];
    int number, screen;
};

static bool read_display(const char *name, struct display *d)
{
    const char *colon = strrchr(name, ':');
    char *end;
    *d = (struct display){ .number = 0 };
    if (colon == NULL || (size_t)(colon - name) >= sizeof d->host)
        return false;
    memcpy(d->host, name, (size_t)(colon - name));
    long number = strtol(colon + 1, &end, 10);
    if (end == colon + 1 || number < 0 || number > 59000)
        return false;
    d->number = (int)number;
    d->screen = *end == '.' ? atoi(end + 1) : 0;
    return *end == '\0' || *end == '.';
}

static bool connect_local(struct x11 *x, const struct display *d)
{
    struct sockaddr_un address = { .sun_family = AF_UNIX };
    char *path = address.sun_path;
    /* Linux: the name without a file first, which needs no folder to be there */
    for (int is_file = 0; is_file < 2; is_file++) {
        int length = snprintf(path + !is_file, sizeof address.sun_path - 1, "/tmp/.X11-unix/X%d",
                              d->number);
        size_t size = offsetof(struct sockaddr_un, sun_path) + (size_t)length + 1;
        if (!is_file)
            path[0] = '\0';
        x->file = socket(AF_UNIX, SOCK_STREAM, 0);
        if (x->file >= 0 && connect(x->file, (struct sockaddr *)&address, (socklen_t)size) == 0)
            return true;
        if (x->file >= 0)
            close(x->file);
        x->file = -1;
    }
    return false;
}

static bool connect_far(struct x11 *x, const struct display *d)
{
    struct addrinfo hints = { .ai_socktype = SOCK_STREAM }, *list = NULL;
    char port[16];
    snprintf(port, sizeof port, "%d", TCP_PORT + d->number);
    if (getaddrinfo(d->host, port, &hints, &list) != 0)
        return false;
    for (struct addrinfo *a = list; a != NULL && x->file < 0; a = a->ai_next) {
        x->file = socket(a->ai_family, a->ai_socktype, a->ai_protocol);
        if (x->file >= 0 && connect(x->file, a->ai_addr, a->ai_addrlen) != 0) {
            close(x->file);
            x->file = -1;
        }
    }
    freeaddrinfo(list);
    return x->file >= 0;
}

static void greet(struct x11 *x, const struct display *d)
{
    static const char method[] = "MIT-MAGIC-COOKIE-1";
    const uint16_t probe = 1;
    uint8_t is_little;
    struct {
        uint8_t order, unused0;
        uint16_t major, minor, name_length, data_length, unused1;
        char name[20];
        uint8_t data[X11_COOKIE];
    } hello = { .major = 11 };
    size_t size = offsetof(__typeof__(hello), name);
    memcpy(&is_little, &probe, 1);
    hello.order = is_little ? 'l' : 'B';
    if (x11_find_cookie(d->number, hello.data)) {
        hello.name_length = sizeof method - 1;
        hello.data_length = X11_COOKIE;
        memcpy(hello.name, method, sizeof method - 1);
        size = sizeof hello;
    }
    struct iovec part = { &hello, size };
    send_all(x, &part, 1);
}

/* The masks of the root's visual. */
static bool find_visual(struct x11 *x, const uint8_t *screen, const uint8_t *end,
                        const uint8_t *formats, int format_count, bool big_endian)
{
    const uint8_t *at = screen + 40;
    int bits = 0;
    for (int i = 0; i < format_count; i++) {
        if (formats[8 * i] == x->depth) {
            bits = formats[8 * i + 1];
            x->scanline_pad = formats[8 * i + 2];
        }
    }
    for (int depth = 0; depth < screen[39] && end - at >= 8; depth++) {
        int visuals = x11_get16(at + 2);
        at += 8;
        for (int i = 0; i < visuals && end - at >= 24; i++, at += 24) {
            const uint32_t mask[3] = { x11_get32(at + 8), x11_get32(at + 12), x11_get32(at + 16) };
            if (x11_get32(at) == x->visual)
                return (at[4] == TRUE_COLOR || at[4] == DIRECT_COLOR) &&
                       layout_from_masks(&x->layout, bits, mask, big_endian);
        }
    }
    return false;
}

static size_t screen_size(const uint8_t *screen, const uint8_t *end)
{
    const uint8_t *at = screen + 40;
    for (int depth = 0; depth < screen[39] && end - at >= 8; depth++) {
        size_t visuals = 8 + 24 * (size_t)x11_get16(at + 2), left = (size_t)(end - at);
        at += visuals < left ? visuals : left;
    }
    return (size_t)(at - screen);
}

/* What a server must offer; one that is none may promise anything. */
static bool check_setup(const struct x11 *x, struct failure *f)
{
    if (x->scanline_pad != 8 && x->scanline_pad != 16 && x->scanline_pad != 32)
        return fail(f, "the server's rows end at multiples of %d bits", x->scanline_pad);
    return x->max_request >= X11_LEAST_REQUEST ||
           fail(f, "the server takes requests of %zu bytes only", x->max_request);
}

static bool read_setup(struct x11 *x, const uint8_t *setup, size_t size, int screen_number,
                       struct failure *f)
{
    const uint8_t *end = setup + size;
    if (size < 32)
        return fail(f, "the server's greeting is too short");
    x->id_base = x11_get32(setup + 4);
    x->id_mask = x11_get32(setup + 8);
    x->max_request = (size_t)x11_get16(setup + 18) * 4;
    x->min_key = setup[26];
    x->max_key = setup[27];
    size_t vendor = (x11_get16(setup + 16) + 3u) & ~3u, lists = vendor + 8 * (size_t)setup[21];
    if (size - 32 < lists)
        return fail(f, "the server's greeting is too short");
    const uint8_t *formats = setup + 32 + vendor, *screen = setup + 32 + lists;
    for (int i = 0; i < screen_number && end - screen >= 40; i++)
        screen += screen_size(screen, end);
    if (screen_number < 0 || screen_number >= setup[20] || end - screen < 40)
        return fail(f, "the server has no screen %d", screen_number);
    x->root = x11_get32(screen);
    x->visual = x11_get32(screen + 32);
    x->depth = screen[38];
    if (!find_visual(x, screen, end, formats, setup[21], setup[22] != 0))
        return fail(f, "the screen has no 16, 24 or 32 bits of true colour");
    return check_setup(x, f);
}

static bool hear_greeting(struct x11 *x, const struct display *d, struct failure *f)
{
    uint8_t head[8], *setup;
    if (!receive(x, head, sizeof head))
        return fail(f, "the server does not answer");
    size_t size = (size_t)x11_get16(head + 6) * 4;
    setup = malloc(size + 1);
    if (setup == NULL || !receive(x, setup, size)) {
        free(setup);
        return fail(f, "the server does not answer");
    }
    bool ok;
    if (head[0] == 1) {
        ok = read_setup(x, setup, size, d->screen, f);
    } else {
        setup[head[1] < size ? head[1] : size] = '\0';
        setup[strcspn((char *)setup, "\n")] = '\0';
        ok = fail(f, "the server refuses: %s", (char *)setup);
    }
    free(setup);
    return ok;
}

static bool open_display(struct x11 *x, const struct display *d, const char *name,
                         struct failure *f)
{
    *x = (struct x11){ .file = -1 };
    x->is_local = d->host[0] == '\0' || strcmp(d->host, "unix") == 0;
    if (x->is_local ? !connect_local(x, d) : !connect_far(x, d))
        return fail(f, "no server at DISPLAY=%s", name);
    greet(x, d);
    return hear_greeting(x, d, f);
}

bool x11_connect(struct x11 *x, struct failure *f)
{
    const char *name = getenv("DISPLAY");
    struct display display;
    *x = (struct x11){ .file = -1 };
    if (name == NULL || name[0] == '\0')
        return fail(f, "DISPLAY is not set");
    if (!read_display(name, &display))
        return fail(f, "DISPLAY=%s is no display", name);
    /* a server that starts anew because its last client has gone hangs up on the next one */
    for (int again = 0;; again++) {
        struct failure why = { "" };
        if (open_display(x, &display, name, &why))
            return true;
        if (guard_is_asked())
            return fail(f, "interrupted at DISPLAY=%s", name);
        if (!x->is_lost || x->file < 0 || again == MAX_TRIES)
            return fail(f, "%s", why.text);
        close(x->file);
        poll(NULL, 0, TRY_AGAIN_MS);
    }
}

void x11_disconnect(struct x11 *x)
{
    if (x->file >= 0)
        close(x->file);
    x->file = -1;
    x->is_lost = true;
}

/* ------------------------------------------------------------------ the cookie */

/* A record is a family and four counted strings, all 16-bit numbers with the high byte first: address, display number, method, data. */

enum { FAMILY_LOCAL = 256, FAMILY_WILD = 65535, MAX_FIELD = 1024 };
enum { ADDRESS, NUMBER, METHOD, DATA, FIELDS };

struct field {
    unsigned size;
    uint8_t bytes[MAX_FIELD + 1];
};

static bool read16(FILE *stream, unsigned *value)
{
    int high = fgetc(stream), low = fgetc(stream);
    *value = (unsigned)high << 8 | (unsigned)low;
    return high != EOF && low != EOF;
}

static bool read_field(FILE *stream, struct field *field)
{
    if (!read16(stream, &field->size) || field->size > MAX_FIELD ||
        fread(field->bytes, 1, field->size, stream) != field->size)
        return false;
    field->bytes[field->size] = '\0';
    return true;
}

static bool is_text(const struct field *field, const char *text)
{
    return field->size == strlen(text) && memcmp(field->bytes, text, field->size) == 0;
}

static int worth(unsigned family, const struct field field[FIELDS], const char *number,
                 const char *host)
{
    if (!is_text(&field[METHOD], "MIT-MAGIC-COOKIE-1") || field[DATA].size != X11_COOKIE ||
        (field[NUMBER].size > 0 && !is_text(&field[NUMBER], number)))
        return 0;
    if (family == FAMILY_LOCAL && is_text(&field[ADDRESS], host))
        return 3;
    return family == FAMILY_WILD ? 2 : 1;
}

static FILE *open_file(void)
{
    const char *path = getenv("XAUTHORITY"), *home = getenv("HOME");
    char own[4096];
    if (path == NULL || path[0] == '\0') {
        snprintf(own, sizeof own, "%s/.Xauthority", home != NULL ? home : "");
        path = own;
    }
    return fopen(path, "rb");
}

bool x11_find_cookie(int number, uint8_t cookie[X11_COOKIE])
{
    static struct field field[FIELDS];
    char text[16], host[256] = "";
    unsigned family;
    int best = 0;
    FILE *stream = open_file();
    if (stream == NULL)
        return false;
    snprintf(text, sizeof text, "%d", number);
    gethostname(host, sizeof host - 1);
    while (read16(stream, &family)) {
        int fields = 0;
        while (fields < FIELDS && read_field(stream, &field[fields]))
            fields++;
        if (fields < FIELDS)
            break;
        int value = worth(family, field, text, host);
        if (value > best) {
            best = value;
            memcpy(cookie, field[DATA].bytes, X11_COOKIE);
        }
    }
    fclose(stream);
    return best > 0;
}

/* SPDX-License-Identifier: MIT */
/* tty.c - see tty.h. */
#include "tools/view/tty.h"

#include "tools/view/guard.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

enum { BYTES = 256, ESCAPE_MS = 30, CTRL_C = 3, CTRL_Z = 26, CTRL_BACKSLASH = 28 };

static struct {
    int file;                   /* -1: closed */
    bool is_own;                /* opened here */
    volatile bool is_raw;
    struct termios saved, raw;
    unsigned char byte[BYTES];
    int count;
    int button, x, y;           /* of the pointer; button 0: none is held */
} tty = { .file = -1 };

bool tty_open(struct failure *f)
{
    tty.file = STDIN_FILENO;
    tty.is_own = false;
    if (!isatty(tty.file)) {
        tty.file = open("/dev/tty", O_RDWR | O_CLOEXEC | O_NOCTTY);
        tty.is_own = tty.file >= 0;
    }
    if (tty.file < 0 || tcgetattr(tty.file, &tty.saved) != 0) {
        tty_close();
        return fail(f, "no terminal to read keys from");
    }
    tty.raw = tty.saved;
    tty.raw.c_iflag &= ~(tcflag_t)(BRKINT | ICRNL | INPCK | ISTRIP | IXON | INLCR | IGNCR);
    tty.raw.c_oflag &= ~(tcflag_t)OPOST;
    tty.raw.c_lflag &= ~(tcflag_t)(ECHO | ECHONL | ICANON | IEXTEN | ISIG);
    tty.raw.c_cc[VMIN] = 0;
    tty.raw.c_cc[VTIME] = 0;
    tty.count = tty.button = 0;
    tty_again();
    return true;
}

void tty_again(void)
{
    if (tty.file >= 0 && tcsetattr(tty.file, TCSANOW, &tty.raw) == 0)
        tty.is_raw = true;
}

void tty_restore(void)
{
    int error = errno;
    if (tty.is_raw)
        tcsetattr(tty.file, TCSANOW, &tty.saved);
    tty.is_raw = false;
    errno = error;
}

void tty_close(void)
{
    tty_restore();
    if (tty.is_own)
        close(tty.file);
    tty.file = -1;
    tty.is_own = false;
}

int tty_file(void)
{
    return tty.file;
}

bool tty_write(int file, const char *bytes, size_t size)
{
    while (size > 0 && !guard_is_asked()) {
        ssize_t n = write(file, bytes, size);
        if (n < 0 && errno == EAGAIN) {
            struct pollfd ready = { .fd = file, .events = POLLOUT };
            poll(&ready, 1, 1000);
        } else if (n < 0 && errno != EINTR) {
            return guard_is_asked();
        }
        bytes += n > 0 ? n : 0;
        size -= n > 0 ? (size_t)n : 0;
    }
    return true;
}

void tty_write_at_once(int file, const char *bytes, size_t size)
{
    int error = errno, flags = fcntl(file, F_GETFL);
    if (flags == -1)
        return;
    fcntl(file, F_SETFL, flags | O_NONBLOCK);
    if (write(file, bytes, size) != (ssize_t)size) {
        tcflush(file, TCOFLUSH);
        (void)!write(file, bytes, size);
    }
    fcntl(file, F_SETFL, flags);
    errno = error;
}

/* ------------------------------------------------------------------ decoding */

static bool is_final(unsigned char c)
{
    return c >= 0x40 && c <= 0x7e;
}

static int key_of_letter(unsigned char letter)
{
    switch (letter) {
    case 'A': return SCREEN_UP;
    case 'B': return SCREEN_DOWN;
    case 'C': return SCREEN_RIGHT;
    case 'D': return SCREEN_LEFT;
    case 'H': return SCREEN_HOME;
    case 'F': return SCREEN_END;
    default: return 0;
    }
}

static int key_of_number(int number)
{
    switch (number) {
    case 1: case 7: return SCREEN_HOME;
    case 4: case 8: return SCREEN_END;
    case 5: return SCREEN_PAGE_UP;
    case 6: return SCREEN_PAGE_DOWN;
    default: return 0;
    }
}

static void make_key(struct event *out, int key)
{
    if (key != 0)
        *out = (struct event){ .kind = EVENT_KEY, .key = key };
}

/* CSI < buttons ; column ; row M or m. A cell is one pixel wide and two high. */
static void decode_pointer(const char *text, bool is_release, struct event *out)
{
    int buttons, column, row;
    if (sscanf(text, "%d;%d;%d", &buttons, &column, &row) != 3)
        return;
    int x = column, y = row * 2;
    if (buttons & 64) {
        *out = (struct event){ .kind = EVENT_WHEEL, .y = buttons & 1 ? -1 : 1 };
    } else if (is_release) {
        tty.button = 0;
    } else if (buttons & 32 && tty.button != 0) {
        *out = (struct event){ .kind = EVENT_DRAG, .button = tty.button, .x = x - tty.x,
                               .y = y - tty.y };
    } else {
        tty.button = (buttons & 3) + 1;
    }
    tty.x = x;
    tty.y = y;
}

/* ESC [ ... final */
static int decode_sequence(const unsigned char *bytes, int count, struct event *out)
{
    char text[32];
    int end = 2;
    while (end < count && !is_final(bytes[end]))
        end++;
    if (end == count)
        return count < (int)sizeof text ? 0 : count;    /* nonsense of that length is dropped */
    int length = end - 2 < (int)sizeof text - 1 ? end - 2 : (int)sizeof text - 1;
    memcpy(text, bytes + 2, (size_t)length);
    text[length] = '\0';
    if (text[0] == '<' && (bytes[end] == 'M' || bytes[end] == 'm'))
        decode_pointer(text + 1, bytes[end] == 'm', out);
    else if (bytes[end] == '~')
        make_key(out, key_of_number(atoi(text)));
    else
        make_key(out, key_of_letter(bytes[end]));
    return end + 1;
}

int tty_decode(const unsigned char *bytes, int count, bool is_last, struct event *out)
{
    *out = (struct event){ .kind = EVENT_EXPOSE };
    if (count == 0)
        return 0;
    unsigned char c = bytes[0];
    if (c == SCREEN_ESCAPE && count == 1) {
        make_key(out, SCREEN_ESCAPE);
        return is_last ? 1 : 0;
    }
    if (c == SCREEN_ESCAPE && bytes[1] == '[') {
        int taken = decode_sequence(bytes, count, out);
        return taken == 0 && is_last ? count : taken;
    }
    if (c == SCREEN_ESCAPE && bytes[1] == 'O') {
        if (count < 3)
            return is_last ? count : 0;
        make_key(out, key_of_letter(bytes[2]));
        return 3;
    }
    if (c == CTRL_C || c == CTRL_BACKSLASH)
        out->kind = EVENT_CLOSE;
    else if (c == '\n')
        make_key(out, SCREEN_ENTER);
    else if (c < 127)
        make_key(out, c);
    return 1;
}

/* ------------------------------------------------------------------ events */

/* Whether bytes have come; -1 when the terminal is gone. */
static int more(int wait_ms)
{
    struct pollfd ready = { .fd = tty.file, .events = POLLIN };
    int n = poll(&ready, 1, wait_ms);
    if (n <= 0)
        return 0;
    ssize_t got = read(tty.file, tty.byte + tty.count, (size_t)(BYTES - tty.count));
    if (got < 0 && (errno == EINTR || errno == EAGAIN))
        return 0;
    if (got < 0 || (got == 0 && ready.revents & (POLLHUP | POLLERR)))
        return -1;
    tty.count += (int)got;
    return got > 0;
}

bool tty_event(int wait_ms, void (*suspend)(void), struct event *out)
{
    for (;;) {
        int taken = tty_decode(tty.byte, tty.count, false, out);
        if (taken == 0) {
            int came = more(tty.count > 0 ? ESCAPE_MS : wait_ms);
            if (came < 0) {
                out->kind = EVENT_LOST;
                return true;
            }
            if (came == 0 && tty.count == 0)
                return false;
            taken = tty_decode(tty.byte, tty.count, came == 0, out);
            if (taken == 0)
                continue;
        }
        bool is_stop = tty.byte[0] == CTRL_Z;
        tty.count -= taken;
        memmove(tty.byte, tty.byte + taken, (size_t)tty.count);
        if (is_stop && suspend != NULL) {
            suspend();
            return true;                /* what was shown is gone */
        }
        if (!is_stop && out->kind != EVENT_EXPOSE)
            return true;
    }
}

/* SPDX-License-Identifier: MIT */
/* x11.h - a connection to an X server by the wire protocol, on libc alone.
 *
 * Requests are plain bytes in this machine's order, as the connection's set-up says. Replies are
 * waited for; events that come meanwhile are kept in order. */
#ifndef SMEAR_TOOLS_VIEW_X11_H
#define SMEAR_TOOLS_VIEW_X11_H

#include "tools/failure.h"
#include "tools/view/surface.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { X11_PACKET = 32, X11_KEPT_EVENTS = 256, X11_LEAST_REQUEST = 4096 * 4 };

struct x11 {
    int file;
    bool is_lost, is_local;
    uint16_t sequence;              /* of the request sent last */
    uint32_t id_base, id_mask, id_next;
    uint32_t root, visual;
    int depth, scanline_pad;        /* bits */
    struct layout layout;
    int min_key, max_key;
    size_t max_request;             /* bytes */
    uint8_t kept[X11_KEPT_EVENTS][X11_PACKET];      /* events in a ring */
    int kept_first, kept_count;
    uint8_t error[X11_PACKET];      /* the last one; error[0] is 1 when there is one, else 0 */
};

/* By $DISPLAY and the cookie that belongs to it. x11_disconnect in any case. */
bool x11_connect(struct x11 *x, struct failure *f);
void x11_disconnect(struct x11 *x);

uint32_t x11_new_id(struct x11 *x);

/* Sends one request in two parts (the second may be empty), whose sum is a multiple of 4. */
void x11_send(struct x11 *x, const void *head, size_t head_size, const void *body,
              size_t body_size);

/* The reply to the request sent last; *body (malloc'ed, for the caller to free) is what follows
 * its 32 bytes, and `body` may be null. False when it was refused or the server is lost. */
bool x11_reply(struct x11 *x, uint8_t reply[X11_PACKET], uint8_t **body, size_t *body_size);

/* Waits until the server has taken all requests; false when the one sent last before was
 * refused. */
bool x11_check(struct x11 *x);

/* The next event within wait_ms (-1: for ever); false when none has come, or the server is lost. */
bool x11_event(struct x11 *x, int wait_ms, uint8_t event[X11_PACKET]);

/* Waits for an event of this kind, keeping all others; false when the request sent last was
 * refused, the server is lost, or the program is asked to end. */
bool x11_wait(struct x11 *x, uint8_t kind);

uint32_t x11_atom(struct x11 *x, const char *name);

static inline uint16_t x11_get16(const uint8_t *p)
{
    uint16_t value;
    __builtin_memcpy(&value, p, 2);
    return value;
}

static inline uint32_t x11_get32(const uint8_t *p)
{
    uint32_t value;
    __builtin_memcpy(&value, p, 4);
    return value;
}

/* ------------------------------------------------------------------ the cookie */

/* The cookie that opens a display, from $XAUTHORITY or ~/.Xauthority. */

enum { X11_COOKIE = 16 };

/* MIT-MAGIC-COOKIE-1 of display `number`: this machine's own before one for any machine, and that
 * before another's (tunnels). False when there is none. */
bool x11_find_cookie(int number, uint8_t cookie[X11_COOKIE]);

#endif

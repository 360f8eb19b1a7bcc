/* SPDX-License-Identifier: MIT */
/* x_server.h - an X server that says what it is told to, whatever it is asked: for clients that must stand any. */
#ifndef SMEAR_TESTS_X_SERVER_H
#define SMEAR_TESTS_X_SERVER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What a greeting says; the rest of it is like other servers'. */
struct x_greeting {
    unsigned max_request;       /* in words */
    uint8_t min_key, max_key;
    uint8_t depth, bits, pad;   /* of the root's pixels */
    uint32_t mask[3];
};

enum { X_GREETING = 8 + 32 + 8 + 8 + 40 + 8 + 24 };

/* That of a server of today: 24 bits in 32, rows of whole words. */
struct x_greeting x_greeting_usual(void);

/* Its bytes, in this machine's order. */
void x_greeting_write(const struct x_greeting *greeting, uint8_t out[X_GREETING]);

/* Listens, points $DISPLAY there, and says these bytes to whoever comes; one at a time. False: no such sockets here. */
bool x_server_begin(const uint8_t *bytes, size_t size);
void x_server_end(void);

#endif

/* SPDX-License-Identifier: MIT */
/* x11_auth.h - the cookie that opens a display, from $XAUTHORITY or ~/.Xauthority. */
#ifndef SMEAR_TOOLS_VIEW_X11_AUTH_H
#define SMEAR_TOOLS_VIEW_X11_AUTH_H

#include <stdbool.h>
#include <stdint.h>

enum { X11_COOKIE = 16 };

/* MIT-MAGIC-COOKIE-1 of display `number`: this machine's own before one for any machine, and that
 * before another's (tunnels). False when there is none. */
bool x11_find_cookie(int number, uint8_t cookie[X11_COOKIE]);

#endif

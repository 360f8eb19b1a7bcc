/* SPDX-License-Identifier: MIT */
/* display.h - what the demo needs of a machine besides platform.h: somewhere to show frames, and
 * keys. A port has one file that defines these functions. */
#ifndef SMEAR_DISPLAY_H
#define SMEAR_DISPLAY_H

#include <smear.h>
#include <stdbool.h>
#include <stdint.h>

/* Makes the display ready. `desc` comes with the size and format that the demo would like, and
 * leaves with what it will be: width, height, format, bands, flush, user and idle. False when there
 * is no display or it cannot show this format. */
bool display_open(smear_desc *desc);

/* The context whose bands will come; for smear_band_done. Called after smear_init. */
void display_attach(smear_context *ctx);

/* All bands of the frame have been flushed: waits until they have arrived, and makes them visible. */
void display_show(void);

/* The frame stays in view for a moment. False where nobody is looking: the program may end. */
bool display_wait(void);

/* Milliseconds since the display was opened. */
uint32_t display_time(void);

enum display_key {
    KEY_UP = 1, KEY_DOWN = 2, KEY_LEFT = 4, KEY_RIGHT = 8,
    KEY_A = 16,                     /* select on boards with one button */
    KEY_START = 32
};

/* display_keys which are held down; 0 on a machine without keys. */
unsigned display_keys(void);

#endif

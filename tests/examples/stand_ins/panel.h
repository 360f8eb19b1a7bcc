/* SPDX-License-Identifier: MIT */
/* panel.h - the panel behind the stand-ins: their functions end in a window of it and bytes for that. What a library
 * sends by DMA is read when that is over, as hardware might, so a band that is drawn over too early shows. */
#ifndef STAND_INS_PANEL_H
#define STAND_INS_PANEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#ifdef SMALL_PANEL
enum { PANEL_WIDTH = 128, PANEL_HEIGHT = 64 };      /* eight pixels of a column in a byte */
#elif defined(TALL_PANEL)
enum { PANEL_WIDTH = 240, PANEL_HEIGHT = 320 };     /* 16 bits a pixel */
#elif defined(WIDE_PANEL)
enum { PANEL_WIDTH = 400, PANEL_HEIGHT = 240 };     /* eight pixels of a row in a byte, rows of 52 bytes */
#else
enum { PANEL_WIDTH = 240, PANEL_HEIGHT = 240 };     /* 16 bits a pixel, high byte first */
#endif

static uint8_t panel_memory[PANEL_WIDTH * PANEL_HEIGHT * 2];
static int panel_x, panel_y, panel_width, panel_height, panel_at;

static inline void panel_window(int x, int y, int width, int height)
{
    panel_x = x, panel_y = y, panel_width = width, panel_height = height, panel_at = 0;
}

static inline void panel_bytes(const void *from, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++, panel_at++)
        if (panel_at / 2 < panel_width * panel_height)
            panel_memory[2 * ((panel_y + panel_at / 2 / panel_width) * PANEL_WIDTH + panel_x + panel_at / 2 % panel_width)
                         + panel_at % 2] = ((const uint8_t *)from)[i];
}

/* Commands of an ST7789 and their data. */
static inline void panel_wire(bool is_data, const uint8_t *from, size_t bytes)
{
    static uint8_t command, first[2][2], last[2][2];
    if (!is_data) {
        command = *from;
        if (command == 0x2c)
            panel_window(first[0][0] << 8 | first[0][1], first[1][0] << 8 | first[1][1],
                         (last[0][0] << 8 | last[0][1]) - (first[0][0] << 8 | first[0][1]) + 1,
                         (last[1][0] << 8 | last[1][1]) - (first[1][0] << 8 | first[1][1]) + 1);
    } else if (command == 0x2a || command == 0x2b) {
        memcpy(first[command - 0x2a], from, 2);
        memcpy(last[command - 0x2a], from + 2, 2);
    } else if (command == 0x2c) {
        panel_bytes(from, bytes);
    }
}

/* A band on its way. */
static struct { const void *from; size_t bytes; int x, y, width, height; } panel_queue[2];
static int panel_queued;

static inline void panel_queue_band(int x, int y, int width, int height, const void *from)
{
    panel_queue[panel_queued].from = from;
    panel_queue[panel_queued].bytes = 2u * (size_t)width * (size_t)height;
    panel_queue[panel_queued].x = x;
    panel_queue[panel_queued].y = y;
    panel_queue[panel_queued].width = width;
    panel_queue[panel_queued++].height = height;
}

static inline void panel_send_first(void)
{
    panel_window(panel_queue[0].x, panel_queue[0].y, panel_queue[0].width, panel_queue[0].height);
    panel_bytes(panel_queue[0].from, panel_queue[0].bytes);
    panel_queue[0] = panel_queue[1];
    panel_queued--;
}

static inline void panel_save(void) { fwrite(panel_memory, 1, sizeof panel_memory, stdout); }

#endif

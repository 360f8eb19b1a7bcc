/* SPDX-License-Identifier: MIT */
/* display.c - display.h in a page: a picture in the module's memory, which the page copies to its canvas. The page has the loop,
 * the clock and the keys: nothing waits here. */
#include "platform/display.h"

#include <stddef.h>

#define EXPORT(name) __attribute__((export_name(#name)))

enum { MOST_PIXELS = 640 * 480 };

static struct {
    uint32_t rgba[MOST_PIXELS];     /* red in the lowest byte, as canvases want it */
    int32_t width, height;
    uint32_t shown;                 /* frames so far */
    uint32_t time;                  /* milliseconds */
    unsigned keys;
    bool has_page;                  /* else nobody would end a loop of display_show */
} screen;

EXPORT(wasm_picture) const uint32_t *wasm_picture(void)
{
    return screen.rgba;
}

EXPORT(wasm_width) int32_t wasm_width(void)
{
    return screen.width;
}

EXPORT(wasm_height) int32_t wasm_height(void)
{
    return screen.height;
}

EXPORT(wasm_shown) uint32_t wasm_shown(void)
{
    return screen.shown;
}

/* Before each turn: the time so far, and the keys that are held. */
EXPORT(wasm_set) void wasm_set(uint32_t milliseconds, unsigned keys)
{
    screen.time = milliseconds;
    screen.keys = keys;
    screen.has_page = true;
}

static int flush(void *user, const smear_band *band)
{
    (void)user;
    for (int32_t y = 0; y < band->height; y++) {
        const uint32_t *from = (const uint32_t *)band->pixels + (uint32_t)y * (band->stride / 4u);
        uint32_t *to = screen.rgba + (band->y + y) * screen.width + band->x;
        for (int32_t x = 0; x < band->width; x++)
            to[x] = 0xff000000u | (from[x] & 0xff00u) | (from[x] & 255u) << 16 | (from[x] >> 16 & 255u);
    }
    return 0;
}

bool display_open(smear_desc *desc)
{
    if (!screen.has_page || desc->format != SMEAR_XRGB8888 || desc->width * desc->height > MOST_PIXELS)
        return false;
    desc->bands = 1;
    desc->flush = flush;
    screen.width = desc->width;
    screen.height = desc->height;
    return true;
}

void display_attach(smear_context *ctx)
{
    (void)ctx;
}

void display_show(void)
{
    screen.shown++;
}

bool display_wait(void)
{
    return true;
}

uint32_t display_time(void)
{
    return screen.time;
}

unsigned display_keys(void)
{
    return screen.keys;
}

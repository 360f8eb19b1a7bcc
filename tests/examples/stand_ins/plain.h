/* SPDX-License-Identifier: MIT */
/* plain.h - what the others are compared with: bands go straight to the panel. */
#include "panel.h"

#ifdef SMALL_PANEL
#define SCREEN_WIDTH 128
#define SCREEN_HEIGHT 64
#define SCREEN_FORMAT SMEAR_L1_PAGES
#elif defined(TALL_PANEL)
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 320
#define SCREEN_FORMAT SMEAR_RGB565
#elif defined(WIDE_PANEL)
#define SCREEN_WIDTH 400
#define SCREEN_HEIGHT 240
#define SCREEN_FORMAT SMEAR_L1
#else
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED
#endif

static int display_flush(void *user, const smear_band *band)
{
    (void)user;
#ifdef SMALL_PANEL
    memcpy(panel_memory + band->y / 8 * PANEL_WIDTH, band->pixels, band->size);
#elif defined(WIDE_PANEL)
    for (int y = 0; y < band->height; y++)
        memcpy(panel_memory + 52 * (band->y + y), (const uint8_t *)band->pixels + y * band->stride, 50);
#else
    panel_window(band->x, band->y, band->width, band->height);
    panel_bytes(band->pixels, band->size);
#endif
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc) { desc->flush = display_flush; }

/* SPDX-License-Identifier: MIT */
/* adafruit_gfx.h - smear on a colour display of Adafruit_GFX: any whose class is an Adafruit_SPITFT. */
#include <Adafruit_ST7789.h>

#ifndef SCREEN_WIDTH
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#endif
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED

static Adafruit_ST7789 tft(10, 9, 8);   /* chip select, data/command, reset */

static int display_flush(void *, const smear_band *band)
{
    tft.startWrite();
    tft.setAddrWindow(band->x, band->y, band->width, band->height);
    tft.writePixels((uint16_t *)band->pixels, band->size / 2, true, true);   /* waits; high byte first */
    tft.endWrite();
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc)
{
    tft.init(SCREEN_WIDTH, SCREEN_HEIGHT);
    desc->flush = display_flush;
}

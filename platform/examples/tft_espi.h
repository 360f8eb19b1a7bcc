/* SPDX-License-Identifier: MIT */
/* tft_espi.h - smear on a display of TFT_eSPI, whose pins User_Setup.h names. */
#if defined(CONFIG_IDF_TARGET_ESP32P4) || defined(CONFIG_IDF_TARGET_ESP32C6) || defined(PICO_RP2350)
#error "TFT_eSPI knows neither ESP32-P4 and C6 nor RP2350: take LovyanGFX or Arduino_GFX"
#endif
#include <TFT_eSPI.h>

#ifndef SCREEN_WIDTH
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#endif
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED

static TFT_eSPI tft;

static int display_flush(void *, const smear_band *band)
{
    tft.startWrite();
    tft.setAddrWindow(band->x, band->y, band->width, band->height);
    tft.pushPixels(band->pixels, band->size / 2);
    tft.endWrite();
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc)
{
    tft.init();
    tft.setSwapBytes(false);            /* bands are as the panel wants them */
    desc->flush = display_flush;
}

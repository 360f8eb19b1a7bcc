/* SPDX-License-Identifier: MIT */
/* lovyangfx.h - smear on a display of LovyanGFX: a band is sent by DMA while the next is drawn. */
#include <LovyanGFX.hpp>
#include <LGFX_AUTODETECT.hpp>

#ifndef SCREEN_WIDTH
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#endif
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED
#define SCREEN_BANDS 2

static LGFX lcd;
static bool sending;

/* Waits for the band that is being sent, if one is. */
static void display_idle(void *)
{
    if (!sending)
        return;
    lcd.waitDMA();
    sending = false;
    smear_band_done(ctx);
}

static int display_flush(void *, const smear_band *band)
{
    display_idle(nullptr);
    lcd.pushImageDMA(band->x, band->y, band->width, band->height, (const lgfx::swap565_t *)band->pixels);
    sending = true;
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc)
{
    lcd.init();
    lcd.startWrite();                   /* the bus is the display's own from here on */
    desc->flush = display_flush;
    desc->idle = display_idle;
}

/* SPDX-License-Identifier: MIT */
/* arduino_gfx.h - smear on a display of Arduino_GFX. */
#include <Arduino_GFX_Library.h>

#ifndef SCREEN_WIDTH
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 240
#endif
#define SCREEN_FORMAT SMEAR_RGB565_SWAPPED

static Arduino_GFX *gfx = new Arduino_ST7789(create_default_Arduino_DataBus(), 8 /* reset */, 0, true, SCREEN_WIDTH, SCREEN_HEIGHT);

static int display_flush(void *, const smear_band *band)
{
    gfx->draw16bitBeRGBBitmap(band->x, band->y, (uint16_t *)band->pixels, band->width, band->height);
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc)
{
    gfx->begin();
    desc->flush = display_flush;
}

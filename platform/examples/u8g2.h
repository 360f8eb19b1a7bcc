/* SPDX-License-Identifier: MIT */
/* u8g2.h - smear on a monochrome display of u8g2, through its U8x8 half: no frame in memory. */
#include <U8x8lib.h>

#ifndef SCREEN_WIDTH
#define SCREEN_WIDTH 128
#define SCREEN_HEIGHT 64
#endif
#define SCREEN_FORMAT SMEAR_L1_PAGES

static U8X8_SSD1306_128X64_NONAME_HW_I2C oled(U8X8_PIN_NONE);

/* Pages are rows of U8x8's tiles of 8 by 8 pixels. */
static int display_flush(void *, const smear_band *band)
{
    uint8_t *page = (uint8_t *)band->pixels;
    for (int y = band->y; y < band->y + band->height; y += 8, page += band->stride)
        oled.drawTile(band->x / 8, y / 8, band->width / 8, page);
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc)
{
    oled.begin();
    desc->flush = display_flush;
}

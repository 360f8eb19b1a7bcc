/* SPDX-License-Identifier: MIT */
/* ili9341_t4.h - smear on an ILI9341 at a Teensy 4.0 or 4.1, by ILI9341_T4: it compares frames, sends what differs by DMA and
 * keeps behind the panel's scan line, so that nothing tears. */
#include <ILI9341_T4.h>

#ifndef SCREEN_WIDTH
#define SCREEN_WIDTH 240
#define SCREEN_HEIGHT 320
#endif
#define SCREEN_FORMAT SMEAR_RGB565

static ILI9341_T4::ILI9341Driver tft(9, 10, 13, 11, 12, 6, 255, 255);   /* select, command, clock, data out and in, reset, no touch */
static ILI9341_T4::DiffBuffStatic<8000> difference[2];
DMAMEM static uint16_t shown[SCREEN_WIDTH * SCREEN_HEIGHT], drawn[SCREEN_WIDTH * SCREEN_HEIGHT];

static int display_flush(void *, const smear_band *band)
{
    memcpy(drawn + band->y * SCREEN_WIDTH, band->pixels, band->size);
    if (band->y + band->height == SCREEN_HEIGHT)
        tft.update(drawn);
    return SMEAR_OK;
}

static void display_begin(smear_desc *desc)
{
    tft.begin(30000000);
    tft.setFramebuffer(shown);
    tft.setDiffBuffers(&difference[0], &difference[1]);
    tft.setRefreshRate(90);
    tft.setVSyncSpacing(2);
    desc->flush = display_flush;
}
